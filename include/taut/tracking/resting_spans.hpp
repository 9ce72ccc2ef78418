// Spans that have no tension whatever their length is: nothing is to be decided there.
#pragma once

#include "taut/tracking/constraints.hpp"

namespace taut {

/// Finds the spans that rest: those of jacks at zero that stay there, and those that hang on nodes which bear
/// nothing, as radial cables do until the hoop at their ends has force.
///
/// Where all tensions that are zero for sure leave no other to a segment, C of Eq. (8) is singular for these
/// segments together, and their slack lengths are not unique: h may go along every z with C z = 0. Of all
/// that are possible that one is taken where as many of them as can be are zero, as at a corner of a linear
/// program: these spans have no slack length, and no variable in a decision. So a span is slack only by a
/// length that its own tension tells, and a node that hangs on slack cables has its place as soon as they
/// are to bear.
template <class Cables>
class RestingSpans {
 public:
  using Real = typename Cables::Real;
  using Cap = typename Cables::Cap;
  using Map = typename Cables::Map;
  using Tensions = typename Cables::Tensions;
  using Values = typename Map::Values;
  /// Of every span: how fast its slack length grows, or that length where all forces are decided [m].
  using Lengths = FixedArray<Real, max_spans<Cap>>;
  using Spans = FixedArray<bool, max_spans<Cap>>;
  /// False for one span, or segments that know nothing of one another: each has a tension of its own.
  static constexpr bool may_depend = !has_rigid_saddles<Cap> && !is_one_span<Cap>;

  RestingSpans(Cables& cables, Constraints<Cables>& constraints)
      : cables_(cables), constraints_(constraints) {}

  /// A jack at zero that stays there leaves its span slack: no segment has tension, the cable moves over
  /// every joint as the structure does, and what is too long is the jack's. A span that rests without one is
  /// left to find_idle().
  void find_jacked() {
    auto& state = cables_.state;
    for (int r = 0; r < cables_.spans.size(); ++r) {
      const auto& span = cables_.spans[r];
      bool rests = cables_.force[state.representative[r]] <= cables_.force_tolerance();
      if (!cables_.is_jacked(span)) rests = rests && state.rests[r] && may_any_depend();
      for (const auto& jack : cables_.jacks)
        if (cables_.pulls(jack, span))
          rests = rests && state.now.jack[jack.cable][jack.end].force <= cables_.force_tolerance() &&
                  state.goal.jack[jack.cable][jack.end].force <= cables_.force_tolerance();
      if (rests != state.rests[r]) set(r, rests);
    }
  }
  /// Whether find_idle() may find another answer than the present one.
  bool is_open() const {
    if (!may_any_depend()) return false;
    const auto& state = cables_.state;
    const bool is_known = state.has_map && cables_.is_set_up && !cables_.map.is_held();
    Tensions rate;
    if (is_known) {
      typename Cables::Inputs dx;
      cables_.directions(dx);
      cables_.map.tension_rates(dx, rate);
    }
    bool any = false;
    for (int r = 0; r < cables_.spans.size(); ++r) {
      if (!may_be_idle(r)) continue;
      const auto& span = cables_.spans[r];
      bool stays = is_known && (state.slack[r] || state.rests[r]);
      for (int i = 0; stays && i < span.count; ++i) stays = std::fabs(rate[span.segment(i)]) <= nothing();
      any = any || !stays;
    }
    return any;
  }
  /// Of spans without a jack: those whose tension is zero because others are. `T` are rates with every joint
  /// stuck, or all tensions; `find_due` gives what jacks at work are to have; `growth` breaks ties between
  /// slack lengths that are zero. The slips must be frozen; the set is another one afterwards. Where loads
  /// would give tension to what is slack, nothing is changed: a node is free. Costs a solution of the set for
  /// every segment of such a span.
  template <class FindDue>
  void find_idle(Tensions& T, const FindDue& find_due, const Lengths& growth, bool totally) {
    auto& state = cables_.state;
    const typename Cables::State::Modes before = state;
    cables_.drop_set();
    Spans candidate;
    for (int r = 0; r < cables_.spans.size(); ++r) {
      candidate[r] = may_be_idle(r) || (totally && !cables_.is_jacked(cables_.spans[r]));
      if (!cables_.is_jacked(cables_.spans[r])) state.rests[r] = false;
    }
    if (constraints_.set_up_rest()) {
      for (int r = 0; r < cables_.spans.size(); ++r) {
        if (!state.slack[r]) continue;
        static_cast<void>(constraints_.add_slack_slips(r));
        if (!constraints_.add_slack_length(r)) exchange(r, growth);
      }
      constraints_.add_gliding();
      Values due, values;
      find_due(due);
      values.fill(Real(0));
      cables_.map.set().settle(cables_.laws, due, T, values);
      if (bears_nothing(T)) {
        mark_idle(T, candidate);
      } else {
        state.slack = before.slack;
        state.moved = before.moved;
        for (int r = 0; r < cables_.spans.size(); ++r)
          state.rests[r] = before.rests[r] && cables_.is_jacked(cables_.spans[r]);
      }
    }
    for (int r = 0; r < cables_.spans.size(); ++r) {
      if (state.slack[r] != before.slack[r]) forget_length(r);
      if (state.rests[r] != before.rests[r]) set(r, state.rests[r]);
    }
    cables_.drop_set();
  }
  bool may_any_depend() const { return may_depend && !cables_.map.set().is_chains(); }

