#include "lib/commands/log_follower.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "lib/commands/first_load.hpp"
#include "lib/commands/progress_line.hpp"
#include "lib/commands/usual_deviations.hpp"
#include "lib/files/deserved_digits.hpp"
#include "lib/files/file_text.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/number_range.hpp"
#include "lib/files/output_file.hpp"
#include "lib/files/plausible_scene.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/files/status_text.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/capacities.hpp"
#include "lib/kinds/condensed_arrays.hpp"
#include "taut/estimation/jump_guard.hpp"

namespace taut::host {
namespace {

constexpr const char* standard_input = "standard input";
constexpr double most_bend_change = 0.1;
// Beyond them direction cosines are off by a thousandth, and by a fiftieth.
constexpr double most_turn = 0.05, most_turn_of_second_order = 0.2;
constexpr int most_tried = 1000000;  // load steps a row

Sentence under_load() {
  return Sentence(
      "the log begins under load: until the cables have slid over all joints their forces are those of any "
      "past; --state FILE goes on from the log before");
}

Sentence taken_for_unloaded(const std::string& cables) {
  return Sentence(
      "only wedges hold {1} in the first row, and no load cell reads what they hold: they are taken to be "
      "without load; if they were pulled before, --state FILE goes on from the log before",
      {cables});
}

Sentence unread(const std::string& cables) {
  if (cables.empty())
    return Sentence(
        "no load cell is read that tells of the jacks: nothing is known of the forces until one is; --state "
        "FILE goes on from the log before");
  return Sentence(
      "only wedges hold {1}, and no load cell reads what they hold: nothing is known of their forces until a "
      "jack pulls; --state FILE goes on from the log before",
      {cables});
}

LogRules rules_for(const RunOptions& options, const SceneDescription& scene) {
  LogRules rules;
  rules.are_readings = options.method == Method::estimate;
  if (rules.are_readings) rules.shortest_step = shortest_step;
  // Without an answer, start() says why.
  const CondensedArrays condensed = condense(scene, options.numbers.scalar);
  rules.most_factor = condensed.most_factor;
  rules.most_force = condensed.most_force;
  if (scene.plausible)
    for (const CableDescription& cable : scene.cables)
      rules.most_plausible_force.push_back(largest_plausible_strain * cable.E * cable.A);
  return rules;
}

// With the displacements that are looked at.
SceneDescription watched_scene(const RunOptions& options) {
  SceneDescription scene = read_scene_file(options.scene);
  if (options.method != Method::stepwise) scene.watched = MemberTurns::watched(scene);
  return scene;
}

// With what is asked for beyond the columns of every result.
SceneDescription scene_for(const RunOptions& options) {
  SceneDescription scene = watched_scene(options);
  const std::vector<std::string>& names = options.choice.columns;
  if (options.method == Method::stepwise)
    for (const std::string& further : further_columns(scene, ResultColumns::state))
      if (std::find(names.begin(), names.end(), further) != names.end())
        throw InputError("--columns", "", "the method stepwise does not give " + quote(further),
                         "leave the column out, or use the method tracker");
  if (options.method == Method::tracker) scene.displaced = displacements_among(names, scene);
  if (scene.displaced.size() > static_cast<std::size_t>(most_displacements))
    throw InputError("--columns", "", std::to_string(scene.displaced.size()) + " displacements are too many",
                     "ask for at most " + std::to_string(most_displacements));
  return scene;
}

std::string name_of(ScalarType scalar) { return scalar == ScalarType::float32 ? "float" : "double"; }

// A place, and where on the path to it the answer ends, if that is known.
Sentence part_of_path(const Sentence& place, double fraction) {
  if (fraction <= 0 || fraction > 1) return place;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", 100 * fraction);
  return Sentence("{1}, after {2} % of the path to it", {place, std::string(text.data())});
}

// Rows on a terminal show themselves how far the run is.
bool wants_progress(const RunOptions& options) {
  return standard_error_is_terminal() && !(options.output.empty() && standard_output_is_terminal());
}

}  // namespace

Sentence reason_to_stop(const Followed& path, const SceneDescription& scene) {
  if (!path.status) return failure_text(path.status, scene);
  // Rows in between give more events to what goes on; what stands still they do not help.
  if (!(path.fraction > 0))
    return Sentence(
        "the event budget is spent at one load: joints go on changing between sticking and sliding there; "
        "stay below this load");
  return Sentence(
      "the event budget is spent: too many changes between sticking and sliding; add rows in between");
}

LogFollower::LogFollower(const RunOptions& options)
    : options_(options),
      scene_(scene_for(options)),
      model_(make_model(scene_, options.method, options.numbers.scalar, options.limits)),
      rules_(rules_for(options, scene_)),
      verdict_(scene_),
      turns_(scene_) {
  keep_inputs(options.output, {options.scene, options.log, options.state});
  keep_inputs(options.state, {options.scene, options.log});
  keep_apart(options.output, options.state, "the output and the state of one run");
  require_writable(options.state);
  if (options.log == "-") {
    source_.emplace(LogStream{std::cin, standard_input, "", {}, {}, {}});
    read_state();
    open_stream();
  } else {
    read_log();
  }
  remark_on_substeps();
}

LogFollower::LogFollower(const RunOptions& options, LogStream stream)
    : options_(options),
      scene_(watched_scene(options)),
      model_(make_model(scene_, options.method, options.numbers.scalar, options.limits)),
      rules_(rules_for(options, scene_)),
      source_(std::move(stream)),
      verdict_(scene_),
      turns_(scene_) {
  if (!source_->state.empty()) take_state(options.state, source_->state);
  open_stream();
}

// The whole of it is checked before anything is computed.
void LogFollower::read_log() {
  std::vector<Sentence> left_out;
  PlausibleLog plausible(scene_);
  const bool measures = options_.method == Method::estimate;
  rows_ = check_log(options_.log, scene_, rules_, &left_out, [&](const LogRow& row) {
    if (measures) plausible.take(row);
  });
  read_state();
  std::ifstream stream = open_log(options_.log);
  for (const Sentence& sentence : left_out) remark(sentence);
  const LogReader log(stream, options_.log, scene_, rules_);
  if (measures) {
    plausible.require(log, options_.log, begun_.has_value());
    for (const Sentence& doubt : plausible.doubts()) remark(doubt);
    bring_into_time(plausible);
  }
  remark_on_columns(log);
  if (begun_)
    fill_in_mu_deviations(scene_);
  else if (measures)
    for (const Sentence& taken : fill_in_deviations(options_.log, rules_, scene_)) remark(taken);
}

void LogFollower::bring_into_time(const PlausibleLog& plausible) {
  const std::vector<LateFarEnd> late = plausible.late_far_ends();
  for (const LateFarEnd& each : late) remark(each.remark);
  if (!late.empty()) late_ends_ = std::make_unique<FarEndsInTime>(options_.log, scene_, rules_, late);
}

// What is not in its header is not known.
void LogFollower::open_stream() {
  stream_ = std::make_unique<LogReader>(source_->text, source_->name, scene_, rules_);
  remark_on_columns(*stream_);
  if (begun_)
    fill_in_mu_deviations(scene_);
  else if (options_.method == Method::estimate)
    for (const Sentence& taken : fill_in_deviations(*stream_, scene_)) remark(taken);
}

Sentence LogFollower::follow(const RowVisitor& visit) {
  const Followed start =
      begun_ ? model_->restore(begun_->bytes, begun_->time) : model_->start(options_.substeps);
  if (!start.whole())
    return Sentence("{1}: {2}: {3}",
                    {options_.scene, part_of_path(Sentence("before the first row"), start.fraction),
                     reason(start, [&](int substeps) { return model_->start(substeps); })});
  if (begun_) {
    last_.time = begun_->time;
    last_.factor = begun_->factor;
    last_.cables = begun_->cables;
    origin_ = begun_->origin;
    verdict_ = LogVerdict(scene_, begun_->verdict);
  }
  begin();
  if (is_stream()) return follow_stream(visit);
  std::ifstream file = open_log(options_.log);
  LogReader log(file, options_.log, scene_, rules_);
  return follow(log, visit);
}

Sentence LogFollower::go_on(LogStream stream, const RowVisitor& visit) {
  source_.emplace(std::move(stream));
  stream_ = std::make_unique<LogReader>(source_->text, source_->name, scene_, rules_);
  left_out_ = 0;
  remark_on_new_columns(*stream_);
  return follow_stream(visit);
}

// Of a stream, the first row has to say whether there was a load before, until the second one does.
void LogFollower::begin() {
  if (begun_ || options_.method != Method::estimate) return;
  if (is_stream()) {
    first_load_ = std::make_unique<FirstLoad>(rules_, scene_);
    model_->doubt_past();
  } else {
    const FirstLoad load = first_load_of(options_.log, rules_, scene_);
    if (!load.is_silent() && !load.is_under_load()) return remark_on_unloaded(load);
    remark(load.is_silent() ? unread(load.unread()) : under_load());
    model_->forget_past();
  }
}

// Load steps that jam are tried smaller: whether that helps nobody knows beforehand.
Sentence LogFollower::reason(const Followed& path, const std::function<Followed(int)>& again) const {
  if (options_.method != Method::stepwise || path.status.code != Code::state_iterations)
    return reason_to_stop(path, scene_);
  for (const int times : {10, 100})
    if (const int substeps = std::min(options_.substeps, most_tried / times) * times; again(substeps).whole())
      return failure_text(path.status, scene_,
                          Sentence("with --substeps {1} it goes on", {std::to_string(substeps)}));
  return failure_text(path.status, scene_, Sentence("smaller load steps do not help: try --method tracker"));
}

Sentence LogFollower::follow(LogReader& log, const RowVisitor& visit) {
  LogRow row = log.first_row();
  if (begun_) {
    row.factor = last_.factor;
    row.cables = last_.cables;
    log.count_from(origin_);
    if (late_ends_) late_ends_->count_from(origin_);
  }
  Answer answer;
  ProgressLine progress(rows_, wants_progress(options_));
  bool is_first = true;
  while (log.next(row)) {
    if (is_first) require_later(log, row);
    is_first = false;
    origin_ = log.origin();
    if (late_ends_) late_ends_->correct(row);
    if (Sentence end = follow_row(row, answer, visit); !end.empty()) return end;
    progress.reach(row.row);
  }
  return {};
}

// What a state has taken already would teach the same once more. Only dates tell; time in seconds may begin
// anew in every log.
void LogFollower::require_later(const LogReader& log, const LogRow& row) const {
  if (!begun_ || !begun_->origin || !log.origin() || row.time > begun_->time) return;
  throw InputError(
      options_.log, log.place(row.line, "time"),
      "the row is not later than the last one that the state " + quote(options_.state) + " has taken",
      "give a log that goes on from there, or another file for the state");
}

Sentence LogFollower::follow_stream(const RowVisitor& visit) {
  if (source_->begins) source_->begins();
  LogRow row = stream_->first_row();
  const bool goes_on = begun_ || followed_ > 0;
  if (goes_on) {
    row.factor = last_.factor;
    row.cables = last_.cables;
    stream_->count_from(origin_);
  }
  const double last_time = last_.time;
  bool is_first = true, is_known = false;
  Answer answer;
  while (next_of_stream(row)) {
    if (is_first) is_known = goes_on && source_->is_known && source_->is_known();
    if (is_first && !is_known) require_later(*stream_, row);
    is_first = false;
    remark_on_left_out(*stream_);
    if (is_known && row.time <= last_time) continue;
    is_known = false;
    origin_ = stream_->origin();
    if (first_load_) take_first_load(row);
    if (Sentence end = follow_row(row, answer, visit); !end.empty()) return end;
  }
  return {};
}

// The next row that can be used; what is left out is as if it were not there.
bool LogFollower::next_of_stream(LogRow& row) {
  if (!source_->leaves_out) return stream_->next(row);
  std::optional<double> after;  // a reader that begins anew does not know the time of the row before
  while (true) {
    const LogRow before = row;
    try {
      if (!stream_->next(row)) return false;
      if (after && !(row.time - *after >= rules_.shortest_step && row.time > *after))
        throw InputError(
            source_->name, "",
            "the time " + plain(row.time) + " is not after " + plain(*after) + " of the row before",
            "let the time increase from row to row");
      return true;
    } catch (const InputError& error) {
      if (!source_->leaves_out(error)) throw;
      if (!after && before.row > 0) after = before.time;
      row = before;
      const std::optional<Moment> origin = stream_->origin();
      stream_ = std::make_unique<LogReader>(source_->text, source_->name, scene_, rules_);
      stream_->count_from(origin);
      left_out_ = 0;
    }
  }
}

// Returns why it has no answer; empty if it has one.
Sentence LogFollower::follow_row(const LogRow& row, Answer& answer, const RowVisitor& visit) {
  if (const Followed path = model_->advance(row, options_.substeps); !path.whole())
    return Sentence("{1}{2}: {3}",
                    {part_of_path(place(row), path.fraction), loads_at_end(path, row),
                     reason(path, [&](int substeps) { return model_->advance(row, substeps); })});
  model_->read(answer);
  if (const std::string number = impossible_number(scene_, answer); !number.empty())
    return Sentence("{1}: {2}; {3}", {place(row), number, Sentence(remedy_of_impossible_numbers)});
  warn_of_bend(row, answer);
  warn_of_turn(row);
  const bool is_stage = followed_ > 0 && JumpGuard<double>::is_stage(row.time - last_.time);
  if (options_.method == Method::estimate) answer.verdict = verdict_.take(row, answer.alarms, is_stage);
  ++followed_;
  last_ = row;
  visit(row, answer);
  return {};
}

// The forces of the jacks where something runs away.
std::string LogFollower::loads_at_end(const Followed& path, const LogRow& row) const {
  if (path.status.code != Code::gives_way) return "";
  Answer reached;
  model_->read(reached);
  std::string loads;
  std::size_t segment = 0;
  for (std::size_t c = 0; c < scene_.cables.size(); ++c) {
    const CableDescription& cable = scene_.cables[c];
    for (std::size_t end = 0; end < 2; ++end) {
      if (!cable.is_jacked(end) || row.cables[c][end].locked) continue;
      std::array<char, 32> force{};
      std::snprintf(force.data(), force.size(), "%.6g",
                    reached.tension[end == 0 ? segment : segment + cable.segments() - 1]);
      loads += ", " + cable.name + "." + end_name(end) + " " + force.data() + " N";
    }
    segment += cable.segments();
  }
  return loads;
}

// Once, where displacements become too large for second-order theory.
void LogFollower::warn_of_bend(const LogRow& row, const Answer& answer) {
  if (bends_too_far_) return;
  int joint = 0;
  for (std::size_t c = 0; c < scene_.cables.size(); ++c)
    for (std::size_t j = 0; j < scene_.cables[c].joints(); ++j, ++joint) {
      const double change = static_cast<std::size_t>(joint) < answer.bend_change.size()
                                ? answer.bend_change[static_cast<std::size_t>(joint)]
                                : 0;
      if (!(std::fabs(change) > most_bend_change)) continue;
      std::array<char, 16> percent{};
      std::snprintf(percent.data(), percent.size(), "%.0f %%", 100 * std::fabs(change));
      bends_too_far_ = true;
      const Sentence bend = Sentence(change < 0 ? "the cable is bent by {1} less than in the scene"
                                                : "the cable is bent by {1} more than in the scene",
                                     {std::string(percent.data())});
      return remark(
          Sentence("{1}: {2}: {3}; second-order theory is made for a tenth: beyond it compare with a program "
                   "for large displacements",
                   {place(row), joint_text(scene_, static_cast<int>(c), static_cast<int>(j)), bend}));
    }
}

// Once, where displacements are no small ones.
void LogFollower::warn_of_turn(const LogRow& row) {
  if (turns_too_far_ || !turns_.are_wanted(row)) return;
  const std::optional<MemberTurn> most = turns_.largest(model_->watched());
  if (!most || !(most->turn > (scene_.second_order ? most_turn_of_second_order : most_turn))) return;
  turns_too_far_ = true;
  std::array<char, 24> metres{}, percent{};
  std::snprintf(metres.data(), metres.size(), "%.3g", most->displacement);
  std::snprintf(percent.data(), percent.size(), "%.3g %%", 100 * most->turn);
  const Sentence moved(
      "node {1} has moved by {2} m, and against node {3} by {4} of their distance",
      {quote(scene_.nodes[static_cast<std::size_t>(most->node)].name), std::string(metres.data()),
       quote(scene_.nodes[static_cast<std::size_t>(most->other)].name), std::string(percent.data())});
  remark(
      scene_.second_order
          ? Sentence("{1}: {2}; second-order theory is made for displacements up to a fifth of it: beyond it "
                     "do not trust its forces, compare with a program for large displacements",
                     {place(row), moved})
          : Sentence(
                "{1}: {2}; linear theory is made for displacements up to a twentieth of it: beyond it do "
                "not trust its forces, and give the scene \"second_order\"",
                {place(row), moved}));
}

// Before the row is followed.
void LogFollower::take_first_load(const LogRow& row) {
  first_load_->take(row);
  if (first_load_->is_silent()) {
    if (followed_ == 0) remark(unread(first_load_->unread()));
  } else if (!first_load_->is_under_load()) {
    remark_on_unloaded(*first_load_);
    model_->deny_past();
    first_load_.reset();
  } else if (first_load_->telling() == 2 && model_->has_unknown_past()) {
    remark(under_load());
  } else if (followed_ > 0 && !model_->has_unknown_past()) {
    first_load_.reset();
  }
}

// Where no cable is known to be under load: else the past of all is doubted.
void LogFollower::remark_on_unloaded(const FirstLoad& load) {
  if (!load.unread().empty()) remark(taken_for_unloaded(load.unread()));
}

void LogFollower::remark_on_left_out(const LogReader& log) {
  for (; left_out_ < log.remarks().size(); ++left_out_) remark(log.remarks()[left_out_]);
}

void LogFollower::keep_state() const {
  if (options_.state.empty()) return;
  if (model_->has_unknown_past()) {
    std::cerr << "remark: no state is written: the log began under load, and the cables have not slid enough "
                 "since for their forces to be known\n";
    return;
  }
  OutputFile file(options_.state);
  file.write(state_text(present_state(), read_text(options_.scene, largest_text_file, "scene file")));
  file.finish();
}

std::optional<std::string> LogFollower::state() const {
  if (model_->has_unknown_past()) return std::nullopt;
  return state_text(present_state(), read_text(options_.scene, largest_text_file, "scene file"));
}

SavedState LogFollower::present_state() const {
  SavedState state;
  state.scalar = name_of(options_.numbers.scalar);
  state.assumed = assumptions(scene_);
  state.time = last_.time;
  state.origin = origin_;
  state.factor = last_.factor;
  state.cables = last_.cables;
  state.verdict = verdict_.memory();
  state.bytes = model_->save();
  return state;
}

void LogFollower::read_state() {
  if (options_.state.empty() || !std::filesystem::exists(options_.state)) return;
  take_state(options_.state, read_text(options_.state, largest_text_file, "state file"));
}

void LogFollower::take_state(const std::string& path, const std::string& text) {
  begun_ = taut::host::read_state(path, text, read_text(options_.scene, largest_text_file, "scene file"),
                                  name_of(options_.numbers.scalar));
  assume(begun_->assumed, scene_);
}

// What the state began without has no place in it.
void LogFollower::remark_on_new_columns(const LogReader& log) {
  const auto is_new = [&](const std::string& column, bool is_known) {
    if (log.has(column) && !is_known)
      remark(Sentence("column {1} is not used: the state began without it", {quote(column)}));
  };
  for (const CableDescription& cable : scene_.cables) {
    for (std::size_t end = 0; end < 2 && !cable.closed; ++end) {
      const std::string column = cable.name + "." + end_name(end);
      if (cable.is_jacked(end))
        is_new(column + ".stroke", cable.stroke[end].is_given);
      else
        is_new(column, cable.cell[end].sd.has_value());
    }
    for (std::size_t i = 0; i < cable.segments(); ++i)
      is_new(cable.name + ".T" + std::to_string(i + 1), cable.force[i].is_given);
  }
  for (std::size_t i = 0; i < scene_.struts.size(); ++i)
    is_new("strut" + std::to_string(i + 1), scene_.struts[i].gauge.is_given);
}

void LogFollower::remark(const Sentence& sentence) {
  std::cerr << "remark: " << sentence.english() << '\n';
  remarks_.push_back(sentence);
}

// Columns that are not there, and columns without effect.
void LogFollower::remark_on_columns(const LogReader& log) {
  const bool measures = options_.method == Method::estimate;
  if (begun_) return remark_on_new_columns(log);
  for (const LoadDescription& load : scene_.loads) {
    if (!log.has(load.name))
      remark(Sentence("the log has no column {1}: the factor of this load stays 0", {quote(load.name)}));
    for (const TemperatureDescription& given : load.temperatures)
      if (const CableDescription& cable = scene_.cables[static_cast<std::size_t>(given.cable)];
          cable.alpha == 0)
        remark(
            Sentence("the load {1} warms cable {2}, which has no \"alpha\": its temperature changes nothing",
                     {quote(load.name), quote(cable.name)}));
  }
  const auto remark_on_measurement = [&](const std::string& column) {
    if (!measures && log.has(column))
      remark(Sentence("column {1} is a measurement: simulate does not use it", {quote(column)}));
  };
  for (const CableDescription& cable : scene_.cables) {
    if (measures && cable.drift != 0)
      remark(Sentence("the drift of mu of cable {1} is not used yet: mu is taken to stay what it is",
                      {quote(cable.name)}));
    for (std::size_t end = 0; end < 2; ++end) {
      const std::string column = cable.name + "." + end_name(end);
      if (cable.is_jacked(end) && !log.has(column)) {
        remark(Sentence("the log has no column {1}: this jack force stays 0", {quote(column)}));
      }
      if (!measures && !cable.is_jacked(end) && log.has(column)) {
        remark(Sentence("column {1} is a measurement at an anchored end: simulate does not use it",
                        {quote(column)}));
      }
      remark_on_measurement(column + ".stroke");
    }
    for (std::size_t i = 0; i < cable.segments(); ++i)
      remark_on_measurement(cable.name + ".T" + std::to_string(i + 1));
  }
  for (std::size_t i = 0; i < scene_.struts.size(); ++i)
    remark_on_measurement("strut" + std::to_string(i + 1));
}

void LogFollower::remark_on_substeps() {
  if (options_.method == Method::tracker && options_.substeps > 1)
    remark(Sentence(
        "--substeps has no effect: the method tracker follows a row from event to event, not in steps"));
}

Sentence LogFollower::place(const LogRow& row) const {
  return Sentence("{1}: line {2} (row {3}, time {4} s)",
                  {is_stream() ? source_->name : options_.log, std::to_string(row.line),
                   std::to_string(row.row), plain(rounded(row.time, time_digits))});
}

}  // namespace taut::host
