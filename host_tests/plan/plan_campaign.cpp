// Random scenes: plans against brute force, and against what is usual.
//
//     plan_campaign [--one N] [--grid N] [--three N] [--coarse N] [--two N] [--random N] [--seed S] [--first
//     I]
//
// README.md here says what is compared and what was found. Fails if any brute force is nearer than the plan,
// if a plan takes more than a thousandth of its end states, or if simulate finds other forces than a plan.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "lib/kinds/make_model.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/objective.hpp"
#include "lib/plan/plan_log.hpp"
#include "lib/plan/prior.hpp"
#include "plan/core_jack.hpp"
#include "plan/random_scene.hpp"
#include "support/campaign_options.hpp"

namespace {

using namespace plan_test;
using namespace taut::host;

struct Options {
  int one = 200, grid = 400, three = 40, coarse = 60, two = 50, random = 20000, first = 0, seed = 1;
};

std::uint64_t mixed(int seed, std::uint64_t kind, std::uint64_t i) {
  return static_cast<std::uint64_t>(seed) * 0x9E3779B97F4A7C15u + kind * 0xBF58476D1CE4E5B9u +
         i * 0x94D049BB133111EBu;
}

// A model that is jacked row by row, as simulate does.
class Rows {
 public:
  explicit Rows(const Site& site) : site_(site), model_(make_leg_model(site.scene)) {
    row_.factor = site.goal.factor;
    row_.cables.resize(1);
    static_cast<void>(model_->start(1));
    good_ = go(0, 0);
    loaded_ = model_->save();
  }
  bool good() const { return good_; }
  void again() { static_cast<void>(model_->go_to(loaded_)); }
  std::string save() const { return model_->save(); }
  void go_to(const std::string& state) { static_cast<void>(model_->go_to(state)); }
  bool go(double start, double end) {
    row_.cables[0][0].force = start;
    row_.cables[0][1].force = end;
    return model_->advance(row_, 1).whole();
  }
  double error() {
    model_->read_cables(answer_);
    double most = 0;
    for (std::size_t i = 0; i < site_.goal.target.size(); ++i)
      if (site_.goal.target[i] > 0)
        most = std::max(most, std::fabs(answer_.tension[i] / site_.goal.target[i] - 1));
    return most;
  }

 private:
  const Site& site_;
  std::unique_ptr<LegModel> model_;
  LogRow row_;
  Answer answer_;
  std::string loaded_;
  bool good_ = false;
};

// Three times the largest target, but no more than a log may hold.
double largest_pull(const Site& site) {
  const double target = *std::max_element(site.goal.target.begin(), site.goal.target.end());
  const CableDescription& cable = site.scene.cables[0];
  return std::min(3 * target, 0.0199 * cable.E * cable.A);
}

// All pairs of a grid of pulls and releases.
double best_of_grid(const Site& site, Rows& rows, int grid) {
  const double most = largest_pull(site);
  double best = 1e300;
  rows.again();
  for (int up = 1; up <= grid; ++up) {
    if (!rows.go(0, most * up / grid)) break;
    const std::string pulled = rows.save();
    best = std::min(best, rows.error());
    for (int back = up - 1; back >= 0 && rows.go(0, most * back / grid); --back)
      best = std::min(best, rows.error());
    rows.go_to(pulled);
  }
  return best;
}

// All triples of a grid of pulls, releases and pulls again, that turn.
double best_of_triples(const Site& site, Rows& rows, int grid) {
  // Finer where turning points are: from half of the target to half above it.
  const double target = *std::max_element(site.goal.target.begin(), site.goal.target.end());
  const auto force = [&](int k) { return target * (0.5 + 1.2 * k / grid); };
  double best = 1e300;
  rows.again();
  for (int up = 0; up <= grid && rows.go(0, force(up)); ++up) {
    const std::string pulled = rows.save();
    for (int back = up - 1; back >= 0 && rows.go(0, force(back)); --back) {
      const std::string released = rows.save();
      for (int again = back; again < up && rows.go(0, force(again)); ++again)
        best = std::min(best, rows.error());
      rows.go_to(released);
    }
    rows.go_to(pulled);
  }
  return best;
}

// Random pulls and releases of both jacks.
double best_of_random(const Site& site, Rows& rows, Random& random, int count) {
  const double target = *std::max_element(site.goal.target.begin(), site.goal.target.end());
  double best = 1e300;
  for (int n = 0; n < count; ++n) {
    rows.again();
    const double start = target * random.between(0.7, 1.8), end = target * random.between(0.7, 1.8);
    if (!rows.go(start, end)) continue;
    best = std::min(best, rows.error());
    const double then_end = end * random.between(0.5, 1.05), then_start = start * random.between(0.5, 1.05);
    if (rows.go(then_start, then_end)) best = std::min(best, rows.error());
  }
  return best;
}

// Mean, median and 95 % of what is collected, in per cent.
class Column {
 public:
  void add(double part) { all_.push_back(100 * part); }
  // What is usual with two jacks may pull the cable through.
  void add(const CourseOutcome& outcome) {
    if (outcome.whole) add(outcome.error);
  }
  std::string text() {
    if (all_.empty()) return "-";
    std::sort(all_.begin(), all_.end());
    double sum = 0;
    for (const double each : all_) sum += each;
    const auto at = [&](double p) {
      return all_[static_cast<std::size_t>(p * static_cast<double>(all_.size() - 1) + 0.5)];
    };
    char text[96];
    std::snprintf(text, sizeof text, "%.2f / %.2f / %.2f", sum / static_cast<double>(all_.size()), at(0.5),
                  at(0.95));
    return text;
  }

