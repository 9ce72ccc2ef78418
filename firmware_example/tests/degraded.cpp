// Trouble is said in the answer, and the next good sample gets a good answer.
#include <cmath>
#include <limits>

#include "rig.hpp"

namespace degraded_test {
using namespace rig;

namespace {

struct OneEvent : monitor::Settings {
  static constexpr int event_budget = 1, most_calls = 1;
};
struct Strict : monitor::Settings {
  static constexpr float most_violation = -1;
};

/// A node that nothing holds.
struct LooseCapacity : taut::Capacity {
  static constexpr int nodes = 4, struts = 1, segments = 2, joints = 1;
};
constexpr taut::Scene<float, 2, LooseCapacity> make_loose() {
  taut::Scene<float, 2, LooseCapacity> scene;
  const int a = scene.add_node({0, 0}, taut::held_xy), b = scene.add_node({1, -1}),
            c = scene.add_node({2, 0}, taut::held_xy), d = scene.add_node({1, -2});
  scene.add_strut(b, d, 1e11F, 1e-4F);
  taut::Cable<float> cable;
  cable.E = 1e11F;
  cable.A = 1e-4F;
  scene.add_cable(cable, {a, b, c});
  return scene;
}
constexpr auto loose = make_loose();

using Board = monitor::host::MemoryBoard;
using Refusing = Rig<monitor::Application<Board, monitor::Settings, monitor::CondensedAtStartUp<loose>,
                                          monitor::FromFlash<monitor::FlashScene>>>;

/// Bytes beyond the room of the ring are lost, as with an interrupt that has nowhere to put them.
struct RingBoard : Board {
  void arrive(const std::string& bytes) {
    for (const char byte : bytes)
      if (to_device.size() < 512)
        to_device += byte;
      else
        ++lost;
  }
};

}  // namespace

TEST_CASE("a sensor out of range: the forces before are held, and the next sample is good") {
  Plain device;
  settle(device, rolling_joint);
  const Fields before = device.ask(sample(1, {40000, 0, 0}));
  std::uint32_t number = 1;
  for (const float wrong :
       {2e7F, -3e4F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity()}) {
    const Fields answer = device.ask(sample(++number, {wrong, 1000, 0}));
    CHECK(quality(answer) == 'h');
    CHECK(alarms(answer).has(Alarm::sensor_range));
    CHECK(state(answer) == state(before));
  }
  const Fields after = device.ask(sample(++number, {40000, 0, 0}));
  CHECK(quality(after) == 'g');
  CHECK(alarms(after).bits() == 0);
  CHECK(tensions(after, 6) == tensions(before, 6));
}

TEST_CASE("a load factor that is no number, or more than cables carry, is refused like a sensor") {
  Plain device;
  settle(device, truss_string);
  const Fields before = device.ask(sample(1, {0, 1000}));
  std::uint32_t number = 1;
  for (const float wrong :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 9.9e37F, -9.9e37F}) {
    const Fields answer = device.ask(sample(++number, {wrong, 1000}));
    CHECK(quality(answer) == 'h');
    CHECK(alarms(answer).has(Alarm::sensor_range));
    CHECK(state(answer) == state(before));
  }
  const Fields after = device.ask(sample(++number, {0, 1000}));
  CHECK(quality(after) == 'g');
  CHECK(tensions(after, 4) == tensions(before, 4));
}

TEST_CASE("a little below zero is zero") {
  Plain device;
  settle(device, rolling_joint);
  const Fields answer = device.ask(sample(1, {-120, 0, 0}));
  CHECK(quality(answer) == 'g');
  CHECK(tension(answer, 1) == 0);
}

TEST_CASE("a cell that says the same again and again is frozen; at rest it may") {
  Plain device;
  settle(device, rolling_joint);
  device.ask("G " + real_field(-100) + " " + real_field(1e6F) + " " + number_field(5));
  for (std::uint32_t number = 1; number < 20; ++number) {
    const Alarms found = alarms(device.ask(sample(number, {40000, 0, number % 2 == 0 ? 100.0F : 101.0F})));
    CHECK(found.has(Alarm::sensor_frozen) == (number >= 5));
  }
  CHECK(alarms(device.ask(sample(20, {40001, 0, 0}))).bits() == 0);
}

