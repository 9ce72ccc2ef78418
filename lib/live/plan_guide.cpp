#include "lib/live/plan_guide.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "lib/files/state_file.hpp"
#include "lib/plan/plan_log.hpp"

namespace taut::host {
namespace {

using Json = nlohmann::ordered_json;

// A jack is there when it is so near, of the largest force that it is to have; or as near as its gauge shows.
constexpr double near = 0.001;
// Ways that stay so near to a straight line are one: five times that.
constexpr double straight = 5;
// A jack that was stopped so far from its stage leaves another rest to plan for.
constexpr double off_stage = 0.005;
// A new plan is looked for when jacks have gone so far since the last time.
constexpr double far_enough = 0.02;
// Of a limit: a plan may go right up to it.
constexpr double beyond_limit = 1.005;
constexpr std::size_t usual_moves = 2;

double largest_force(const Plan& plan, std::size_t jack) {
  double own = 0, any = 0;
  for (const PlanStage& stage : plan.stages)
    for (std::size_t k = 0; k < stage.force.size(); ++k) {
      any = std::max(any, stage.force[k]);
      if (k == jack) own = std::max(own, stage.force[k]);
    }
  return own > 0 ? own : any > 0 ? any : 1;
}

std::vector<double> tolerances(const SceneDescription& scene, const Plan& plan) {
  std::vector<double> all;
  for (std::size_t k = 0; k < plan.jacks.size(); ++k) {
    const InstrumentDescription& cell = scene.cables[plan.jacks[k].cable].cell[plan.jacks[k].end];
    all.push_back(std::max({near * largest_force(plan, k), cell.sd.value_or(0), cell.resolution / 2}));
  }
  return all;
}

std::vector<double> times(double factor, std::vector<double> all) {
  for (double& each : all) each *= factor;
  return all;
}

PlanStage at_rest(std::size_t jacks) { return {std::vector<double>(jacks, 0), std::vector<char>(jacks, 0)}; }

std::string word_of(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return "plan-limit:" + name;
}

bool has_word(const std::string& words, const std::string& kind) {
  return words.compare(0, kind.size(), kind) == 0 || words.find(" " + kind) != std::string::npos;
}

Json json_of(const PlanStage& stage) { return {{"force", stage.force}, {"locked", stage.locked}}; }
PlanStage stage_from(const Json& json) {
  return {json.at("force").get<std::vector<double>>(), json.at("locked").get<std::vector<char>>()};
}

}  // namespace

PlanGuide::PlanGuide(const SceneDescription& scene, const PlanGoal& goal, const std::string& goal_text,
                     const Plan& plan, const std::optional<PriorOutcome>& prior)
    : scene_(scene),
      goal_(goal),
      goal_print_(fingerprint(goal_text)),
      jacks_(plan.jacks),
      tolerance_(tolerances(scene, plan)),
      finder_(plan.shape, plan.stages, at_rest(plan.jacks.size()), tolerance_),
      path_(times(straight, tolerance_)),
      now_(at_rest(plan.jacks.size())),
      moves_left_(goal.has_stages ? static_cast<std::size_t>(goal.stages) : usual_moves),
      planned_(known_mu(scene)),
      ahead_(plan.jacks.size()),
      asked_at_(plan.jacks.size(), 0) {
  take_outcome(plan, prior);
}

void PlanGuide::begin(const KnownMu& mu) { planned_ = mu; }

void PlanGuide::take_outcome(const Plan& plan, const std::optional<PriorOutcome>& prior) {
  stroke_ = plan.outcome.stroke;
  error_ = plan.outcome.error;
  expected_.reset();
  at_95_.reset();
  if (!prior || prior->failed == prior->draws) return;
  expected_ = prior->expected;
  at_95_ = prior->at_95;
}

PlanStage PlanGuide::stand(const LogRow& row, const Answer& answer) const {
  PlanStage stage = at_rest(jacks_.size());
  std::size_t first = 0;
  for (std::size_t c = 0; c < scene_.cables.size(); ++c) {
    for (std::size_t k = 0; k < jacks_.size(); ++k) {
      if (jacks_[k].cable != c) continue;
      stage.locked[k] = row.cables[c][jacks_[k].end].locked ? 1 : 0;
      // What the wedge holds is not what the jack did.
      stage.force[k] =
          stage.locked[k] != 0
              ? now_.force[k]
              : answer.tension[jacks_[k].end == 0 ? first : first + scene_.cables[c].segments() - 1];
    }
    first += scene_.cables[c].segments();
  }
  return stage;
}

std::optional<PlanRequest> PlanGuide::take(const LogRow& row, const Answer& answer,
                                           const std::vector<double>& factor, bool may_ask) {
  const PlanStage now = stand(row, answer);
  look_ahead(row, now);
  now_ = now;
  time_ = row.time;
  has_row_ = true;
  path_.take({now_, factor});
  const std::size_t before = finder_.present();
  finder_.take(row.time, now_);
  pass_stages(before);
  watch_limits(answer);
  if (!may_ask || is_planning_ || finder_.is_over() || has_word(answer.alarms, "unknown-past"))
    return std::nullopt;
  // What is left has a force in it that can still be chosen.
  if (forces_of(finder_.shape(), finder_.stages(), finder_.present()).empty()) return std::nullopt;
  const KnownMu mu{answer.mu, answer.mu_deviation};
  const std::optional<MuNews> found = news(mu);
  if (!found) return std::nullopt;
  return request(row.time, *found, mu);
}

// After a rest the estimator waits with the first steps of a pump until it is sure that they are no outliers:
// whoever pumps must not wait so long.
void PlanGuide::look_ahead(const LogRow& row, const PlanStage& now) {
  constexpr double stands = 0.25, steps = 3;
  for (std::size_t k = 0; k < jacks_.size(); ++k) {
    Ahead& ahead = ahead_[k];
    const std::optional<double>& reading = row.cables[jacks_[k].cable][jacks_[k].end].reading;
    const bool stood = has_row_ && std::fabs(now.force[k] - now_.force[k]) < stands * tolerance_[k];
    if (!stood || now.locked[k] != 0) {
      ahead.read = reading;
      ahead.by = 0;
      continue;
    }
    if (!reading) continue;
    if (!ahead.read) ahead.read = reading;
    const double step = *reading - *ahead.read;
    const int way = step > 0 ? 1 : -1;
    ahead.by = 0;
    if (std::fabs(step) <= steps * tolerance_[k]) continue;
    // Where a jack has turned the friction of its ram lets the reading go ahead alone.
    const double whole_play = 2 * scene_.cables[jacks_[k].cable].cell[jacks_[k].end].part * now.force[k];
    const double gone = way * (now.force[k] - finder_.memory().begin.force[k]);
    const double play = gone > straight * tolerance_[k] + whole_play ? 0 : whole_play;
    ahead.by = way * std::max(0.0, std::fabs(step) - play);
  }
}

// Of the stages that were left behind in this row.
void PlanGuide::pass_stages(std::size_t before) {
  for (std::size_t s = before; s < finder_.present(); ++s) {
    has_changed_ = true;
    const CourseStep& step = finder_.shape()[s];
    if (step.locks) continue;
    if (moves_left_ > 0) --moves_left_;
    for (const std::size_t k : step.jacks) {
      const double planned = finder_.stages()[s].force[k], stopped = finder_.memory().begin.force[k];
      if (s + 1 < finder_.present() && !finder_.is_skipped(s)) continue;
      if (std::fabs(stopped - planned) <= std::max(2 * tolerance_[k], off_stage * planned)) continue;
      const ForceUnit unit = ForceUnit::for_largest(planned);
      off_plan_ = jacks_[k].name + " went to " + unit.text(stopped) + " and not to " + unit.text(planned);
    }
  }
}

void PlanGuide::watch_limits(const Answer& answer) {
  const auto watch = [&](const std::string& name, double value, double most) {
    if (!(most < no_limit)) return;
    if (value > beyond_limit * most)
      raised_.insert(word_of(name));
    else if (value <= most)
      raised_.erase(word_of(name));
  };
  for (std::size_t k = 0; k < jacks_.size(); ++k) {
    const std::size_t c = jacks_[k].cable, end = jacks_[k].end;
    watch(jacks_[k].name, now_.force[k], goal_.most_force[c][end]);
    watch(jacks_[k].name + ".stroke", answer.extension[c][end], goal_.most_stroke[c][end]);
  }
  std::size_t segment = 0;
  for (const CableDescription& cable : scene_.cables)
    for (std::size_t i = 0; i < cable.segments(); ++i, ++segment)
      watch(cable.name + ".T" + std::to_string(i + 1), answer.tension[segment], goal_.most_segment[segment]);
}

bool PlanGuide::has_moved() const {
  for (std::size_t k = 0; k < jacks_.size(); ++k)
    if (std::fabs(now_.force[k] - asked_at_[k]) >= far_enough / near * tolerance_[k]) return true;
  return false;
}

std::optional<MuNews> PlanGuide::news(const KnownMu& mu) const {
  if (!off_plan_.empty()) return MuNews{off_plan_, true};
  if (!has_moved()) return std::nullopt;
  return mu_news(scene_, planned_, mu);
}

PlanRequest PlanGuide::request(double time, const MuNews& news, const KnownMu& mu) {
  PlanRequest asked;
  asked.time = time;
  asked.why = news.why;
  asked.mu = mu;
  asked.scene = with_mu(scene_, mu.mu, mu.sd);
  asked.past.moves = path_.moves();
  asked.past.rest.assign(finder_.shape().begin() + static_cast<std::ptrdiff_t>(finder_.present()),
                         finder_.shape().end());
  asked.past.force = forces_of(finder_.shape(), finder_.stages(), finder_.present());
  asked.past.moves_left = std::max<std::size_t>(1, moves_left_);
  asked.past.stays = !news.is_other;
  off_plan_.clear();
  asked_at_ = now_.force;
  is_planning_ = true;
  return asked;
}

void PlanGuide::take(const PlanFound& found) {
  is_planning_ = false;
  const PlanPast& past = found.request.past;
  // The jacks have gone on to another stage: what was found is not for it.
  const std::size_t left = finder_.stages().size() - finder_.present();
  if (left != past.rest.size()) {
    if (off_plan_.empty() && !past.stays) off_plan_ = found.request.why;
    return;
  }
  if (!past.stays) planned_.mu = found.request.mu.mu;
  planned_.sd = found.request.mu.sd;
  has_changed_ = true;
  if (!found.failure.empty()) {
    anew_.push_back({found.request.time, found.request.why + "; but there is no new plan: " + found.failure +
                                             ", the one before stays"});
    return;
  }
  if (!found.plan.is_as_before) {
    adopt(found);
    return;
  }
  const std::size_t first = finder_.present();
  for (std::size_t s = 0; s < left; ++s) stroke_[first + s] = found.plan.outcome.stroke[s];
  const std::vector<std::vector<double>> strokes = std::move(stroke_);
  take_outcome(found.plan, found.prior);
  stroke_ = strokes;
}

void PlanGuide::adopt(const PlanFound& found) {
  const PlanStage& from = found.request.past.moves.back().stage;
  const std::size_t present = finder_.present();
  for (std::size_t s = 0; s < present; ++s) passed_.push_back(stage_now(s));
  // A jack that is to turn where it stands has made a move.
  const CourseStep& step = finder_.shape()[present];
  PlanStageNow cut_short = stage_now(present);
  bool turns = false;
  for (const std::size_t k : step.jacks) {
    const int way = finder_.direction(k);
    const double moved = way * (from.force[k] - finder_.memory().begin.force[k]);
    cut_short.force[k] = from.force[k];
    turns = turns || (!step.locks && way != 0 && moved > straight * tolerance_[k] &&
                      way * (found.plan.stages[0].force[k] - from.force[k]) < -tolerance_[k]);
  }
  if (turns) {
    cut_short.passed = true;
    passed_.push_back(cut_short);
    if (moves_left_ > 0) --moves_left_;
  }
  take_outcome(found.plan, found.prior);
  // A jack that pulls on has not begun another stage.
  PlanStage first = from;
  if (!turns)
    for (const std::size_t k : step.jacks) first.force[k] = finder_.memory().begin.force[k];
  finder_ = StageFinder(found.plan.shape, found.plan.stages, first, tolerance_);
  anew_.push_back({found.request.time, found.request.why});
  finder_.take(time_, now_);
  pass_stages(0);
}

bool PlanGuide::take_change() { return std::exchange(has_changed_, false); }

PlanStageNow PlanGuide::stage_now(std::size_t stage) const {
  PlanStageNow now;
  now.locks = finder_.shape()[stage].locks;
  now.jacks = finder_.shape()[stage].jacks;
  now.force = finder_.stages()[stage].force;
  now.stroke = stroke_[stage];
  now.passed = stage < finder_.present();
  now.skipped = finder_.is_skipped(stage);
  return now;
}

PlanOrder PlanGuide::order_of(std::size_t k) const {
  const std::size_t present = finder_.present();
  PlanOrder order;
  order.jack = k;
  if (finder_.shape()[present].locks) {
    order.order = now_.locked[k] != 0 ? JackOrder::stop : JackOrder::lock;
    return order;
  }
  const int way = finder_.direction(k);
  const bool pulls = way >= 0;
  order.to = finder_.stages()[present].force[k];
  const double force = now_.force[k] + ahead_[k].by;
  order.to_go = (pulls ? 1 : -1) * (order.to - force);
  const InstrumentDescription& gauge = scene_.cables[jacks_[k].cable].cell[jacks_[k].end];
  if (!gauge.calibration.empty()) {
    order.gauge_to = gauge_shows(gauge, order.to, pulls);
    order.gauge_to_go = (pulls ? 1 : -1) * (*order.gauge_to - gauge_shows(gauge, force, pulls));
  }
  const bool is_there = finder_.is_reached(k) || way == 0 || order.to_go <= tolerance_[k];
  if (!is_there) order.order = pulls ? JackOrder::pull : JackOrder::let_out;
  if (!raised_.empty() && order.order == JackOrder::pull) order.order = JackOrder::stop;
  return order;
}

std::string PlanGuide::say(const std::vector<PlanOrder>& orders, const ForceUnit& unit) const {
  if (finder_.is_over()) return "all stages are passed";
  std::string text;
  if (!raised_.empty()) text = "STOP: a limit of the goal is passed";
  for (const PlanOrder& each : orders) {
    if (!raised_.empty() && each.order == JackOrder::stop) continue;
    text += text.empty() ? "" : "; ";
    const std::string& jack = jacks_[each.jack].name;
    const auto gauge = [](const std::optional<double>& reading) {
      return reading ? " (gauge " + significant(*reading, 4) + ")" : std::string();
    };
    if (each.order == JackOrder::lock)
      text += "lock " + jack;
    else if (each.order == JackOrder::stop)
      text += "STOP " + jack + ": " +
              (each.to_go < -straight * tolerance_[each.jack]
                   ? unit.text(-each.to_go) + " beyond " + unit.text(each.to)
                   : unit.text(each.to) + " is reached");
    else
      text += std::string(order_word(each.order)) + " " + jack + " to " + unit.text(each.to) +
              gauge(each.gauge_to) + ": " + unit.text(each.to_go) + gauge(each.gauge_to_go) + " to go";
  }
  return text;
}

PlanNow PlanGuide::now() const {
  PlanNow now;
  double largest = 0;
  for (const PlanJack& jack : jacks_) now.jacks.push_back(jack.name);
  now.stages = passed_;
  for (std::size_t s = 0; s < finder_.stages().size(); ++s) now.stages.push_back(stage_now(s));
  std::size_t moves = 0;
  for (PlanStageNow& stage : now.stages) {
    stage.name = stage.locks ? "lock" : std::to_string(++moves);
    for (const double force : stage.force) largest = std::max(largest, force);
  }
  now.unit = ForceUnit::for_largest(largest);
  now.present = passed_.size() + finder_.present();
  if (!finder_.is_over())
    for (const std::size_t k : finder_.shape()[finder_.present()].jacks) now.orders.push_back(order_of(k));
  now.say = say(now.orders, now.unit);
  now.error = error_;
  now.expected = expected_;
  now.at_95 = at_95_;
  now.is_planning = is_planning_;
  now.anew = anew_;
  now.alarms.assign(raised_.begin(), raised_.end());
  return now;
}

std::string PlanGuide::state() const {
  if (!has_row_) return "";
  Json json = {{"goal", goal_print_},   {"moves_left", moves_left_}, {"error", error_},
               {"off_plan", off_plan_}, {"asked_at", asked_at_},     {"stroke", stroke_},
               {"mu", planned_.mu},     {"sd", planned_.sd},         {"now", json_of(now_)},
               {"time", time_},         {"limits", raised_}};
  if (expected_ && at_95_) json["expected"] = {*expected_, *at_95_};
  for (const PlanStageNow& stage : passed_)
    json["passed"].push_back({{"locks", stage.locks},
                              {"jacks", stage.jacks},
                              {"force", stage.force},
                              {"stroke", stage.stroke},
                              {"skipped", stage.skipped}});
  for (std::size_t s = 0; s < finder_.stages().size(); ++s)
    json["stages"].push_back({{"locks", finder_.shape()[s].locks},
                              {"jacks", finder_.shape()[s].jacks},
                              {"to", json_of(finder_.stages()[s])}});
  const StageFinder::Memory& memory = finder_.memory();
  json["memory"] = {{"stage", memory.stage},       {"begin", json_of(memory.begin)},
                    {"extreme", memory.extreme},   {"reached", memory.reached},
                    {"still_at", memory.still_at}, {"still_since", memory.still_since},
                    {"skipped", memory.skipped}};
  for (const PastMove& move : path_.moves())
    json["path"].push_back({{"to", json_of(move.stage)}, {"factor", move.factor}});
  for (const PlanAnew& anew : anew_) json["anew"].push_back({{"time", anew.time}, {"why", anew.why}});
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

bool PlanGuide::go_on(const std::string& state) {
  const Json json = Json::parse(state, nullptr, false);
  if (!json.is_object() || json.value("goal", "") != goal_print_) return false;
  try {
    CourseShape shape;
    std::vector<PlanStage> stages;
    for (const Json& stage : json.at("stages")) {
      shape.push_back({stage.at("jacks").get<std::vector<std::size_t>>(), stage.at("locks").get<bool>()});
      stages.push_back(stage_from(stage.at("to")));
    }
    StageFinder finder(shape, stages, at_rest(jacks_.size()), tolerance_);
    const Json& kept = json.at("memory");
    finder.go_on({kept.at("stage").get<std::size_t>(), stage_from(kept.at("begin")),
                  kept.at("extreme").get<std::vector<double>>(), kept.at("reached").get<std::vector<char>>(),
                  kept.at("still_at").get<std::vector<double>>(),
                  kept.at("still_since").get<std::vector<double>>(),
                  kept.at("skipped").get<std::vector<char>>()});
    std::vector<PastMove> moves;
    for (const Json& move : json.at("path"))
      moves.push_back({stage_from(move.at("to")), move.at("factor").get<std::vector<double>>()});
    std::vector<PlanStageNow> passed;
    if (json.contains("passed"))
      for (const Json& stage : json.at("passed"))
        passed.push_back(
            {"", stage.at("locks").get<bool>(), stage.at("jacks").get<std::vector<std::size_t>>(),
             stage.at("force").get<std::vector<double>>(), stage.at("stroke").get<std::vector<double>>(),
             true, stage.at("skipped").get<bool>()});
    std::vector<PlanAnew> anew;
    if (json.contains("anew"))
      for (const Json& each : json.at("anew"))
        anew.push_back({each.at("time").get<double>(), each.at("why").get<std::string>()});
    moves_left_ = json.at("moves_left").get<std::size_t>();
    error_ = json.at("error").get<double>();
    off_plan_ = json.at("off_plan").get<std::string>();
    asked_at_ = json.at("asked_at").get<std::vector<double>>();
    stroke_ = json.at("stroke").get<std::vector<std::vector<double>>>();
    planned_ = {json.at("mu").get<std::vector<double>>(), json.at("sd").get<std::vector<double>>()};
    now_ = stage_from(json.at("now"));
    time_ = json.at("time").get<double>();
    raised_ = json.at("limits").get<std::set<std::string>>();
    expected_.reset();
    at_95_.reset();
    if (json.contains("expected")) {
      expected_ = json.at("expected").at(0).get<double>();
      at_95_ = json.at("expected").at(1).get<double>();
    }
    has_row_ = true;
    finder_ = std::move(finder);
    passed_ = std::move(passed);
    anew_ = std::move(anew);
    path_.go_on(std::move(moves));
  } catch (const Json::exception&) {
    return false;
  }
  return true;
}

}  // namespace taut::host
