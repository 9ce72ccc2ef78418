// While no state changes, tensions and slips are affine in the inputs: this is that map.
#pragma once

#include <type_traits>

#include "taut/numerics/larger.hpp"
#include "taut/tracking/active_set.hpp"

namespace taut {

/// T = base + sum of (input - anchor) x column, and the same for the active variables.
///
/// Made from totals whenever the set of active variables changes: with R the laws' coefficients, W the
/// columns of the slips, T0 the tensions at the anchor and s what the laws are to be, the slips change by m =
/// (R W)^-1 (s - R T0), and T = T0 + W m.
template <class CondensedType, class Laws>
class AffineMap {
 public:
  using Scalar = typename CondensedType::Scalar;
  using Real = typename CondensedType::Real;
  using Cap = typename CondensedType::Capacity;
  static constexpr int max_active = max_active_constraints<Cap>;
  /// Load patterns, jacks, and the prestrain; one at least.
  static constexpr int max_inputs =
      Cap::loads + max_jacks<Cap> + (Cap::prestrain || Cap::loads + max_jacks<Cap> == 0 ? 1 : 0);
  using Set = ActiveSet<CondensedType, Laws>;
  using Tensions = FixedArray<Real, Cap::segments>;
  using Values = FixedArray<Real, max_active>;
  using Inputs = FixedArray<Real, max_inputs>;
  /// Tensions in the scene's scalar.
  using Rounded = FixedArray<Scalar, Cap::segments>;

  /// Empties the map. The model must outlive it.
  void begin(const CondensedType& model) {
    model_ = &model;
    set_.begin(model);
    clear();
  }
  /// No slip variable is at work, and nothing comes in.
  void clear() {
    set_.clear();
    inputs_.clear();
    has_slack_ = false;
  }
  void clear_inputs() { inputs_.clear(); }
  void add_input(Input::Kind kind, int index) { inputs_.add({kind, static_cast<std::int16_t>(index)}); }

  /// The slip variables at work; whoever changes them makes the map anew.
  Set& set() { return set_; }
  const Set& set() const { return set_; }
  bool is_held() const { return set_.is_held(); }
  int active() const { return set_.size(); }
  const SlipVariable& variable(int i) const { return set_[i].variable; }
  const typename Set::ActiveConstraints& actives() const { return set_.actives(); }
  int inputs() const { return inputs_.size(); }
  const Input& input(int k) const { return inputs_[k]; }
  bool has_slack() const { return has_slack_; }

  /// Makes the map for the slips of the set. `T` are the tensions of all slips as they are at the anchor,
  /// `values` the active ones, `anchor` the inputs.
  void make(const Laws& laws, const Tensions& T, const Values& values, const Inputs& anchor) {
    has_slack_ = false;
    for (const ActiveConstraint& active : actives())
      has_slack_ = has_slack_ || active.variable.kind == SlipVariable::Kind::slack_length;
    anchor_ = anchor;
    base_ = T;
    base_values_ = values;
    Values due;
    due.fill(Real(0));
    for (int k = 0; k < inputs(); ++k)
      if (inputs_[k].kind == Input::Kind::jack_force) due[row_of_jack(inputs_[k].index)] = anchor[k];
    set_.settle(laws, due, base_, base_values_, most_passes);
    for (int k = 0; k < inputs(); ++k) make_column(laws, k);
    round_columns();
  }

  const Tensions& base() const { return base_; }
  const Tensions& column(int k) const { return column_[k]; }
  const Inputs& anchor() const { return anchor_; }
  template <class Values>
  void tensions(const Values& x, Tensions& T) const {
    T = base_;
    for (int k = 0; k < inputs(); ++k) {
      const Real dx = x[k] - anchor_[k];
      axpy(model_->segments, dx, &column_[k][0], &T[0]);
    }
  }
  void tension_rates(const Inputs& dx, Tensions& rates) const {
    rates.fill(Real(0));
    for (int k = 0; k < inputs(); ++k) axpy(model_->segments, Real(dx[k]), &column_[k][0], &rates[0]);
  }
  Real value(int i, const Inputs& x) const {
    Real at = base_values_[i];
    for (int k = 0; k < inputs(); ++k) at += (x[k] - anchor_[k]) * column_values_[k][i];
    return at;
  }
  /// What a unit of input `k` adds to active variable `i`.
  Real column_value(int k, int i) const { return column_values_[k][i]; }
  /// Rate along a direction `dx` of the inputs.
  Real value_rate(int i, const Inputs& dx) const {
    Real rate = 0;
    for (int k = 0; k < inputs(); ++k) rate += dx[k] * column_values_[k][i];
    return rate;
  }
  /// What an elongation by an active variable is in its own segment [N/m].
  Real stiffness(int i) const { return set_.stiffness(i); }