 private:
  bool may_be_idle(int r) const {
    return !cables_.is_jacked(cables_.spans[r]) &&
           (cables_.state.slack[r] ||
            cables_.force[cables_.state.representative[r]] <= cables_.force_tolerance());
  }
  void set(int r, bool rests) {
    cables_.freeze();
    cables_.state.rests[r] = rests;
    cables_.drop_set();
    const auto& span = cables_.spans[r];
    for (int i = 0; rests && i < span.joints(); ++i) cables_.stop(span.joint(i));
    if (!rests) forget(span);
  }
  /// While a span rests its joints follow a jack's error as they need not when it pulls; a strut that only
  /// its cable holds goes far then.
  void forget(const typename Cables::Span& span) {
    if constexpr (Cables::is_adjustable && Cables::Model::has_level)
      cables_.derivatives.for_each([&](auto& moved, int) {
        for (int i = 0; i < span.joints(); ++i) moved.slip[span.joint(i)] = 0;
      });
    else
      static_cast<void>(span);
  }
  void forget_length(int r) {
    if constexpr (Cables::is_adjustable)
      cables_.derivatives.for_each([&](auto& moved, int) { moved.slack_length[r] = 0; });
    else
      static_cast<void>(r);
  }
  /// Takes `r` or another slack span, the first that has no more length to spare when `r` gives up its own
  /// while no tension changes, among those that rest.
  void exchange(int r, const Lengths& growth) {
    auto& state = cables_.state;
    auto& set = cables_.map.set();
    Tensions T;
    T.fill(Real(0));
    Values by, none;
    by.fill(Real(0));
    none.fill(Real(0));
    set.carry(cables_.spans[r].segment(0), Real(1), T);
    set.settle(cables_.laws, none, T, by, 2);
    int first = r, at = -1;
    Real length = rounded(r), next = growth[r];
    for (int i = 0; i < set.size(); ++i) {
      const SlipVariable& variable = set[i].variable;
      if (variable.kind != SlipVariable::Kind::slack_length || !(by[i] > least)) continue;
      const Real its = rounded(variable.index) / by[i], its_next = growth[variable.index] / by[i];
      if (its > length || (its == length && !(its_next < next))) continue;
      first = variable.index;
      at = i;
      length = its;
      next = its_next;
    }
    for (int i = 0; i < set.size(); ++i) state.moved.of(set[i].variable) -= length * by[i];
    state.moved.slack_length[r] -= length;
    state.slack[first] = false;
    state.rests[first] = true;
    state.moved.slack_length[first] = 0;
    if (first == r) return;
    static_cast<void>(set.remove(cables_.laws, at));
    static_cast<void>(constraints_.add_slack_length(r));
  }
  /// A tension, or a rate, that is rounding.
  Real nothing() const { return Cables::tolerance * larger(cables_.push, cables_.state.peak); }
  /// A slack length that is rounding is zero.
  Real rounded(int r) const {
    const Real length = cables_.state.moved.slack_length[r];
    const int segment = cables_.spans[r].segment(0);
    return length * cables_.model->coupling(segment, segment) > cables_.force_tolerance() ? length : Real(0);
  }
  /// Whether all that came to rest in exchange has no tension.
  bool bears_nothing(const Tensions& T) const {
    bool nothing_is_borne = true;
    for (int r = 0; r < cables_.spans.size(); ++r) {
      const auto& span = cables_.spans[r];
      if (!cables_.state.rests[r] || cables_.is_jacked(span)) continue;
      for (int i = 0; i < span.count; ++i)
        nothing_is_borne = nothing_is_borne && std::fabs(T[span.segment(i)]) <= nothing();
    }
    return nothing_is_borne;
  }
  void mark_idle(const Tensions& T, const Spans& candidate) {
    auto& state = cables_.state;
    for (int r = 0; r < cables_.spans.size(); ++r) {
      if (!candidate[r] || state.slack[r] || state.rests[r]) continue;
      bool idle = cables_.map.active() > 0;
      const auto& span = cables_.spans[r];
      for (int i = 0; idle && i < span.count; ++i)
        idle = std::fabs(T[span.segment(i)]) <= nothing() && !constraints_.depends(span.segment(i));
      state.rests[r] = idle;
    }
  }

  /// Of what another slack length follows: less is rounding.
  static constexpr Real least = Real(1e-9);

  Cables& cables_;
  Constraints<Cables>& constraints_;
};

}  // namespace taut
