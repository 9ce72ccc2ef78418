// Random scenes of many cables, kind by kind, through the tracker: what it solves, what it refuses and why.
//
//     many_cables [--count N] [--seed S] [--threads T] [--kind NAME] [--no-float] [--one]
//
// N scenes of every kind, or of one. --one runs the single scene of --seed (with --kind) and says what
// happens in every row.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <thread>

#include "campaign/many_cables_run.hpp"

namespace campaign {
namespace {

// Parts of the largest force so far.
constexpr double accepted_double = 1e-9, accepted_float = 1e-5;

using Seeds = std::map<std::string, std::vector<std::uint64_t>>;

/// What came of many scenes of one kind, added up.
struct Tally {
  long scenes = 0, rows = 0, events = 0, solved = 0, solved_float = 0;
  double worst_double = 0, worst_float = 0, seconds = 0;
  std::uint64_t worst_seed = 0;
  Seeds refusals, float_refusals, failures;

  void add(const Tally& other) {
    scenes += other.scenes;
    rows += other.rows;
    events += other.events;
    solved += other.solved;
    solved_float += other.solved_float;
    if (other.worst_double > worst_double) worst_seed = other.worst_seed;
    worst_double = std::max(worst_double, other.worst_double);
    worst_float = std::max(worst_float, other.worst_float);
    seconds += other.seconds;
    append(refusals, other.refusals);
    append(float_refusals, other.float_refusals);
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
    follow<double>();
    if (in_float) follow<float>();
  }

 private:
  void fail(const std::string& what) { tally_.failures[what].push_back(seed_); }

  template <class Scalar>
  void refuse(const std::string& where, const taut::Status& status, double fraction) {
    auto& list = sizeof(Scalar) == sizeof(float) ? tally_.float_refusals : tally_.refusals;
    list[where + taut::describe(status.code)].push_back(seed_);
    if (talkative)
      std::printf("  refused at %.17g: %s, cable %d, index %d\n", fraction, taut::describe(status.code),
                  status.cable, status.index);
  }

  template <class Scalar>
  void follow() {
    const bool single = sizeof(Scalar) == sizeof(float);
    if (talkative) std::printf("%s\n", single ? "float" : "double");
    Run<Scalar> run(world_.scene);
    if (!run.condensed()) return refuse<Scalar>("condensation: ", run.condensed(), 0);
    const auto started = run.started();
    if (!started.status) return refuse<Scalar>("start: ", started.status, double(started.fraction));
    if (!take(run)) return;
    for (std::size_t row = 0; row < world_.samples.size(); ++row) {
      const auto progress = run.advance(world_.samples[row]);
      if (talkative)
        std::printf("  row %zu: %d events, fraction %g\n", row, progress.events, double(progress.fraction));
      if (!single) {
        ++tally_.rows;
        tally_.events += progress.events;
      }
      if (!progress.status) return refuse<Scalar>("", progress.status, double(progress.fraction));
      if (progress.fraction < 1) {
        if (!single) fail("event budget spent");
        return;
      }
      if (!take(run)) return;
    }
    ++(single ? tally_.solved_float : tally_.solved);
  }

  template <class Scalar>
  bool take(const Run<Scalar>& run) {
    const bool single = sizeof(Scalar) == sizeof(float);
    const double off = run.verified();
    if (talkative) std::printf("    verify %.1e\n", off);
    double& worst = single ? tally_.worst_float : tally_.worst_double;
    if (!single && !(off <= worst)) tally_.worst_seed = seed_;
    worst = off <= worst ? worst : off;
    if (off <= (single ? accepted_float : accepted_double)) return true;
    fail(single ? "verify() in float" : "verify() in double");
    return false;
  }

  const World<SceneType>& world_;
  std::uint64_t seed_;
  Tally& tally_;
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
  std::printf("  solved %ld (%.2f %%), in float %ld\n", tally.solved,
              100.0 * double(tally.solved) / double(std::max(1L, tally.scenes)), tally.solved_float);
  std::printf("  worst verify(): double %.1e (seed %llu), float %.1e\n", tally.worst_double,
              static_cast<unsigned long long>(tally.worst_seed), tally.worst_float);
  print_list("refused in double:", tally.refusals);
  print_list("refused in float:", tally.float_refusals);
  print_list("FAILED:", tally.failures);
  std::fflush(stdout);
  return tally.failures.empty();
}

}  // namespace
}  // namespace campaign

int main(int argc, char** argv) {
  using campaign::ManyKind;
  long count = 200, seed = 1;
  int threads = 1;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    const char* value = i + 1 < argc ? argv[i + 1] : "0";
    if (std::strcmp(argv[i], "--count") == 0) count = std::atol(value);
    if (std::strcmp(argv[i], "--seed") == 0) seed = std::atol(value);
    if (std::strcmp(argv[i], "--threads") == 0) threads = std::atoi(value);
    if (std::strcmp(argv[i], "--kind") == 0) only = value;
    if (std::strcmp(argv[i], "--no-float") == 0) campaign::in_float = false;
    if (std::strcmp(argv[i], "--one") == 0) campaign::talkative = true;
  }
  if (campaign::talkative) count = 1;
  bool known = only.empty(), good = true;
  for (int k = 0; k < static_cast<int>(ManyKind::count); ++k) {
    const auto kind = static_cast<ManyKind>(k);
    if (!only.empty() && only != campaign::name_of(kind)) continue;
    known = true;
    campaign::Tally tally = campaign::try_all(kind, std::uint64_t(seed), count, threads);
    good = campaign::report(kind, tally) && good;
  }
  if (!known) std::fprintf(stderr, "no such kind: %s\n", only.c_str());
  return known && good ? 0 : 1;
}
