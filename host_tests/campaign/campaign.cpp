// Random scenes and logs through the tracker; everything it answers or refuses is checked by other means.
//
//     campaign [--count N] [--seed S] [--threads T] [--no-float] [--one]
//
// --one runs the single scene of --seed and says what is wrong with it.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "campaign/world.hpp"
#include "reference/reference.hpp"
#include "support/campaign_options.hpp"
#include "support/equilibrium.hpp"
#include "support/run.hpp"
#include "taut/stepwise/stepwise.hpp"

namespace campaign {
namespace {

using support::Exact;

// Parts of the largest force so far. The tracker takes forces within 1e-12 for equal (behind a joint with a
// small rho that is 1 / rho times as much), and 1e-6 in a sample without an event in float.
constexpr double accepted_double = 1e-9, accepted_float = 1e-5;

constexpr int restore_every = 10, cut_every = 10, reference_every = 20, stepwise_every = 50;

/// What came of many scenes, added up.
struct Tally {
  long scenes = 0, rows = 0, events = 0, cut = 0, referred = 0, ambiguous = 0, stepped = 0, restored = 0;
  double worst_double = 0, worst_float = 0, worst_cut = 0, worst_reference = 0;
  double least_clearance = 1;            ///< of refusals, see Reference::clearance()
  std::array<double, 3> stepwise_off{};  ///< sums of the deviations with 1, 8 and 64 load steps a path
  std::map<std::string, std::vector<std::uint64_t>> refusals, failures;
  support::RoutesTaken::Counts routes{};

  void add(const Tally& other) {
    scenes += other.scenes;
    rows += other.rows;
    events += other.events;
    cut += other.cut;
    referred += other.referred;
    ambiguous += other.ambiguous;
    stepped += other.stepped;
    restored += other.restored;
    worst_double = std::max(worst_double, other.worst_double);
    worst_float = std::max(worst_float, other.worst_float);
    worst_cut = std::max(worst_cut, other.worst_cut);
    worst_reference = std::max(worst_reference, other.worst_reference);
    least_clearance = std::min(least_clearance, other.least_clearance);
    for (std::size_t i = 0; i < 3; ++i) stepwise_off[i] += other.stepwise_off[i];
    support::add(routes, other.routes);
    for (const auto& entry : other.refusals) append(refusals[entry.first], entry.second);
    for (const auto& entry : other.failures) append(failures[entry.first], entry.second);
  }

 private:
  static void append(std::vector<std::uint64_t>& to, const std::vector<std::uint64_t>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }
};

bool talkative = false;
bool in_float = true;

/// Everything that is tried on one scene.
template <class SceneType>
class Trial {
 public:
  using Cap = typename SceneType::Capacity;
  using Sample = taut::Sample<double, Cap>;
  template <class Scalar>
  using Run = support::Run<Scalar, SceneType>;

  Trial(const World<SceneType>& world, std::uint64_t seed, support::Random& random, Tally& tally)
      : world_(world), seed_(seed), random_(random), tally_(tally), run_(world.scene) {}

  void run() {
    ++tally_.scenes;
    std::vector<std::vector<double>> found;
    const bool good = begin(run_) && follow(found);
    support::add(tally_.routes, support::RoutesTaken::counts());
    if (!good) return;
    if (in_float) follow_in_float();
    if (seed_ % cut_every == 0) follow_in_pieces(found);
    if (seed_ % restore_every == 0) follow_restored<double>();
    if (seed_ % restore_every == 0 && in_float) follow_restored<float>();
    if (seed_ % reference_every == 0 || talkative) compare_with_reference(found);
    if (seed_ % stepwise_every == 0) compare_with_stepwise(found);
  }

 private:
  void fail(const std::string& what) { tally_.failures[world_.kind + ": " + what].push_back(seed_); }

