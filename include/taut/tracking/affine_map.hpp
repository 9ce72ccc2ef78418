// While no state changes, tensions and moves are affine in the inputs: this is that map.
#pragma once

#include <cmath>

#include "taut/condensation/condensed.hpp"
#include "taut/numerics/band_lu.hpp"

namespace taut {

/// Something that moves along a cable and imposes an elongation: the slip of a joint lengthens the segment
/// before it and shortens the one after, a payout or an excess length lengthens one segment.
struct Move {
  enum class Kind : std::uint8_t { slip, payout, excess } kind = Kind::slip;
  int index = 0;        ///< joint; 2 x cable + end; run
  int lengthened = -1;  ///< segment
  int shortened = -1;   ///< segment, slip only
};

/// What an active move obeys: a weighted sum of two tensions, T_first - weight T_second, is zero or an input.
template <class Scalar>
struct Law {
  int first = 0;
  int second = -1;
  Scalar weight = 0;

  template <class Tensions>
  Scalar of(const Tensions& T) const {
    return second < 0 ? T[first] : T[first] - weight * T[second];
  }
};

/// Something outside that changes along a path.
struct Input {
  enum class Kind : std::uint8_t { load, jack_force, payout, prestrain } kind = Kind::load;
  int index = 0;  ///< load pattern; 2 x cable + end
};

/// T = base + sum of input x column, and the same for the active moves.
///
/// Made from totals whenever the set of active moves changes: with R the laws' coefficients, W the columns of
/// the moves and v the tensions with the active moves at zero, m = (R W)^-1 (s - R v) and T = v + W m.
template <class CondensedType>
class AffineMap {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Cap = typename CondensedType::Capacity;
  static constexpr int max_active = Cap::segments + 2 * Cap::cables;
  static constexpr int max_inputs = Cap::loads + 2 * Cap::cables + 1;
  using Tensions = FixedArray<Scalar, Cap::segments>;
  using Moves = FixedArray<Scalar, max_active>;

  void clear(const CondensedType& model) {
    model_ = &model;
    moves_.clear();
    laws_.clear();
    sense_.clear();
    inputs_.clear();
    has_slack_ = false;
  }
  /// `sense` is the sign that the move's rate must have, 0 for any.
  void add_active(const Move& move, const Law<Scalar>& law, Scalar sense = 0) {
    moves_.add(move);
    laws_.add(law);
    sense_.add(sense);
    has_slack_ = has_slack_ || move.kind == Move::Kind::excess;
  }
  void add_input(const Input& input) { inputs_.add(input); }

  int active() const { return moves_.size(); }
  const Move& move(int i) const { return moves_[i]; }
  int inputs() const { return inputs_.size(); }
  const Input& input(int k) const { return inputs_[k]; }

  /// Factors R W. Returns -1, or an active move that changes no law: nothing resists it.
  int factor() {
    const int n = active();
    laws_times_moves_.reset(n, n > 0 ? n - 1 : 0);
    Tensions column;
    for (int k = 0; k < n; ++k) {
      column_of(moves_[k], column);
      for (int i = 0; i < n; ++i) laws_times_moves_.add(i, k, laws_[i].of(column));
      laws_times_moves_.set_column_scale(
          k, Scalar(1) / model_->coupling(moves_[k].lengthened, moves_[k].lengthened));
    }
    return laws_times_moves_.factor();
  }

  /// From the tensions of the frozen moves and constant loads.
  void make_base(const Tensions& frozen) {
    base_ = frozen;
    project(base_, -1, base_moves_);
  }
  /// Tensions that a unit of an input makes.
  void make_columns() {
    for (int k = 0; k < inputs(); ++k) {
      Tensions& column = column_[k];
      column.fill(Scalar(0));
      const Input& input = inputs_[k];
      int driven = -1;
      if (input.kind == Input::Kind::load) column = model_->load[input.index];
      if (input.kind == Input::Kind::prestrain) column = model_->prestrain;
      if (input.kind == Input::Kind::payout) column_of(payout_move(input.index), column);
      if (input.kind == Input::Kind::jack_force) driven = row_of_jack(input.index);
      project(column, driven, column_moves_[k]);
      keeps_if_up_[k] = keeps_if_down_[k] = true;
      for (int i = 0; i < active(); ++i) {
        keeps_if_up_[k] = keeps_if_up_[k] && sense_[i] * column_moves_[k][i] >= 0;
        keeps_if_down_[k] = keeps_if_down_[k] && sense_[i] * column_moves_[k][i] <= 0;
      }
    }
  }
  /// Makes input `k` constant at x: one column less to add up, until the next map.
  void fold(int k, Scalar x) {
    for (int i = 0; i < model_->segments; ++i) base_[i] += x * column_[k][i];
    for (int i = 0; i < active(); ++i) base_moves_[i] += x * column_moves_[k][i];
    for (int later = k; later + 1 < inputs(); ++later) {
      inputs_[later] = inputs_[later + 1];
      column_[later] = column_[later + 1];
      column_moves_[later] = column_moves_[later + 1];
      keeps_if_up_[later] = keeps_if_up_[later + 1];
      keeps_if_down_[later] = keeps_if_down_[later + 1];
    }
    inputs_.drop_last();
  }

