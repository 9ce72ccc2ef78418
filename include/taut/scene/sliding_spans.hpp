// SlidingSpans: the parts of the cables that go slack and taut as a whole.
#pragma once

#include <cstdint>

#include "taut/scene/scene.hpp"

namespace taut {

/// A part of a cable between anchors, jacks and self-locking joints. Every joint inside can slide, so at zero
/// tension one slack segment pulls its neighbours slack too. `Hoops`: whether its cable may be closed.
template <bool Hoops>
struct SpanOf {
  std::int16_t cable = 0;
  std::int16_t first = 0;          ///< segment of the cable it starts with
  std::int16_t count = 0;          ///< segments
  std::int16_t around = 0;         ///< segments of the whole cable
  std::int16_t first_segment = 0;  ///< of the cable, in the scene's numbering
  std::int16_t first_joint = 0;
  bool closed = false;  ///< its cable is a hoop
  bool ring = false;    ///< a closed hoop without a self-locking joint: the span has no end

  /// Segment `i` of the span, in the scene's numbering.
  constexpr int segment(int i) const { return first_segment + (Hoops ? (first + i) % around : first + i); }
  /// Joint `i` of those inside the span, in the scene's numbering: the one after its segment `i`.
  constexpr int joint(int i) const {
    return first_joint + (Hoops && closed ? (first + i + 1) % around : first + i);
  }
  /// A joint inside the span or beside it, -1 if its cable has none.
  constexpr int joint_near() const {
    if ((Hoops && closed) || first + 1 < around) return joint(0);
    return first == 0 ? -1 : joint(-1);
  }
  /// Joints inside the span.
  constexpr int joints() const { return Hoops && ring ? count : count - 1; }
};
using SlidingSpan = SpanOf<true>;

/// All sliding spans of a scene, and the span of every segment.
template <class Cap>
class SlidingSpans {
 public:
  using Span = SpanOf<Cap::hoops>;

  /// `cables` is a list of CableLayout or Cable; is_self_locking(joint) tells which joints never slide.
  template <class Cables, class Locked>
  void find(const Cables& cables, Locked is_self_locking) {
    spans_ = {};
    for (int c = 0; c < cables.size(); ++c) {
      const auto& cable = cables[c];
      const int n = cable.segments();
      if constexpr (is_one_span<Cap>) {
        spans_.add({0, 0, small(n), small(n), small(cable.first_segment), small(cable.first_joint)});
        continue;
      }
      const auto ends_here = [&](int segment) {
        const int joint = cable.segment_joints(segment)[1];
        return joint < 0 || is_self_locking(joint);
      };
      int last_end = -1;
      for (int i = 0; i < n; ++i)
        if (ends_here(i)) last_end = i;
      const bool ring = last_end < 0;
      Span span;
      span.cable = small(c);
      span.around = small(n);
      span.first_segment = small(cable.first_segment);
      span.first_joint = small(cable.first_joint);
      span.closed = cable.closed;
      span.ring = ring;
      span.first = small(ring ? 0 : (last_end + 1) % n);
      for (int i = 0; i < n; ++i) {
        ++span.count;
        const int segment = (span.first + span.count - 1) % n;
        if constexpr (max_spans<Cap> != 1) of_[cable.first_segment + segment] = small(spans_.size());
        if (!ends_here(segment) && i + 1 < n) continue;
        spans_.add(span);
        span.first = small((segment + 1) % n);
        span.count = 0;
      }
    }
  }

  int size() const { return spans_.size(); }
  const Span& operator[](int span) const { return spans_[span]; }
  const Span* begin() const { return spans_.begin(); }
  const Span* end() const { return spans_.end(); }
  /// The span of a segment, in the scene's numbering.
  int of(int segment) const { return max_spans<Cap> == 1 ? 0 : of_[segment]; }

 private:
  static constexpr std::int16_t small(int number) { return static_cast<std::int16_t>(number); }

  FixedList<Span, max_spans<Cap>> spans_;
  FixedArray<std::int16_t, max_spans<Cap> == 1 ? 0 : Cap::segments> of_;
};

}  // namespace taut