  template <class Scalar>
  bool begin(const Run<Scalar>& run) {
    const bool single = sizeof(Scalar) == sizeof(float);
    if (!run.condensed()) {
      const std::string reason = taut::describe(run.condensed().code);
      tally_.refusals[(single ? "float, condensation: " : "condensation: ") + reason].push_back(seed_);
      return false;
    }
    const auto progress = run.started();
    if (!progress.status) {
      if (single)
        fail(std::string("float start: ") + taut::describe(progress.status.code));
      else
        judge_refusal(progress.status, static_cast<double>(progress.fraction), -1);
    }
    return progress.status.ok();
  }

  bool follow(std::vector<std::vector<double>>& found) {
    for (std::size_t row = 0; row < world_.samples.size(); ++row) {
      const auto progress = run_.advance(world_.samples[row]);
      ++tally_.rows;
      tally_.events += progress.events;
      if (!progress.status) {
        judge_refusal(progress.status, progress.fraction, int(row));
        return false;
      }
      if (progress.fraction < 1) {
        fail("event budget spent");
        return false;
      }
      const double off = run_.verified();
      if (talkative) std::printf("row %zu: %d events, verify %.1e\n", row, progress.events, off);
      if (!(off <= accepted_double)) {
        fail("verify() in double");
        return false;
      }
      tally_.worst_double = std::max(tally_.worst_double, off);
      found.push_back(run_.tensions());
    }
    return true;
  }

  void follow_in_float() {
    Run<float> run(world_.scene);
    if (!begin(run)) return;
    for (std::size_t row = 0; row < world_.samples.size(); ++row) {
      const auto progress = run.advance(world_.samples[row]);
      if (!progress.status || progress.fraction < 1) {
        fail(std::string("float: ") + taut::describe(progress.status.code));
        return;
      }
      const double off = run.verified();
      if (talkative) std::printf("float row %zu: %d events, verify %.1e\n", row, progress.events, off);
      if (!(off <= accepted_float)) {
        fail("verify() in float");
        return;
      }
      tally_.worst_float = std::max(tally_.worst_float, off);
    }
  }

  /// Between rows without a change of locks the path is the same in one piece or in three.
  void follow_in_pieces(const std::vector<std::vector<double>>& found) {
    Run<double> run(world_.scene);
    if (!run.status()) return;
    ++tally_.cut;
    Sample before;
    for (std::size_t row = 0; row < world_.samples.size(); ++row) {
      const Sample& goal = world_.samples[row];
      const double first = random_.between(0, 1), second = random_.between(first, 1);
      for (const double part : {first, second})
        if (same_locks(before, goal) && !run.advance(between(before, goal, part)).status)
          return fail("refused in pieces");
      if (!run.advance(goal).status) return fail("refused in pieces");
      const double off = difference(run.tensions(), found[row], run.peak());
      if (talkative) std::printf("in pieces, row %zu: off by %.1e\n", row, off);
      if (!(off <= accepted_double)) return fail("another answer in pieces");
      tally_.worst_cut = std::max(tally_.worst_cut, off);
      before = goal;
    }
  }
  /// A tracker that is saved and restored after every row goes on with the same bits.
  template <class Scalar>
  void follow_restored() {
    Run<Scalar> run(world_.scene), restored(world_.scene);
    if (!run.status()) return;
    ++tally_.restored;
    for (const Sample& goal : world_.samples) {
      if (!restored.replace_tracker()) return fail("not restored");
      const auto progress = run.advance(goal);
      const auto again = restored.advance(goal);
      if (progress.status.code != again.status.code || progress.events != again.events ||
          run.tensions() != restored.tensions())
        return fail("other bits after restore()");
      if (!progress.status) return;
    }
  }
  static bool same_locks(const Sample& a, const Sample& b) {
    for (int c = 0; c < Cap::cables; ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (a.jack[c][end].locked != b.jack[c][end].locked) return false;
    return true;
  }
  static Sample between(const Sample& a, const Sample& b, double part) {
    Sample mixed = b;
    for (int i = 0; i < Cap::loads; ++i) mixed.factor[i] = a.factor[i] + part * (b.factor[i] - a.factor[i]);
    for (int c = 0; c < Cap::cables; ++c)
      for (std::size_t end = 0; end < 2; ++end)
        mixed.jack[c][end].force =
            a.jack[c][end].force + part * (b.jack[c][end].force - a.jack[c][end].force);
    return mixed;
  }
  static double difference(const std::vector<double>& a, const std::vector<double>& b, double scale) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
    return scale > 0 ? most / scale : most;
  }

