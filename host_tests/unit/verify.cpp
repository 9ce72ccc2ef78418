// taut::verify() sees every kind of state that breaks a law. The condensed scene is spoiled behind the
// tracker's back, so that its state is none of that scene any more.
#include <doctest/doctest.h>

#include <limits>
#include <memory>

#include "support/run.hpp"
#include "support/scenes.hpp"
#include "taut/tracking/verify.hpp"

namespace verify_test {
using namespace support;

namespace {

using Model = taut::Condensed<double, PlaneCapacity>;
using Verdict = taut::Verdict<double>;

constexpr double full = 2e5, infinite = std::numeric_limits<double>::infinity(),
                 no_number = std::numeric_limits<double>::quiet_NaN();

/// What verify() says of a cable over rigid saddles that is pulled to `force` once `spoil` has been.
template <class Spoil>
Verdict after(double force, Spoil spoil) {
  static Plane scene;
  static Model model;
  rigid_saddles(scene, steel_cable(0.2), chain_points(5));
  REQUIRE(condense(scene, model).ok());
  const auto tracker = std::make_unique<taut::Tracker<Model>>();
  REQUIRE(tracker->start(model).status.ok());
  taut::Sample<double, PlaneCapacity> sample;
  for (const double part : {1.0, force}) {
    sample.jack[0][1].force = part * full;
    REQUIRE(tracker->advance(sample).status.ok());
  }
  REQUIRE(taut::verify(*tracker).worst() < 1e-12);
  spoil(model);
  return taut::verify(*tracker);
}

}  // namespace

TEST_CASE("tensions that do not follow from the slips are an imbalance of the segment") {
  const Verdict found = after(1, [](Model& model) { model.prestrain[2] += 1e-6 * full; });
  CHECK(found.imbalance == doctest::Approx(1e-6).epsilon(1e-6));
  CHECK(found.segment == 2);
}

TEST_CASE("a jack that pulls by another force is an imbalance") {
  const Verdict found = after(1, [](Model& model) { model.prestrain[model.segments - 1] -= 1e-6 * full; });
  CHECK(found.imbalance == doctest::Approx(1e-6).epsilon(1e-6));
}

TEST_CASE("a segment that pushes is told, by how much") {
  const Verdict found = after(1, [](Model& model) { model.prestrain[0] -= full; });
  CHECK(found.compression > 0.01);
  CHECK(found.compression < 1);
}

TEST_CASE("forces beyond friction are told with their joint") {
  const Verdict found = after(0.99, [](Model& model) { model.prestrain[3] += 0.5 * full; });
  CHECK(found.outside > 0.1);
  CHECK((found.joint == 2 || found.joint == 3));
}

TEST_CASE("a joint that slides below its limit is told") {
  // Within its cone, for the segment at the anchor has the smaller force.
  const Verdict found = after(1.01, [](Model& model) { model.prestrain[0] += 1e-6 * full; });
  CHECK(found.outside < 1e-12);
  CHECK(found.off_limit > 1e-7);
  CHECK(found.joint == 0);
}

TEST_CASE("what is no number is infinitely wrong, wherever it is") {
  CHECK(after(1, [](Model& model) { model.prestrain[1] = no_number; }).worst() == infinite);
  CHECK(after(1, [](Model& model) { model.prestrain[1] = infinite; }).worst() == infinite);
  CHECK(after(1, [](Model& model) {
          for (int i = 0; i < model.segments; ++i) model.coupling.set(i, i, no_number);
        }).worst() == infinite);
}

}  // namespace verify_test
