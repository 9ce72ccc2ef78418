#include "lib/live/jack_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut::host {
namespace {

constexpr double load_tolerance = 0.01;
// Points of the way, in tolerances apart, and how many are kept: noise must not fill the memory.
constexpr double apart = 0.1;
constexpr std::size_t most_kept = 4096;

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

}  // namespace

// In tolerances.
std::vector<double> JackPath::coordinates(const PastMove& at) const {
  std::vector<double> all;
  for (std::size_t k = 0; k < tolerance_.size(); ++k) all.push_back(at.stage.force[k] / tolerance_[k]);
  for (const double factor : at.factor) all.push_back(factor / load_tolerance);
  return all;
}

double JackPath::distance(const PastMove& at, const PastMove& from, const PastMove& to) const {
  const std::vector<double> point = coordinates(at), first = coordinates(from), last = coordinates(to);
  double along = 0, length = 0;
  for (std::size_t i = 0; i < point.size(); ++i) {
    along += (point[i] - first[i]) * (last[i] - first[i]);
    length += (last[i] - first[i]) * (last[i] - first[i]);
  }
  const double part = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  std::vector<double> nearest(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) nearest[i] = first[i] + part * (last[i] - first[i]);
  return largest_difference(point, nearest);
}

void JackPath::take(const PastMove& now) {
  if (turns_.empty()) {
    turns_.push_back(now);
  } else if (now.stage.locked != now_.stage.locked) {
    // A wedge ends one way, and its row is another.
    turns_.push_back(now_);
    turns_.push_back(now);
    since_.clear();
  } else {
    while (!since_.empty()) {
      std::size_t furthest = 0;
      double most = 0;
      for (std::size_t i = 0; i < since_.size(); ++i)
        if (const double off = distance(since_[i], turns_.back(), now); off > most) {
          most = off;
          furthest = i;
        }
      if (most <= 1 && since_.size() < most_kept) break;
      turns_.push_back(since_[furthest]);
      since_.erase(since_.begin(), since_.begin() + static_cast<std::ptrdiff_t>(furthest) + 1);
    }
    const PastMove& last = since_.empty() ? turns_.back() : since_.back();
    if (largest_difference(coordinates(last), coordinates(now)) > apart) since_.push_back(now);
  }
  now_ = now;
}

std::vector<PastMove> JackPath::moves() const {
  std::vector<PastMove> all = turns_;
  if (!all.empty()) all.push_back(now_);
  return all;
}

void JackPath::go_on(std::vector<PastMove> moves) {
  since_.clear();
  turns_ = std::move(moves);
  if (turns_.empty()) return;
  now_ = turns_.back();
  if (turns_.size() > 1) turns_.pop_back();
  // What was between is not known any more: where the jacks stand may be where they turn.
  since_.push_back(now_);
}

}  // namespace taut::host
