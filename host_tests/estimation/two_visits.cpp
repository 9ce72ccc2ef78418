// A cable that is jacked twice, at two temperatures: the estimate against the truth before, in between and
// after.
#include <doctest/doctest.h>

#include <array>

#include "estimation/site.hpp"

namespace two_visits_test {
using namespace estimation;

namespace {

constexpr double full = 2e5;
constexpr double kelvin = 25;

/// Load 0 is the temperature of the cable alone, `kelvin` at a factor of one.
void make_ground(Ground& ground, bool elastic, double mu_sd, double actual_mu) {
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = mu_sd;
  cable.shared_mu = true;
  cable.seating = 0.004;
  cable.alpha = 1.2e-5;
  if (elastic)
    support::truss_string(ground.known, cable, 6);
  else
    support::rigid_saddles(ground.known, cable, support::chain_points(7));
  REQUIRE(ground.known.add_temperature(ground.known.add_load(), 0, kelvin) >= 0);
  ground.set_true_mu(std::vector<double>(16, actual_mu));
}

/// What is compared at the end of every stage, of all segments.
struct Tally {
  long held = 0, all = 0;
  double square = 0;

  double share() const { return static_cast<double>(held) / static_cast<double>(all); }
  /// Of relative errors.
  double rms() const { return std::sqrt(square / static_cast<double>(all)); }
};
enum Stage {
  jacking,
  holding,
  locked,
  at_other_temperature,
  left_alone,
  jacking_again,
  holding_again,
  stages
};

template <class Scalar>
class Visits {
 public:
  Visits(Site<Scalar>& site, std::array<Tally, stages>& tallies) : site_(site), tallies_(tallies) {}

  /// The jack comes to pull what the wedge holds, which goes on holding it.
  void put_on_again(int samples) {
    const double held = site_.true_force(site_.segments() - 1);
    for (int i = 1; i <= samples; ++i) {
      deed_.force[1] = held * i / samples;
      site_.advance(deed_);
      REQUIRE(site_.good());
    }
  }
  void go(Stage stage, double force, double factor, bool is_locked, int samples) {
    const Deed from = deed_;
    for (int i = 1; i <= samples; ++i) {
      deed_.force[1] = from.force[1] + (force * full - from.force[1]) * i / samples;
      deed_.factor = from.factor + (factor - from.factor) * i / samples;
      deed_.locked[1] = is_locked;
      site_.advance(deed_);
      REQUIRE(site_.good());
    }
    Tally& tally = tallies_[static_cast<std::size_t>(stage)];
    for (int k = 0; k < site_.segments(); ++k) {
      const double part = site_.error(k) / site_.true_force(k);
      tally.held += site_.holds_truth(k) ? 1 : 0;
      ++tally.all;
      tally.square += part * part;
    }
  }

 private:
  Site<Scalar>& site_;
  std::array<Tally, stages>& tallies_;
  Deed deed_;
};

TEST_CASE_TEMPLATE("the error bars hold before, during and after a change of temperature between two visits",
                   Scalar, double, float) {
  static Ground ground;
  for (const bool elastic : {false, true})
    for (const bool has_cell : {true, false}) {
      CAPTURE(elastic);
      CAPTURE(has_cell);
      std::array<Tally, stages> tallies;
      for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        // What nothing measures stays as uncertain as it was: not so much that lines bend.
        const double mu_sd = has_cell ? 0.06 : 0.03;
        make_ground(ground, elastic, mu_sd, std::fmax(0.02, 0.2 + mu_sd * gaussian(random)));
        Instruments instruments;
        instruments.has_cell = has_cell;
        const auto site = std::make_unique<Site<Scalar>>(ground, instruments, full, seed);
        Visits<Scalar> visits(*site, tallies);
        const double warmer = random.coin() ? 1 : -1;
        visits.go(jacking, 0.8, 0, false, 100);
        visits.go(holding, 0.8, 0, false, 40);
        visits.go(locked, 0.8, 0, true, 20);
        const double before = site->true_force(0);
        visits.go(at_other_temperature, 0.8, warmer, true, 40);
        if (!elastic) CHECK(std::fabs(site->true_force(0) / before - 1) > 0.2);
        visits.go(left_alone, 0, warmer, true, 20);
        // The wedge holds until the jack pulls as much.
        visits.put_on_again(50);
        visits.go(jacking_again, 1, warmer, false, 100);
        visits.go(holding_again, 1, warmer, false, 40);
      }
      for (const Tally& tally : tallies) {
        const auto stage = &tally - tallies.data();
        CAPTURE(stage);
        // Of 400 truths; where a ramp ends the filter knows the load better than it says.
        CHECK(tally.share() > 0.92);
        CHECK(tally.rms() < (has_cell ? 0.005 : 0.05));
      }
    }
}

}  // namespace

}  // namespace two_visits_test
