// Chains of saddles by hand: what the jack force becomes along the cable.
#pragma once

#include <cmath>
#include <vector>

#include "support/scenes.hpp"

namespace hand {

/// T_small / T_big at the limit of a point contact that turns by `beta`: cot(alpha) = tan(beta / 2).
inline double point_ratio(double mu, double beta) {
  const double kappa = mu * std::tan(beta / 2);
  return (1 - kappa) / (1 + kappa);
}

/// A chain of support::chain_points() on rigid saddles with point contacts.
struct Chain {
  int segments;
  double mu;

  double length(int segment) const { return support::chain_length(segment); }
  double total_length() const {
    double sum = 0;
    for (int i = 0; i < segments; ++i) sum += length(i);
    return sum;
  }
  /// Part of a force at the cable's end that reaches a segment while everything slides towards the end.
  double reach(int segment) const {
    double part = 1;
    for (int j = segment; j + 1 < segments; ++j) part *= point_ratio(mu, support::chain_turn[j]);
    return part;
  }
  /// The same for a force at the start.
  double reach_from_start(int segment) const { return reach(0) / reach(segment); }
};

constexpr double EA = support::cable_E * support::cable_A;

}  // namespace hand
