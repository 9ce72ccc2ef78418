// Whom an estimator tells what each of its instruments taught it of friction.
#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "estimation/ramp.hpp"

namespace account_test {
using namespace estimation;

namespace {

/// Every update: what was read, how many readings of it, and the variance of mu after it.
struct Recorder {
  struct Lesson {
    taut::Alarm::Kind kind;
    int readings;
    double variance;
  };
  std::vector<Lesson> lessons;
  double before = 0;

  template <class Filter>
  void begin(const Filter& filter) {
    lessons.clear();
    before = filter.belief().variance(0);
  }
  template <class Filter>
  void learned(const taut::Alarm& source, int readings, const Filter& filter) {
    lessons.push_back({source.kind, readings, filter.belief().variance(0)});
  }
  double information_of(taut::Alarm::Kind kind) const {
    double sum = 0, last = before;
    for (const Lesson& lesson : lessons) {
      if (lesson.kind == kind) sum += 1 / lesson.variance - 1 / last;
      last = lesson.variance;
    }
    return sum;
  }
  int readings_of(taut::Alarm::Kind kind) const {
    int sum = 0;
    for (const Lesson& lesson : lessons) sum += lesson.kind == kind ? lesson.readings : 0;
    return sum;
  }
};
struct Recorded : PlaneCapacity {
  using Account = Recorder;
};
using Model = taut::Condensed<double, Recorded>;
using Estimator = taut::Estimator<Model, 8, 2>;
using Kind = taut::Alarm::Kind;

constexpr int rows = 400;
constexpr double actual_mu = 0.25, cell_noise = 0.005 * full;

/// A ramp with a load cell at the far end, or not, and one at segment 2, or not, with this standard
/// deviation.
std::unique_ptr<Estimator> pulled(bool has_cell, double gauge_sd) {
  taut::Scene<double, 2, Recorded> scene;
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = 0.1;
  cable.shared_mu = true;
  cable.cell[0].sd = cable.cell[1].sd = cell_noise;
  support::rigid_saddles(scene, cable, support::chain_points(5));
  static taut::Condensation<double, taut::Scene<double, 2, Recorded>> condensation;
  static Model model;
  static taut::FrictionPrior<double, Recorded> prior;
  REQUIRE(condensation.run(scene, model).ok());
  taut::find_friction_prior(scene, prior);
  auto estimator = std::make_unique<Estimator>();
  taut::FixedList<taut::LoadCell<double>, 1> gauges;
  taut::LoadCell<double> gauge;
  gauge.sd = gauge_sd;
  gauges.add(gauge);
  REQUIRE(estimator->start(model, prior, {}, gauges).status.ok());
  Random random(20261123);
  for (int i = 1; i <= rows; ++i) {
    std::vector<double> T(5, full * i / rows);
    for (int j = 3; j >= 0; --j) {
      const double c = actual_mu * std::tan(support::chain_turn[j] / 2);
      T[static_cast<std::size_t>(j)] = T[static_cast<std::size_t>(j) + 1] * (1 - c) / (1 + c);
    }
    taut::Readings<double, Recorded> readings;
    readings.ends[0][1] = {true, false, T[4] + cell_noise * gaussian(random), 0};
    readings.ends[0][0] = {has_cell, false, T[0] + cell_noise * gaussian(random), 0};
    REQUIRE(estimator->advance(readings).status.ok());
    if (gauge_sd > 0) estimator->take_segment(1, T[1] + gauge_sd * gaussian(random), taut::Gauge{0});
  }
  return estimator;
}
double gained(const Estimator& estimator) {
  const double sd = estimator.mu_deviation(0);
  return 1 / (sd * sd) - 1 / (0.1 * 0.1);
}

TEST_CASE("what instruments brought adds up to what is known more than beforehand") {
  const auto estimator = pulled(true, 2 * cell_noise);
  const Recorder& account = estimator->account();
  const double of_cell = account.information_of(Kind::sensor),
               of_gauge = account.information_of(Kind::segment);
  CHECK(of_cell > 0);
  CHECK(of_gauge > 0);
  CHECK(std::fabs(of_cell + of_gauge - gained(*estimator)) < 1e-9 * gained(*estimator));
}

TEST_CASE("readings that waited when a gauge was read are the cell's and not the gauge's") {
  // What the gauge says is nothing, but every reading of it has those that wait be learned first.
  const auto estimator = pulled(true, 1e4 * full);
  const Recorder& account = estimator->account();
  CHECK(account.readings_of(Kind::segment) > 50);
  CHECK(account.information_of(Kind::segment) < 1e-6 * gained(*estimator));
  CHECK(account.information_of(Kind::sensor) > (1 - 1e-6) * gained(*estimator));
}

TEST_CASE("readings of a far-end cell count one by one, whether they were gathered or not") {
  const auto estimator = pulled(true, 0);
  const Recorder& account = estimator->account();
  bool gathers = false;
  for (const Recorder::Lesson& lesson : account.lessons) gathers = gathers || lesson.readings == 16;
  CHECK(gathers);
  // Up to fifteen still wait; at the first loads nothing slides surely.
  CHECK(account.readings_of(Kind::sensor) <= rows);
  CHECK(account.readings_of(Kind::sensor) > rows - 32);
  CHECK(account.readings_of(Kind::segment) == 0);
}

TEST_CASE("without a far-end cell all comes from the gauge, and without either nothing does") {
  const auto gauge = pulled(false, cell_noise), none = pulled(false, 0);
  CHECK(gauge->account().information_of(Kind::sensor) == 0);
  CHECK(std::fabs(gauge->account().information_of(Kind::segment) - gained(*gauge)) < 1e-9 * gained(*gauge));
  CHECK(none->account().lessons.empty());
  CHECK(none->mu_deviation(0) == 0.1);
}

}  // namespace

}  // namespace account_test
