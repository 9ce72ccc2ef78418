// Strokes against the elongation that is expected, by slope: jackings whose stroke follows from a closed
// form.
#include "taut/estimation/elongation_check.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>

#include "estimation/ramp.hpp"

namespace elongation_check_test {
using namespace estimation;

namespace {

using Check = taut::ElongationCheck<double>;

constexpr int segments = 4;
constexpr double stretch = 5;  // of the lengths of the chain
constexpr double EA = support::cable_E * support::cable_A, highest = 0.004 * EA;

/// What is true of a jacking, and what its instruments make of it.
struct Jacking {
  double mu = 0.2, EA_true = EA;
  double known_mu = 0.2, mu_sd = 0.1;
  bool has_cell = true;                  ///< at the far end
  double noise = 1e-3, force_noise = 0;  ///< of the stroke [m], of forces as a part of the highest
  double zero = 0;                       ///< where the stroke is read from [m]
  std::function<double(double, double)> seen = [](double, double stroke) {
    return stroke;
  };               ///< of part, stroke
  int rows = 600;  ///< ten a second, of the ramp
  std::uint64_t seed = 1;
};

/// The stroke at a jack force: Eq. (34) while the cable slides throughout, mu * cot(alpha) at every saddle.
double stroke_at(double force, const Jacking& jacking) {
  double tension = force, sum = 0;
  for (int i = segments - 1; i >= 0; --i) {
    sum += tension * stretch * support::chain_length(i) / jacking.EA_true;
    if (i == 0) break;
    const double c = jacking.mu * std::tan(support::chain_turn[i - 1] / 2);
    tension *= (1 - c) / (1 + c);
  }
  return sum;
}
double far_end(double force, const Jacking& jacking) {
  for (int i = 0; i + 1 < segments; ++i) {
    const double c = jacking.mu * std::tan(support::chain_turn[i] / 2);
    force *= (1 - c) / (1 + c);
  }
  return force;
}

/// In how many rows of a ramp and a hold of five seconds the elongation is told to be off, and the first of
/// them as a part of the highest force.
struct Told {
  int rows = 0;
  double first = -1;
};
template <class Scalar>
class Site {
 public:
  explicit Site(const Jacking& jacking) : jacking_(jacking), random_(jacking.seed) {
    auto points = support::chain_points(segments);
    for (auto& point : points) point = {stretch * point[0], stretch * point[1]};
    taut::Cable<double> cable = support::steel_cable(jacking.known_mu);
    cable.mu_sd = jacking.mu_sd;
    cable.shared_mu = true;
    cable.cell[0].sd = cable.cell[1].sd = jacking.force_noise * highest;
    if (jacking.force_noise == 0) cable.cell[0].sd = 1e-4 * highest;
    Plane scene;
    support::rigid_saddles(scene, cable, points);
    REQUIRE(support::condense(scene, model_).ok());
    taut::find_friction_prior(scene, prior_);
    REQUIRE(estimator_.start(model_, prior_).status.ok());
  }
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  /// A row at this part of the highest force. Whether the elongation is told to be off.
  bool advance(double part) {
    const double force = part * highest;
    const double stroke = jacking_.seen(part, stroke_at(force, jacking_)) + jacking_.zero;
    return read(force, stroke);
  }
  bool read(double force, double stroke, bool locked = false) {
    taut::Readings<Scalar, PlaneCapacity> readings;
    readings.sample.jack[0][1].locked = locked;
    readings.dt = Scalar(0.1);
    readings.ends[0][1] = {true, true, number(force + jacking_.force_noise * highest * gaussian(random_)),
                           number(stroke + jacking_.noise * gaussian(random_))};
    readings.ends[0][0].has_force = jacking_.has_cell;
    readings.ends[0][0].force =
        number(far_end(force, jacking_) + jacking_.force_noise * highest * gaussian(random_));
    REQUIRE(estimator_.advance(readings).status.ok());
    return raised(estimator_.alarms(), taut::Alarm::Kind::elongation) > 0;
  }
  void restart() {
    const auto state = estimator_.save();
    estimator_ = {};
    REQUIRE(estimator_.restore(model_, prior_, state).ok());
  }

