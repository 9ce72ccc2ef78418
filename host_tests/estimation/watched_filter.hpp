// A load filter that is watched: what it promises whatever the readings and their times are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "taut/estimation/load_filter.hpp"

namespace estimation {

template <class Scalar>
class WatchedFilter {
 public:
  using Load = taut::ConditionedLoad<Scalar>;

  /// Readings have a standard deviation `sd` > 0 [N].
  explicit WatchedFilter(Scalar sd) : sd_(sd) { filter_.start(sd); }

  const Load& take(Scalar reading, Scalar dt) {
    const bool is_reading = std::fabs(reading) < Scalar(1e9) * sd_;
    if (is_reading) recent_[count_++ % recent_.size()] = reading;
    before_ = now_;
    now_ = filter_.take(reading, dt);
    is_refused_rightly_ = is_reading || now_.refused;
    return now_;
  }
  /// What is finite, and not negative.
  bool is_sound() const {
    const auto is_force = [](Scalar x) { return std::isfinite(x) && x >= 0; };
    return is_force(now_.load) && is_force(now_.sd) && is_force(now_.confirmed) && is_force(now_.reversal);
  }
  /// Readings that cannot be any are refused. A refused one leaves the load where it was, but for readings
  /// that have waited until then.
  bool refuses_rightly() const {
    const bool stays = std::fabs(now_.load - before_.load) <= 2 * (before_.sd + now_.sd) + rounding();
    return is_refused_rightly_ && (!now_.refused || stays);
  }
  /// The load is among the last eight readings, but for their noise and that of the estimate.
  bool is_among_readings() const {
    const std::size_t size = std::min(count_, recent_.size());
    if (size == 0) return now_.load == 0;
    const auto* const end = recent_.data() + size;
    const Scalar least = *std::min_element(recent_.data(), end),
                 most = *std::max_element(recent_.data(), end);
    const Scalar noise = 5 * std::sqrt(now_.sd * now_.sd + sd_ * sd_) + rounding();
    return now_.load >= least - noise && now_.load <= std::max(most, Scalar(0)) + noise;
  }
  bool keeps_its_promises() const { return is_sound() && refuses_rightly() && is_among_readings(); }

 private:
  /// Forces are known to so much beside the largest of the last readings.
  Scalar rounding() const {
    Scalar largest = 0;
    for (const Scalar reading : recent_) largest = std::max(largest, std::fabs(reading));
    return Scalar(5e-7) * largest;
  }

  taut::LoadFilter<Scalar> filter_;
  Scalar sd_;
  Load now_, before_;
  std::array<Scalar, 8> recent_{};
  std::size_t count_ = 0;
  bool is_refused_rightly_ = true;
};

}  // namespace estimation
