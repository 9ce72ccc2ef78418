// Readings of the far end that are taken into account together teach what they teach one by one.
#include <doctest/doctest.h>

#include "estimation/ramp.hpp"

namespace gathered_test {
using namespace estimation;

namespace {

constexpr double known_mu = 0.2, mu_sd = 0.01, actual_mu = 0.205;
constexpr double cell_sd = 0.005 * full;

void make_ground(Ground& ground) {
  taut::Cable<double> cable = support::steel_cable(known_mu);
  cable.mu_sd = mu_sd;
  cable.shared_mu = true;
  cable.seating = 0.004;
  support::truss_string(ground.known, cable, 6);
  ground.set_true_mu(std::vector<double>(16, actual_mu));
}
/// The jack's cell is exact.
Instruments far_end_alone() {
  Instruments instruments;
  instruments.jack = 0;
  return instruments;
}
template <class Scalar>
int waiting(const Site<Scalar>& site) {
  return site.estimator().save().far_ends.gathered.size;
}

}  // namespace

TEST_CASE_TEMPLATE("mu and its deviation are those of least squares over all readings one by one", Scalar,
                   double, float) {
  static Ground ground;
  make_ground(ground);
  const auto site = std::make_unique<Site<Scalar>>(ground, far_end_alone(), full, 1);
  // As long as mu is not far from where the tracker is linearized, its tension and derivative are those of
  // the prior; the last readings may wait.
  struct Row {
    double off, derivative;
  };
  std::vector<Row> rows;
  int most = 0;
  for (int i = 1; i <= 400; ++i) {
    CAPTURE(i);
    site->advance(full * std::min(1.0, i / 300.0));
    REQUIRE(site->good());
    const auto& estimator = site->estimator();
    if (raised(estimator.alarms(), taut::Alarm::Kind::no_information) == 0)
      rows.push_back({site->cell_reading() - static_cast<double>(estimator.tracker().tension(0)),
                      static_cast<double>(estimator.tracker().sensitivity(0, 0))});
    const auto known = rows.size() - static_cast<std::size_t>(waiting(*site));
    double information = 1 / (mu_sd * mu_sd), sum = 0;
    for (std::size_t row = 0; row < known; ++row) {
      information += rows[row].derivative * rows[row].derivative / (cell_sd * cell_sd);
      sum += rows[row].derivative * rows[row].off / (cell_sd * cell_sd);
    }
    const double deviation = 1 / std::sqrt(information);
    // All of a few are weighed alike, although the derivative grows with the load: by 5 % where a third of
    // what is known comes from such readings, which is worth 0.05 x sqrt(1/3) of the deviation.
    REQUIRE(static_cast<double>(estimator.mu_deviation(0)) ==
            doctest::Approx(deviation).epsilon(2e-3).scale(0));
    REQUIRE(std::fabs(static_cast<double>(estimator.mu(0)) - known_mu - sum / information) < 0.1 * deviation);
    most = std::max(most, waiting(*site));
  }
  CHECK(most == taut::Gathered<Scalar>::capacity - 1);
}

TEST_CASE_TEMPLATE("in a hold readings are gathered after the tracker has been adjusted as before", Scalar,
                   double, float) {
  // So short a ramp leaves much to be learned in the hold.
  static Ground ground;
  make_ground(ground);
  ground.known.cables[0].mu_sd = 0.1;
  ground.set_true_mu(std::vector<double>(16, 0.35));
  const auto site = std::make_unique<Site<Scalar>>(ground, far_end_alone(), full, 2);
  ramp(*site, 0, 1, 10);
  auto rho = site->estimator().tracker().rho(0);
  int adjusted = 0, most = 0;
  for (int i = 0; i < 200; ++i) {
    site->advance(full);
    REQUIRE(site->good());
    const auto now = site->estimator().tracker().rho(0);
    if (now != rho) {
      ++adjusted;
      most = 0;
    }
    rho = now;
    most = std::max(most, waiting(*site));
  }
  REQUIRE(adjusted > 0);
  CHECK(most == taut::Gathered<Scalar>::capacity - 1);
}

TEST_CASE("what waits is learned before something else happens") {
  static Ground ground;
  make_ground(ground);
  for (const int rows : {101, 102, 103, 104, 105, 106, 107}) {
    CAPTURE(rows);
    const auto locked = std::make_unique<Site<double>>(ground, far_end_alone(), full, 2),
               released = std::make_unique<Site<double>>(ground, far_end_alone(), full, 2);
    for (Site<double>* site : {locked.get(), released.get()}) {
      ramp(*site, 0, 1, 100);
      for (int i = 0; i < rows - 100; ++i) site->advance(full);
    }
    const int before = waiting(*locked);
    const double deviation = locked->estimator().mu_deviation(0);
    locked->advance(full, true);
    released->advance(0.99 * full);
    for (const Site<double>* site : {locked.get(), released.get()}) {
      CHECK(site->good());
      CHECK(waiting(*site) <= 1);
      if (before > 0) CHECK(site->estimator().mu_deviation(0) < deviation);
    }
  }
}

TEST_CASE("among readings that wait one that contradicts is told at once, and not believed") {
  static Ground ground;
  make_ground(ground);
  const auto site = std::make_unique<Site<double>>(ground, far_end_alone(), full, 3);
  ramp(*site, 0, 1, 100);
  for (int i = 0; i < 16; ++i) {
    CAPTURE(i);
    Site<double>::Estimator estimator = site->estimator();
    taut::Readings<double, PlaneCapacity> wrong;
    wrong.ends[0][1] = {true, false, full, 0};
    wrong.ends[0][0] = {true, false, site->true_force(0) + 7 * cell_sd, 0};
    REQUIRE(estimator.advance(wrong).status.ok());
    CHECK(raised(estimator.alarms(), taut::Alarm::Kind::sensor) == 1);
    CHECK(estimator.save().far_ends.gathered.size == waiting(*site));
    CHECK(estimator.mu(0) == site->estimator().mu(0));
    site->advance(full);
    CHECK(raised(site->estimator().alarms(), taut::Alarm::Kind::sensor) == 0);
  }
}

}  // namespace gathered_test