 private:
  static Scalar number(double value) { return static_cast<Scalar>(value); }

  Jacking jacking_;
  Random random_;
  taut::Condensed<Scalar, PlaneCapacity> model_;
  taut::FrictionPrior<Scalar, PlaneCapacity> prior_;
  taut::Estimator<taut::Condensed<Scalar, PlaneCapacity>, most_unknowns> estimator_;
};

template <class Scalar = double>
Told follow(const Jacking& jacking) {
  const auto site = std::make_unique<Site<Scalar>>(jacking);
  Told told;
  for (int i = 1; i <= jacking.rows + 50; ++i) {
    const double part = std::fmin(static_cast<double>(i) / jacking.rows, 1);
    if (!site->advance(part)) continue;
    if (told.rows++ == 0) told.first = part;
  }
  return told;
}
Jacking with(const std::function<void(Jacking&)>& change) {
  Jacking jacking;
  change(jacking);
  return jacking;
}

// Friction of the prior, E A within 3 %, any zero.
Jacking clean(std::uint64_t seed) {
  Random random(seed);
  Jacking jacking;
  jacking.seed = seed;
  jacking.mu = std::fmax(0.2 + 0.05 * gaussian(random), 0.02);
  jacking.EA_true = EA * random.between(0.97, 1.03);
  jacking.zero = random.between(-0.1, 0.1);
  jacking.force_noise = 0.002;
  return jacking;
}
constexpr std::uint64_t first_seed = 20261123;

TEST_CASE("of two hundred clean jackings with a millimetre of noise at most two per cent are told") {
  int told = 0;
  for (std::uint64_t i = 0; i < 200; ++i) told += follow(clean(first_seed + i)).rows > 0 ? 1 : 0;
  MESSAGE("seeds from ", first_seed, ": ", told, " of 200 clean jackings are told");
  CHECK(told <= 4);
}

TEST_CASE("a zero, slack at the start, a toe and an E A within the tolerance are no alarm") {
  for (const double noise : {0.0, 1e-3})
    for (const auto& jacking : {
             with([](Jacking& j) { j.zero = 0.4; }),
             with([](Jacking& j) {
               j.seen = [](double part, double s) { return s + 0.02 * std::fmin(part / 0.02, 1); };
             }),
             with([](Jacking& j) {
               j.seen = [](double part, double s) { return s + 0.006 * (1 - std::exp(-part / 0.03)); };
             }),
             with([](Jacking& j) { j.EA_true = EA / 1.03; }),
             with([](Jacking& j) { j.EA_true = EA / 0.97; }),
         }) {
      Jacking noisy = jacking;
      noisy.noise = noise;
      CHECK(follow(noisy).rows == 0);
      CHECK(follow<float>(noisy).rows == 0);
    }
}

TEST_CASE("an E A that is 12 % off is told, either way, and until the end") {
  for (const double part : {0.88, 1.12})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Jacking jacking = clean(first_seed + seed);
      jacking.EA_true = EA * part;
      const Told told = follow(jacking);
      CAPTURE(seed);
      CHECK(told.rows > 100);
      CHECK(told.first > 0.2);
    }
}

TEST_CASE("a cable that jams at half the load is told soon after") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Jacking jacking = clean(first_seed + seed);
    const double stop = stroke_at(0.5 * highest, jacking);
    jacking.seen = [stop](double, double stroke) { return std::fmin(stroke, stop); };
    const Told told = follow(jacking);
    CAPTURE(seed);
    CHECK(told.first > 0.5);
    CHECK(told.first < 0.6);
    CHECK(told.rows > 200);
  }
}

