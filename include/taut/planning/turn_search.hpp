// The least value of a function that is costly and piecewise linear: where a jack is best turned.
#pragma once

#include <limits>

#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// Looks for the least value of a continuous function of one number that changes by at most `steepest` a
/// unit, from at most N values of it.
///
/// Of the intervals between places that were looked at the one with the lowest bound, Eq. (51), is divided
/// where the bounds from both of its ends meet (Piyavskii 1972, Shubert 1972). How steep the function can be
/// in an interval is told by how steep it is beside it, the less so the wider the interval is (local tuning,
/// Sergeyev 1995), Eq. (52): much of it is flat, and what a bound for all of it says is wasted there. Every
/// other time the best place is refined where the lines through two places on either side meet, which for a
/// piecewise linear function is the very vertex once they lie on its pieces. Ends where no bound is lower
/// than the best value by more than the tolerance, or with as many values as are allowed.
template <class Scalar, int N>
class TurnSearch {
 public:
  /// The value of a place from which nothing follows.
  static constexpr Scalar unreachable = Scalar(1e6);

  /// Between two places, with at most so many values.
  void begin(Scalar first, Scalar last, Scalar steepest, Scalar tolerance, int most_values = N) {
    places_.clear();
    first_ = first;
    last_ = last;
    steepest_ = steepest;
    tolerance_ = tolerance;
    most_ = most_values;
    refines_ = false;
  }
  /// The value of a place: of the one that next() gave, or, before that, of the first one. Cost: O(N).
  void take(Scalar at, Scalar value) {
    int i = places_.add({at, value});
    for (; i > 0 && places_[i - 1].at > at; --i) places_[i] = places_[i - 1];
    places_[i] = {at, value};
  }
  /// Where to look next. False if the search is over. Cost: O(N^2).
  bool next(Scalar& at) {
    if (places_.size() == 0) {
      at = first_;
      return true;
    }
    if (places_.size() == 1) {
      at = last_;
      return at != first_;
    }
    if (places_.size() >= most_) return false;
    const int lowest = lowest_bound();
    if (!(bound(lowest) < least() - tolerance_)) return false;
    refines_ = !refines_;
    return (refines_ && find_vertex(at)) || divide(lowest, at);
  }
  /// The least value until now.
  Scalar least() const { return places_.empty() ? unreachable : places_[best()].value; }

 private:
  struct Place {
    Scalar at = 0, value = 0;
  };
  // By how much steeper than beside it the function may be in an interval.
  static constexpr Scalar as_steep = Scalar(1.5);
  // What rounding leaves of a difference of values.
  static constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();

  int best() const {
    int best = 0;
    for (int i = 1; i < places_.size(); ++i)
      if (places_[i].value < places_[best].value) best = i;
    return best;
  }
  Scalar width(int i) const { return places_[i + 1].at - places_[i].at; }
  bool has_answers(int i) const {
    return places_[i].value < unreachable && places_[i + 1].value < unreachable;
  }
  // In the interval after place i; 0 where there is none.
  Scalar slope(int i) const {
    if (i < 0 || i + 1 >= places_.size()) return 0;
    if (!has_answers(i)) return steepest_;
    const Scalar by = places_[i + 1].value - places_[i].value;
    return (by < 0 ? -by : by) / width(i);
  }
  // How steep the function can be there, Eq. (52).
  Scalar steepness(int i) const {
    Scalar widest = 0;
    for (int k = 0; k + 1 < places_.size(); ++k) widest = larger(widest, width(k));
    const Scalar near = as_steep * larger(slope(i), larger(slope(i - 1), slope(i + 1))),
                 there = larger(near, steepest_ * width(i) / widest);
    return there < steepest_ ? there : steepest_;
  }
  // Below which the function cannot be there, Eq. (51). Where there is no answer at one end, all that is
  // known is how near the other is.
  Scalar bound(int i) const {
    if (steepest_ * width(i) <= rounding) return unreachable;
    const Scalar a = places_[i].value, b = places_[i + 1].value, lower = a < b ? a : b,
                 fall = steepness(i) * width(i);
    if (lower >= unreachable) return 0;
    return larger(Scalar(0), has_answers(i) ? (a + b - fall) / 2 : lower - fall);
  }
  int lowest_bound() const {
    int lowest = 0;
    Scalar least = bound(0);
    for (int i = 1; i + 1 < places_.size(); ++i) {
      const Scalar here = bound(i);
      if (!(here < least)) continue;
      least = here;
      lowest = i;
    }
    return lowest;
  }
  // Where the bounds from both ends meet, not too near to either.
  bool divide(int i, Scalar& at) const {
    const Place &a = places_[i], &b = places_[i + 1];
    at = a.at + width(i) / 2;
    const Scalar steep = steepness(i), most = Scalar(0.45) * width(i);
    if (has_answers(i) && steep > 0) {
      const Scalar by = (a.value - b.value) / (2 * steep);
      at += by > most ? most : by < -most ? -most : by;
    }
    return at > a.at && at < b.at;
  }
  // Beside the best place, on either side.
  bool find_vertex(Scalar& at) const {
    const int b = best();
    Scalar value = places_[b].value - tolerance_;
    const bool before = meet(b - 2, b - 1, b, b + 1, at, value);
    const bool after = meet(b - 1, b, b + 1, b + 2, at, value);
    return before || after;
  }
  // The line through places i and j, and that through k and l, if they meet between j and k and below
  // `value`, which is theirs then.
  bool meet(int i, int j, int k, int l, Scalar& at, Scalar& value) const {
    if (i < 0 || l >= places_.size() || !has_answers(i) || !has_answers(k)) return false;
    const Place &p = places_[i], &q = places_[j], &r = places_[k], &s = places_[l];
    const Scalar falls = (q.value - p.value) / (q.at - p.at), rises = (s.value - r.value) / (s.at - r.at);
    if (!(falls < rises)) return false;
    const Scalar x = (q.value - r.value + rises * r.at - falls * q.at) / (rises - falls);
    const Scalar there = q.value + falls * (x - q.at), room = Scalar(0.001) * (r.at - q.at);
    if (!(x > q.at + room && x < r.at - room && there < value)) return false;
    at = x;
    value = there;
    return true;
  }

  FixedList<Place, N> places_;
  Scalar first_ = 0, last_ = 0, steepest_ = 0, tolerance_ = 0;
  int most_ = 0;
  bool refines_ = false;
};

}  // namespace taut
