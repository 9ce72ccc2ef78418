// Counts the instructions of the parts of taut on an emulated board, one line a part over the serial line.
//
// BENCH_TRACK: the tracker follows the exported scene; BENCH_VERIFY: verify() after every sample;
// BENCH_ESTIMATE: the estimator follows it from readings with noise, the far end's cell in one sample of
// three; BENCH_PLAN: the next moves of its jack are looked for then, event by event; BENCH_RAMP: both follow
// the log of host_tests/benchmark instead; BENCH_CONDENSE: a scene of BENCH_JOINTS joints in BENCH_DIMENSION
// dimensions is condensed, with struts if BENCH_STRUTS. With none of them what is left is the program that
// the sizes are compared with.
#include <cstdint>

#include "board.hpp"
#include "boards/cortex_m/run.hpp"
#include "boards/cortex_m/stack.hpp"
#if BENCH_TRACK
#include "flash_scene.hpp"
#include "taut/condensation/second_order.hpp"
#include "taut/tracking/tracker.hpp"
#include "taut/tracking/verify.hpp"
#endif
#if BENCH_ESTIMATE
#include "flash_scene.hpp"
#include "taut/condensation/second_order.hpp"
#include "taut/estimation/estimator.hpp"
#endif
#if BENCH_PLAN
#include "taut/planning/jack_planner.hpp"
#endif
#if BENCH_CONDENSE
#include "taut/condensation/condense.hpp"
#endif

namespace boards {

// Nothing interrupts the count.
void on_receive() {}
void on_tick() {}
void restart_after_fault() {
  for (;;) {
  }
}

}  // namespace boards

namespace {

volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}
constexpr std::uintptr_t uart = 0x40004000, timer = 0x40000000;

void say(char letter) { at(uart) = static_cast<std::uint8_t>(letter); }
void say(const char* word) {
  for (; *word != '\0'; ++word) say(*word);
}
void say(std::uint32_t number) {
  char digits[10];
  int count = 0;
  do {
    digits[count++] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number > 0);
  say(' ');
  while (count > 0) say(digits[--count]);
}
void say(const char* word, std::uint32_t number) {
  say(word);
  say(number);
  say('\n');
}

/// The emulator gives every instruction 256 ns; the timer counts 40 ns.
std::uint32_t ticks() {
  asm volatile("" ::: "memory");
  const std::uint32_t now = 0xFFFFFFFF - at(timer + 4);
  asm volatile("" ::: "memory");
  return now;
}
std::uint32_t instructions(std::uint32_t from, std::uint32_t to) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(to - from) * 40 / 256);
}

template <class Part>
std::uint32_t count(Part part) {
  const std::uint32_t from = ticks();
  part();
  return instructions(from, ticks());
}

#if BENCH_TRACK || BENCH_ESTIMATE
#if BENCH_RAMP
constexpr int steps = 1000;

/// What a jack pulls after it has pulled `force`: a ramp and a hold.
float next(float, int step) { return 200.0F * static_cast<float>(step < 500 ? step + 1 : 500); }
constexpr int far_end_every = 1;  // samples
#else
constexpr int steps = 96;

/// What a jack pulls after it has pulled `force`: it pulls, releases, pulls again, with small changes in
/// between.
float next(float force, int step) {
  return force + (step / 24 == 2 ? -1.0F : 1.0F) * (step % 3 == 2 ? 20.0F : 4000.0F);
}
constexpr int far_end_every = 3;
#endif
#endif

#if BENCH_TRACK
using Cap = monitor::FlashScene::Capacity;
taut::Tracker<monitor::FlashScene::Model> tracker;
taut::Sample<float, Cap> sample;
volatile float worst = 0;

void track() {
  const auto& model = taut::linear_part(monitor::FlashScene::model());
  tracker.start(monitor::FlashScene::model()).status.ok();
  float force = 0;
  for (int step = 0; step < steps; ++step) {
    force = next(force, step);
    bool second = false;
    taut::for_each_jacked_end(model.cables, [&](int c, std::size_t end) {
      sample.jack[c][end].force = second ? force * 0.97F : force;
      second = true;
    });
    for (int i = 0; i < model.loads; ++i) sample.factor[i] = static_cast<float>(step % 32) / 32.0F;
    int events = 0;
    bool good = false;
    const std::uint32_t used = count([&] {
      const auto progress = tracker.advance(sample);
      events = progress.events;
      good = progress.status.ok() && progress.fraction >= 1;
    });
    say(good ? "sample" : "refused");
    say(static_cast<std::uint32_t>(events));
    say(used);
    say('\n');
#if BENCH_VERIFY
    say("verify", count([&] { worst = taut::verify(tracker).worst(); }));
#endif
  }
}
#endif

#if BENCH_ESTIMATE
using Cap = monitor::FlashScene::Capacity;
using Model = taut::Condensed<float, Cap>;
taut::Estimator<monitor::FlashScene::Model, monitor::FlashScene::unknowns,
                monitor::FlashScene::reading_unknowns>
    estimator;
taut::Readings<float, Cap> readings;
volatile float answered = 0;

/// About Gaussian, of standard deviation one.
float noise() {
  static std::uint32_t seed = 4711;
  float sum = 0;
  for (int i = 0; i < 12; ++i) {
    seed = seed * 1664525U + 1013904223U;
    sum += static_cast<float>(seed >> 8) / 16777216.0F;
  }
  return sum - 6;
}

