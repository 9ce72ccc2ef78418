// Two cables that are jacked in turns: what is in doubt of one says nothing against what is read of the
// other.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "estimation/saddle_rows.hpp"
#include "estimation/site.hpp"

namespace several_cables_test {
using namespace estimation;

namespace {

constexpr double noise = 500, nominal_mu = 0.2, mu_sd = 0.05;

taut::Cable<double> a_cable(double mu) {
  taut::Cable<double> cable = support::steel_cable(mu);
  cable.mu_sd = mu / 4;
  cable.shared_mu = true;
  for (auto& cell : cable.cell) cell.sd = noise;
  return cable;
}
/// Each with a jack at its end and a cell at its start: over saddles of their own, or both below one truss.
void make_pair(Plane& scene, double mu, bool elastic) {
  const taut::Cable<double> cable = a_cable(mu);
  if (!elastic) return saddle_rows(scene, cable, 2);
  std::vector<int> path;
  support::truss_string(scene, cable, 4);
  for (int i = 0; i < scene.cables[0].nodes; ++i) path.push_back(scene.path[scene.cables[0].first_path + i]);
  scene.add_cable(cable, path.data(), static_cast<int>(path.size()));
}

/// The truth in double, the estimate in Scalar.
template <class Scalar>
class Pair {
 public:
  using Model = taut::Condensed<Scalar, PlaneCapacity>;
  using Truth = taut::Condensed<double, PlaneCapacity>;

  Pair(bool elastic, double nominal, double mu, std::uint64_t seed) : random_(seed) {
    make_pair(known_, nominal, elastic);
    make_pair(actual_, mu, elastic);
    REQUIRE(support::condense(known_, model_).ok());
    REQUIRE(support::condense(actual_, true_model_).ok());
    taut::find_friction_prior(known_, prior_);
    REQUIRE(truth_.start(true_model_).status.ok());
    REQUIRE(estimator_.start(model_, prior_).status.ok());
  }
  /// A row with these forces of the jacks [N]; a dead cell shows what a meter says that is not connected.
  void advance(const std::array<double, 2>& force, int dead = -1) {
    taut::Sample<double, PlaneCapacity> sample;
    taut::Readings<Scalar, PlaneCapacity> readings;
    for (int c = 0; c < 2; ++c) sample.jack[c][1].force = force[static_cast<std::size_t>(c)];
    REQUIRE(truth_.advance(sample).status.ok());
    for (int c = 0; c < 2; ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        const double at_far = truth_.tension(true_model_.cables[c].first_segment),
                     read = (end == 1 ? sample.jack[c][1].force : at_far) +
                            (scatters ? noise * gaussian(random_) : 0);
        readings.ends[c][end].has_force = true;
        readings.ends[c][end].force = static_cast<Scalar>(c == dead && end == 1 ? 9.9e37 : read);
      }
    REQUIRE(estimator_.advance(readings).status.ok());
  }
  bool holds_truth(int segment) const {
    const auto found = estimator_.estimate(segment);
    return std::fabs(static_cast<double>(found.force) - truth_.tension(segment)) <=
           1.96 * static_cast<double>(found.deviation);
  }
  const Truth& model() const { return true_model_; }
  bool scatters = true;  ///< load cells have noise
  double tension(int segment) const { return truth_.tension(segment); }
  const auto& estimator() const { return estimator_; }

 private:
  Random random_;
  Plane known_, actual_;
  Model model_;
  Truth true_model_;
  taut::FrictionPrior<Scalar, PlaneCapacity> prior_;
  taut::Tracker<Truth> truth_;
  taut::Estimator<Model, most_unknowns> estimator_;
};

}  // namespace

TEST_CASE_TEMPLATE("a far end teaches its cable's mu while the cell of another cable's idle jack is dead",
                   Scalar, double, float) {
  int doubtful = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(1000 + seed);
    const double mu = nominal_mu + mu_sd * gaussian(random);
    const auto pair = std::make_unique<Pair<Scalar>>(false, nominal_mu, mu, seed);
    for (int row = 1; row <= 100; ++row) {
      pair->advance({0, 2000.0 * row}, 0);
      doubtful += pair->estimator().load(0, 1).refused ? 1 : 0;
    }
    const int joint = pair->model().cables[1].first_joint;
    const double found = static_cast<double>(pair->estimator().mu(joint)),
                 sd = static_cast<double>(pair->estimator().mu_deviation(joint));
    CHECK(sd < 0.3 * mu_sd);
    CHECK(std::fabs(found - mu) < 4 * sd);
  }
  // Else nothing was tested.
  CHECK(doubtful == 2000);
}

