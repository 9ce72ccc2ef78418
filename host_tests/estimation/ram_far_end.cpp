// A far end that is read while the pressure of a ram goes from one branch to the other and all forces rest.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>

#include "estimation/ramp.hpp"

namespace ram_far_end_test {
using namespace estimation;

namespace {

constexpr double up = 1.04, down = 0.95;

/// A jack whose ram has friction, and a cell at the far end, on the model and in truth.
class Pressed {
 public:
  using Model = taut::Condensed<double, PlaneCapacity>;
  using Estimator = taut::Estimator<Model, most_unknowns>;

  Pressed(bool elastic, double sd, std::uint64_t seed) : sd_(sd), random_(seed) {
    taut::Cable<double> cable = support::steel_cable(0.2);
    cable.mu_sd = 0.04;
    cable.shared_mu = true;
    cable.cell[0].sd = cable.cell[1].sd = sd * full;
    cable.cell[1].up = up;
    cable.cell[1].down = down;
    if (elastic)
      support::truss_string(ground_.known, cable, 6);
    else
      support::rigid_saddles(ground_.known, cable, support::chain_points(7));
    ground_.set_true_mu(std::vector<double>(16, 0.22));
    taut::find_friction_prior(ground_.known, prior_);
    REQUIRE(support::condense(ground_.known, model_).ok());
    REQUIRE(support::condense(ground_.actual, truth_model_).ok());
    REQUIRE(truth_.start(truth_model_).status.ok());
    REQUIRE(estimator.start(model_, prior_).status.ok());
  }
  Pressed(const Pressed&) = delete;
  Pressed& operator=(const Pressed&) = delete;
  ~Pressed() = default;

  /// The pressure goes to `pressure`, in parts of the full force, in so many rows; the force follows.
  template <class Check>
  void press(double pressure, int rows, const Check& check) {
    const double from = pressure_;
    for (int i = 1; i <= rows; ++i) {
      pressure_ = from + (pressure - from) * i / rows;
      force_ = std::min(std::max(force_, pressure_ / up), pressure_ / down);
      taut::Sample<double, PlaneCapacity> sample;
      sample.jack[0][1].force = force_ * full;
      REQUIRE(truth_.advance(sample).status.ok());
      taut::Readings<double, PlaneCapacity> readings;
      readings.ends[0][1] = {true, false, full * (pressure_ + sd_ * gaussian(random_)), 0};
      readings.ends[0][0] = {true, false, truth_.tension(0) + full * sd_ * gaussian(random_), 0};
      REQUIRE(estimator.advance(readings).status.ok());
      check();
    }
  }
  double force() const { return force_; }
  double true_force(int segment) const { return truth_.tension(segment); }
  int segments() const { return truth_model_.segments; }

  Estimator estimator;

 private:
  double sd_;
  Random random_;
  Ground ground_;
  taut::FrictionPrior<double, PlaneCapacity> prior_;
  Model model_, truth_model_;
  taut::Tracker<Model> truth_;
  double pressure_ = 0, force_ = 0;
};

}  // namespace

TEST_CASE("between the branches of a ram the far end is compared with the force that rests") {
  double square = 0;
  int all = 0;
  for (const bool elastic : {false, true})
    for (const double sd : {0.001, 0.003})
      for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        CAPTURE(elastic);
        CAPTURE(sd);
        CAPTURE(seed);
        const auto pressed = std::make_unique<Pressed>(elastic, sd, seed);
        auto& estimator = pressed->estimator;
        const auto nothing_is_odd = [&] {
          REQUIRE(raised(estimator.alarms(), taut::Alarm::Kind::sensor) == 0);
          REQUIRE(raised(estimator.alarms(), taut::Alarm::Kind::misfit) == 0);
        };
        pressed->press(0.8 * up, 200, nothing_is_odd);
        pressed->press(0.8 * up, 60, nothing_is_odd);
        const double force = pressed->force(), mu = estimator.mu(0), deviation = estimator.mu_deviation(0);
        int resting = 0;
        const auto rests = [&] {
          nothing_is_odd();
          const auto jack = estimator.save().jacks.jack[0];
          resting += jack.at.load == jack.turned ? 1 : 0;
        };
        // Down between the branches, fast enough to be seen to turn; a while there; and up again.
        pressed->press(0.8 * (down + 0.02), 6, rests);
        pressed->press(0.8 * (down + 0.02), 40, rests);
        pressed->press(0.8 * (up - 0.02), 40, rests);
        REQUIRE(pressed->force() == force);
        // Else nothing was tested.
        CHECK(resting > 20);
        for (int i = 0; i < pressed->segments(); ++i)
          CHECK(std::fabs(estimator.force(i) - pressed->true_force(i)) < 4 * sd * full);
        const double moved = (estimator.mu(0) - mu) / deviation;
        CHECK(std::fabs(moved) < 4);
        square += moved * moved;
        ++all;
      }
  // By its deviation at most, in the mean of all.
  CHECK(std::sqrt(square / all) < 1);
}

}  // namespace ram_far_end_test
