// The board's own instruments: a converter on two pins, and its readings in a sample.
#include <cmath>
#include <optional>
#include <random>

#include "instruments/hx711.hpp"
#include "instruments/load_cell.hpp"
#include "rig.hpp"
#include "simulated_hx711.hpp"

namespace instruments_test {
using namespace rig;
using instruments::Counts;
using instruments::Fault;
using Chip = SimulatedHx711;
using Driver = instruments::Hx711<Chip>;
using Gain = Driver::Gain;

namespace {

constexpr double conversion = Chip::conversion;
const auto constant = [](double counts) { return [counts](int) { return counts; }; };

/// Asks until it has settled, once a conversion.
void settle(Chip& chip, Driver& driver) {
  for (int i = 0; i < 8; ++i) {
    chip.pass(conversion);
    driver.read();
  }
}
/// Of the next conversion.
Counts next(Chip& chip, Driver& driver) {
  chip.pass(conversion);
  return driver.read();
}

}  // namespace

TEST_CASE("24 bits are read with their sign, most significant first") {
  Chip chip;
  Driver driver(chip);
  settle(chip, driver);
  // Counts at gain 1: the chip multiplies by 128.
  for (const int counts : {0, 1, -1, 127, 12345, -12345, 65535, -65535}) {
    chip.input = constant(counts);
    next(chip, driver);
    const Counts found = next(chip, driver);
    CHECK(found.fault == Fault::none);
    CHECK(found.value == 128 * counts);
    CHECK(chip.milliseconds() - found.at <= 1);
  }
  CHECK(chip.longest_pulse < 50);
  CHECK(chip.last_pulses == 25);
}

TEST_CASE("the number of pulses chooses channel and gain, and what has not settled is not used") {
  for (const auto& [gain, factor, channel] :
       {std::tuple(Gain::a128, 128, 0), std::tuple(Gain::b32, 32, 1), std::tuple(Gain::a64, 64, 0)}) {
    Chip chip;
    chip.input = [](int of) { return of == 0 ? 700.0 : -900.0; };
    Driver driver(chip, gain);
    int settling = 0, good = 0;
    for (int i = 0; i < 20; ++i) {
      const Counts found = next(chip, driver);
      settling += found.fault == Fault::settling ? 1 : 0;
      if (found.fault == Fault::none) {
        ++good;
        CHECK(found.value == factor * (channel == 0 ? 700 : -900));
      }
    }
    CHECK(good + settling == 20);
    CHECK(good >= 12);
    CHECK(chip.last_pulses == 24 + static_cast<int>(gain));
  }
}

TEST_CASE("a change of gain while it runs is waited for") {
  Chip chip;
  chip.input = constant(5000);
  Driver driver(chip);
  settle(chip, driver);
  CHECK(next(chip, driver).value == 128 * 5000);
  driver.set_gain(Gain::a64);
  for (int i = 0; i < 10; ++i) {
    const Counts found = next(chip, driver);
    if (found.fault == Fault::none) CHECK(found.value == 64 * 5000);
  }
  CHECK(next(chip, driver).fault == Fault::none);
}

TEST_CASE("between conversions it says what it said, with the time of then, and never waits") {
  Chip chip;
  chip.input = constant(77);
  Driver driver(chip);
  settle(chip, driver);
  const Counts first = next(chip, driver);
  const int pulses = chip.pulses;
  for (int i = 0; i < 9; ++i) {
    chip.pass(conversion / 20);
    const Counts again = driver.read();
    CHECK(again.value == first.value);
    CHECK(again.at == first.at);
  }
  CHECK(chip.pulses == pulses);
}

TEST_CASE("rails are no readings") {
  Chip chip;
  Driver driver(chip);
  settle(chip, driver);
  for (const double beyond : {1e6, -1e6}) {
    chip.input = constant(beyond);
    next(chip, driver);
    CHECK(next(chip, driver).fault == Fault::saturated);
  }
  // One count before a rail is one.
  chip.input = constant(8388606.0 / 128);
  next(chip, driver);
  const Counts found = next(chip, driver);
  CHECK(found.fault == Fault::none);
  CHECK(found.value == 8388606);
}

TEST_CASE("a data line that is stuck, a wire that is broken and a chip without supply are noticed") {
  for (const Chip::Line line : {Chip::Line::low, Chip::Line::high, Chip::Line::follows}) {
    Chip chip;
    chip.input = constant(100);
    Driver driver(chip);
    settle(chip, driver);
    REQUIRE(next(chip, driver).fault == Fault::none);
    chip.line = line;
    chip.has_supply = line != Chip::Line::follows;
    for (int i = 0; i < 6; ++i) next(chip, driver);
    const Fault expected = line == Chip::Line::low ? Fault::stuck : Fault::not_ready;
    for (int i = 0; i < 5; ++i) CHECK(next(chip, driver).fault == expected);
    chip.line = Chip::Line::follows;
    chip.has_supply = true;
    next(chip, driver);
    CHECK(next(chip, driver).value == 12800);
  }
}

TEST_CASE("a chip that was never there is not ready, not zero") {
  Chip chip;
  chip.has_supply = false;
  Driver driver(chip);
  CHECK(next(chip, driver).fault == Fault::settling);
  for (int i = 0; i < 10; ++i) next(chip, driver);
  CHECK(next(chip, driver).fault == Fault::not_ready);
}

TEST_CASE("a spike in any one look at the data line changes no reading") {
  // The looks of one reading: one for readiness, three a pulse, three for the rest.
  constexpr int looks = 1 + 3 * 25 + 3;
  for (const int counts : {0, 54321, -54321})
    for (int spike = 1; spike < looks; ++spike) {
      Chip chip;
      chip.input = constant(counts);
      Driver driver(chip);
      settle(chip, driver);
      chip.pass(conversion);
      chip.spike_at_read = chip.reads + spike;
      const Counts found = driver.read();
      INFO("look " << spike);
      REQUIRE(chip.reads > chip.spike_at_read);
      CHECK(found.fault == Fault::none);
      CHECK(found.value == 128 * counts);
    }
}

TEST_CASE("a bit that is wrong for a whole pulse at the end is noticed") {
  Chip chip;
  chip.input = constant(10);
  Driver driver(chip);
  settle(chip, driver);
  chip.pass(conversion);
  chip.line = Chip::Line::low;
  CHECK(driver.read().fault == Fault::stuck);
}

TEST_CASE("an interrupt is held off; what cannot be held off costs a reading, and the chip begins anew") {
  for (int pulse = 0; pulse < 25; ++pulse) {
    Chip chip;
    chip.input = constant(4000);
    Driver driver(chip);
    settle(chip, driver);
    chip.pass(conversion);
    chip.interrupt_at_pulse = chip.pulses + pulse;
    const Counts held = driver.read();
    CHECK(held.fault == Fault::none);
    CHECK(held.value == 128 * 4000);
    CHECK(chip.longest_pulse < 50);

    chip.pass(conversion);
    chip.slow_at_pulse = chip.pulses + pulse;
    CHECK(driver.read().fault == Fault::timing);
    CHECK(chip.longest_pulse > 60);
    int good = 0;
    for (int i = 0; i < 12; ++i) {
      const Counts found = next(chip, driver);
      if (found.fault != Fault::none) {
        CHECK(found.fault == Fault::settling);
        continue;
      }
      ++good;
      CHECK(found.value == 128 * 4000);
    }
    CHECK(good >= 4);
  }
}

TEST_CASE("pulses that are too short read another number: the pins' pause is needed") {
  Chip chip;
  chip.input = constant(0x5555);
  chip.pause_microseconds = 0;
  chip.access_microseconds = 0.02;
  Driver driver(chip);
  settle(chip, driver);
  const Counts found = next(chip, driver);
  CHECK((found.fault != Fault::none || found.value != 128 * 0x5555));
}

TEST_CASE("switched off it is absent, and switched on it settles first") {
  Chip chip;
  chip.input = constant(300);
  Driver driver(chip);
  settle(chip, driver);
  driver.power_down();
  chip.pass(100);
  CHECK(chip.is_off());
  CHECK(next(chip, driver).fault == Fault::absent);
  driver.power_up();
  CHECK(driver.read().fault == Fault::settling);
  settle(chip, driver);
  CHECK(next(chip, driver).value == 128 * 300);
}

TEST_CASE("clocks may pass zero while it waits") {
  Chip chip;
  chip.input = constant(300);
  Driver driver(chip);
  settle(chip, driver);
  chip.pass(4294967296.0 * 1000 - 300 * 1000.0 - conversion * 8);
  for (int i = 0; i < 20; ++i) {
    const Counts found = next(chip, driver);
    CHECK(found.fault == Fault::none);
    CHECK(found.value == 128 * 300);
  }
}

TEST_CASE("a scale through two points") {
  instruments::Scale scale;
  CHECK_FALSE(scale.calibrate(5, 5, 100));
  CHECK(scale.calibrate(-20000, 380000, 100000));
  CHECK(scale.force(-20000) == 0);
  CHECK(scale.force(380000) == 100000);
  CHECK(scale.force(180000) == 50000);
  CHECK(scale.force(-24000) == -1000);
}

namespace {

/// A board with a cell of its own at the jack of the first cable.
struct CellBoard : monitor::host::MemoryBoard {
  Chip chip;
  Driver driver{chip};
  instruments::LoadCell<Driver> cell{driver, {1000, 0.25F}};