  void compare_with_reference(const std::vector<std::vector<double>>& found) {
    reference::Reference reference(world_.scene);
    bool good = reference.start();
    ++tally_.referred;
    for (std::size_t row = 0; row < world_.samples.size(); ++row) {
      good = good && reference.advance(world_.samples[row]);
      // From here on the two may rightly differ.
      if (reference.events_with_several_answers() > 0) {
        ++tally_.ambiguous;
        return;
      }
      if (!good) return fail("the reference has no answer");
      double off = 0;
      for (std::size_t i = 0; i < found[row].size(); ++i)
        off = std::max(off, double(std::fabs(Exact(found[row][i]) - reference.tension(int(i)))));
      const double scale = std::max(double(reference.peak()), run_.peak());
      if (scale > 0) off /= scale;
      if (talkative) std::printf("reference, row %zu: off by %.1e\n", row, off);
      if (!(off <= accepted_double)) return fail("other than the reference");
      tally_.worst_reference = std::max(tally_.worst_reference, off);
    }
  }

  void compare_with_stepwise(const std::vector<std::vector<double>>& found) {
    std::array<double, 3> off{};
    const int substeps[] = {1, 8, 64};
    const auto solver = std::make_unique<taut::Stepwise<double, SceneType>>();
    for (std::size_t k = 0; k < 3; ++k) {
      if (!solver->start(world_.scene, substeps[k])) return;
      for (std::size_t row = 0; row < world_.samples.size(); ++row) {
        if (!solver->advance(world_.samples[row], substeps[k])) return;
        std::vector<double> stepped;
        for (int i = 0; i < world_.scene.prestrain.size(); ++i)
          stepped.push_back(solver->response().tension[i]);
        off[k] += difference(stepped, found[row], run_.peak());
      }
    }
    ++tally_.stepped;
    for (std::size_t k = 0; k < 3; ++k) tally_.stepwise_off[k] += off[k];
  }

  // Refusals.

  /// The reference must refuse in the same place, and friction must say that a cable is pulled through.
  void judge_refusal(const taut::Status& status, double fraction, int row) {
    tally_.refusals[world_.kind + ": " + taut::describe(status.code)].push_back(seed_);
    if (talkative) {
      std::printf("refused in row %d at %.17g: %s, index %d\n", row, fraction, taut::describe(status.code),
                  status.index);
      std::printf("verify %.1e\n", run_.verified());
    }
    if (status.code == taut::Code::pulled_through && !is_pulled_through(status.index, row))
      return fail("pulled_through below the friction there is");
    reference::Reference reference(world_.scene);
    bool good = reference.start();
    int reached = -1;
    while (good && reached < row) good = reference.advance(world_.samples[std::size_t(++reached)]);
    if (talkative)
      std::printf("reference: %d in row %d at %.17g, several answers %d, clearance %.1e\n", int(good),
                  reached, double(reference.fraction()), reference.events_with_several_answers(),
                  double(reference.clearance()));
    if (reference.events_with_several_answers() > 0) {
      ++tally_.ambiguous;
      return;
    }
    if (good || reached != row || std::fabs(double(reference.fraction()) - fraction) > accepted_double)
      return fail(std::string("refused, not by the reference: ") + taut::describe(status.code));
    tally_.least_clearance = std::min(tally_.least_clearance, double(reference.clearance()));
    if (!(reference.clearance() > Exact(accepted_double)))
      fail(std::string("refused by a hair: ") + taut::describe(status.code));
  }
  bool is_pulled_through(int c, int row) const {
    const auto& cable = world_.scene.cables[c];
    const auto& goal = world_.samples[std::size_t(row)].jack[c];
    if (cable.segments() == 1) return goal[0].force != goal[1].force;
    const support::Anatomy<SceneType> anatomy(world_.scene);
    Exact carried = 1;
    for (int j = 0; j < cable.joints(); ++j) carried *= anatomy.ratio(c, j);
    const Exact F0 = Exact(run_.jack_force(c, 0)), F1 = Exact(run_.jack_force(c, 1));
    return std::min(F0, F1) <= carried * std::max(F0, F1) + Exact(accepted_double) * Exact(run_.peak());
  }

