// What friction alone says of forces along a cable, whatever the structure does.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace taut::host {

/// The segments of a cable one after the other, with the ratio of friction between each and the next. Units:
/// N.
struct FrictionChain {
  std::vector<double> target;  ///< 0: does not matter
  std::vector<double> most;    ///< largest force
  std::vector<double> rho;     ///< smallest T_small / T_big of the joint behind each segment but the last
};

/// How near forces can come to their targets at best, for any way of jacking: neighbours differ by no more
/// than friction holds. `high` and `low` are two segments of the chain between which it holds too little;
/// equal where one segment alone is in the way, by its limit. Exact to 1e-12: an interval of forces is
/// carried along the chain.
struct FrictionBound {
  double error = 0;
  std::size_t low = 0, high = 0;
};
FrictionBound friction_bound(const FrictionChain& chain);

/// Jack forces for a cable between rigid saddles that is pulled and let out in turn, first pulled, so that
/// all forces are within `error` of their targets: of jacks at the start and at the end, where there are any.
/// Nothing if it needs more than `moves`. Every tooth of the forces along the cable goes as far as it can:
/// the fewest moves for targets that are all the same, a good start for others.
using JackMoves = std::array<std::vector<double>, 2>;
std::optional<JackMoves> teeth(const FrictionChain& chain, std::array<bool, 2> jacked, double error,
                               std::size_t moves);
/// Those for the smallest error, by bisection.
JackMoves nearest_teeth(const FrictionChain& chain, std::array<bool, 2> jacked, std::size_t moves);

}  // namespace taut::host