  /// Whether samples stay on this piece when input `k` alone grows, or shrinks: every slip variable keeps the
  /// sign it must have. Laws that imply one another may contradict where an input changes; only a whole path
  /// sees that, and such a map keeps nothing.
  bool keeps(int k, bool up) const { return up ? keeps_if_up_[k] : keeps_if_down_[k]; }
  /// The same of a sample at `x` that is reached by `dx`; every slack span still has length to spare there.
  bool keeps(const Inputs& dx, const Inputs& x) const {
    return !is_held() && goes_on(dx, Real(0)) && stays_slack(x);
  }
  /// Whether every slip variable keeps the sign it must have going along `dx`, give or take `tolerance` [N].
  bool goes_on(const Inputs& dx, Real tolerance) const {
    for (int i = 0; i < active(); ++i)
      if (!goes_on(i, dx, tolerance)) return false;
    return true;
  }
  bool goes_on(int i, const Inputs& dx, Real tolerance) const {
    return static_cast<Real>(set_[i].sense) * value_rate(i, dx) * stiffness(i) >= -tolerance;
  }
  /// By how much tensions at `x` miss the laws of the active variables [N]: more than rounding if Real has
  /// too few digits.
  Real law_violation(const Laws& laws, const Tensions& T, const Inputs& x) const {
    Values off;
    for (int i = 0; i < active(); ++i) off[i] = laws.of(set_[i]).of(T);
    for (int k = 0; k < inputs(); ++k)
      if (inputs_[k].kind == Input::Kind::jack_force) off[row_of_jack(inputs_[k].index)] -= x[k];
    return largest(active(), &off[0]);
  }

  // In the scene's scalar, for samples without an event.

  Scalar rounded_base(int i) const { return static_cast<Scalar>(base_[i]); }
  const Rounded& rounded_column(int k) const {
    if constexpr (is_wide)
      return column_[k];
    else
      return rounded_[k];
  }

  static SlipVariable extension_variable(const CondensedType& model, int index) {
    const auto& cable = model.cables[index / 2];
    return SlipVariable::of(SlipVariable::Kind::extension, index,
                            cable.end_segment(static_cast<std::size_t>(index % 2)));
  }

 private:
  static constexpr bool is_wide = std::is_same<Real, Scalar>::value;
  static constexpr int most_passes = 8;

  /// Whether at `x` every slack span still has length to spare.
  bool stays_slack(const Inputs& x) const {
    for (int i = 0; i < active(); ++i)
      if (variable(i).kind == SlipVariable::Kind::slack_length && value(i, x) < 0) return false;
    return true;
  }

  void round_columns() {
    if constexpr (!is_wide) {
      for (int k = 0; k < inputs(); ++k)
        for (int i = 0; i < model_->segments; ++i) rounded_[k][i] = static_cast<Scalar>(column_[k][i]);
    }
  }

  /// Tensions that a unit of an input makes.
  void make_column(const Laws& laws, int k) {
    Tensions& column = column_[k];
    column.fill(Real(0));
    const Input& input = inputs_[k];
    Values due;
    due.fill(Real(0));
    if (input.kind == Input::Kind::load) column = model_->load[input.index];
    if (Cap::prestrain && input.kind == Input::Kind::prestrain) column = model_->prestrain;
    if (input.kind == Input::Kind::extension) {
      Tensions e;
      e.fill(Real(0));
      extension_variable(*model_, input.index).impose(Real(1), e);
      model_->coupling.add(model_->segments, e, column);
    }
    if (input.kind == Input::Kind::jack_force) due[row_of_jack(input.index)] = 1;
    column_values_[k].fill(Real(0));
    set_.settle(laws, due, column, column_values_[k], most_passes);
    keeps_if_up_[k] = keeps_if_down_[k] = !is_held();
    for (int i = 0; i < active(); ++i) {
      const Real along = static_cast<Real>(set_[i].sense) * column_values_[k][i];
      keeps_if_up_[k] = keeps_if_up_[k] && along >= 0;
      keeps_if_down_[k] = keeps_if_down_[k] && along <= 0;
    }
  }

  int row_of_jack(int index) const {
    for (int i = 0; i < active(); ++i)
      if (variable(i).kind == SlipVariable::Kind::extension && variable(i).index == index) return i;
    return 0;
  }

  const CondensedType* model_ = nullptr;
  Set set_;
  FixedList<Input, max_inputs> inputs_;
  Inputs anchor_;
  Tensions base_;
  Values base_values_;
  FixedArray<Tensions, max_inputs> column_;
  FixedArray<Values, max_inputs> column_values_;
  FixedArray<bool, max_inputs> keeps_if_up_;
  FixedArray<bool, max_inputs> keeps_if_down_;
  bool has_slack_ = false;
  FixedArray<Rounded, is_wide ? 0 : max_inputs> rounded_;  // columns
};

}  // namespace taut