/// What the far end has in truth when the jack pulls `force`, with a fifth less friction than is known: it
/// follows where all joints slide, and rests in between.
float far_end(const Model& model, float force) {
  static float far = 0;
  float held = 1;
  for (int j = 0; j < model.joints; ++j) held *= 1 - 0.8F * (1 - static_cast<float>(model.rho[j]));
  if (far < force * held) far = force * held;
  if (far > force / held) far = force / held;
  return far;
}

/// The cable is jacked at its end.
void estimate() {
  const Model& model = taut::linear_part(monitor::FlashScene::model());
  const auto& prior = monitor::FlashScene::prior();
  const auto& cell = prior.cell[0];
  estimator.start(monitor::FlashScene::model(), prior).status.ok();
  float force = 0;
  for (int step = 0; step < steps; ++step) {
    force = next(force, step);
    readings.ends[0][1] = {true, false, force + cell[1].sd * noise(), 0};
    const bool measured = step % far_end_every == 0;
    readings.ends[0][0] = {measured, false, far_end(model, force) + cell[0].sd * noise(), 0};
    int events = 0;
    bool good = false;
    const std::uint32_t used = count([&] {
      const auto progress = estimator.advance(readings);
      events = progress.events;
      good = progress.status.ok() && progress.fraction >= 1;
#if BENCH_RAMP
      const auto [force_there, deviation] = estimator.estimate(0);
      answered = force_there + deviation;
#endif
    });
    say(!good ? "refused" : measured ? "measured" : "sample");
    say(static_cast<std::uint32_t>(events));
    say(used);
    say('\n');
    say("answer", count([&] {
          for (int i = 0; i < model.segments; ++i) {
            const auto here = estimator.estimate(i);
            answered = here.force + here.deviation;
          }
        }));
  }
}
#endif

#if BENCH_PLAN
taut::JackPlanner<decltype(estimator)::TrackerType> planner;

/// After estimate(): the jack stands at 120 kN and has been further; mu is a fifth less than was known.
void plan() {
  decltype(planner)::Goal goal;
  goal.target.fill(110000);
  std::uint32_t all = count([&] {
    if (!planner.begin(estimator, goal, 0, 1)) say("refused", 0);
  });
  std::uint32_t worst = 0;
  while (!planner.is_done()) {
    const std::uint32_t used = count([] { planner.step(1); });
    all += used;
    if (used > worst) worst = used;
  }
  say("plan_events", static_cast<std::uint32_t>(planner.events()));
  say("plan_all", all);
  say("plan_most", worst);
  say("plan_error", static_cast<std::uint32_t>(1e4F * planner.best().error));
}
#endif

#if BENCH_CONDENSE
struct Whole : taut::Capacity {
  static constexpr int nodes = 2 * BENCH_JOINTS + 3, struts = BENCH_STRUTS ? 2 * BENCH_JOINTS : 0,
                       segments = BENCH_JOINTS + 1, joints = BENCH_JOINTS;
};
using SceneType = taut::Scene<float, BENCH_DIMENSION, Whole>;
SceneType scene;
taut::Condensation<float, SceneType> condensation;
taut::Condensed<float, Whole> condensed;

SceneType::Point point(float x, float y) {
  SceneType::Point at{};
  at[0] = x;
  at[1] = y;
  return at;
}

/// The scene of measure's scene_of(): a parabola, every node on two struts.
void condense() {
  constexpr int n = BENCH_JOINTS;
  constexpr auto all = BENCH_DIMENSION == 2 ? taut::held_xy : taut::held_xyz;
  constexpr auto free = BENCH_STRUTS ? (BENCH_DIMENSION == 2 ? taut::held_none : taut::held_z) : all;
  int path[n + 2];
  for (int i = 0; i < n + 2; ++i) {
    const float x = static_cast<float>(i), t = 2 * x / (n + 1) - 1;
    path[i] =
        scene.add_node(point(x, 0.25F * static_cast<float>(n) * t * t), i == 0 || i == n + 1 ? all : free);
  }
  if (BENCH_STRUTS) {
    int left = scene.add_node(point(0.5F, -2 - static_cast<float>(n) / 8), all);
    for (int i = 1; i <= n; ++i) {
      const int right =
          scene.add_node(point(static_cast<float>(i) + 0.5F, -2 - static_cast<float>(n) / 8), all);
      scene.add_strut(path[i], left, 2.1e11F, 1e-3F);
      scene.add_strut(path[i], right, 2.1e11F, 1e-3F);
      left = right;
    }
  }
  taut::Cable<float> cable;
  cable.E = 1.95e11F;
  cable.A = 1e-3F;
  cable.mu = 0.1F;
  cable.ends[1] = taut::End::jacked;
  scene.add_cable(cable, path, n + 2);
  bool good = false;
  const std::uint32_t used = count([&] { good = condensation.run(scene, condensed).ok(); });
  say(good ? "condense" : "refused", used);
}
#endif

/// Tells the emulator to end.
[[noreturn]] void end() {
  asm volatile(
      "mov r0, #0x18\n"
      "ldr r1, =0x20026\n"
      "bkpt 0xab" ::
          : "r0", "r1", "memory");
  for (;;) {
  }
}

}  // namespace

void run() {
  at(uart + 0x10) = 16;
  at(uart + 8) = 1;
  at(timer + 8) = 0xFFFFFFFF;
  at(timer + 4) = 0xFFFFFFFF;
  at(timer) = 1;
  say("nothing", count([] {}));
#if BENCH_TRACK
  track();
#endif
#if BENCH_ESTIMATE
  estimate();
#endif
#if BENCH_PLAN
  plan();
#endif
#if BENCH_CONDENSE
  condense();
#endif
  say("stack", boards::stack_used());
  end();
}
