// A past that is taken for known.
#pragma once

#include "taut/estimation/force_estimate.hpp"
#include "taut/status.hpp"
#include "taut/tracking/tracker.hpp"

namespace monitor {

/// What a session asks of taut::UnknownPast, where a site takes it that there was no load before the first
/// sample: no code and no second estimator.
template <class Estimator>
struct KnownPast {
  struct Phase {};

  static void reset() {}
  static constexpr bool is_unknown() { return false; }
  static constexpr Phase phase() { return {}; }
  static constexpr bool has_above(Phase) { return false; }
  template <class... Arguments>
  static void look(const Arguments&...) {}
  template <class... Arguments>
  static void withhold(const Arguments&...) {}
  template <class... Arguments>
  static taut::Progress<float> advance(const Arguments&...) {
    return {taut::Status::success(), 1.0F, 0};
  }
  static void settle(const Estimator&) {}
  static taut::ForceEstimate<float> estimate(const Estimator& below, int segment) {
    return below.estimate(segment);
  }
  template <class Response>
  static void respond(const Estimator&, const Response&) {}
  template <class Layout>
  static constexpr bool is_wiped_out(const Estimator&, const Layout&) {
    return true;
  }
};

}  // namespace monitor