  const World<SceneType>& world_;
  std::uint64_t seed_;
  support::Random& random_;
  Tally& tally_;
  Run<double> run_;
};

void try_seed(std::uint64_t seed, Tally& tally) {
  visit_world(seed, [&](const auto& world, support::Random& random) {
    using SceneType = std::decay_t<decltype(world.scene)>;
    support::RoutesTaken::counts() = {};
    if (talkative) std::printf("%s, %d joints\n", world.kind.c_str(), world.scene.mu.size());
    Trial<SceneType>(world, seed, random, tally).run();
  });
}

Tally try_all(std::uint64_t first, long count, int threads) {
  Tally all;
  std::mutex guard;
  std::atomic<long> next{0};
  const auto work = [&] {
    Tally tally;
    for (long i = next++; i < count; i = next++) try_seed(first + std::uint64_t(i), tally);
    const std::lock_guard<std::mutex> lock(guard);
    all.add(tally);
  };
  std::vector<std::thread> workers;
  for (int i = 1; i < threads; ++i) workers.emplace_back(work);
  work();
  for (auto& worker : workers) worker.join();
  return all;
}

void print_list(const char* title, std::map<std::string, std::vector<std::uint64_t>>& lists) {
  std::printf("%s\n", title);
  for (auto& [reason, seeds] : lists) {
    std::sort(seeds.begin(), seeds.end());
    std::printf("  %6zu  %s; seeds", seeds.size(), reason.c_str());
    for (std::size_t i = 0; i < seeds.size() && i < 12; ++i)
      std::printf(" %llu", static_cast<unsigned long long>(seeds[i]));
    std::printf(seeds.size() > 12 ? " ...\n" : "\n");
  }
  if (lists.empty()) std::printf("  none\n");
}

/// Prints what was found; returns whether all is well.
bool report(Tally& tally) {
  std::printf("%ld scenes, %ld rows, %ld events\n", tally.scenes, tally.rows, tally.events);
  std::printf("worst verify(): double %.1e, float %.1e\n", tally.worst_double, tally.worst_float);
  std::printf("%ld scenes in pieces: worst %.1e\n", tally.cut, tally.worst_cut);
  std::printf("%ld times saved and restored after every row\n", tally.restored);
  std::printf("%ld scenes against the reference: worst %.1e; %ld had several answers\n", tally.referred,
              tally.worst_reference, tally.ambiguous);
  const auto& off = tally.stepwise_off;
  std::printf("%ld scenes against stepwise: mean deviation of a scene with 1, 8, 64 steps %.1e %.1e %.1e\n",
              tally.stepped, off[0] / double(std::max(1L, tally.stepped)),
              off[1] / double(std::max(1L, tally.stepped)), off[2] / double(std::max(1L, tally.stepped)));
  std::printf("least contradiction in what is refused: %.1e of the rates\n", tally.least_clearance);
  support::print(tally.routes);
  print_list("refused:", tally.refusals);
  print_list("FAILED:", tally.failures);
  // In the mean only: a single scene may be lucky with few steps.
  const bool closer = tally.stepped < 20 || (off[2] < off[1] && off[1] < off[0]);
  if (!closer) std::printf("stepwise does not come closer with more steps\n");
  return tally.failures.empty() && closer;
}

}  // namespace
}  // namespace campaign

int main(int argc, char** argv) {
  long count = 2000, seed = 1;
  int threads = 1;
  bool no_float = false;
  support::read_options(argc, argv,
                        {{"--count", &count},
                         {"--seed", &seed},
                         {"--threads", &threads},
                         {"--no-float", &no_float},
                         {"--one", &campaign::talkative}});
  campaign::in_float = !no_float;
  if (campaign::talkative) count = 1;
  campaign::Tally tally = campaign::try_all(std::uint64_t(seed), count, threads);
  return campaign::report(tally) ? 0 : 1;
}