TEST_CASE_TEMPLATE(
    "of two cables below one truss that are jacked in turns 93 % of the intervals hold the truth", Scalar,
    double, float) {
  long held = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(2000 + seed);
    const auto pair =
        std::make_unique<Pair<Scalar>>(true, nominal_mu, nominal_mu + mu_sd * gaussian(random), seed);
    std::array<double, 2> at{};
    // Up by a half each, one after the other, with waits between; then the first one is let out.
    const auto go = [&](std::size_t jack, double to, int rows) {
      const double from = at[jack];
      for (int i = 1; i <= rows; ++i) {
        at[jack] = from + (to - from) * i / rows;
        pair->advance(at);
        for (int k = 0; k < pair->model().segments; ++k) {
          if (pair->tension(k) < 2000) continue;
          held += pair->holds_truth(k) ? 1 : 0;
          ++all;
        }
      }
    };
    for (const double part : {0.5, 1.0})
      for (const std::size_t jack : {std::size_t{0}, std::size_t{1}}) {
        go(jack, 2e5 * part, 5 + random.below(60));
        go(jack, 2e5 * part, 10);
      }
    go(0, 1.2e5, 30);
  }
  const double share = static_cast<double>(held) / static_cast<double>(all);
  CAPTURE(share);
  CHECK(share > 0.93);
  CHECK(share < 0.985);
}

TEST_CASE_TEMPLATE("a far end teaches its cable's mu while another cable's jack idles, or rests after a ramp",
                   Scalar, double, float) {
  // Over saddles nothing happens to the one as the other is pulled; below one truss joint after joint slides.
  for (const bool elastic : {false, true})
    for (const double other : {0.0, 1.5e5})
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(elastic);
        CAPTURE(other);
        CAPTURE(seed);
        Random random(3000 + seed);
        const double mu = nominal_mu + mu_sd * gaussian(random);
        const auto pair = std::make_unique<Pair<Scalar>>(elastic, nominal_mu, mu, seed);
        for (int row = 1; row <= 30; ++row) pair->advance({other * row / 30, 0});
        for (int row = 1; row <= 100; ++row) pair->advance({other, 2000.0 * row});
        const int joint = pair->model().cables[1].first_joint;
        const double found = static_cast<double>(pair->estimator().mu(joint)),
                     sd = static_cast<double>(pair->estimator().mu_deviation(joint));
        CHECK(sd < 0.3 * mu_sd);
        CHECK(std::fabs(found - mu) < 4 * sd);
      }
}

TEST_CASE_TEMPLATE(
    "a cable that was let out a little remembers where its jack stands while the other one is pulled", Scalar,
    double, float) {
  // So little friction that joint after joint slides back.
  const double mu = 0.05;
  double worst = 0;
  for (const double out : {0.02, 0.03, 0.04, 0.05, 0.07, 0.1})
    for (const int rows : {6, 12, 50}) {
      CAPTURE(out);
      CAPTURE(rows);
      const auto pair = std::make_unique<Pair<Scalar>>(true, mu, mu, 1);
      // Cells that could scatter by as much, and do not: a load is confirmed when it is five of it farther.
      pair->scatters = false;
      for (int row = 1; row <= 60; ++row) pair->advance({2e5 * row / 60, 0});
      for (int row = 1; row <= rows; ++row) pair->advance({2e5 * (1 - out * row / rows), 0});
      for (int row = 1; row <= 60; ++row) pair->advance({2e5 * (1 - out), 2e5 * row / 60});
      const auto& cable = pair->model().cables[0];
      for (int k = cable.first_segment; k < cable.first_segment + cable.segments(); ++k)
        worst =
            std::fmax(worst, std::fabs(static_cast<double>(pair->estimator().force(k)) - pair->tension(k)));
      // Beside the jack the force is its load, and as well known.
      CHECK(static_cast<double>(pair->estimator().deviation(cable.end_segment(1))) ==
            doctest::Approx(static_cast<double>(pair->estimator().load(0, 1).sd)).epsilon(1e-3));
    }
  CAPTURE(worst);
  CHECK(worst < 0.15 * noise);
}

TEST_CASE_TEMPLATE("what was in the memory of an estimator before does not matter", Scalar, double, float) {
  std::vector<Scalar> found[2];
  for (const int before : {0x00, 0xFF}) {
    const std::unique_ptr<void, void (*)(void*)> memory(::operator new(sizeof(Pair<Scalar>)),
                                                        [](void* at) { ::operator delete(at); });
    std::memset(memory.get(), before, sizeof(Pair<Scalar>));
    auto* const pair = new (memory.get()) Pair<Scalar>(true, 0.05, 0.05, 1);
    pair->scatters = false;
    for (int row = 1; row <= 60; ++row) pair->advance({2e5 * row / 60, 0});
    for (int row = 1; row <= 6; ++row) pair->advance({2e5 * (1 - 0.02 * row / 6), 0});
    for (int row = 1; row <= 60; ++row) pair->advance({2e5 * 0.98, 2e5 * row / 60});
    for (int i = 0; i < pair->model().segments; ++i) {
      found[before != 0].push_back(pair->estimator().force(i));
      found[before != 0].push_back(pair->estimator().deviation(i));
    }
    pair->~Pair<Scalar>();
  }
  CHECK(found[0] == found[1]);
}

}  // namespace several_cables_test
