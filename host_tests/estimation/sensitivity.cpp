// Derivatives with respect to friction, carried through stick and slip, against trackers with other friction.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "support/run.hpp"
#include "support/saddles.hpp"
#include "support/scenes.hpp"
#include "taut/taut.hpp"

namespace sensitivity_test {
using namespace support;

namespace {

constexpr int most_parameters = 12;
using Model = taut::Condensed<double, PlaneCapacity>;
using Known = taut::FrictionPrior<double, PlaneCapacity>;
using Follower = taut::Tracker<Model, most_parameters>;
using Row = taut::Sample<double, PlaneCapacity>;

/// A scene with friction that is moved by `by` in one parameter: the common one of all joints, or a joint's.
struct Varied {
  taut::Scene<double, 2, PlaneCapacity> scene;
  Model model;
  Known known;

  Varied(const Plane& original, bool shared, int parameter, double by) : scene(original) {
    for (int j = 0; j < scene.mu.size(); ++j)
      if (shared || j == parameter) scene.mu[j] += by;
    REQUIRE(support::condense(scene, model).ok());
    taut::find_friction_prior(scene, known);
  }
  auto friction(bool shared) const {
    return [this, shared](int j) {
      const auto limit = known.limit(0, j, known.mu[j]);
      return taut::JointFriction<double>{limit.rho, shared ? 0 : j, limit.slope};
    };
  }
  void begin(Follower& tracker, bool shared) const {
    REQUIRE(tracker.start(model, friction(shared)).status.ok());
  }
};

/// Ramps, releases, changes of load and lock-offs with re-jacking.
std::vector<Row> random_log(Random& random, bool locks) {
  std::vector<Row> rows;
  Row row;
  const int pieces = 3 + random.below(4);
  for (int piece = 0; piece < pieces; ++piece) {
    const Row from = row;
    const int what = random.below(locks ? 4 : 3);
    if (what < 2) row.jack[0][1].force = random.between(0.2, 1) * 4e5;
    if (what == 2) row.factor[random.below(2)] = random.between(-1, 1);
    if (what == 3) row.jack[0][1].locked = !row.jack[0][1].locked;
    const int steps = 7;
    for (int i = 1; i <= steps; ++i) {
      Row between = row;
      const auto mix = [&](double a, double b) { return a + (b - a) * i / steps; };
      between.jack[0][1].force = mix(from.jack[0][1].force, row.jack[0][1].force);
      for (int k = 0; k < 2; ++k) between.factor[k] = mix(from.factor[k], row.factor[k]);
      rows.push_back(between);
    }
  }
  return rows;
}

struct Case {
  Plane scene;
  std::vector<Row> log;
  bool shared = true;
  int parameter = 0;
};
void make_case(std::uint64_t seed, Case& made) {
  Random random(seed);
  const Variation vary(random);
  taut::Cable<double> cable = steel_cable(random.between(0.1, 0.5));
  cable.seating = random.coin() ? 0.004 : 0;
  cable.law = random.coin() ? taut::FrictionLaw::point : taut::FrictionLaw::capstan;
  if (random.coin())
    truss_string(made.scene, cable, 3 + random.below(4), vary);
  else
    rigid_saddles(made.scene, cable, chain_points(3 + random.below(5)));
  while (made.scene.loads < 2) made.scene.add_load();
  made.shared = random.coin();
  made.parameter = made.shared ? 0 : random.below(made.scene.mu.size());
  made.log = random_log(random, true);
}

/// Largest difference between carried derivatives and central differences, relative to the largest
/// derivative there can be, the force itself.
double worst_difference(std::uint64_t seed, int& compared) {
  static Case given;
  make_case(seed, given);
  const bool shared = given.shared;
  const int parameter = given.parameter;
  const double h = 1e-7;
  const Varied plain(given.scene, shared, parameter, 0), more(given.scene, shared, parameter, h),
      less(given.scene, shared, parameter, -h);
  const auto trackers = std::make_unique<std::array<Follower, 3>>();
  Follower &at = (*trackers)[0], &up = (*trackers)[1], &down = (*trackers)[2];
  plain.begin(at, shared);
  more.begin(up, shared);
  less.begin(down, shared);
  double worst = 0;
  for (const Row& row : given.log) {
    if (!at.advance(row).status.ok() || !up.advance(row).status.ok() || !down.advance(row).status.ok()) break;
    for (int i = 0; i < plain.model.segments; ++i) {
      const double found = at.sensitivity(parameter, i),
                   expected = (up.tension(i) - down.tension(i)) / (2 * h);
      worst = std::fmax(worst, std::fabs(found - expected) / at.peak());
      ++compared;
    }
  }
  return worst;
}

TEST_CASE(
    "derivatives of the forces are those of trackers with other friction, through stick, slip and lock-off") {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    CHECK(worst_difference(seed, compared) < 1e-5);
  }
  CHECK(compared > 50000);
}

/// The same by an unknown that the jack's force depends on: F + p (constant + proportional F).
double worst_difference_by_load(std::uint64_t seed, double constant, double proportional, int& compared) {
  static Case given;
  make_case(seed, given);
  const double h = 1e-7;
  const Varied plain(given.scene, true, 0, 0);
  const auto trackers = std::make_unique<std::array<Follower, 3>>();
  taut::FixedList<taut::JackError<double>, 1> errors;
  const int p = most_parameters - 1;
  errors.add({static_cast<std::int16_t>(p), 1, constant, proportional});
  auto &at = (*trackers)[0], &up = (*trackers)[1], &down = (*trackers)[2];
  REQUIRE(at.start(plain.model, plain.friction(true), errors).status.ok());
  plain.begin(up, true);
  plain.begin(down, true);
  double worst = 0;
  bool pulls = false;
  for (const Row& row : given.log) {
    const auto shifted = [&](double by) {
      Row moved = row;
      double& F = moved.jack[0][1].force;
      if (F > 0) F += by * (constant + proportional * F);
      return moved;
    };
    if (!at.advance(row).status.ok() || !up.advance(shifted(h)).status.ok() ||
        !down.advance(shifted(-h)).status.ok())
      break;
    // Where nothing pulls, nothing is read.
    pulls = pulls || (row.jack[0][1].force > 1 && !row.jack[0][1].locked);
    for (int i = 0; pulls && i < plain.model.segments; ++i) {
      const double found = at.sensitivity(p, i), expected = (up.tension(i) - down.tension(i)) / (2 * h);
      worst = std::fmax(worst, std::fabs(found - expected) / at.peak());
      ++compared;
    }
  }
  return worst;
}

TEST_CASE(
    "derivatives by gain and zero of a jack's cell are those of trackers with other loads, through corners") {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    CHECK(worst_difference_by_load(seed, 0, -1, compared) < 1e-5);
    CHECK(worst_difference_by_load(seed, -2e5, 0, compared) < 1e-5);
  }
  CHECK(compared > 50000);
}