TEST_CASE("a wedge that slips by 6 mm is told within a second, pulling or not") {
  int pulling = 0, resting = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Jacking jacking = clean(first_seed + seed);
    jacking.seen = [](double part, double stroke) { return stroke + (part >= 0.6 ? 0.006 : 0); };
    const Told told = follow(jacking);
    if (told.first >= 0.6 && told.first < 0.6 + 11.0 / jacking.rows) ++pulling;
    const auto site = std::make_unique<Site<double>>(jacking);
    for (int i = 1; i <= 300; ++i) CHECK_FALSE(site->advance(0.5 * i / 300));
    for (int i = 0; i < 50; ++i) CHECK_FALSE(site->advance(0.5));
    const double slipped = stroke_at(0.5 * highest, jacking) + jacking.zero + 0.006;
    for (int i = 0, told_here = 0; i < 10 && told_here == 0; ++i)
      if (site->read(0.5 * highest, slipped)) told_here = ++resting;
  }
  CHECK(pulling >= 38);
  CHECK(resting >= 38);
}

TEST_CASE("where friction is hardly known and nothing measures it, the stroke of another friction is none") {
  Jacking jacking;
  jacking.has_cell = false;
  jacking.noise = 0;
  for (const double mu : {0.02, 0.38}) {
    jacking.mu = mu;
    jacking.mu_sd = 0.1;
    CHECK(follow(jacking).rows == 0);
    // Known as well as this, the same is.
    jacking.mu_sd = 0.002;
    CHECK(follow(jacking).rows > 0);
  }
}

TEST_CASE("a leg ends where the load turns or the end is locked: a new zero is an alarm within one alone") {
  Jacking jacking;
  jacking.mu = 0;
  jacking.known_mu = jacking.mu_sd = 0;
  jacking.noise = 0;
  const auto site = std::make_unique<Site<double>>(jacking);
  for (int i = 1; i <= 100; ++i) CHECK_FALSE(site->advance(0.008 * i));
  const auto at = [&](double part, double zero, bool locked) {
    return site->read(part * highest, stroke_at(part * highest, jacking) + zero, locked);
  };
  for (int i = 1; i <= 20; ++i) CHECK_FALSE(at(0.8 - 0.01 * i, 0.05, false));
  // The stroke of a jack that is taken off.
  for (int i = 0; i < 20; ++i) CHECK_FALSE(at(0, 0.3, true));
  for (int i = 0; i < 20; ++i) CHECK_FALSE(at(0.65 + 0.01 * i, -0.2, false));
  CHECK(at(0.85, -0.15, false));
}

TEST_CASE("a stage a row: what is off by a fifth is told, what is not is none") {
  for (const double part : {1.0, 1.2, 0.8}) {
    Jacking jacking;
    jacking.EA_true = EA / part;
    jacking.rows = 10;
    CAPTURE(part);
    CHECK((follow(jacking).rows > 0) == (part != 1));
  }
}

TEST_CASE("restored after every row, what is told of strokes is the same") {
  Jacking jacking = clean(first_seed);
  jacking.seen = [](double part, double stroke) { return stroke + (part >= 0.6 ? 0.006 : 0); };
  const auto plain = std::make_unique<Site<float>>(jacking),
             restarted = std::make_unique<Site<float>>(jacking);
  int told = 0;
  for (int i = 1; i <= 300; ++i) {
    const bool expected = plain->advance(i / 300.0);
    CHECK(restarted->advance(i / 300.0) == expected);
    restarted->restart();
    told += expected ? 1 : 0;
  }
  CHECK(told > 0);
}

/// Strokes one by one against an elongation that is known exactly.
struct Plain {
  Check check;
  taut::AlarmLimits<double> limits;

  bool at(double stroke, double expected) { return check.take(stroke, {expected, 0, 0, 0}, limits); }
};

TEST_CASE("a single stroke that is no stroke is told in its row alone") {
  Plain plain;
  for (int i = 0; i < 100; ++i) CHECK(plain.at(1e-3 * i + (i == 50 ? 1 : 0), 1e-3 * i) == (i == 50));
}

