// Strokes: measurements where the scene describes them, a check elsewhere.
#include "rig.hpp"

namespace strokes_test {
using namespace rig;

namespace {

/// A cable over three saddles with a noisy cell at its jack, and nothing at the far end.
struct PulledCapacity : taut::Capacity {
  static constexpr int nodes = 5, segments = 4, joints = 3;
};
constexpr taut::Scene<double, 2, PulledCapacity> make_pulled(double mu_sd) {
  taut::Scene<double, 2, PulledCapacity> scene;
  const int a = scene.add_node({0, 0}, taut::held_xy), b = scene.add_node({6, -1.1}, taut::held_xy),
            c = scene.add_node({12, -1.5}, taut::held_xy), d = scene.add_node({18, -1.1}, taut::held_xy),
            e = scene.add_node({24, 0}, taut::held_xy);
  taut::Cable<double> cable;
  cable.E = 1.95e11;
  cable.A = 1.4e-4;
  cable.law = taut::FrictionLaw::capstan;
  cable.mu = 0.2;
  cable.mu_sd = mu_sd;
  cable.shared_mu = true;
  cable.ends[1] = taut::End::jacked;
  cable.seating = 0.003;
  cable.cell[1].sd = 300;
  scene.add_cable(cable, {a, b, c, d, e});
  return scene;
}
constexpr auto pulled = make_pulled(0.05), well_known = make_pulled(0.01);

using Checked = monitor::CondensedAtStartUp<pulled>;
/// With a stroke that is read from any mark, and E A known to 1 %.
template <const auto& scene>
struct MeasuredIn : monitor::CondensedAtStartUp<scene> {
  static constexpr taut::StrokeGauge<float> list[1] = {
      {{5e-4F, 0.01F, taut::free_zero<float>, 0, 1, 1}, 0, 1}};
  static constexpr int reading_unknowns = monitor::CondensedAtStartUp<scene>::reading_unknowns + 2;
  using StrokesType = monitor::Strokes<1>;
  static constexpr StrokesType strokes() { return {list, 1}; }
};
using Measured = MeasuredIn<pulled>;
template <class Source>
using Device = Rig<monitor::Application<monitor::host::MemoryBoard, monitor::Settings, Source>>;

// The fields of an answer, where its values begin at 10: 4 tensions, 3 slips, a word of states, 3 contact and
// 3 friction forces, an extension, 4 deviations, 3 mu and their deviations, alarms.
float extension(const Fields& answer) { return real(answer.at(24)); }
float mu_deviation(const Fields& answer) { return real(answer.at(32)); }
bool finds(const Fields& answer, taut::Alarm::Kind kind) {
  for (std::size_t i = 35; i < answer.size(); ++i)
    if (monitor::alarm_of(monitor::host::number_of(answer[i])).kind == kind) return true;
  return false;
}

/// Pulled to 100 kN, let out to 60 kN, pulled to 110 kN.
float force(int row) {
  const int kilonewtons = row <= 25 ? 4 * row : row <= 45 ? 100 - 2 * (row - 25) : 60 + 2 * (row - 45);
  return 1000 * static_cast<float>(kilonewtons);
}
constexpr int rows = 70;

std::string row_of(int row, const Reading& stroke) {
  return sample_of(static_cast<std::uint32_t>(row) + 1, {none, force(row), stroke});
}
/// What the jack pays out with the friction that is expected, beyond a mark at 0.4 m.
Reading stroke_at(const Fields& answer, int row) {
  return row % 3 == 0 ? Reading(0.4F + extension(answer)) : none;
}

}  // namespace

TEST_CASE("a stroke that the scene describes tells of friction, from whatever mark it is read") {
  Device<Checked> checked;
  Device<Measured> measured;
  Fields answer;
  for (int row = 0; row <= rows; ++row) {
    const Fields expected = checked.ask(row_of(row, none));
    answer = measured.ask(row_of(row, stroke_at(expected, row)));
    CHECK(quality(answer) == 'g');
    CHECK_FALSE(finds(answer, taut::Alarm::Kind::elongation));
  }
  CHECK(mu_deviation(answer) < 0.025F);
}

TEST_CASE("a stroke that contradicts as a measurement is said though it is within 5 %, and is left out") {
  Device<Checked> checked;
  Device<Measured> measured;
  Fields expected, answer;
  for (int row = 0; row < 24; ++row) {
    expected = checked.ask(row_of(row, none));
    answer = measured.ask(row_of(row, stroke_at(expected, row)));
  }
  const float before = mu_deviation(answer);
  expected = checked.ask(row_of(24, none));
  answer = measured.ask(row_of(24, 0.4F + 1.045F * extension(expected)));
  CHECK(finds(answer, taut::Alarm::Kind::elongation));
  CHECK(mu_deviation(answer) == before);
}

TEST_CASE("four standard deviations of a stroke's noise are no elongation") {
  Device<Checked> checked;
  Device<Measured> measured;
  for (int row = 0; row <= 6; ++row) {
    const Fields expected = checked.ask(row_of(row, none));
    const float off = row == 6 ? 0.002F : 0;
    const Reading stroke = row % 3 == 0 ? Reading(0.4F + extension(expected) + off) : none;
    CHECK_FALSE(finds(measured.ask(row_of(row, stroke)), taut::Alarm::Kind::elongation));
  }
}

TEST_CASE("a stroke that the scene does not describe is compared, and changes no number") {
  Device<Checked> heard, deaf;
  for (int row = 0; row <= rows; ++row) {
    const Fields expected = deaf.ask(row_of(row, none)), answer = heard.ask(row_of(row, 0.4F));
    CHECK(Fields(answer.begin() + 10, answer.begin() + 35) ==
          Fields(expected.begin() + 10, expected.begin() + 35));
    // It does not grow. A leg begins where the jack reverses.
    if (row == 25 || row == 45 || row == rows) CHECK(finds(answer, taut::Alarm::Kind::elongation));
  }
}

TEST_CASE("with strokes too, a power failure after any sample changes no bit") {
  Device<Checked> checked;
  Device<Measured> steady, failing;
  for (int row = 0; row <= rows; ++row) {
    const std::string body = row_of(row, stroke_at(checked.ask(row_of(row, none)), row));
    const Fields expected = steady.ask(body);
    CHECK(state(failing.ask(body)) == state(expected));
    failing.boot();
    CHECK(state(failing.ask("P")) == state(expected));
  }
}

TEST_CASE("while the past is not known a stroke teaches nothing; then it does") {
  // So well known that the cable surely slides before the past is wiped out.
  Device<MeasuredIn<well_known>> device;
  int doubted = 0;
  float last = 0;
  for (int row = 1; row <= 120; ++row) {
    const float pull = 60000 + 500 * static_cast<float>(row);
    const Fields answer =
        device.ask(sample_of(static_cast<std::uint32_t>(row), {none, pull, 0.4F + 9e-7F * pull}));
    last = mu_deviation(answer);
    if (!finds(answer, taut::Alarm::Kind::unknown_past)) continue;
    ++doubted;
    CHECK(doubted == row);
    CHECK(last == 0.01F);
  }
  CHECK(doubted > 5);
  CHECK(last < 0.01F);
}

TEST_CASE("another list of strokes makes a record of no use") {
  Device<Measured> measured;
  Device<Checked> checked;
  CHECK(measured.greeting.at(12) != checked.greeting.at(12));
}

}  // namespace strokes_test
