// Random scenes of many cables, kind by kind, through the tracker: what it solves, what it refuses and why.
//
//     many_cables [--count N] [--seed S] [--threads T] [--kind NAME] [--judge N] [--no-float] [--one]
//
// N scenes of every kind, or of one. Every refusal is judged: see README.md. --judge says how many of a kind
// may take the slow judges too. --one runs the single scene of --seed (with --kind) and says what happens in
// every row.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <thread>

#include "campaign/load_steps.hpp"
#include "campaign/many_cables_run.hpp"
#include "campaign/many_cables_stepwise.hpp"
#include "reference/reference.hpp"
#include "support/campaign_options.hpp"

namespace campaign {
namespace {

// Parts of the largest force so far.
constexpr double accepted_double = 1e-9, accepted_float = 1e-5;
constexpr double wanted_double = 1e-11;

using Seeds = std::map<std::string, std::vector<std::uint64_t>>;

/// What came of many scenes of one kind, added up.
struct Tally {
  long scenes = 0, rows = 0, events = 0, solved = 0, solved_float = 0, compared = 0;
  double worst_double = 0, worst_float = 0, seconds = 0;
  std::uint64_t worst_seed = 0;
  Seeds refusals, float_refusals, confirmed, coarse, failures;
  support::RoutesTaken::Counts routes{};

  void add(const Tally& other) {
    scenes += other.scenes;
    rows += other.rows;
    events += other.events;
    solved += other.solved;
    solved_float += other.solved_float;
    compared += other.compared;
    if (other.worst_double > worst_double) worst_seed = other.worst_seed;
    worst_double = std::max(worst_double, other.worst_double);
    worst_float = std::max(worst_float, other.worst_float);
    seconds += other.seconds;
    support::add(routes, other.routes);
    append(refusals, other.refusals);
    append(float_refusals, other.float_refusals);
    append(confirmed, other.confirmed);
    append(coarse, other.coarse);
    append(failures, other.failures);
  }

 private:
  static void append(Seeds& to, const Seeds& from) {
    for (const auto& [reason, seeds] : from) {
      auto& all = to[reason];
      all.insert(all.end(), seeds.begin(), seeds.end());
    }
  }
};

bool talkative = false;
bool in_float = true;
std::atomic<int> slow_judgements{0};  ///< left for this kind

constexpr int most_joints_of_reference = 16, most_places_of_stepwise = 150;
constexpr int few_steps = 16, many_steps = 64;
constexpr int compare_every = 4, most_joints_of_comparison = 20;
constexpr double accepted_deviation = 0.01;  // from load steps, unless more of them come closer

/// Everything that is tried on one scene.
template <class SceneType>
class Trial {
 public:
  template <class Scalar>
  using Run = support::Run<Scalar, SceneType>;

  Trial(const World<SceneType>& world, std::uint64_t seed, Tally& tally)
      : world_(world), seed_(seed), tally_(tally) {}

  void run() {
    ++tally_.scenes;
    follow_in_double();
    if (in_float && solved_) follow_in_float();
  }

 private:
  void fail(const std::string& what) { tally_.failures[what].push_back(seed_); }

  template <class Scalar>
  bool refuse(const std::string& where, const taut::Status& status, double fraction) {
    auto& list = sizeof(Scalar) == sizeof(float) ? tally_.float_refusals : tally_.refusals;
    list[where + taut::describe(status.code)].push_back(seed_);
    if (talkative)
      std::printf("  refused at %.17g: %s, cable %d, index %d\n", fraction, taut::describe(status.code),
                  status.cable, status.index);
    return false;
  }

  /// Where the tracker was before the row that it refuses, as far as the goal depends on it.
  struct Begun {
    std::vector<Exact> extension;
    std::vector<bool> locked;
  };
  Begun remember(const Run<double>& run) const {
    Begun begun;
    const auto moves = run.tracker().slip_state();
    for (int c = 0; c < world_.scene.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        begun.extension.push_back(Exact(moves.extension[c][end]));
        begun.locked.push_back(run.tracker().loads().jack[c][end].locked);
      }
    return begun;
  }

