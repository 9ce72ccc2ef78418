// What segments had where the jack of their cable turned last, and what they have if friction is another.
#pragma once

#include <cmath>
#include <cstdint>

#include "taut/estimation/kink.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// What the derivatives of forces by friction do not tell once a jack has turned, was locked or took hold
/// again. From there on joints let go one after the other, and which has last depends on friction: beyond the
/// next kink, forces change in another way. All derivatives are by one move of the unknowns of friction, by
/// which a cable has more or less of it as a whole, Eq. (55); and what they do not tell by errors of loads: a
/// joint that has just let go may still stick. A plain value.
template <class Scalar, class Cap, int Parameters>
class TurnedForces {
 public:
  using Values = FixedArray<Scalar, Parameters>;
  /// Segments beside a wedge of which it may be unknown how far it is drawn in.
  static constexpr int drawn_segments = Cap::seating ? Cap::segments : 0;
  /// So many standard deviations away friction is still likely.
  static constexpr int far = 2;

  static Scalar farther(Scalar a, Scalar b) { return std::fabs(b) > std::fabs(a) ? b : a; }

  void clear() {
    move_.fill(Scalar(0));
    by_loads_.fill(Scalar(0));
    leader_.fill(-1);
    leader_of_.fill(-1);
    drawn_by_.fill(-1);
  }
  /// Unknown `p` moves by so much where `leader`, one unknown of its cable that stands for all, does by one.
  void set_move(int p, Scalar move, int leader) {
    move_[p] = move;
    leader_[p] = static_cast<std::int16_t>(leader);
  }
  Scalar move(int p) const { return move_[p]; }
  int leader(int p) const { return leader_[p]; }
  /// The jack turns: a segment has this force [N], known to `by_loads` as far as errors of loads go [N].
  void turn(int segment, Scalar force, Scalar by_loads) {
    by_loads_[segment] = larger(by_loads, deviation_by_loads(segment, force));
    force_[segment] = force;
  }
  /// The force of a segment [N] is found to be another one by `change` than it was taken for, and its errors
  /// of loads to be `by_loads` [N]: so they were where it turned, if it still has that force.
  void correct(int segment, Scalar force, Scalar change, Scalar by_loads) {
    if (has_gone_on(segment, force)) return;
    force_[segment] += change;
    by_loads_[segment] = -larger(-by_loads_[segment], -by_loads);
    if constexpr (drawn_segments > 0) drawn_force_[segment] += change;
  }
  /// Whether a segment has another force now [N] than where it turned.
  bool has_gone_on(int segment, Scalar force) const {
    return std::fabs(force - force_[segment]) > Scalar(1e-4) * force_[segment];
  }
  /// The standard deviation of a force by what was not known of loads where it turned [N]: its joint may
  /// still stick. Cost: a few operations.
  Scalar deviation_by_loads(int segment, Scalar force) const {
    return deviation_across(by_loads_[segment], std::fabs(force - force_[segment]));
  }
  /// After turn(): the force of a segment has this derivative by the move of `leader` while its joint sticks.
  /// Between it and the jack friction is off its move by itself, with the variance `apart`, in moves.
  void turn_with_friction(int segment, Scalar derivative, int leader, Scalar apart) {
    sticks_[segment] = derivative;
    found_[segment] = 0;
    leader_of_[segment] = static_cast<std::int16_t>(leader);
    apart_[segment] = apart;
  }
  /// Its force follows friction that is off by itself with this variance, if that is more.
  void follow(int segment, Scalar apart) { apart_[segment] = larger(apart_[segment], apart); }
  Scalar found(int segment) const { return found_[segment]; }
  Scalar apart(int segment) const { return apart_[segment]; }
  /// Where it turned [N].
  Scalar force(int segment) const { return force_[segment]; }
  /// After turn(): the force was found to change by so much with the move, `far` standard deviations away.
  void find(int segment, Scalar derivative) { found_[segment] = farther(found_[segment], derivative); }