/// Largest difference, relative to the largest force, between a tracker that is adjusted to other friction in
/// the middle of its log and one that had it from the start, at the end of the log.
double worst_after_adjusting(std::uint64_t seed, double by) {
  static Case given;
  make_case(seed, given);
  const Varied before(given.scene, given.shared, given.parameter, 0),
      after(given.scene, given.shared, given.parameter, by);
  const auto trackers = std::make_unique<std::array<Follower, 2>>();
  Follower &adjusted = (*trackers)[0], &expected = (*trackers)[1];
  before.begin(adjusted, given.shared);
  after.begin(expected, given.shared);
  double worst = 0;
  for (std::size_t row = 0; row < given.log.size(); ++row) {
    if (!adjusted.advance(given.log[row]).status.ok() || !expected.advance(given.log[row]).status.ok()) break;
    if (row < given.log.size() / 2) continue;
    if (row == given.log.size() / 2) {
      taut::FixedArray<double, most_parameters> change;
      change[given.parameter] = by;
      REQUIRE(adjusted.adjust(after.friction(given.shared), change).ok());
      CHECK(taut::verify(adjusted).worst() < 1e-9);
    }
    for (int i = 0; i < before.model.segments; ++i)
      worst = std::fmax(worst, std::fabs(adjusted.tension(i) - expected.tension(i)) / expected.peak());
  }
  return worst;
}

TEST_CASE(
    "adjusting the friction on the way leads to where it would have led from the start, to second order") {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    // A hundredth of the change: a ten-thousandth of the error.
    CHECK(worst_after_adjusting(seed, 1e-4) < 1e-6);
    CHECK(worst_after_adjusting(seed, 1e-6) < 1e-10);
  }
}

struct InFloat {
  double worst = 0, squares = 0;
  int compared = 0;
  double rms() const { return std::sqrt(squares / compared); }
};

