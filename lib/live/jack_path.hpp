// The way of the jacks until now, as what friction remembers of it.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/plan/jacking.hpp"

namespace taut::host {

/// Turning points of jacks and loads: the way between two of them is a straight line, but for what is nearer
/// to it than a tolerance.
class JackPath {
 public:
  /// `tolerance` of every jack [N]; that of a load factor is a hundredth.
  explicit JackPath(std::vector<double> tolerance) : tolerance_(std::move(tolerance)) {}

  /// Where all stand now. Cost: that of a few thousand comparisons.
  void take(const PastMove& now);
  /// From rest: all turning points, and last where they stand now.
  std::vector<PastMove> moves() const;
  /// Goes on from moves() of before.
  void go_on(std::vector<PastMove> moves);

 private:
  std::vector<double> coordinates(const PastMove& at) const;
  double distance(const PastMove& at, const PastMove& from, const PastMove& to) const;

  std::vector<double> tolerance_;
  std::vector<PastMove> turns_;  // the first row, and what followed
  std::vector<PastMove> since_;  // of the way since the last of them
  PastMove now_;
};

}  // namespace taut::host
