// An adversary of the estimator: sites with a known truth, through the files of the program alone.
//
//     estimation_site [--count N] [--seed S] [--first I] [--case NAME,..] [--far yes|no|both]
//                     [--plain] [--declared] [--asked] [--phase] [--alarms] [--check]
//                     [--missed FILE] [--verify] [--threads T]
//                     [--keep DIR] [--keep-all DIR] [--program PATH] [--year-rows N] [--fineness N]
//
// README.md here says what each is.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "estimation_site/demands.hpp"
#include "reference/reference.hpp"

namespace estimation_site {
namespace {

constexpr char usage[] =
    "usage: estimation_site [--count N] [--seed S] [--first I] [--case NAME,..] [--far yes|no|both]\n"
    "                       [--plain] [--declared] [--asked] [--phase] [--alarms] [--check]\n"
    "                       [--missed FILE] [--verify] [--threads T]\n"
    "                       [--keep DIR] [--keep-all DIR] [--program PATH] [--year-rows N] [--fineness N]\n"
    "host_tests/estimation_site/README.md says what each is.\n";

struct Options {
  long count = 300, first = 0;
  std::uint64_t seed = 1;
  std::string only, keep, missed, program = TAUT_PROGRAM;
  bool keep_all = false, plain = true, declared = true, with_far = true, without_far = true;
  bool by_phase = false, alarms = false, check = false, verify = false, asked = false;
  int fineness = 1000, year_rows = 1500, threads = 1;
};

std::uint64_t mixed(std::uint64_t seed, std::uint64_t i) {
  std::uint64_t z = seed * 0x9E3779B97F4A7C15u + (i + 1) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// The force at the start of a cable at a time, straight on from row to row.
double tension_then(const std::vector<Deed>& rows, const Cable& cable, double time) {
  const auto after =
      std::find_if(rows.begin(), rows.end(), [&](const Deed& row) { return row.time >= time; });
  if (after == rows.begin()) return tension_at(rows.front(), cable, 0);
  if (after == rows.end()) return tension_at(rows.back(), cable, 0);
  const auto before = after - 1;
  const double from = tension_at(*before, cable, 0), to = tension_at(*after, cable, 0);
  return from + (to - from) * (time - before->time) / (after->time - before->time);
}

/// What the cells of a cable show of a jacking.
Readings read_cable(Random& random, const InstrumentRules& rules, const Jacked& jacked, std::size_t c) {
  const Cable& cable = jacked.ground.cables[c];
  const double full = cable.full;
  Readings readings;
  readings.sd = full * log_between(random, rules.least_sd, rules.most_sd);
  readings.step = rules.step * full;
  const double noise = rules.noise * readings.sd;
  Filter filter;
  if (rules.filtered) {
    readings.lag = log_between(random, 0.2, 3);
    filter = {readings.lag * std::fmax(0.5, 1 + 0.1 * gaussian(random)), random.coin()};
  }
  const auto cell = [&](double gain_sd) {
    const double drawn = gaussian(random), gain = gain_sd * (rules.sized ? std::copysign(1.0, drawn) : drawn),
                 zero = rules.zero_sd * full * gaussian(random);
    return Cell(gain, zero, noise, rules.memory, readings.step, filter);
  };
  Cell at_jack = cell(rules.jack_gain_sd),
       at_start = cell(cable.two_jacks ? rules.jack_gain_sd : rules.far_gain_sd);
  const double tared = rules.far_tared > 0 ? rules.far_tared * full * (random.coin() ? 1 : -1) : 0;
  const double behind =
      rules.other_clock > 0 ? random.between(1, rules.other_clock) * (random.coin() ? 1 : -1) : 0;
  const double mark = random.between(-0.05, 0.05);
  int last_free = 0, last_of_ramp = 0;
  for (std::size_t i = 0; i < jacked.rows.size(); ++i) {
    const Deed& deed = jacked.rows[i];
    const Pull& pull = deed.pulls[c];
    const auto shown = [&](std::size_t end) {
      return pull.shut[end] || (end == 0 && !cable.two_jacks) ? tension_at(deed, cable, end)
                                                              : pull.gauge[end];
    };
    readings.end.push_back(at_jack.read(random, shown(1), deed.time));
    const double at_far_end = behind == 0 ? shown(0) : tension_then(jacked.rows, cable, deed.time - behind);
    readings.start.push_back(at_start.read(random, at_far_end, deed.time) + tared);
    readings.stroke[1].push_back(mark + pull.extension[1] + 0.001 * gaussian(random));
    if (!pull.locked[1]) last_free = static_cast<int>(i);
    if (pull.phase == Phase::ramp) last_of_ramp = static_cast<int>(i);
  }
  if (cable.two_jacks)
    for (const Deed& deed : jacked.rows)
      readings.stroke[0].push_back(deed.pulls[c].extension[0] + 0.001 * gaussian(random));
  if (rules.in_turn) read_in_turn(readings.end, readings.start);
  if (rules.drops_out) drop_out(random, readings.end);
  if (rules.far_drops_out) drop_out(random, readings.start);
  if (rules.wrong > 0) {
    misread(random, rules.wrong, full, readings.end);
    misread(random, rules.wrong, full, readings.start);
  }
  if (rules.loose_plug) loosen_plug(random, full, readings.end, last_free);
  if (rules.mistyped) mistype(random, readings.end, last_free);
  if (rules.is_held) {
    std::vector<double> times;
    for (const Deed& deed : jacked.rows) times.push_back(deed.time);
    hold(random, times, readings.end);
    hold(random, times, readings.start);
  }
  if (rules.far_freezes) freeze(readings.start, static_cast<int>(last_of_ramp * random.between(0.3, 0.8)));
  return readings;
}

/// Adds a gauge whose true force is force_in(row), `full` when the jacks pull with their full force.
template <class ForceIn>
void read_gauge(Random& random, const InstrumentRules& rules, const std::string& column, double full,
                const ForceIn& force_in, Jacked& jacked) {
  GaugeReadings gauge;
  gauge.column = column;
  gauge.sd = full * log_between(random, rules.least_sd, rules.most_sd);
  gauge.zero_sd = full * rules.gauge_zero_sd;
  const double gain = rules.gauge_gain_sd * gaussian(random), zero = gauge.zero_sd * gaussian(random);
  Cell cell(gain, zero, rules.noise * gauge.sd, rules.memory, 0);
  const double creep = jacked.gauges.empty() ? full * rules.gauge_creep * (random.coin() ? 1 : -1) : 0;
  std::size_t last_of_ramp = 0;
  for (std::size_t i = 0; i < jacked.rows.size(); ++i) {
    const Deed& deed = jacked.rows[i];
    gauge.force.push_back(cell.read(random, force_in(deed), deed.time) +
                          creep * double(i) / double(jacked.rows.size()));
    if (deed.pulls[0].phase == Phase::ramp) last_of_ramp = i;
  }
  if (rules.gauges_freeze && jacked.gauges.empty())
    freeze(gauge.force, static_cast<int>(double(last_of_ramp) * random.between(0.3, 0.8)));
  jacked.gauges.push_back(gauge);
}

/// One gauge a cable, between two of its joints.
void read_segments(Random& random, const InstrumentRules& rules, Jacked& jacked) {
  for (std::size_t c = 0; c < jacked.ground.cables.size(); ++c) {
    const Cable& cable = jacked.ground.cables[c];
    const int i = 1 + random.below(cable.segments() - 2);
    read_gauge(
        random, rules, cable_name(c) + ".T" + std::to_string(i + 1), cable.full,
        [&](const Deed& deed) { return deed.tension[static_cast<std::size_t>(cable.first_segment + i)]; },
        jacked);
  }
}

/// Gauges on the two struts of one joint of each cable.
void read_struts(Random& random, const InstrumentRules& rules, Jacked& jacked) {
  for (std::size_t c = 0; c < jacked.ground.cables.size(); ++c) {
    const Cable& cable = jacked.ground.cables[c];
    const int j = random.below(cable.joints());
    const auto struts = jacked.ground.struts_at(cable, j);
    const auto full = jacked.ground.strut_forces(struts, cable, j, cable.full, cable.full);
    const auto before = static_cast<std::size_t>(cable.first_segment + j);
    for (std::size_t k = 0; k < 2; ++k)
      read_gauge(
          random, rules, "strut" + std::to_string(struts[k] + 1), std::fabs(full[k]),
          [&](const Deed& deed) {
            return jacked.ground.strut_forces(struts, cable, j, deed.tension[before],
                                              deed.tension[before + 1])[k];
          },
          jacked);
  }
}

/// What the instruments show of a jacking.
void read_instruments(Random& random, const Case& tried, Jacked& jacked) {
  const InstrumentRules& rules = tried.instruments;
  for (std::size_t c = 0; c < jacked.ground.cables.size(); ++c)
    jacked.readings.push_back(read_cable(random, rules, jacked, c));
  if (tried.gauges_segments) read_segments(random, rules, jacked);
  if (tried.gauges_struts) read_struts(random, rules, jacked);
}

/// A jacking before anything is read, and the random numbers that instruments draw from.
struct Unread {
  Jacked jacked;
  Random random;
};

Unread random_jacking(const Options& options, const Case& tried, std::uint64_t i, long& without_truth) {
  for (std::uint64_t attempt = 0; attempt < 1000; ++attempt) {
    Random random(mixed(options.seed, 1000 * i + attempt));
    Jacked jacked;
    jacked.ground = random_ground(random, tried.ground);
    jacked.reality = random_reality(random, jacked.ground, tried.ground);
    const Jacking jacking(jacked.ground, jacked.reality, tried.jacking, random, options.fineness);
    if (!jacking.good()) {
      ++without_truth;
      continue;
    }
    jacked.rows = jacking.rows();
    return {jacked, random};
  }
  std::fprintf(stderr, "%s: no jacking in a thousand has a truth\n", tried.name.c_str());
  std::exit(1);
}

/// Jackings by number, of cases that differ in their instruments only.
class Jackings {
 public:
  explicit Jackings(const Options& options) : options_(options) {}

  Jacked read(const Case& tried, std::uint64_t i) {
    auto found = kept_.find(i);
    if (found == kept_.end())
      found = kept_.emplace(i, random_jacking(options_, tried, i, without_truth_)).first;
    Unread unread = found->second;
    read_instruments(unread.random, tried, unread.jacked);
    return std::move(unread.jacked);
  }
  long without_truth() const { return without_truth_; }

 private:
  const Options& options_;
  std::map<std::uint64_t, Unread> kept_;
  long without_truth_ = 0;
};

/// The first line of a message, from the name of the file on.
std::string without_folder(const std::string& errors) {
  const std::string line = errors.substr(0, errors.find('\n'));
  for (const char* file : {"scene.json", "log.csv"})
    if (line.find(file) != std::string::npos) return line.substr(line.find(file));
  return line;
}

/// The largest difference to the true forces, as a part of the full force of the cable. tension(row, cable,
/// segment of the cable) is the other force; every row is asked for in turn.
template <class Tension>
double largest_difference(const Jacked& jacked, const Tension& tension) {
  double worst = 0;
  for (std::size_t row = 0; row < jacked.rows.size(); ++row)
    for (std::size_t c = 0; c < jacked.ground.cables.size(); ++c) {
      const Cable& cable = jacked.ground.cables[c];
      for (int i = 0; i < cable.segments(); ++i) {
        const double truth = jacked.rows[row].tension[static_cast<std::size_t>(cable.first_segment + i)];
        worst = std::fmax(worst, std::fabs(tension(row, c, i) - truth) / cable.full);
      }
    }
  return worst;
}

/// Runs the program on the jackings of a case.
class Trial {
 public:
  explicit Trial(const Options& options) : options_(options) {}

  void estimate(const Jacked& jacked, const Outcome& outcome, bool far, long i, Tally& tally) {
    if (!tally.refusal.empty()) return;
    const bool declared = outcome.way == "declared";
    const std::string scene = scene_text(jacked, *outcome.tried, far, declared),
                      log = log_text(jacked, *outcome.tried, far);
    write_text(scratch_.path / "scene.json", scene);
    write_text(scratch_.path / "log.csv", log);
    std::error_code ignored;
    std::filesystem::remove(scratch_.path / "result.csv", ignored);
    const int status = run({"estimate", path("scene.json"), path("log.csv"), "-o", path("result.csv")});
    const std::string errors = text_of(scratch_.path / "errors");
    if (status == 2) {
      tally.refusal = without_folder(errors);
      return;
    }
    const bool answered = judge(jacked, status, Result(text_of(scratch_.path / "result.csv")), tally);
    if (options_.keep.empty() || (answered && !options_.keep_all)) return;
    const auto folder =
        std::filesystem::path(options_.keep) /
        (outcome.tried->name + "-" + outcome.way + (far ? "-far-" : "-alone-") + std::to_string(i));
    std::filesystem::create_directories(folder);
    for (const char* file : {"scene.json", "log.csv", "result.csv", "errors"})
      if (std::filesystem::exists(scratch_.path / file))
        std::filesystem::copy_file(scratch_.path / file, folder / file,
                                   std::filesystem::copy_options::overwrite_existing);
    write_text(folder / "true.json", true_scene_text(jacked));
    write_text(folder / "true.csv", true_log_text(jacked));
    write_text(folder / "forces.csv", truth_text(jacked));
  }

  /// The worst difference to the paper's load steps, as a part of the full force; negative if these have no
  /// answer.
  double compare_with_stepwise(const Jacked& jacked) {
    write_text(scratch_.path / "true.json", true_scene_text(jacked));
    write_text(scratch_.path / "true.csv", true_log_text(jacked));
    const int status = run({"simulate", path("true.json"), path("true.csv"), "--method", "stepwise",
                            "--substeps", "8", "-o", path("simulated.csv")});
    if (status != 0) return -1;
    const Result result(text_of(scratch_.path / "simulated.csv"));
    return largest_difference(jacked, [&](std::size_t row, std::size_t c, int i) {
      return result.number(row, result.column(cable_name(c) + ".T" + std::to_string(i + 1)));
    });
  }

 private:
  std::string path(const char* file) const { return (scratch_.path / file).string(); }
  int run(std::vector<std::string> words) const {
    words.insert(words.begin(), options_.program);
    return run_program(words, scratch_.path / "errors");
  }

  const Options& options_;
  Scratch scratch_;
};

// Tables.

std::string cell(const char* format, double far, double alone) {
  const auto text = [&](double value) -> std::string {
    if (!std::isfinite(value)) return "-";
    char written[40];
    std::snprintf(written, sizeof written, format, value);
    return written;
  };
  return text(far) + " / " + text(alone);
}

void print_heading(bool by_phase) {
  std::printf("Far-end cell / jack alone.\n\n");
  std::printf(
      by_phase ? "| case | way | phase | coverage [%%] | error, rms [%%] | sd / rms | rms of error / sd |\n"
               : "| case | way | coverage [%%] | error, rms [%%] | sd / rms | first 12 rows, coverage [%%] | "
                 "error at end [%%] | exits |\n");
  std::printf(by_phase ? "| --- | --- | --- | --- | --- | --- | --- |\n"
                       : "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
}
void print_row(const Outcome& outcome) {
  const Tally &far = outcome.far, &alone = outcome.alone;
  std::printf("| %s | %s |", outcome.tried->name.c_str(), outcome.way.c_str());
  const std::string& refusal = far.refusal.empty() ? alone.refusal : far.refusal;
  if (!refusal.empty()) {
    std::printf(" refused: %s |\n", refusal.c_str());
    return;
  }
  std::printf(" %s | %s | %s | %s | %s |", cell("%.1f", far.all.coverage(), alone.all.coverage()).c_str(),
              cell("%.2f", far.all.error(), alone.all.error()).c_str(),
              cell("%.2f", far.all.sd_over_rms(), alone.all.sd_over_rms()).c_str(),
              cell("%.1f", far.fresh.coverage(), alone.fresh.coverage()).c_str(),
              cell("%.2f", far.end.error(), alone.end.error()).c_str());
  std::printf(" %ld of %ld / %ld of %ld |\n", far.stopped, far.jackings, alone.stopped, alone.jackings);
}
void print_phases(const Outcome& outcome) {
  const auto print = [&](const char* name, const Score& far, const Score& alone) {
    if (far.count() + alone.count() == 0) return;
    std::printf("| %s | %s | %s | %s | %s | %s | %s |\n", outcome.tried->name.c_str(), outcome.way.c_str(),
                name, cell("%.1f", far.coverage(), alone.coverage()).c_str(),
                cell("%.2f", far.error(), alone.error()).c_str(),
                cell("%.2f", far.sd_over_rms(), alone.sd_over_rms()).c_str(),
                cell("%.2f", far.normalized(), alone.normalized()).c_str());
  };
  print("all rows", outcome.far.all, outcome.alone.all);
  for (int p = 0; p < phases; ++p) {
    const auto i = static_cast<std::size_t>(p);
    print(name_of(static_cast<Phase>(p)), outcome.far.phase[i], outcome.alone.phase[i]);
  }
  print("first 12 rows", outcome.far.fresh, outcome.alone.fresh);
  print("last row", outcome.far.end, outcome.alone.end);
}
void print_alarms(const std::vector<Outcome>& outcomes) {
  std::printf(
      "\n| case | way | far-end cell | mu: error, rms [%%] | sd [%%] | jackings with alarms [%%] |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (const Outcome& outcome : outcomes)
    for (const bool far : {true, false}) {
      const Tally& tally = far ? outcome.far : outcome.alone;
      if (tally.jackings == 0) continue;
      std::printf("| %s | %s | %s | %.1f | %.1f |", outcome.tried->name.c_str(), outcome.way.c_str(),
                  far ? "yes" : "no", tally.mu_rms(), tally.mu_sd());
      for (const auto& [word, count] : tally.alarms)
        std::printf(" %s %.0f", word.c_str(), 100 * double(count) / double(tally.jackings));
      std::printf(" |\n");
    }
}

/// All jackings of a case, in all ways that are asked for.
std::vector<Outcome> try_case(const Options& options, const Case& tried, Jackings& jackings) {
  std::vector<Outcome> outcomes;
  const auto add = [&](const char* way) {
    outcomes.emplace_back();
    outcomes.back().tried = &tried;
    outcomes.back().way = way;
  };
  if (tried.silent) {
    add("silent");
  } else {
    if (options.plain || (options.asked && tried.demand == Demand::alarm)) add("plain");
    if (options.declared) add("declared");
  }
  Trial trial(options);
  for (long i = options.first; i < options.first + options.count; ++i) {
    const Jacked jacked = jackings.read(tried, static_cast<std::uint64_t>(i));
    for (Outcome& outcome : outcomes) {
      if (options.with_far && tried.with_far) trial.estimate(jacked, outcome, true, i, outcome.far);
      if (options.without_far && tried.without_far) trial.estimate(jacked, outcome, false, i, outcome.alone);
    }
  }
  return outcomes;
}

/// The worst difference to the event-driven reference, as a part of the full force; negative if that has no
/// answer.
double compare_with_reference(const Jacked& jacked) {
  reference::Reference found(true_structure(jacked.ground, jacked.reality));
  if (!found.start()) return -1;
  std::size_t followed = 0;
  bool good = true;
  const double worst = largest_difference(jacked, [&](std::size_t row, std::size_t c, int i) {
    for (; good && followed <= row; ++followed) good = found.advance(row_of(jacked.rows[followed]));
    return static_cast<double>(found.tension(jacked.ground.cables[c].first_segment + i));
  });
  return good ? worst : -1;
}

/// The worst of some differences, and how many there are.
struct Differences {
  long compared = 0, unanswered = 0;
  double worst = 0;
  void add(double difference) {
    ++(difference < 0 ? unanswered : compared);
    worst = std::fmax(worst, difference);
  }
};

/// Compares the truth with the reference, and with the paper's load steps; returns whether they agree.
bool verify_case(const Options& options, const Case& tried) {
  Trial trial(options);
  Differences from_reference, from_stepwise;
  long without_truth = 0;
  for (long i = options.first; i < options.first + options.count; ++i) {
    const Jacked jacked = random_jacking(options, tried, static_cast<std::uint64_t>(i), without_truth).jacked;
    from_reference.add(compare_with_reference(jacked));
    from_stepwise.add(trial.compare_with_stepwise(jacked));
  }
  std::printf("| %s | %ld of %ld | %.1e | %ld of %ld | %.1e |\n", tried.name.c_str(), from_reference.compared,
              options.count, from_reference.worst, from_stepwise.compared, options.count,
              from_stepwise.worst);
  std::fflush(stdout);
  // Eight steps a row are few where a wedge is drawn in.
  return from_reference.worst < 1e-4 && from_stepwise.worst < 3e-3 &&
         from_reference.compared + from_stepwise.compared > 0;
}

bool read_options(int count, char** words, Options& options) {
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto value = [&]() -> std::string { return i + 1 < count ? words[++i] : ""; };
    if (word == "--count") {
      options.count = std::atol(value().c_str());
    } else if (word == "--first") {
      options.first = std::atol(value().c_str());
    } else if (word == "--seed") {
      options.seed = std::strtoull(value().c_str(), nullptr, 10);
    } else if (word == "--case") {
      options.only = value();
      for (char& c : options.only) c = c == ' ' ? '-' : c;
    } else if (word == "--program") {
      options.program = value();
    } else if (word == "--keep" || word == "--keep-all") {
      options.keep = value();
      options.keep_all = word == "--keep-all";
    } else if (word == "--far") {
      const std::string far = value();
      options.with_far = far != "no";
      options.without_far = far != "yes";
    } else if (word == "--year-rows") {
      options.year_rows = std::atoi(value().c_str());
    } else if (word == "--fineness") {
      options.fineness = std::max(4, std::atoi(value().c_str()));
    } else if (word == "--plain") {
      options.declared = false;
    } else if (word == "--declared") {
      options.plain = false;
    } else if (word == "--asked") {
      options.plain = false;
      options.asked = true;
    } else if (word == "--phase") {
      options.by_phase = true;
    } else if (word == "--alarms") {
      options.alarms = true;
    } else if (word == "--check") {
      options.check = true;
    } else if (word == "--missed") {
      options.missed = value();
      options.check = true;
    } else if (word == "--threads") {
      options.threads = std::max(1, std::atoi(value().c_str()));
    } else if (word == "--verify") {
      options.verify = true;
    } else if (word == "-h" || word == "--help") {
      std::fputs(usage, stdout);
      std::exit(0);
    } else {
      std::fprintf(stderr, "unknown option %s; --help has them all\n", word.c_str());
      return false;
    }
  }
  return true;
}

/// Whether a name is one of those between commas.
bool is_listed(const std::string& name, const std::string& list) {
  return ("," + list + ",").find("," + name + ",") != std::string::npos;
}

/// Cases one after the other that have the same jackings.
std::vector<std::vector<const Case*>> in_groups(const std::vector<const Case*>& cases) {
  std::vector<std::vector<const Case*>> groups;
  for (const Case* tried : cases) {
    const Case* before = groups.empty() ? nullptr : groups.back().front();
    if (before == nullptr || before->ground.all() != tried->ground.all() ||
        before->jacking.all() != tried->jacking.all())
      groups.emplace_back();
    groups.back().push_back(tried);
  }
  return groups;
}

/// Tries all cases, and prints them in their order.
std::vector<Outcome> try_all(const Options& options, const std::vector<const Case*>& cases) {
  const auto groups = in_groups(cases);
  std::vector<std::vector<Outcome>> found(groups.size());
  std::vector<Outcome> outcomes;
  std::set<std::size_t> done;
  std::size_t printed = 0;
  long without_truth = 0;
  std::mutex guard;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t g = next++; g < groups.size(); g = next++) {
      Jackings jackings(options);
      for (const Case* tried : groups[g])
        for (Outcome& outcome : try_case(options, *tried, jackings)) found[g].push_back(std::move(outcome));
      const std::lock_guard<std::mutex> lock(guard);
      without_truth += jackings.without_truth();
      for (done.insert(g); done.count(printed) > 0; ++printed)
        for (Outcome& outcome : found[printed]) {
          options.by_phase ? print_phases(outcome) : print_row(outcome);
          std::fflush(stdout);
          outcomes.push_back(std::move(outcome));
        }
    }
  };
  std::vector<std::thread> workers;
  for (int i = 1; i < options.threads; ++i) workers.emplace_back(work);
  work();
  for (auto& worker : workers) worker.join();
  if (options.alarms) print_alarms(outcomes);
  if (without_truth > 0) std::printf("\n%ld jackings drawn again, without a truth.\n", without_truth);
  return outcomes;
}

/// The lines of a file that are no comments.
std::set<std::string> lines_of(const std::string& name) {
  std::set<std::string> lines;
  std::ifstream file(name);
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#') lines.insert(line);
  return lines;
}

/// Prints which demands are missed; returns whether they are those that are known to be.
bool check_demands(const Options& options, const std::vector<Outcome>& outcomes) {
  Demands demands;
  for (const Outcome& outcome : outcomes) demands.check(outcome);
  const auto known = lines_of(options.missed);
  long missed = 0, met = 0;
  std::string text;
  for (const Judged& each : demands.judged()) {
    const bool is_known = known.count(each.demand) > 0;
    if (!each.is_met) text += "- " + each.demand + ": " + each.found + (is_known ? ", as before" : "") + "\n";
    if (!each.is_met && !is_known) ++missed;
    if (each.is_met && is_known) {
      ++met;
      text += "- met by now: " + each.demand + ": " + each.found + "\n";
    }
  }
  std::printf("\n%ld demands missed%s.\n%s", missed, options.missed.empty() ? "" : " that were met before",
              text.c_str());
  if (met > 0) std::printf("\nTake what is met by now out of %s.\n", options.missed.c_str());
  return missed + met == 0;
}

int run(const Options& options) {
  const std::vector<Case> cases = all_cases(options.year_rows);
  std::vector<const Case*> chosen;
  for (const Case& each : cases)
    if (options.only.empty() || is_listed(each.name, options.only)) chosen.push_back(&each);
  if (chosen.empty()) {
    std::fprintf(stderr, "no such case: %s; there are", options.only.c_str());
    for (const Case& each : cases) std::fprintf(stderr, " %s", each.name.c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  if (!options.missed.empty() && !std::ifstream(options.missed)) {
    std::fprintf(stderr, "%s: cannot be read; --missed needs the demands that are missed, a line each\n",
                 options.missed.c_str());
    return 2;
  }
  std::printf("Seed %llu, %ld jackings a case.\n", static_cast<unsigned long long>(options.seed),
              options.count);
  if (options.verify) {
    std::printf(
        "\nLargest difference, part of the full force.\n\n"
        "| case | reference | worst | `stepwise` | worst |\n| --- | --- | --- | --- | --- |\n");
    bool good = true;
    for (const Case* tried : chosen) good = verify_case(options, *tried) && good;
    return good ? 0 : 1;
  }
  print_heading(options.by_phase);
  const std::vector<Outcome> outcomes = try_all(options, chosen);
  bool good = true;
  for (const Outcome& outcome : outcomes)
    for (const Tally* tally : {&outcome.far, &outcome.alone})
      if (tally->broken > 0 || !tally->refusal.empty()) good = false;
  if (!good) std::printf("\nFAILED: runs without a usable result, or refused.\n");
  const bool is_met = !options.check || check_demands(options, outcomes);
  return good && is_met ? 0 : 1;
}

}  // namespace
}  // namespace estimation_site

int main(int count, char** words) {
  estimation_site::Options options;
  if (!estimation_site::read_options(count, words, options)) return 2;
  return estimation_site::run(options);
}
