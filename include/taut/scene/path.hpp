// The straight path from one sample to the next: loads, jack forces, lock-off and release.
#pragma once

#include <array>
#include <cmath>

#include "taut/scene/sample.hpp"
#include "taut/scene/scene.hpp"
#include "taut/status.hpp"

namespace taut {

/// Loads, jacks and prestrain at one point of the path.
template <class Scalar, class Cap>
struct Drive {
  /// A jacked end: the force is prescribed while jacking, the extension of the jack once locked.
  struct JackedEnd {
    bool locked = false;
    Scalar force = 0;      ///< [N]
    Scalar extension = 0;  ///< extension of the jack [m]
    friend bool operator==(const JackedEnd& a, const JackedEnd& b) {
      return a.locked == b.locked && a.force == b.force && a.extension == b.extension;
    }
  };
  FixedArray<Scalar, Cap::loads> factor;
  FixedArray<std::array<JackedEnd, 2>, Cap::cables> jack;
  Scalar prestrain = 0;  ///< 0 to 1: how much of the prestrain there is

  friend bool operator==(const Drive& a, const Drive& b) {
    return a.factor == b.factor && a.jack == b.jack && a.prestrain == b.prestrain;
  }
  /// The point `part` of the way from `a` to `b`; locks are those of `b`.
  static Drive between(const Drive& a, const Drive& b, Scalar part) {
    if (part >= Scalar(1)) return b;
    const auto mix = [part](Scalar p, Scalar q) { return p + part * (q - p); };
    Drive drive = b;
    if constexpr (Cap::prestrain) drive.prestrain = mix(a.prestrain, b.prestrain);
    for (int i = 0; i < Cap::loads; ++i) drive.factor[i] = mix(a.factor[i], b.factor[i]);
    for (int c = 0; c < Cap::cables; ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        drive.jack[c][end].force = mix(a.jack[c][end].force, b.jack[c][end].force);
        drive.jack[c][end].extension = mix(a.jack[c][end].extension, b.jack[c][end].extension);
      }
    return drive;
  }
};

/// Calls visit(cable number, end 0 or 1) for every jacked end. `Cables` is a list of Cable or of CableLayout.
template <class Cables, class Visit>
void for_each_jacked_end(const Cables& cables, Visit visit) {
  for (int c = 0; c < cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end)
      if (!cables[c].closed && cables[c].ends[end] == End::jacked) visit(c, end);
}

/// `bad_sample` if a factor is not finite, or the force of an unlocked jack not finite or negative.
template <class Cables, class Scalar, class Cap>
Status check_sample(const Cables& cables, int loads, const Sample<Scalar, Cap>& sample) {
  for (int i = 0; i < loads; ++i)
    if (!std::isfinite(sample.factor[i])) return Status::at(Code::bad_sample, Place::load, i);
  Status status = Status::success();
  for_each_jacked_end(cables, [&](int c, std::size_t end) {
    const Jack<Scalar>& jack = sample.jack[c][end];
    if (!jack.locked && !(std::isfinite(jack.force) && jack.force >= 0) && status.ok())
      status = Status::along(Code::bad_sample, Place::cable_end, c, static_cast<int>(end));
  });
  return status;
}

/// Both ends of the path from the present state to a sample. Lock-off keeps the extension and draws the wedge
/// in along the path; a released end starts at the force it has.
///
/// `from` enters as the present drive, `to` as the goal of the path before (the same, if that was reached);
/// force(c, end) and extension(c, end) tell what a jacked end has at present.
template <class Cables, class Scalar, class Real, class Cap, class Force, class Extension>
void set_path(const Cables& cables, int loads, const Sample<Scalar, Cap>& sample, Force force,
              Extension extension, Drive<Real, Cap>& from, Drive<Real, Cap>& to) {
  for (int i = 0; i < loads; ++i) to.factor[i] = static_cast<Real>(sample.factor[i]);
  for_each_jacked_end(cables, [&](int c, std::size_t end) {
    const Jack<Scalar>& jack = sample.jack[c][end];
    auto& start = from.jack[c][end];
    auto& goal = to.jack[c][end];
    goal.locked = jack.locked;
    if (jack.locked && !start.locked) {
      start.extension = extension(c, end);
      goal.extension = start.extension - static_cast<Real>(cables[c].seating);
    } else if (!jack.locked) {
      if (start.locked) start.force = force(c, end);
      goal.force = static_cast<Real>(jack.force);
      start.extension = goal.extension = 0;
    }
  });
}

}  // namespace taut