/// Differences between derivatives of trackers in float and in double with a mu a joint, relative to the
/// largest force, along random logs on scenes of make(random, scene).
template <class SceneType, class Make>
InFloat in_float(const Make& make) {
  using Cap = typename SceneType::Capacity;
  static SceneType scene;
  static taut::Condensed<float, Cap> rounded_model;
  static taut::Condensed<double, Cap> model;
  static taut::Tracker<taut::Condensed<float, Cap>, most_parameters> follower;
  static taut::Tracker<taut::Condensed<double, Cap>, most_parameters> exact;
  InFloat found;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto cable = steel_cable(random.between(0.02, 0.8));
    cable.law = random.coin() ? taut::FrictionLaw::point : taut::FrictionLaw::capstan;
    cable.seating = random.coin() ? 0.004 : 0;
    make(random, cable, scene);
    REQUIRE(support::condense<float>(scene, rounded_model, nullptr, nullptr).ok());
    REQUIRE(support::condense<double>(scene, model, nullptr, nullptr).ok());
    taut::FrictionPrior<double, Cap> known;
    taut::find_friction_prior(scene, known);
    const auto friction = [&](int j) {
      const auto limit = known.limit(0, j, known.mu[j]);
      return taut::JointFriction<double>{limit.rho, j, limit.slope};
    };
    REQUIRE(follower.start(rounded_model, friction).status.ok());
    REQUIRE(exact.start(model, friction).status.ok());
    taut::Sample<double, Cap> row;
    auto& jack = row.jack[0][1];
    for (int i = 0; i < 40; ++i) {
      if (i > 0 && random.below(8) == 0)
        jack.locked = !jack.locked;
      else if (!jack.locked)
        jack.force = 1000 * (1 + random.below(400));
      REQUIRE(exact.advance(row).status.ok());
      REQUIRE(follower.advance(rounded<float>(row)).status.ok());
      for (int p = 0; p < model.joints; ++p)
        for (int k = 0; k < model.segments; ++k) {
          const double off =
              std::fabs(static_cast<double>(follower.sensitivity(p, k)) - exact.sensitivity(p, k)) /
              exact.peak();
          found.worst = std::fmax(found.worst, off);
          found.squares += off * off;
          ++found.compared;
        }
    }
  }
  MESSAGE("off by " << found.rms() << " of the largest force, rms, at most by " << found.worst);
  return found;
}

}  // namespace

TEST_CASE("a tracker in float has the derivatives of one in double: between rigid saddles") {
  const InFloat found =
      in_float<Saddles>([](Random& random, const taut::Cable<double>& cable, Saddles& scene) {
        saddles(scene, cable, chain_points(3 + random.below(7)));
      });
  // With all of it in double, at commit be9fff1, 0.7e-8.
  CHECK(found.rms() < 3e-8);
  CHECK(found.worst < 1e-6);
  CHECK(found.compared > 100000);
}

TEST_CASE("a tracker in float has the derivatives of one in double: where friction all but locks a cable") {
  // Of the force, 1e-4 to 1e-60 come to the far end: less than a float can be.
  const InFloat found = in_float<Saddles>([](Random& random, taut::Cable<double>& cable, Saddles& scene) {
    cable.law = taut::FrictionLaw::capstan;
    cable.mu = random.between(4, 55);
    saddles(scene, cable, chain_points(3 + random.below(7)));
  });
  CHECK(found.rms() < 3e-8);
  CHECK(found.worst < 1e-6);
  CHECK(found.compared > 100000);
}

TEST_CASE("a tracker in float has the derivatives of one in double: on structures, however soft or stiff") {
  const InFloat found = in_float<Plane>([](Random& random, const taut::Cable<double>& cable, Plane& scene) {
    const Variation vary(random);
    truss_string(scene, cable, 3 + random.below(5), vary);
    const double stiffer = std::pow(10.0, random.between(-4, 4));
    for (int i = 0; i < scene.struts.size(); ++i) scene.struts[i].E *= stiffer;
  });
  // With all of it in double, at commit be9fff1, 0.9e-8.
  CHECK(found.rms() < 2e-7);
  CHECK(found.worst < 2e-5);
  CHECK(found.compared > 100000);
}

TEST_CASE(
    "adjusted in the row in which a load came to depend on another unknown, it is where it would be else") {
  Random random(7);
  for (int n = 0; n < 20; ++n) {
    CAPTURE(n);
    static Plane scene;
    support::rigid_saddles(scene, support::steel_cable(0.2), support::chain_points(6));
    const Varied before(scene, true, 0, 0),
        after(scene, true, 0, (n < 10 ? 1 : -1) * random.between(0.01, 0.05));
    const auto trackers = std::make_unique<std::array<Follower, 2>>();
    Row row;
    for (Follower& tracker : *trackers) {
      before.begin(tracker, true);
      for (const double force : {4e5, n % 2 == 0 ? 4e5 : 1e5}) {
        row.jack[0][1].force = force;
        REQUIRE(tracker.advance(row).status.ok());
      }
    }
    Follower &plain = (*trackers)[0], &changed = (*trackers)[1];
    const double was = plain.tension(0);
    changed.change_load_error({1, 1, 0, 1});
    taut::FixedArray<double, most_parameters> change;
    change[0] = after.scene.mu[0] - before.scene.mu[0];
    for (Follower* tracker : {&plain, &changed}) REQUIRE(tracker->adjust(after.friction(true), change).ok());
    for (int i = 0; i < before.model.segments; ++i)
      CHECK(changed.tension(i) == doctest::Approx(plain.tension(i)).epsilon(1e-12));
    CHECK(std::fabs(plain.tension(0) - was) > 1e3);
  }
}