  /// The standard deviation of friction, in moves, that a segment follows; `sd` is that of
  /// leader_of(segment).
  Scalar of_friction(int segment, Scalar sd) const {
    return apart_[segment] > 0 ? std::sqrt(sd * sd + apart_[segment]) : sd;
  }
  /// What a force [N] changes with the move, of a segment whose derivative by it is `slides` where the
  /// tracker is. As a function of friction the force is the lower of what the segment has where its joint
  /// sticks and where it slides if it fell since the turn, the higher if it rose: `far` times of_friction()
  /// away, `sd`, the longer side counts; so does what was found. Cost: a few operations.
  Scalar longest(int segment, Scalar force, Scalar slides, Scalar sd) const {
    const Scalar changed = force - force_[segment], way = changed < 0 ? Scalar(-1) : Scalar(1);
    Scalar longest = farther(slides, found_[segment]);
    for (const Scalar x : {-far * sd, far * sd}) {
      if (x == 0) continue;
      const Scalar further = way * larger(way * x * slides, way * (x * sticks_[segment] - changed));
      longest = farther(longest, further / x);
    }
    return longest;
  }
  /// The standard deviation of a force by friction, with what scatters [N]; `sd` is that of
  /// leader_of(segment). Cost: that of longest().
  Scalar deviation(int segment, Scalar force, Scalar slides, Scalar sd) const {
    const Scalar all = of_friction(segment, sd);
    return longest(segment, force, slides, all) * all;
  }
  /// A wedge was drawn in, by unknown `p` more than was said, and left this force [N], which changes with the
  /// draw-in by so much [N/m].
  void draw(int segment, Scalar force, Scalar derivative, int p) {
    if (drawn_by_[segment] < 0) kept_[segment] = 0;
    kept_[segment] = left(kept_[segment], segment, force);
    drawn_force_[segment] = force;
    drawn_[segment] = derivative;
    drawn_by_[segment] = static_cast<std::int16_t>(p);
  }
  /// Unknown `p`, known to `sd` [m], will be another one; with it the force of a segment [N] is as uncertain
  /// as before.
  void keep_drawn(int segment, Scalar force, int p, Scalar sd) {
    if (drawn_by_[segment] != p) return;
    kept_[segment] = drawn_deviation(segment, force, sd);
    drawn_[segment] = 0;
    drawn_force_[segment] = force;
  }
  /// That unknown, or -1.
  int drawn_by(int segment) const {
    if constexpr (drawn_segments == 0)
      return -1;
    else
      return drawn_by_[segment];
  }
  /// The standard deviation of a force by it, known to `sd` [m], and by how far wedges were drawn in before:
  /// nothing where the segment has gone on since by as much as `far` of them. Cost: a few operations.
  Scalar drawn_deviation(int segment, Scalar force, Scalar sd) const {
    const Scalar drawn = drawn_[segment] * sd, kept = kept_[segment];
    return left(std::sqrt(drawn * drawn + kept * kept), segment, force);
  }
  /// The unknown that stands for the friction of a segment's cable, or -1: its jack has not turned.
  int leader_of(int segment) const { return leader_of_[segment]; }

 private:
  /// Of a deviation, once the segment has gone on to this force.
  Scalar left(Scalar deviation, int segment, Scalar force) const {
    return larger(deviation - std::fabs(force - drawn_force_[segment]) / far, Scalar(0));
  }

  Values move_;                                        // of unknowns
  FixedArray<std::int16_t, Parameters> leader_;        // that they move with, or -1
  FixedArray<Scalar, Cap::segments> force_;            // at the turn [N]
  FixedArray<Scalar, Cap::segments> by_loads_;         // its deviation by errors of loads there [N]
  FixedArray<Scalar, Cap::segments> sticks_;           // its derivative there
  FixedArray<Scalar, Cap::segments> found_;            // the one that was found since
  FixedArray<Scalar, drawn_segments> drawn_force_;     // once a wedge was drawn in [N]
  FixedArray<Scalar, drawn_segments> drawn_;           // its derivative by the draw-in [N/m]
  FixedArray<Scalar, drawn_segments> kept_;            // its deviation by earlier draw-ins [N]
  FixedArray<std::int16_t, drawn_segments> drawn_by_;  // the unknown of that, or -1
  FixedArray<Scalar, Cap::segments> apart_;            // variance of friction that is off the move
  FixedArray<std::int16_t, Cap::segments> leader_of_;  // or -1: it has not turned
};

}  // namespace taut