TEST_CASE("what is off by the tolerance and five standard deviations is told, and less is not") {
  // From the mean of two readings to one 100 mm on.
  const double allowed = 0.005 + 5 * std::sqrt(1 + 1 / 2.0) * 1e-3;
  for (const double part : {-1.01, -0.99, 0.99, 1.01}) {
    CAPTURE(part);
    Plain plain;
    CHECK_FALSE(plain.at(0.3, 0.1));
    CHECK_FALSE(plain.at(0.301, 0.101));
    CHECK(plain.at(0.4005 + part * allowed, 0.2005) == (std::fabs(part) > 1));
  }
}

TEST_CASE("eight readings that say the same are told where one is not enough") {
  const double allowed = 0.005 + 5 * std::sqrt(2 / 8.0) * 1e-3;
  for (const double part : {0.98, 1.02}) {
    CAPTURE(part);
    Plain plain;
    for (int i = 0; i < 8; ++i) CHECK_FALSE(plain.at(0, 0.1));
    for (int i = 0; i < 7; ++i) CHECK_FALSE(plain.at(0.1 + 0.98 * allowed, 0.2));
    CHECK(plain.at(0.1 + (0.98 + 8 * (part - 0.98)) * allowed, 0.2) == (part > 1));
  }
}

TEST_CASE("errors of the loads at both places widen what is allowed") {
  // As large as the noise of the stroke: of two readings each.
  const double sd = 1e-3, allowed = 0.005 + 5 * std::sqrt(4.0) * sd;
  for (const double part : {0.99, 1.01}) {
    Check check;
    const taut::AlarmLimits<double> limits;
    CHECK_FALSE(check.take(0, {0.1, 0, 0, sd * sd}, limits));
    CHECK(check.take(0.1 + part * allowed, {0.2, 0, 0, sd * sd}, limits) == (part > 1));
  }
}

TEST_CASE("what has been told stays so until it is off by half as many standard deviations") {
  Plain plain;
  const auto off_by = [](double sigmas) { return 0.005 + sigmas * std::sqrt(2.0) * 1e-3; };
  CHECK_FALSE(plain.at(0, 0.1));
  CHECK(plain.at(0.1 + off_by(5.1), 0.2));
  // Their mean is off by four.
  CHECK(plain.at(0.1 + off_by(2.9), 0.2));
  CHECK_FALSE(plain.at(0.1, 0.2));
  CHECK_FALSE(plain.at(0.1069, 0.2));
}

TEST_CASE("what was read while it was off is no place to compare with afterwards") {
  Plain plain;
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    const bool is_off = i >= 40 && i < 60;
    CHECK(plain.at(1e-3 * i + (is_off ? 0.05 : 0), 1e-3 * i) == is_off);
  }
}

TEST_CASE("what is known better of friction by now is not taken for known before") {
  // Known by 0.2 at first and 0.01 later: the error of then does not cancel in the increment, as it does
  // where nothing was learned.
  const double by_friction = 0.05, before = 0.2 * by_friction, after = 0.01 * 3 * by_friction;
  for (const bool learns : {true, false}) {
    CAPTURE(learns);
    const double now = learns ? after : 3 * before;
    const auto taken = [&](double off) {
      Check check;
      taut::AlarmLimits<double> limits;
      limits.stroke_sd = 1e-6;
      CHECK_FALSE(check.take(0.1, {0.1, before * before, by_friction, 0}, limits));
      CHECK_FALSE(check.take(0.1 + 1e-6, {0.1 + 1e-6, before * before, by_friction, 0}, limits));
      return check.take(0.2 + off, {0.2, now * now, 3 * by_friction, 0}, limits);
    };
    // Of 3 e_1 - e_0, with e_0 the sum of e_1 and of what was learned, which are independent.
    const double e_0 = 0.2 * 0.2, e_1 = learns ? 0.01 * 0.01 : e_0;
    const double sd = by_friction * std::sqrt(9 * e_1 + e_0 - 6 * e_1);
    const double allowed = 0.05 * 0.1 + 5 * sd;
    CHECK_FALSE(taken(0.99 * allowed));
    CHECK(taken(1.01 * allowed));
  }
}

}  // namespace

}  // namespace elongation_check_test