 private:
  std::vector<double> all_;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// The same stages on a structure whose mu is other.
double error_with_mu(const Site& site, const std::vector<PlanJack>& jacks,
                     const std::vector<PlanStage>& stages, double factor) {
  Site other = site;
  for (double& mu : other.scene.cables[0].mu) mu *= factor;
  Jacking jacking(other.scene, other.goal, jacks);
  if (!jacking.begin()) return 1;
  Leg leg;
  for (const PlanStage& stage : stages) leg = jacking.jump(stage);
  return off_target(leg.end().tension, site.goal.target);
}

// As `taut watch` plans anew: mu becomes known when the first pull is so far done.
double error_planned_anew(const Site& site, const Plan& plan, double half_way, double factor) {
  std::vector<double> mu, known(site.scene.cables[0].joints(), 0);
  for (const double each : site.scene.cables[0].mu) mu.push_back(factor * each);
  PlanPast past;
  PlanStage half = plan.stages[0];
  for (double& force : half.force) force = half_way;
  // The first row has the loads.
  past.moves = {{{std::vector<double>(half.force.size(), 0), half.locked}, site.goal.factor},
                {half, site.goal.factor}};
  past.rest = plan.shape;
  past.moves_left = static_cast<std::size_t>(site.goal.has_stages ? site.goal.stages : 2);
  past.force = forces_of(plan.shape, plan.stages);
  return find_rest_of_plan(with_mu(site.scene, mu, known), site.goal, past).outcome.error;
}

// The same by the planner of the core, on the device's way: from where the jack stands.
CoreMoves core_planned_anew(const Site& site, double half_way, double& took) {
  const auto jack = make_core_jack(site.scene);
  CoreMoves none;
  none.error = 1;
  if (!jack->go(site.goal.factor, 0) || !jack->go(site.goal.factor, half_way)) return none;
  const auto begin = std::chrono::steady_clock::now();
  const CoreMoves found = jack->plan(site.goal, {0, 40000, 40000});
  took = seconds_since(begin);
  // What it says comes of it.
  for (int m = 0; m < found.count; ++m)
    if (!jack->go(site.goal.factor, found.force[static_cast<std::size_t>(m)])) return none;
  const double off = off_target(jack->tension(), site.goal.target);
  return std::fabs(off - found.error) <= 5e-4 ? found : none;
}

struct Kind {
  SceneKind kind;
  int scenes = 0, unusable = 0, proved = 0, most_moves = 0;
  Column straight, rule, plan, straight_low, rule_low, plan_low, straight_high, rule_high, plan_high,
      again_low, again_high, core_low, core_high, core_time, time;
  double slowest = 0, excess = -1, core_excess = -1;
  int core_events = 0;
};

bool compare_one(const Options& options, Kind& kind, std::uint64_t i) {
  const std::uint64_t seed = mixed(options.seed, static_cast<std::uint64_t>(kind.kind), i);
  Random random(seed);
  const Site site = random_site(random, kind.kind, false);
  Rows rows(site);
  if (!rows.good()) {
    ++kind.unusable;
    return true;
  }
  const auto begin = std::chrono::steady_clock::now();
  const Plan plan = find_plan(site.scene, site.goal);
  const double took = seconds_since(begin);
  if (!plan.status()) {
    ++kind.unusable;
    return true;
  }
  ++kind.scenes;
  kind.proved += plan.certainty != Certainty::best_found;
  kind.most_moves = std::max(kind.most_moves, static_cast<int>(plan.moves_tried));
  kind.time.add(10 * took);
  kind.slowest = std::max(kind.slowest, took);
  bool good = true;
  const auto fail = [&](const char* what, double here, double there) {
    std::printf("FAILED: %s, scene %llu (seed %d): %s: %.12g beside %.12g\n", name_of(kind.kind),
                static_cast<unsigned long long>(i), options.seed, what, here, there);
    good = false;
  };
  const SimulatedPlan simulated = simulate(plan_log(site.scene, site.goal, plan), site.scene);
  if (!simulated.stopped.empty()) {
    fail("simulate stops", 0, 0);
    return false;
  }
  for (std::size_t s = 0; s < site.goal.target.size(); ++s) {
    const double here = plan.outcome.tension.back()[s], there = simulated.answers.back().tension[s];
    if (std::fabs(here - there) > 1e-9 * std::fabs(there)) fail("simulate finds another force", here, there);
  }
  if (options.grid > 0) {
    const double brute = best_of_grid(site, rows, options.grid);
    kind.excess = std::max(kind.excess, plan.outcome.error - brute);
    if (plan.outcome.error > brute + 1e-9) fail("brute force is nearer", plan.outcome.error, brute);
    if (options.grid >= 400 && plan.moves_tried > 160)
      fail("moves tried", static_cast<double>(plan.moves_tried), 160);
  }
  const UsualJacking straight = usual_jacking(site.scene, site.goal, 0);
  const UsualJacking rule = usual_jacking(site.scene, site.goal, 0.05);
  kind.straight.add(straight.outcome);
  kind.rule.add(rule.outcome);
  kind.plan.add(plan.outcome.error);
  const auto other_mu = [&](double factor, Column& of_straight, Column& of_rule, Column& of_plan,
                            Column& of_again, Column& of_core) {
    of_straight.add(error_with_mu(site, plan.jacks, straight.stages, factor));
    of_rule.add(error_with_mu(site, plan.jacks, rule.stages, factor));
    of_plan.add(error_with_mu(site, plan.jacks, plan.stages, factor));
    Site other = site;
    for (double& mu : other.scene.cables[0].mu) mu *= factor;
    const Plan rest = find_plan(other.scene, other.goal);
    const double from_rest = rest.outcome.error;
    // Beyond the farthest pull of the best plan there is no way back to it.
    double farthest = 0;
    for (const PlanStage& stage : rest.stages) farthest = std::max(farthest, stage.force[0]);
    const double half_way = std::min(plan.stages[0].force[0] / 2, farthest);
    const double again = error_planned_anew(site, plan, half_way, factor);
    of_again.add(again);
    double core_took = 0;
    const CoreMoves core = core_planned_anew(other, half_way, core_took);
    of_core.add(core.error);
    kind.core_time.add(10 * core_took);
    kind.core_events = std::max(kind.core_events, core.events);
    kind.core_excess = std::max(kind.core_excess, core.error - again);
    if (core.error > again + 5e-4) fail("planned anew in the core", core.error, again);
    if (again > from_rest + worth_a_change + 1e-9) fail("planned anew on the way", again, from_rest);
  };
  other_mu(0.7, kind.straight_low, kind.rule_low, kind.plan_low, kind.again_low, kind.core_low);
  other_mu(1.3, kind.straight_high, kind.rule_high, kind.plan_high, kind.again_high, kind.core_high);
  return good;
}

bool compare_three(const Options& options, Kind& kind, std::uint64_t i) {
  Random random(mixed(options.seed, static_cast<std::uint64_t>(kind.kind), i));
  Site site = random_site(random, kind.kind, false);
  Rows rows(site);
  if (!rows.good()) return true;
  site.goal.stages = 3;
  const auto begin = std::chrono::steady_clock::now();
  const Plan plan = find_plan(site.scene, site.goal);
  const double took = seconds_since(begin);
  ++kind.scenes;
  kind.time.add(10 * took);
  kind.most_moves = std::max(kind.most_moves, static_cast<int>(plan.moves_tried));
  kind.plan.add(plan.outcome.error);
  const double brute = best_of_triples(site, rows, options.coarse);
  kind.excess = std::max(kind.excess, plan.outcome.error - brute);
  if (plan.outcome.error <= brute + 1e-9) return true;
  std::printf("FAILED: three moves, %s, scene %llu (seed %d): brute force is nearer: %.12g beside %.12g\n",
              name_of(kind.kind), static_cast<unsigned long long>(i), options.seed, plan.outcome.error,
              brute);
  return false;
}

bool compare_two(const Options& options, Kind& kind, std::uint64_t i) {
  Random random(mixed(options.seed, 10 + static_cast<std::uint64_t>(kind.kind), i));
  const Site site = random_site(random, kind.kind, true);
  Rows rows(site);
  if (!rows.good()) {
    ++kind.unusable;
    return true;
  }
  const auto begin = std::chrono::steady_clock::now();
  const Plan plan = find_plan(site.scene, site.goal);
  const double took = seconds_since(begin);
  if (!plan.status()) {
    ++kind.unusable;
    return true;
  }
  ++kind.scenes;
  kind.time.add(10 * took);
  kind.slowest = std::max(kind.slowest, took);
  kind.most_moves = std::max(kind.most_moves, static_cast<int>(plan.moves_tried));
  kind.plan.add(plan.outcome.error);
  kind.straight.add(usual_jacking(site.scene, site.goal, 0).outcome);
  kind.rule.add(usual_jacking(site.scene, site.goal, 0.05).outcome);
  const double brute = best_of_random(site, rows, random, options.random);
  kind.excess = std::max(kind.excess, plan.outcome.error - brute);
  if (plan.outcome.error <= brute + 1e-9) return true;
  std::printf("FAILED: two jacks, %s, scene %llu (seed %d): a random plan is nearer: %.12g beside %.12g\n",
              name_of(kind.kind), static_cast<unsigned long long>(i), options.seed, plan.outcome.error,
              brute);
  return false;
}

int run(const Options& options) {
  std::printf("seed %d, scenes from %d on\n", options.seed, options.first);
  bool good = true;
  // Half of the scenes on saddles, three eighths on trusses, an eighth in second-order theory, which takes
  // long.
  const auto kind_of = [](int i) {
    const int of = i % 8;
    return of < 4 ? SceneKind::saddles : of < 7 ? SceneKind::truss : SceneKind::second_order;
  };
  std::vector<Kind> one(3), three(3), two(3);
  for (std::size_t k = 0; k < 3; ++k) one[k].kind = three[k].kind = two[k].kind = static_cast<SceneKind>(k);
  for (int i = options.first; i < options.first + options.one; ++i)
    good = compare_one(options, one[static_cast<std::size_t>(kind_of(i))], static_cast<std::uint64_t>(i)) &&
           good;
  for (int i = options.first; i < options.first + options.three; ++i)
    good =
        compare_three(options, three[static_cast<std::size_t>(kind_of(i))], static_cast<std::uint64_t>(i)) &&
        good;
  for (int i = options.first; i < options.first + options.two; ++i)
    good = compare_two(options, two[static_cast<std::size_t>(kind_of(i))], static_cast<std::uint64_t>(i)) &&
           good;
  std::printf("\nOne jack, up and back; furthest from the target [%%], mean / median / 95 %%\n\n");
  std::printf(
      "| | scenes | straight pull | 105 %% and back | plan | proved | moves tried, at most | "
      "plan less brute force, at most [%%] | time [ms], mean / median / 95 %% |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (Kind& kind : one)
    std::printf("| %s | %d (%d without an answer) | %s | %s | %s | %d | %d | %.4f | %s |\n",
                name_of(kind.kind), kind.scenes, kind.unusable, kind.straight.text().c_str(),
                kind.rule.text().c_str(), kind.plan.text().c_str(), kind.proved, kind.most_moves,
                100 * kind.excess, kind.time.text().c_str());
  std::printf("\nThe same with mu 30 %% lower and higher than planned for\n\n");
  std::printf(
      "| | mu | straight pull | 105 %% and back | plan | planned anew | planned anew in the core |\n| --- | "
      "--- | --- | --- | --- | --- | --- |\n");
  for (Kind& kind : one) {
    std::printf("| %s | -30 %% | %s | %s | %s | %s | %s |\n", name_of(kind.kind),
                kind.straight_low.text().c_str(), kind.rule_low.text().c_str(), kind.plan_low.text().c_str(),
                kind.again_low.text().c_str(), kind.core_low.text().c_str());
    std::printf("| %s | +30 %% | %s | %s | %s | %s | %s |\n", name_of(kind.kind),
                kind.straight_high.text().c_str(), kind.rule_high.text().c_str(),
                kind.plan_high.text().c_str(), kind.again_high.text().c_str(), kind.core_high.text().c_str());
  }
  std::printf(
      "\n| in the core | core less host, at most [%%] | events, at most | time [ms], mean / median / 95 %% "
      "|\n"
      "| --- | --- | --- | --- |\n");
  for (Kind& kind : one)
    std::printf("| %s | %.4f | %d | %s |\n", name_of(kind.kind), 100 * kind.core_excess, kind.core_events,
                kind.core_time.text().c_str());
  std::printf("\nOne jack, up, back and up again\n\n");
  std::printf(
      "| | scenes | plan | plan less brute force, at most [%%] | moves tried, at most | time [ms], mean / "
      "median / 95 %% |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (Kind& kind : three)
    std::printf("| %s | %d | %s | %.4f | %d | %s |\n", name_of(kind.kind), kind.scenes,
                kind.plan.text().c_str(), 100 * kind.excess, kind.most_moves, kind.time.text().c_str());
  std::printf("\nTwo jacks, up and back\n\n");
  std::printf(
      "| | scenes | straight pull | 105 %% and back | plan | plan less the best of %d random ones, at most "
      "[%%] | moves tried, at most | time [ms], mean / median / 95 %% |\n| --- | --- | --- | --- | --- | --- "
      "| --- | --- |\n",
      options.random);
  for (Kind& kind : two)
    std::printf("| %s | %d (%d without an answer) | %s | %s | %s | %.4f | %d | %s |\n", name_of(kind.kind),
                kind.scenes, kind.unusable, kind.straight.text().c_str(), kind.rule.text().c_str(),
                kind.plan.text().c_str(), 100 * kind.excess, kind.most_moves, kind.time.text().c_str());
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  support::read_options(argc, argv,
                        {{"--one", &options.one},
                         {"--grid", &options.grid},
                         {"--three", &options.three},
                         {"--coarse", &options.coarse},
                         {"--two", &options.two},
                         {"--random", &options.random},
                         {"--first", &options.first},
                         {"--seed", &options.seed}});
  return run(options);
}