  void follow_in_double() {
    support::RoutesTaken::counts() = {};
    follow_rows();
    support::add(tally_.routes, support::RoutesTaken::counts());
    if (worst_ > wanted_double) tally_.coarse["above 1e-11"].push_back(seed_);
  }
  void follow_rows() {
    if (talkative) std::printf("double\n");
    Run<double> run(world_.scene);
    if (!run.condensed()) {
      refuse<double>("condensation: ", run.condensed(), 0);
      return fail(std::string("condensation: ") + taut::describe(run.condensed().code));
    }
    const auto started = run.started();
    if (!started.status) {
      refuse<double>("start: ", started.status, started.fraction);
      return judge(run, started.status, -1, {});
    }
    if (!take(run)) return;
    for (std::size_t row = 0; row < world_.samples.size(); ++row) {
      const Begun begun = remember(run);
      const auto progress = run.advance(world_.samples[row]);
      if (talkative)
        std::printf("  row %zu: %d events, fraction %g\n", row, progress.events, progress.fraction);
      ++tally_.rows;
      tally_.events += progress.events;
      if (!progress.status) {
        refuse<double>("", progress.status, progress.fraction);
        return judge(run, progress.status, int(row), begun);
      }
      if (progress.fraction < 1) return fail("event budget spent");
      if (!take(run)) return;
      found_.push_back(run.tensions());
    }
    ++tally_.solved;
    solved_ = true;
    if ((seed_ % compare_every == 0 || talkative) && world_.scene.mu.size() <= most_joints_of_comparison)
      compare_with_load_steps(run.peak());
  }
  /// All laws may hold after a force has jumped: only the path there tells.
  void compare_with_load_steps(double peak) {
    const double coarse = off_load_steps(few_steps, peak), fine = off_load_steps(many_steps, peak);
    if (coarse < 0 || fine < 0) return;
    ++tally_.compared;
    if (talkative) std::printf("  off load steps by %.1e and %.1e\n", coarse, fine);
    if (fine > accepted_deviation && fine > coarse / 2) fail("load steps come to other forces");
  }
  /// The largest deviation after any row as a part of the largest force, -1 if load steps stop.
  double off_load_steps(int count, double peak) const {
    LoadSteps steps(world_.scene);
    if (!steps.start(count)) return -1;
    Exact most = 0;
    for (std::size_t row = 0; row < world_.samples.size(); ++row) {
      if (!steps.advance(reference::write_out(world_.samples[row]), count)) return -1;
      for (std::size_t i = 0; i < found_[row].size(); ++i)
        most = std::max(most, std::fabs(Exact(found_[row][i]) - steps.tension(int(i))));
    }
    return peak > 0 ? double(most) / peak : double(most);
  }

  /// Refusals count only where double has an answer.
  void follow_in_float() {
    if (talkative) std::printf("float\n");
    Run<float> run(world_.scene);
    bool good = run.status().ok() || refuse<float>("start: ", run.status(), 0);
    for (std::size_t row = 0; good && row < world_.samples.size(); ++row) {
      const auto progress = run.advance(world_.samples[row]);
      good = progress.status.ok() || refuse<float>("", progress.status, double(progress.fraction));
      good = good && progress.fraction >= 1 && take(run);
    }
    if (good) ++tally_.solved_float;
  }

  // Refusals.

