// An independent answer in long double, from the mechanics alone: slow, dense, and sharing no code with the
// solvers.
#pragma once

#include <memory>
#include <vector>

#include "reference/structure.hpp"

namespace reference {

/// Follows the straight paths between samples from event to event. At every event the states of the joints at
/// their limit are found by trying them: all combinations for up to eight joints, otherwise from many starts
/// by letting the first joint that disagrees change its mind.
///
/// No template but to write the question out: compiled once for all scenes.
class Reference {
 public:
  template <int Dimension, class Cap>
  explicit Reference(const taut::Scene<double, Dimension, Cap>& scene) : Reference(write_out(scene)) {}
  explicit Reference(Structure structure);
  ~Reference();
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  /// Brings the prestrain on.
  bool start();

  /// Follows the straight path to the sample; false if there is no answer past fraction().
  template <class Cap>
  bool advance(const taut::Sample<double, Cap>& sample) {
    return advance(write_out(sample));
  }
  bool advance(const Row& row);

  Exact fraction() const;
  int events() const;
  /// Events since the beginning at which several combinations of states with different forces were possible.
  int events_with_several_answers() const;
  /// After advance() failed: by how much all combinations of states contradict the rates under them, as a
  /// part of the rates. Of the order of rounding where rounding may have decided.
  Exact clearance() const;
  Exact tension(int segment) const;
  Exact strut(int i) const;
  Exact slip(int joint) const;
  Exact extension(int cable, int end) const;
  /// The largest tension so far [N].
  Exact peak() const;

  /// The rates of all tensions that are possible from the present state on the way to the sample.
  template <class Cap>
  std::vector<std::vector<Exact>> possible_rates(const taut::Sample<double, Cap>& sample) const {
    return possible_rates(write_out(sample));
  }
  std::vector<std::vector<Exact>> possible_rates(const Row& row) const;

 private:
  class Follower;

  const Structure structure_;
  std::unique_ptr<Follower> follower_;
};

}  // namespace reference
