#include "lib/plan/objective.hpp"

#include <cmath>

namespace taut::host {
namespace {

// The largest of the lines at one place, and its slope: among equals the one that is largest on the way
// there.
struct Top {
  double value = -1, slope = 0;
};

Top top(const std::vector<double>& from, const std::vector<double>& to, const std::vector<double>& target,
        double part, double way) {
  Top most;
  for (std::size_t i = 0; i < target.size(); ++i) {
    if (!(target[i] > 0)) continue;
    const double rate = (to[i] - from[i]) / target[i];
    const double off = (from[i] - target[i]) / target[i] + part * rate;
    const double value = std::fabs(off), slope = off < 0 || (off == 0 && way * rate < 0) ? -rate : rate;
    if (value > most.value || (value == most.value && way * slope > way * most.slope)) most = {value, slope};
  }
  return most;
}

}  // namespace

double off_target(const std::vector<double>& tension, const std::vector<double>& target) {
  double most = 0;
  for (std::size_t i = 0; i < target.size(); ++i)
    if (target[i] > 0) most = std::fmax(most, std::fabs(tension[i] - target[i]) / target[i]);
  return most;
}

NearestPart nearest_part(const std::vector<double>& from, const std::vector<double>& to,
                         const std::vector<double>& target, double least_part, double most_part) {
  double left = least_part, right = most_part;
  Top falling = top(from, to, target, left, 1), rising = top(from, to, target, right, -1);
  if (falling.slope >= 0 || right <= left) return {left, falling.value};
  if (rising.slope <= 0) return {right, rising.value};
  // Every round finds a line that was not there before.
  for (std::size_t round = 0; round <= 2 * target.size(); ++round) {
    const double at = (rising.value - falling.value + falling.slope * left - rising.slope * right) /
                      (falling.slope - rising.slope);
    if (!(at > left && at < right)) break;
    const Top middle = top(from, to, target, at, 1);
    const double bound = falling.value + falling.slope * (at - left);
    if (middle.value <= bound * (1 + 1e-15) || middle.slope == 0) return {at, middle.value};
    if (middle.slope < 0) {
      falling = middle;
      left = at;
    } else {
      rising = middle;
      right = at;
    }
  }
  return falling.value <= rising.value ? NearestPart{left, falling.value} : NearestPart{right, rising.value};
}

}  // namespace taut::host