  void judge(const Run<double>& run, const taut::Status& status, int row, const Begun& begun) {
    const std::string reason = std::string(row < 0 ? "start: " : "") + taut::describe(status.code);
    const auto say = [&](bool failed, const std::string& verdict) {
      const std::string far =
          failed && slides_beyond_itself(run) ? ", a cable having slid by more than it is long" : "";
      (failed ? tally_.failures : tally_.confirmed)[reason + ": " + verdict + far].push_back(seed_);
      if (talkative) std::printf("  judged: %s%s\n", failed ? "FAILED, " : "", verdict.c_str());
    };
    if (status.code == taut::Code::pulled_through && row >= 0)
      return is_pulled_through(run, status.index) ? say(false, "so say the jacks and the product of rho")
                                                  : say(true, "below the friction there is");
    LoadSteps from_there(world_.scene);
    const LoadSteps::Way way = probe(from_there, run, row, begun);
    if (talkative)
      std::printf("  from there: %s, smallest pivot %.1e\n",
                  way == LoadSteps::Way::goes_on ? "goes on"
                  : way == LoadSteps::Way::jumps ? "jumps"
                                                 : "no answer found",
                  double(from_there.pivot()));
    if (way == LoadSteps::Way::goes_on) return say(true, "it goes on from the state reached");
    const bool slow = slow_judgements-- > 0;
    if (slow && solved_by_reference()) return say(true, "solved by the reference");
    const InLoadSteps few = in_load_steps(few_steps, row);
    const bool solved = few.solved || (slow && solved_by_stepwise());
    const bool jumps = way == LoadSteps::Way::jumps || (few.solved && jumps_however_small(few, row));
    if (solved && !jumps) return say(true, "solved in load steps");
    if (jumps) return say(false, solved ? "load steps jump there" : "all other answers are far away");
    if (from_there.pivot() < Exact(1e-12L)) return say(false, "a mechanism by its rank");
    say(false, from_there.exhausted() ? "no combination of states is an answer" : "no other answer found");
  }
  /// Whether a cable has slid over a joint by more than its length: where nodes are held so softly the theory
  /// of small displacements is at its end, and totals have lost their digits.
  bool slides_beyond_itself(const Run<double>& run) const {
    const auto moves = run.tracker().slip_state();
    const auto& scene = world_.scene;
    for (int c = 0; c < scene.cables.size(); ++c) {
      const auto& cable = scene.cables[c];
      double length = 0;
      for (int k = 0; k < cable.segments(); ++k)
        length += taut::CableElement<double, SceneType::dimension>::of(scene, c, k).line.length;
      for (int j = cable.first_joint; j < cable.first_joint + cable.joints(); ++j)
        if (std::fabs(moves.slip[j]) > length) return true;
    }
    return false;
  }
  bool is_pulled_through(const Run<double>& run, int c) const {
    const support::Anatomy<SceneType> anatomy(world_.scene);
    Exact carried = 1;
    for (int j = 0; j < world_.scene.cables[c].joints(); ++j) carried *= anatomy.ratio(c, j);
    const Exact F0 = Exact(run.jack_force(c, 0)), F1 = Exact(run.jack_force(c, 1));
    return std::min(F0, F1) <= carried * std::max(F0, F1) + Exact(accepted_double) * Exact(run.peak());
  }

  LoadSteps::Way probe(LoadSteps& judge, const Run<double>& run, int row, const Begun& begun) const {
    const auto& tracker = run.tracker();
    const auto reached = tracker.slip_state();
    const auto& loads = tracker.loads();
    const auto& scene = world_.scene;
    LoadSteps::Drive now, goal;
    LoadSteps::Moves moves;
    moves.excess.assign(std::size_t(scene.prestrain.size()), 0);
    for (int r = 0; r < tracker.spans().size(); ++r)
      moves.excess[std::size_t(tracker.spans()[r].segment(0))] = Exact(reached.slack_length[r]);
    for (int j = 0; j < scene.mu.size(); ++j) moves.slip.push_back(Exact(reached.slip[j]));
    for (int k = 0; k < scene.loads; ++k) {
      now.factors.push_back(Exact(loads.factor[k]));
      goal.factors.push_back(row < 0 ? 0 : Exact(world_.samples[std::size_t(row)].factor[k]));
    }
    now.prestrain = Exact(loads.prestrain);
    goal.prestrain = 1;
    for (int c = 0; c < scene.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        const auto& at = loads.jack[c][end];
        LoadSteps::End from{!scene.cables[c].closed && scene.cables[c].ends[end] == taut::End::jacked,
                            at.locked, Exact(at.force), Exact(at.extension)};
        LoadSteps::End to = from;
        moves.extension.push_back(Exact(reached.extension[c][end]));
        if (from.jacked && row >= 0) {
          const auto& asked = world_.samples[std::size_t(row)].jack[c][end];
          const std::size_t i = 2 * std::size_t(c) + end;
          if (asked.locked && !begun.locked[i])
            to.extension = begun.extension[i] - Exact(scene.cables[c].seating);
          if (!asked.locked) to.force = Exact(asked.force);
        }
        now.ends.push_back(from);
        goal.ends.push_back(to);
      }
    return judge.probe(now, goal, moves, Exact(run.peak()));
  }

