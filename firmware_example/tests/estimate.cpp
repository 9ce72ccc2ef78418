// Readings with noise: what is not read, time steps, the far end's cell, and what the estimator finds odd.
#include <limits>
#include <random>
#include <utility>

#include "rig.hpp"

namespace estimate_test {
using namespace rig;

namespace {

/// A cable over two saddles with noisy cells at jack and far end.
struct NoisyCapacity : taut::Capacity {
  static constexpr int nodes = 4, segments = 3, joints = 2;
};
constexpr taut::Scene<double, 2, NoisyCapacity> make_noisy() {
  taut::Scene<double, 2, NoisyCapacity> scene;
  const int a = scene.add_node({0, 0}, taut::held_xy), b = scene.add_node({5, 2}, taut::held_xy),
            c = scene.add_node({10, 2}, taut::held_xy), d = scene.add_node({15, 0}, taut::held_xy);
  taut::Cable<double> cable;
  cable.E = 1.95e11;
  cable.A = 1e-3;
  cable.mu = 0.2;
  cable.mu_sd = 0.05;
  cable.shared_mu = true;
  cable.ends[1] = taut::End::jacked;
  cable.seating = 0.002;
  cable.cell[0].sd = 300;
  cable.cell[1].sd = 400;
  scene.add_cable(cable, {a, b, c, d});
  return scene;
}
constexpr auto noisy = make_noisy();
static_assert(monitor::most_unknowns(noisy).carried == 3);

using Board = monitor::host::MemoryBoard;
using Source = monitor::CondensedAtStartUp<noisy>;
using Noisy = Rig<monitor::Application<Board, monitor::Settings, Source>>;
struct Limited : monitor::Settings {
  static constexpr taut::AlarmLimits<float> alarm_limits{-1, 115e3F};
};
/// A call has one event: rows with more take several.
struct CutUp : Limited {
  static constexpr int event_budget = 1;
};

// The fields of an answer, where its values begin at 10: 3 tensions, 2 slips, one word of states, 2 contact
// and 2 friction forces, an extension, 3 deviations, 2 mu and their deviations, alarms.
float deviation(const Fields& answer, std::size_t segment) { return real(answer.at(21 + segment)); }
float mu(const Fields& answer) { return real(answer.at(24)); }
float mu_deviation(const Fields& answer) { return real(answer.at(26)); }
std::vector<taut::Alarm> findings(const Fields& answer) {
  std::vector<taut::Alarm> found;
  for (std::size_t i = 28; i < answer.size(); ++i)
    found.push_back(monitor::alarm_of(monitor::host::number_of(answer[i])));
  return found;
}
bool finds(const Fields& answer, taut::Alarm::Kind kind) {
  for (const taut::Alarm& each : findings(answer))
    if (each.kind == kind) return true;
  return false;
}

class Noise {
 public:
  float operator()(double force, double sd) { return static_cast<float>(force + sd * scatter_(random_)); }