  instruments::Reading instrument(int cable, std::size_t end, instruments::Quantity quantity) {
    if (cable != 0 || end != 1 || quantity != instruments::Quantity::force) return {};
    return cell.read();
  }
  std::uint32_t milliseconds() { return chip.milliseconds(); }
};
using Own = Rig<monitor::Application<CellBoard, monitor::Settings, monitor::FromFlash<monitor::FlashScene>>,
                CellBoard>;

/// The reading for which the first jack has `force` [N].
auto pulled(float force) {
  return [force](int) { return (static_cast<double>(force) / 0.25 + 1000) / 128; };
}

}  // namespace

TEST_CASE("where the line has no reading the board's own cell is read, and the forces have the same bits") {
  Own own;
  Plain other;
  settle(other, rolling_joint);
  own.ask("Q");
  own.ask(choose(rolling_joint));
  own.ask("P");
  instruments_test::settle(own.board.chip, own.board.driver);
  std::uint32_t number = 0;
  for (const float force : {0.0F, 16000.0F, 40000.0F, 32000.0F}) {
    own.board.chip.input = pulled(force);
    own.board.chip.pass(2 * conversion);
    own.board.driver.read();
    own.board.chip.pass(conversion);
    ++number;
    const Fields answer =
        own.ask(sample_of(number, {none, none, none, none, 30000.0F, none, none, 100.0F, none}));
    CHECK(quality(answer) == 'g');
    CHECK(state(answer) == state(other.ask(sample(number, {force, 30000, 100}))));
  }
  // What the line says is taken before.
  own.board.chip.input = pulled(10000);
  own.board.chip.pass(2 * conversion);
  ++number;
  CHECK(state(own.ask(sample(number, {35000, 30000, 100}))) ==
        state(other.ask(sample(number, {35000, 30000, 100}))));
}

TEST_CASE("a board's own cell at a jack that is broken, saturated or silent is out of range, not zero") {
  Own own;
  own.ask("Q");
  own.ask(choose(rolling_joint));
  own.ask("P");
  instruments_test::settle(own.board.chip, own.board.driver);
  own.board.chip.input = pulled(40000);
  own.board.chip.pass(2 * conversion);
  own.board.driver.read();
  own.board.chip.pass(conversion);
  const Readings nothing{none, none, none, none, 30000.0F, none, none, 100.0F, none};
  std::uint32_t number = 1;
  const Fields before = own.ask(sample_of(number, nothing));
  REQUIRE(tension(before, 1) == 40000);
  const auto is_held = [&] {
    for (int i = 0; i < 8; ++i) {
      own.board.chip.pass(conversion);
      own.board.driver.read();
    }
    const Fields answer = own.ask(sample_of(++number, nothing));
    CHECK(quality(answer) == 'h');
    CHECK(alarms(answer).has(Alarm::sensor_range));
    CHECK(tensions(answer, 6) == tensions(before, 6));
  };
  own.board.chip.input = constant(1e6);
  is_held();
  own.board.chip.line = Chip::Line::low;
  is_held();
  own.board.chip.line = Chip::Line::high;
  is_held();
  own.board.chip.line = Chip::Line::follows;
  own.board.chip.input = pulled(41000);
  instruments_test::settle(own.board.chip, own.board.driver);
  own.board.chip.pass(conversion);
  const Fields answer = own.ask(sample_of(++number, nothing));
  CHECK(quality(answer) == 'g');
  CHECK(tension(answer, 1) == 41000);
  // Two seconds without a look at it: what it holds is new, what the driver holds would be old.
  own.board.chip.pass(20 * conversion);
  CHECK(quality(own.ask(sample_of(++number, nothing))) == 'g');
}

TEST_CASE("a reading that is too old is none") {
  const float limit = monitor::Settings::oldest_reading;
  for (const std::uint32_t at : {0U, 0xFFFFFF00U}) {
    for (const std::uint32_t age : {0U, 1000U, 1001U}) {
      bool has = false;
      float value = 0;
      instruments::fill(has, value, instruments::Reading::of(5, at), at + age,
                        monitor::Settings::oldest_reading);
      CHECK(has);
      CHECK(std::isnan(value) == (static_cast<float>(age) > limit));
    }
  }
  bool has = false;
  float value = 3;
  instruments::fill(has, value, {}, 0, 1000);
  CHECK_FALSE(has);
  CHECK(value == 3);
}

}  // namespace instruments_test