TEST_CASE(
    "a locked cable whose wedge turns out to be drawn in by more than it is stretched is slack, and pushes "
    "not") {
  // At commit 74723ed verify() refused that state.
  for (const bool elastic : {false, true}) {
    CAPTURE(elastic);
    static Plane scene;
    const auto cable = support::steel_cable(0.2);
    if (elastic)
      support::truss_string(scene, cable, 4);
    else
      support::rigid_saddles(scene, cable, support::chain_points(6));
    const Varied given(scene, true, 0, 0);
    const auto trackers = std::make_unique<std::array<Follower, 2>>();
    Follower &adjusted = (*trackers)[0], &drawn_in = (*trackers)[1];
    constexpr double further = 0.02;
    Row row;
    for (Follower* tracker : {&adjusted, &drawn_in}) {
      given.begin(*tracker, true);
      row.jack[0][1] = {1e4, false};
      REQUIRE(tracker->advance(row).status.ok());
      row.jack[0][1].locked = true;
      const double more = tracker == &drawn_in ? further : 0;
      REQUIRE(tracker->seat(row, [&](int, std::size_t) { return more; }).is_complete());
    }
    adjusted.draw_in(1, 0, 1);
    taut::FixedArray<double, most_parameters> change;
    change[1] = further;
    REQUIRE(adjusted.adjust(given.friction(true), change).ok());
    for (int i = 0; i < given.model.segments; ++i) CHECK(std::fabs(adjusted.tension(i)) < 1e-3);
    CHECK(taut::verify(adjusted).worst() < 1e-9);
    row.jack[0][1] = {1e5, false};
    for (Follower* tracker : {&adjusted, &drawn_in}) REQUIRE(tracker->advance(row).status.ok());
    for (int i = 0; i < given.model.segments; ++i)
      CHECK(adjusted.tension(i) == doctest::Approx(drawn_in.tension(i)).epsilon(1e-9));
  }
}

TEST_CASE(
    "between two jacks that differ by all friction a cable is brought to more of it, and one joint sticks") {
  for (const bool elastic : {false, true})
    for (const double by : {0.01, 0.03, 0.1})
      for (const double above : {1.001, 1.02, 1.05}) {
        CAPTURE(elastic);
        CAPTURE(by);
        CAPTURE(above);
        const std::size_t more = above > 1.03 ? 1 : 0;
        static Plane scene;
        const auto cable = support::steel_cable(0.2, support::two_jacks);
        if (elastic)
          support::truss_string(scene, cable, 6);
        else
          support::rigid_saddles(scene, cable, support::chain_points(8));
        const auto given = std::make_unique<Varied>(scene, true, 0, 0),
                   after = std::make_unique<Varied>(scene, true, 0, by);
        const auto trackers = std::make_unique<std::array<Follower, 2>>();
        Follower &adjusted = (*trackers)[0], &driven = (*trackers)[1];
        given->begin(adjusted, true);
        after->begin(driven, true);
        double carried = 1;
        for (int j = 0; j < given->model.cables[0].joints(); ++j) carried *= given->model.rho[j];
        Row row;
        row.jack[0][more].force = 1e5;
        row.jack[0][1 - more].force = above * carried * 1e5;
        for (Follower* tracker : {&adjusted, &driven}) REQUIRE(tracker->advance(row).status.ok());
        taut::FixedArray<double, most_parameters> change;
        change[0] = by;
        REQUIRE(adjusted.adjust(after->friction(true), change).ok());
        CHECK(taut::verify(adjusted).worst() < 1e-9);
        // To first order, over a kink.
        for (int i = 0; i < given->model.segments; ++i)
          CHECK(std::fabs(adjusted.tension(i) - driven.tension(i)) < 0.2 * by * 1e5);
        // And goes on.
        row.jack[0][1 - more].force = 1e5;
        for (Follower* tracker : {&adjusted, &driven}) REQUIRE(tracker->advance(row).status.ok());
        CHECK(taut::verify(adjusted).worst() < 1e-9);
      }
}

}  // namespace sensitivity_test