  /// The whole log in load steps, and the largest change of a force in one of those of a row (-1: of the
  /// prestrain), as a part of the largest force.
  struct InLoadSteps {
    bool solved = false;
    double change = 0;
  };
  InLoadSteps in_load_steps(int count, int row_of_interest) const {
    InLoadSteps found;
    LoadSteps steps(world_.scene);
    bool good = steps.start(count);
    for (int row = -1; good; ++row) {
      if (row == row_of_interest) found.change = double(steps.largest_change());
      if (row + 1 == int(world_.samples.size())) break;
      good = steps.advance(reference::write_out(world_.samples[std::size_t(row + 1)]), count);
    }
    if (talkative)
      std::printf("  %d load steps a row: %s, violation %.1e, forces change by %.1e at once\n", count,
                  good ? "solved" : "not solved", double(steps.violation()), found.change);
    found.solved = good && steps.violation() <= Exact(accepted_double);
    return found;
  }
  /// Whether forces change as much in one of four times as many load steps: then load steps have an answer
  /// because they may jump to it.
  bool jumps_however_small(const InLoadSteps& few, int row) const {
    if (!(few.change > accepted_deviation)) return false;
    const InLoadSteps many = in_load_steps(many_steps, row);
    return many.solved && many.change > few.change / 2;
  }
  bool solved_by_reference() const {
    if (world_.scene.mu.size() > most_joints_of_reference) return false;
    reference::Reference reference(world_.scene);
    bool good = reference.start();
    for (std::size_t row = 0; good && row < world_.samples.size(); ++row)
      good = reference.advance(world_.samples[row]);
    if (talkative) std::printf("  reference: %s\n", good ? "solved" : "not solved");
    return good;
  }
  bool solved_by_stepwise() const {
    const int places = SceneType::dimension * (world_.scene.nodes.size() + 2 * world_.scene.mu.size());
    if (places > most_places_of_stepwise) return false;
    const double off = stepwise_violation(world_, many_steps);
    if (talkative) std::printf("  stepwise: violation %.1e\n", off);
    return off <= accepted_double;
  }

  template <class Scalar>
  bool take(const Run<Scalar>& run) {
    const bool single = sizeof(Scalar) == sizeof(float);
    const double off = run.verified();
    if (talkative) std::printf("    verify %.1e\n", off);
    double& worst = single ? tally_.worst_float : tally_.worst_double;
    if (!single && !(off <= worst)) tally_.worst_seed = seed_;
    if (!single) worst_ = std::max(worst_, off);
    worst = off <= worst ? worst : off;
    if (off <= (single ? accepted_float : accepted_double)) return true;
    fail(single ? "verify() in float" : "verify() in double");
    return false;
  }