  /// Tensions that a unit of a move makes, all other moves frozen.
  void column_of(const Move& move, Tensions& column) const {
    Tensions e;
    e.fill(Scalar(0));
    impose(move, Scalar(1), e);
    column.fill(Scalar(0));
    model_->coupling.add(model_->segments, e, column);
  }
  /// Adds the elongations that a move imposes on the segments.
  static void impose(const Move& move, Scalar by, Tensions& e) {
    e[move.lengthened] += by;
    if (move.shortened >= 0) e[move.shortened] -= by;
  }

  /// Lets the active moves follow: on entry T with them at zero; on return T with their laws kept, and the
  /// moves. `driven` is the law that equals one instead of zero, or -1.
  void project(Tensions& T, int driven, Moves& moves) const {
    moves.fill(Scalar(0));
    // The second pass takes out what the first one's rounding left.
    for (int pass = 0; pass < 2 && active() > 0; ++pass) {
      Moves change;
      for (int i = 0; i < active(); ++i) change[i] = (i == driven ? Scalar(1) : Scalar(0)) - laws_[i].of(T);
      laws_times_moves_.solve(change);
      Tensions e;
      e.fill(Scalar(0));
      for (int i = 0; i < active(); ++i) {
        moves[i] += change[i];
        impose(moves_[i], change[i], e);
      }
      model_->coupling.add(model_->segments, e, T);
    }
  }

  template <class Values>
  void tensions(const Values& x, Tensions& T) const {
    for (int i = 0; i < model_->segments; ++i) T[i] = base_[i];
    for (int k = 0; k < inputs(); ++k)
      for (int i = 0; i < model_->segments; ++i) T[i] += x[k] * column_[k][i];
  }
  template <class Values>
  Scalar active_move(int i, const Values& x) const {
    return base_moves_[i] + move_rate(i, x);
  }
  /// Rates along a direction `dx` of the inputs.
  template <class Values>
  Scalar move_rate(int i, const Values& dx) const {
    Scalar rate = 0;
    for (int k = 0; k < inputs(); ++k) rate += dx[k] * column_moves_[k][i];
    return rate;
  }
  /// Whether, going along `dx`, every move keeps the sign it must have, give or take `tolerance` [N].
  template <class Values>
  bool goes_on(const Values& dx, Scalar tolerance = 0) const {
    bool each = true;
    for (int k = 0; k < inputs(); ++k)
      each = each && (dx[k] == 0 || (dx[k] > 0 ? keeps_if_up_[k] : keeps_if_down_[k]));
    for (int i = 0; !each && i < active(); ++i)
      if (sense_[i] * move_rate(i, dx) * model_->coupling(moves_[i].lengthened, moves_[i].lengthened) <
          -tolerance)
        return false;
    return true;
  }
  /// By how much tensions at `x` miss the laws of the active moves [N]: more than rounding if Scalar has too
  /// few digits.
  template <class Values>
  Scalar law_violation(const Tensions& T, const Values& x) const {
    Scalar most = 0;
    for (int i = 0; i < active(); ++i) {
      Scalar due = 0;
      for (int k = 0; k < inputs(); ++k)
        if (inputs_[k].kind == Input::Kind::jack_force && moves_[i].kind == Move::Kind::payout &&
            inputs_[k].index == moves_[i].index)
          due = x[k];
      most = std::fmax(most, std::fabs(laws_[i].of(T) - due));
    }
    return most;
  }
  /// Whether at `x` every slack run still has length to spare.
  template <class Values>
  bool stays_slack(const Values& x) const {
    for (int i = 0; has_slack_ && i < active(); ++i)
      if (moves_[i].kind == Move::Kind::excess && active_move(i, x) < 0) return false;
    return true;
  }
  template <class Values>
  void tension_rates(const Values& dx, Tensions& rates) const {
    rates.fill(Scalar(0));
    for (int k = 0; k < inputs(); ++k)
      for (int i = 0; i < model_->segments; ++i) rates[i] += dx[k] * column_[k][i];
  }

  Move payout_move(int index) const {
    const auto& cable = model_->cables[index / 2];
    return {Move::Kind::payout, index, cable.end_segment(static_cast<std::size_t>(index % 2)), -1};
  }

 private:
  int row_of_jack(int index) const {
    for (int i = 0; i < active(); ++i)
      if (moves_[i].kind == Move::Kind::payout && moves_[i].index == index) return i;
    return -1;
  }

  const CondensedType* model_ = nullptr;
  FixedList<Move, max_active> moves_;
  FixedList<Law<Scalar>, max_active> laws_;
  FixedList<Scalar, max_active> sense_;
  FixedList<Input, max_inputs> inputs_;
  BandLu<Scalar, max_active> laws_times_moves_;
  Tensions base_;
  Moves base_moves_;
  FixedArray<Tensions, max_inputs> column_;
  FixedArray<Moves, max_inputs> column_moves_;
  FixedArray<bool, max_inputs> keeps_if_up_;  // whether every move keeps its sign when the input grows
  FixedArray<bool, max_inputs> keeps_if_down_;
  bool has_slack_ = false;
};

}  // namespace taut
