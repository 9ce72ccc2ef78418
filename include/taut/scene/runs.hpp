// Runs: the parts of the cables that go slack and taut as a whole.
#pragma once

#include "taut/scene/scene.hpp"

namespace taut {

/// A part of a cable between anchors, jacks and locked joints. Every joint inside can slide, so at zero
/// tension one slack segment pulls its neighbours slack too.
template <class Scalar>
struct Run {
  CableLayout<Scalar> layout;  ///< of its cable
  int cable = 0;
  int first = 0;      ///< segment of the cable it starts with
  int count = 0;      ///< segments
  bool ring = false;  ///< a closed hoop without a locked joint: it has no end

  /// Segment `i` of the run, in the scene's numbering.
  constexpr int segment(int i) const { return layout.first_segment + (first + i) % layout.segments(); }
  /// The joint after segment `i` of the run, in the scene's numbering; inside the run for i < joints().
  constexpr int joint(int i) const { return layout.segment_joints((first + i) % layout.segments())[1]; }
  /// Joints inside the run.
  constexpr int joints() const { return ring ? count : count - 1; }
};

/// All runs of a scene, and the run of every segment.
template <class Scalar, class Cap>
class Runs {
 public:
  /// `cables` is a list of CableLayout or Cable; is_locked(joint) tells which joints never slide.
  template <class Cables, class Locked>
  void find(const Cables& cables, Locked is_locked) {
    runs_ = {};
    for (int c = 0; c < cables.size(); ++c) {
      const CableLayout<Scalar> layout = layout_of(cables[c]);
      const int n = layout.segments();
      const auto ends_here = [&](int segment) {
        const int joint = layout.segment_joints(segment)[1];
        return joint < 0 || is_locked(joint);
      };
      int last_end = -1;
      for (int i = 0; i < n; ++i)
        if (ends_here(i)) last_end = i;
      const bool ring = last_end < 0;
      Run<Scalar> run{layout, c, ring ? 0 : (last_end + 1) % n, 0, ring};
      for (int i = 0; i < n; ++i) {
        ++run.count;
        const int segment = (run.first + run.count - 1) % n;
        of_[layout.first_segment + segment] = runs_.size();
        if (!ends_here(segment) && i + 1 < n) continue;
        runs_.add(run);
        run = {layout, c, (segment + 1) % n, 0, false};
      }
    }
  }

  int size() const { return runs_.size(); }
  const Run<Scalar>& operator[](int run) const { return runs_[run]; }
  const Run<Scalar>* begin() const { return runs_.begin(); }
  const Run<Scalar>* end() const { return runs_.end(); }
  /// The run of a segment, in the scene's numbering.
  int of(int segment) const { return of_[segment]; }

 private:
  template <class Real>
  static CableLayout<Scalar> layout_of(const CableLayout<Real>& c) {
    return {c.closed, c.ends, static_cast<Scalar>(c.seating), c.nodes, c.first_segment, c.first_joint};
  }

  FixedList<Run<Scalar>, Cap::segments> runs_;
  FixedArray<int, Cap::segments> of_;
};

}  // namespace taut
