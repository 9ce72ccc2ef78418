// One ramp of the jack, and how well the estimate comes out of it.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "estimation/site.hpp"

namespace estimation {

/// The jack force at the end of a whole ramp [N].
constexpr double full = 2e5;

/// Parts of the full force.
template <class Scalar, class Check>
void ramp(Site<Scalar>& site, double from, double to, int samples, const Check& check) {
  for (int i = 1; i <= samples; ++i) {
    site.advance(full * (from + (to - from) * i / samples));
    check();
  }
}
template <class Scalar>
void ramp(Site<Scalar>& site, double from, double to, int samples) {
  ramp(site, from, to, samples, [] {});
}

/// How many alarms are of this kind.
template <class Alarms>
int raised(const Alarms& alarms, taut::Alarm::Kind kind) {
  return static_cast<int>(
      std::count_if(alarms.begin(), alarms.end(), [kind](const auto& alarm) { return alarm.kind == kind; }));
}

/// Of the forces from segment `first` to the one before the jack: root mean square, relative to the truth.
struct Errors {
  double estimated = 0, nominal = 0;
};
template <class Scalar>
Errors after_one_ramp(const Ground& ground, const Instruments& instruments, std::uint64_t seeds, int first) {
  Errors errors;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto site = std::make_unique<Site<Scalar>>(ground, instruments, full, seed);
    ramp(*site, 0, 1, 200);
    REQUIRE(site->good());
    for (int i = first; i + 1 < site->segments(); ++i) {
      const double truth = site->true_force(i), nominal = site->nominal_force(i) - truth;
      errors.estimated += site->error(i) * site->error(i) / (truth * truth);
      errors.nominal += nominal * nominal / (truth * truth);
      ++count;
    }
  }
  errors.estimated = std::sqrt(errors.estimated / count);
  errors.nominal = std::sqrt(errors.nominal / count);
  return errors;
}

}  // namespace estimation