  const World<SceneType>& world_;
  std::uint64_t seed_;
  Tally& tally_;
  bool solved_ = false;
  double worst_ = 0;
  std::vector<std::vector<double>> found_;  // tensions after every row
};

void try_seed(ManyKind kind, std::uint64_t seed, Tally& tally) {
  const auto began = std::chrono::steady_clock::now();
  visit_many(kind, seed, [&](const auto& world, support::Random&) {
    using SceneType = std::decay_t<decltype(world.scene)>;
    const auto& scene = world.scene;
    if (talkative)
      std::printf("%s in %s: %d nodes, %d struts, %d cables, %d segments, %d joints, %zu rows\n",
                  world.kind.c_str(), SceneType::dimension == 2 ? "the plane" : "space", scene.nodes.size(),
                  scene.struts.size(), scene.cables.size(), scene.prestrain.size(), scene.mu.size(),
                  world.samples.size());
    Trial<SceneType>(world, seed, tally).run();
  });
  tally.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

Tally try_all(ManyKind kind, std::uint64_t first, long count, int threads) {
  Tally all;
  std::mutex guard;
  std::atomic<long> next{0};
  const auto work = [&] {
    Tally tally;
    for (long i = next++; i < count; i = next++) try_seed(kind, first + std::uint64_t(i), tally);
    const std::lock_guard<std::mutex> lock(guard);
    all.add(tally);
  };
  std::vector<std::thread> workers;
  for (int i = 1; i < threads; ++i) workers.emplace_back(work);
  work();
  for (auto& worker : workers) worker.join();
  return all;
}

void print_list(const char* title, Seeds& lists) {
  if (lists.empty()) return;
  std::printf("  %s\n", title);
  for (auto& [reason, seeds] : lists) {
    std::sort(seeds.begin(), seeds.end());
    std::printf("    %6zu  %s; seeds", seeds.size(), reason.c_str());
    for (std::size_t i = 0; i < seeds.size() && i < 12; ++i)
      std::printf(" %llu", static_cast<unsigned long long>(seeds[i]));
    std::printf(seeds.size() > 12 ? " ...\n" : "\n");
  }
}

/// Prints what was found; returns whether all is well.
bool report(ManyKind kind, Tally& tally) {
  std::printf("%s: %ld scenes, %ld rows, %ld events, %.1f s\n", name_of(kind), tally.scenes, tally.rows,
              tally.events, tally.seconds);
  std::printf("  solved %ld (%.2f %%), in float %ld; %ld compared with load steps\n", tally.solved,
              100.0 * double(tally.solved) / double(std::max(1L, tally.scenes)), tally.solved_float,
              tally.compared);
  std::printf("  worst verify(): double %.1e (seed %llu), float %.1e\n", tally.worst_double,
              static_cast<unsigned long long>(tally.worst_seed), tally.worst_float);
  support::print(tally.routes, "  ");
  print_list("verify() in double:", tally.coarse);
  print_list("refused in double:", tally.refusals);
  print_list("refused in float where double has an answer:", tally.float_refusals);
  print_list("refusals that are right, or that nobody has an answer to:", tally.confirmed);
  print_list("FAILED:", tally.failures);
  std::fflush(stdout);
  return tally.failures.empty();
}

}  // namespace
}  // namespace campaign

int main(int argc, char** argv) {
  using campaign::ManyKind;
  long count = 200, seed = 1;
  int threads = 1, slow = 20;
  std::string only;
  bool no_float = false;
  support::read_options(argc, argv,
                        {{"--count", &count},
                         {"--seed", &seed},
                         {"--threads", &threads},
                         {"--kind", &only},
                         {"--judge", &slow},
                         {"--no-float", &no_float},
                         {"--one", &campaign::talkative}});
  campaign::in_float = !no_float;
  if (campaign::talkative) count = 1;
  bool known = only.empty(), good = true;
  for (int k = 0; k < static_cast<int>(ManyKind::count); ++k) {
    const auto kind = static_cast<ManyKind>(k);
    if (!only.empty() && only != campaign::name_of(kind)) continue;
    known = true;
    campaign::slow_judgements = slow;
    campaign::Tally tally = campaign::try_all(kind, std::uint64_t(seed), count, threads);
    good = campaign::report(kind, tally) && good;
  }
  if (!known) std::fprintf(stderr, "no such kind: %s\n", only.c_str());
  return known && good ? 0 : 1;
}