TEST_CASE("an event budget that is spent is said, and the same sample goes on from there") {
  Plain free;
  settle(free, truss_string);
  using Tight = Rig<monitor::Monitor<Board, OneEvent>>;
  Tight device;
  device.ask("Q");
  device.ask(choose(truss_string));
  device.ask("P");
  std::uint32_t number = 0;
  int behind = 0;
  for (const auto& row : truss_log()) {
    Fields answer = device.ask(sample(++number, row));
    for (int again = 0; quality(answer) != 'g' && again < 20; ++again) {
      CHECK(quality(answer) == 'b');
      CHECK(alarms(answer).has(Alarm::budget_exceeded));
      CHECK(real(answer.at(5)) < 1);
      ++behind;
      answer = device.ask(sample(++number, row));
    }
    CHECK(quality(answer) == 'g');
    CHECK(alarms(answer).bits() == 0);
    const Fields expected = free.ask(sample(number, row));
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(tension(answer, i) == doctest::Approx(static_cast<double>(tension(expected, i))).epsilon(1e-5));
  }
  CHECK(behind > 0);
}

TEST_CASE("what verify() doubts is not shown as good") {
  Rig<monitor::Monitor<Board, Strict>> device;
  device.ask(choose(truss_string));
  const Fields answer = device.ask(sample(1, {0, 100000}));
  CHECK(quality(answer) != 'g');
  CHECK(alarms(answer).has(Alarm::doubtful));
}

TEST_CASE("a scene that cannot be used is refused by name, and another one can be chosen") {
  Refusing device;
  CHECK(device.greeting.at(4) == number_field(static_cast<std::uint32_t>(taut::Code::mechanism)));
  const Fields answer = device.ask(sample(1, {}));
  CHECK(quality(answer) == 'n');
  CHECK(alarms(answer).has(Alarm::scene_refused));
  CHECK(answer.size() == 10);
  CHECK(device.ask("L 00000000 00000001") == Fields{"E", "cell"});
  device.ask(choose(1));
  device.ask("P");
  CHECK(quality(device.ask(sample(1, {40000, 0, 0}))) == 'g');
}

TEST_CASE("silence is said once, and over with the next sample") {
  Plain device;
  settle(device, rolling_joint);
  device.board.clock += monitor::Settings::silence_after - 1;
  device.run();
  CHECK(device.answers().empty());
  device.board.clock += 1;
  device.run();
  CHECK(device.one_answer().at(0) == "!");
  device.board.clock += 100000;
  device.run();
  CHECK(device.answers().empty());
  CHECK(alarms(device.ask(sample(1, {0, 0, 0}))).has(Alarm::silence));
  CHECK(alarms(device.ask(sample(2, {0, 0, 0}))).bits() == 0);
}

TEST_CASE("samples that come too fast lose bytes, which is said; afterwards all is well") {
  Rig<monitor::Monitor<RingBoard>, RingBoard> device;
  device.ask(choose(rolling_joint));
  device.ask("P");
  std::string burst;
  for (std::uint32_t number = 1; number <= 200; ++number)
    burst += framed(sample(number, {40000, static_cast<float>(number), 0}));
  device.board.arrive(burst);
  device.run();
  Alarms said;
  std::uint32_t last = 0;
  for (const Fields& answer : device.answers()) {
    if (answer[0] != "A") continue;
    said.add(alarms(answer));
    CHECK(sequence(answer) == last + 1);
    CHECK(tension(answer, 3) == static_cast<float>(last + 1));
    last = sequence(answer);
  }
  CHECK(last > 0);
  CHECK(last < 200);
  CHECK(said.has(Alarm::bytes_lost));
  // What was left of the last frame runs into the next one.
  device.board.to_device += framed(sample(201, {40000, 201, 0}));
  device.run();
  const Fields next = device.answers().back();
  REQUIRE(next[0] == "A");
  CHECK(quality(next) == 'g');
  CHECK(alarms(next).has(Alarm::sample_lost));
  CHECK(tension(next, 3) == 201);
  CHECK(alarms(device.ask(sample(202, {40000, 202, 0}))).bits() == 0);
}

TEST_CASE("clock and sample numbers pass zero without anybody noticing") {
  Plain device;
  device.board.clock = 0xFFFFFFFF - 20000;
  device.run();
  device.answers();
  settle(device, rolling_joint);
  device.ask(sample(0xFFFFFFE0, {1, 0, 0}));
  device.ask("Q");
  for (std::uint32_t i = 1; i < 64; ++i) {
    device.board.clock += 1000;
    const Fields answer = device.ask(sample(0xFFFFFFE0 + i, {static_cast<float>(i), 0, 0}));
    CHECK(alarms(answer).bits() == 0);
    CHECK(quality(answer) == 'g');
    CHECK(tension(answer, 1) == static_cast<float>(i));
  }
  CHECK(device.ask(sample(0xFFFFFFE0, {1, 0, 0})) == Fields{"E", "sequence"});
}

TEST_CASE("the watchdog is fed in every pass of the main loop") {
  Plain device;
  for (int i = 0; i < 100; ++i) {
    const std::uint32_t before = device.board.fed;
    device.application().step();
    CHECK(device.board.fed > before);
  }
}

}  // namespace degraded_test
