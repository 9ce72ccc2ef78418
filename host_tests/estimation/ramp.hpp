// One ramp of the jack, and how well the estimate comes out of it.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

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

/// Takes `deed` on, evenly, to these parts of the full force and of the other load; visit() in every row.
template <class Visit>
void go_on(Deed& deed, double force, double factor, int rows, const Visit& visit) {
  const Deed from = deed;
  for (int i = 1; i <= rows; ++i) {
    deed.force[1] = from.force[1] + (force * full - from.force[1]) * i / rows;
    deed.factor = from.factor + (factor - from.factor) * i / rows;
    visit();
  }
}

/// A truss string with six struts, whose joints share a mu that is known to be 0.2, to `mu_sd`.
inline void truss_of_unknown_mu(Ground& ground, double mu_sd, Random& random) {
  taut::Cable<double> cable = support::steel_cable(0.2);
  cable.mu_sd = mu_sd;
  cable.shared_mu = true;
  support::truss_string(ground.known, cable, 6);
  ground.set_true_mu(std::vector<double>(16, std::fmax(0.02, 0.2 + mu_sd * gaussian(random))));
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