 private:
  std::mt19937 random_{2015};
  std::normal_distribution<double> scatter_;
};

/// Pulls by 2 kN a sample; the far end has 85 % of it, which mu = 0.211 does.
Readings pulling(Noise& noise, int row) {
  const double force = 2000 * row;
  return {noise(0.85 * force, 300), noise(force, 400), none};
}

}  // namespace

TEST_CASE("jack and far end tell mu, and with it the forces between") {
  Noisy device;
  Noise noise;
  Fields answer;
  for (int row = 1; row <= 60; ++row)
    answer = device.ask(sample_of(static_cast<std::uint32_t>(row), pulling(noise, row)));
  CHECK(quality(answer) == 'g');
  CHECK(tension(answer, 0) == doctest::Approx(102000).epsilon(0.01));
  CHECK(tension(answer, 2) == doctest::Approx(120000).epsilon(0.01));
  CHECK(deviation(answer, 1) > 0);
  CHECK(deviation(answer, 1) < 1000);
  CHECK(mu_deviation(answer) < 0.01F);
  CHECK(mu(answer) == doctest::Approx(0.211).epsilon(0.05));
  CHECK(real(answer.at(24)) == real(answer.at(25)));
}

TEST_CASE("a force above the site's limit is said, before and after a power failure, and others are not") {
  Rig<monitor::Application<Board, Limited, Source>> device;
  const auto is_high = [&](std::uint32_t row, float force) {
    return finds(device.ask(sample_of(row, {none, force, none})), taut::Alarm::Kind::force_high);
  };
  CHECK(!is_high(1, 50e3F));
  CHECK(!is_high(2, 112e3F));
  CHECK(is_high(3, 120e3F));
  device.boot();
  // It has not come back by a hundredth: the episode is kept.
  CHECK(is_high(4, 114.5e3F));
  CHECK(!is_high(5, 113e3F));
}

TEST_CASE("a cell without load may say five standard deviations of its noise") {
  Noisy without, with;
  CHECK_FALSE(finds(without.ask(sample_of(1, {none, 1990.0F, none})), taut::Alarm::Kind::unknown_past));
  CHECK(finds(with.ask(sample_of(1, {none, 2010.0F, none})), taut::Alarm::Kind::unknown_past));
}

TEST_CASE("what the far end reads teaches nothing while the past is not known") {
  Noisy device;
  const Fields answer = device.ask(sample_of(1, {85000.0F, 100000.0F, none}));
  CHECK(mu(answer) == 0.2F);
  CHECK(mu_deviation(answer) == 0.05F);
  // Pulled from zero, it would have told.
  Noisy from_zero;
  from_zero.ask(sample_of(1, {0.0F, 0.0F, none}));
  CHECK(mu_deviation(from_zero.ask(sample_of(2, {85000.0F, 100000.0F, none}))) < 0.05F);
}

TEST_CASE("what is not read is neither zero nor the reading before") {
  Noisy device;
  // From zero: of a past that is not known the middle moves as bars get wider.
  device.ask(sample_of(1, {none, 0.0F, none}));
  const Fields first = device.ask(sample_of(2, {none, 50000.0F, none}));
  const Fields silent = device.ask(sample_of(3, {none, none, none}));
  CHECK(quality(silent) == 'g');
  CHECK(tensions(silent, 3) == tensions(first, 3));
  CHECK(device.ask(sample_of(4, {none, none})) == Fields{"E", "fields"});
  CHECK(device.ask("S 00000004 3f800000 - -- -") == Fields{"E", "fields"});
  CHECK(device.ask("S 00000004 3f800000 - - -x") == Fields{"E", "fields"});
}

TEST_CASE("time does not stand still") {
  Noisy device;
  for (const float dt :
       {0.0F, -1.0F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    CHECK(device.ask(sample_of(1, {none, 1000.0F, none}, dt)) == Fields{"E", "fields"});
}

TEST_CASE("the time of a sample that was not used is not lost") {
  Noisy without, with;
  Noise noise;
  Fields expected, found;
  for (std::uint32_t row = 1; row <= 30; ++row) {
    const Readings numbers = pulling(noise, static_cast<int>(row));
    if (row % 10 == 0) {
      with.ask(sample_of(2 * row - 1, {none, 2e7F, none}, 0.25F));
      found = with.ask(sample_of(2 * row, numbers, 0.75F));
    } else {
      with.ask(sample_of(2 * row - 1, {none, none, none}, 0.5F));
      found = with.ask(sample_of(2 * row, numbers, 0.5F));
    }
    without.ask(sample_of(2 * row - 1, {none, none, none}, 0.5F));
    expected = without.ask(sample_of(2 * row, numbers, 0.5F));
    CHECK(state(found) == state(expected));
  }
}

TEST_CASE("a far end's cell out of range is left out, and said") {
  Noisy device;
  const Fields answer = device.ask(sample_of(1, {std::numeric_limits<float>::quiet_NaN(), 50000.0F, none}));
  CHECK(quality(answer) == 'g');
  CHECK(alarms(answer).has(Alarm::sensor_range));
  CHECK(mu_deviation(answer) == 0.05F);
  CHECK(tension(answer, 2) > 40000);
  const Fields stroke = device.ask(sample_of(2, {none, 50000.0F, std::numeric_limits<float>::infinity()}));
  CHECK(quality(stroke) == 'g');
  CHECK(alarms(stroke).has(Alarm::sensor_range));
  CHECK_FALSE(finds(stroke, taut::Alarm::Kind::elongation));
}

TEST_CASE("the far end's cell is zeroed like a jack's, but not locked") {
  Noisy device;
  device.ask(sample_of(1, {900.0F, 0.0F, none}));
  const std::string start = number_field(0) + " " + number_field(0);
  CHECK(device.ask("Z " + start) == Fields{"K", "Z"});
  CHECK(device.ask("L " + start) == Fields{"E", "cell"});
}

TEST_CASE("what the estimator finds odd is in the answer, by cable and place") {
  Noisy device;
  Noise noise;
  Fields answer;
  std::uint32_t number = 0;
  for (int row = 1; row <= 30; ++row) answer = device.ask(sample_of(++number, pulling(noise, row)));
  CHECK(findings(answer).empty());
  answer = device.ask(sample_of(++number, {none, 150000.0F, none}));
  CHECK(findings(answer).empty());
  // That it was an outlier shows in the next reading.
  answer = device.ask(sample_of(++number, {none, 62000.0F, none}));
  REQUIRE(findings(answer).size() == 1);
  CHECK(findings(answer)[0].kind == taut::Alarm::Kind::outlier);
  CHECK(findings(answer)[0].cable == 0);
  CHECK(findings(answer)[0].place == 1);
  // Strokes count by how they grow, once the cable is strained.
  for (int row = 32; row <= 60; ++row) answer = device.ask(sample_of(++number, pulling(noise, row)));
  answer = device.ask(sample_of(++number, {none, 122000.0F, 1.0F}));
  CHECK(findings(answer).empty());
  answer = device.ask(sample_of(++number, {none, 124000.0F, 1.5F}));
  CHECK(finds(answer, taut::Alarm::Kind::elongation));
  answer = device.ask(sample_of(++number, {2000.0F, 126000.0F, none}));
  CHECK(finds(answer, taut::Alarm::Kind::sensor));
  answer = device.ask(sample_of(++number, {none, 128000.0F, none}));
  CHECK(findings(answer).empty());
}

TEST_CASE("what is odd in a row is said however many calls the row takes") {
  using Source = monitor::CondensedAtStartUp<noisy>;
  int with_both = 0;
  for (int wrong = 2; wrong < 90; ++wrong) {
    CAPTURE(wrong);
    Rig<monitor::Application<Board, Limited, Source>> whole;
    Rig<monitor::Application<Board, CutUp, Source>> cut_up;
    Noise noise;
    std::uint32_t number = 0;
    // Pulled, let out and pulled again, with one reading that is wrong.
    for (int row = 1; row <= 90; ++row) {
      const int step = row <= 30 ? row : row <= 60 ? 60 - row : row - 60;
      const float reading = row == wrong ? 2e5F : noise(4000.0 * step, 400);
      const std::string sent = sample_of(++number, {none, reading, none});
      const Fields expected = whole.ask(sent), answer = cut_up.ask(sent);
      REQUIRE(quality(answer) == 'g');
      const auto found = findings(answer), due = findings(expected);
      REQUIRE(found.size() == due.size());
      for (std::size_t i = 0; i < due.size(); ++i)
        CHECK(monitor::code_of(found[i]) == monitor::code_of(due[i]));
      with_both += !due.empty() && monitor::host::number_of(answer.at(4)) > 1 ? 1 : 0;
    }
  }
  CHECK(with_both > 0);
}

TEST_CASE("a jack that is put back on a locked end is told when its wedge is free") {
  Noisy heard, deaf;
  Noise noise;
  std::uint32_t number = 0;
  const std::string jack = number_field(0) + " " + number_field(1);
  // The zero of the jack's cell counts while the end is locked, too.
  constexpr double zero = 900;
  for (Noisy* each : {&heard, &deaf}) {
    each->ask(sample_of(1, {none, static_cast<float>(zero), none}));
    CHECK(each->ask("Z " + jack) == Fields{"K", "Z"});
  }
  ++number;
  const auto both = [&](double force, bool locked) {
    const float reading = noise(force + zero, 400);
    const Fields answer = heard.ask(sample_of(++number, {none, reading, none}));
    const Fields other = deaf.ask(sample_of(number, {none, locked ? none : Reading(reading), none}));
    CHECK_FALSE(alarms(answer).has(Alarm::sensor_range));
    const bool is_free = finds(answer, taut::Alarm::Kind::lift_off);
    // Nothing but what is odd comes after the numbers.
    CHECK(Fields(answer.begin() + 10, answer.begin() + 28) == Fields(other.begin() + 10, other.begin() + 28));
    return std::make_pair(is_free, tension(answer, 2));
  };
  for (int row = 1; row <= 30; ++row) CHECK_FALSE(both(4000 * row, false).first);
  for (Noisy* each : {&heard, &deaf}) CHECK(each->ask("L " + jack) == Fields{"K", "L"});
  for (int row = 0; row < 20; ++row) CHECK_FALSE(both(0, true).first);
  double free = 0;
  float held = 0;
  for (int row = 1; row <= 40 && free == 0; ++row) {
    const auto [is_free, tension] = both(4000 * row, true);
    if (is_free) free = 4000 * row;
    held = tension;
    // In between, the power fails.
    if (row == 10) heard.boot();
  }
  CHECK(held < 120000);
  CHECK(free > static_cast<double>(held) - 4000);
  CHECK(free < static_cast<double>(held) + 8000);
}

TEST_CASE("an alarm keeps its kind, cable and place in a code") {
  using taut::Alarm;
  for (const Alarm& alarm :
       {Alarm::of(Alarm::Kind::outlier, 0, 0), Alarm::of(Alarm::Kind::mu_band, 254, -1),
        Alarm::of(Alarm::Kind::no_information, 3, 127), Alarm::of(Alarm::Kind::force_low, 63, 32767),
        Alarm::of(Alarm::Kind::strut, -1, 2000), Alarm::of(Alarm::Kind::lift_off, 254, 1)}) {
    const Alarm back = monitor::alarm_of(monitor::code_of(alarm));
    CHECK(back.kind == alarm.kind);
    CHECK(back.cable == alarm.cable);
    CHECK(back.place == alarm.place);
  }
}

TEST_CASE("with noise too, a power failure after any sample changes no bit") {
  Noisy steady, failing;
  Noise noise;
  std::uint32_t number = 0;
  const std::string jack = number_field(0) + " " + number_field(1);
  const auto both = [&](const Readings& numbers) {
    const std::string body = sample_of(++number, numbers);
    const Fields expected = steady.ask(body);
    CHECK(state(failing.ask(body)) == state(expected));
    failing.boot();
    CHECK(state(failing.ask("P")) == state(expected));
  };
  for (int row = 1; row <= 20; ++row) both(pulling(noise, row));
  for (int row = 0; row < 10; ++row) both({none, noise(40000, 400), none});
  for (int row = 0; row < 8; ++row) both({none, noise(40000 - 2500 * row, 400), none});
  for (Noisy* each : {&steady, &failing}) each->ask("L " + jack);
  for (int row = 0; row < 3; ++row) both({none, 0.0F, none});
  for (Noisy* each : {&steady, &failing}) each->ask("J " + jack);
  for (int row = 0; row < 12; ++row) both(pulling(noise, 20 + row));
}

}  // namespace estimate_test
