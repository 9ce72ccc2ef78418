// Where a piece of the path ends, whether its forces may be shown, and why there is no answer.
#pragma once

#include "taut/tracking/cable_system.hpp"

namespace taut {

/// What ends a piece of the path: a joint at its limit, a span that goes slack, or one that is taut again.
template <class Real>
struct Ending {
  SlipMode next;
  std::int16_t span = -1, slack = -1;  ///< the span; the active variable of its slack length
  Real falling = 0;                    ///< rate of what reached zero
  Real step = 1;                       ///< where, as a part of what was left of the path
  bool has_total = false;              ///< the forces there were tested: their totals are known
  bool ends_level = false;             ///< second-order theory: level or geometry have changed by a step
};

/// Looks along the present piece, Eq. (15); changes nothing but derivatives.
template <class Cables>
class EventSearch {
 public:
  using Real = typename Cables::Real;
  using Cap = typename Cables::Cap;
  using Laws = typename Cables::Laws;
  using Map = typename Cables::Map;
  using State = typename Cables::State;
  using Tensions = typename Cables::Tensions;
  using Inputs = typename Cables::Inputs;
  static constexpr Real epsilon = Cables::epsilon, tolerance = Cables::tolerance;
  using Ending = taut::Ending<Real>;

  explicit EventSearch(Cables& cables)
      : cables_(cables),
        model_(*cables.model),
        spans_(cables.spans),
        laws_(cables.laws),
        state_(cables.state),
        map_(cables.map) {}

  /// How far the present piece goes, as a part of what is left of the path.
  Real next(const Inputs& dx, Ending& ending) const {
    Tensions rate;
    map_.tension_rates(dx, rate);
    Real step = 1;
    ending = {};
    const auto shorten = [&](Real room, Real falling, const SlipMode& next, int span, int slack) {
      // At the limit, and held there by decide(), or beyond it at the end of the path by no more than equal
      // forces differ: what is left is rounding.
      const bool is_held =
          falling >= -Real(16) * cables_.rate_tolerance() ||
          (next.joint >= 0 && room + falling >= -cables_.held(next) * cables_.force_tolerance());
      if (room <= cables_.force_tolerance() && is_held) return;
      if (falling >= 0 || room > -falling * step) return;
      step = room > 0 ? room / -falling : Real(0);
      ending = {next, static_cast<std::int16_t>(span), static_cast<std::int16_t>(slack), falling, step};
    };
    for (int j = 0; j < cables_.joints(); ++j) {
      if (state_.slides[j] != JointState::stick || !cables_.can_slide(j) || cables_.glides(j)) continue;
      for (const JointState way : {JointState::forward, JointState::backward}) {
        const SlipMode mode = SlipMode::of(j, way);
        const TensionConstraint<Real> limit = laws_.limit(mode);
        shorten(limit.of(cables_.force), limit.of(rate), mode, -1, -1);
      }
    }
    for (int r = 0; r < spans_.size(); ++r) {
      const int segment = state_.representative[r];
      if (!state_.slack[r]) shorten(cables_.force[segment], rate[segment], {}, r, -1);
    }
    Inputs x;
    cables_.values(state_.now, x);
    for (int i = 0; i < map_.active(); ++i)
      if (map_.variable(i).kind == SlipVariable::Kind::slack_length)
        shorten(map_.stiffness(i) * map_.value(i, x), map_.stiffness(i) * map_.value_rate(i, dx), {},
                map_.variable(i).index, i);
    if constexpr (Cables::Model::has_level) shorten_to_level(x, dx, rate, step, ending);
    return step;
  }

  /// Largest change of a tension, or of what a slack span's slack length stands for, along the whole path
  /// [N].
  Real change(const Inputs& dx) const {
    Tensions rate;
    map_.tension_rates(dx, rate);
    Real most = largest(model_.segments, &rate[0]);
    for (int i = 0; i < map_.active(); ++i)
      if (map_.variable(i).kind == SlipVariable::Kind::slack_length)
        most = larger(most, std::fabs(map_.stiffness(i) * map_.value_rate(i, dx)));
    return most;
  }
  /// How much later the piece would end if friction were other.
  void find_saltation(const Ending& ending, const Inputs& x) {
    if (!(-ending.falling > cables_.rate_tolerance())) return;
    cables_.differentiate_at(x);
    if (ending.slack >= 0)
      cables_.derivatives.find_saltation_of_move(map_, x, ending.slack, ending.falling);
    else if (ending.span >= 0)
      cables_.derivatives.find_saltation(map_, x, cables_.force,
                                         TensionConstraint<Real>::on(state_.representative[ending.span]), -1,
                                         ending.falling);
    else if (ending.next.joint >= 0)
      cables_.derivatives.find_saltation(map_, x, cables_.force, laws_.limit(ending.next), ending.next.joint,
                                         ending.falling);
  }
  /// Whether the forces obey the laws of all slips at work, friction where joints stick, and T >= 0: no state
  /// is shown that was not tested.
  Status check_forces() const {
    const Real most = largest(model_.segments, &cables_.force[0], state_.peak);
    const Real least = -Real(8) * tolerance * most;
    const auto broken = [&](const Status& imprecise) { return map_.is_held() ? free_node() : imprecise; };
    const Status imprecise = Status::at(Code::ill_conditioned, Place::none, -1);
    Inputs x;
    cables_.values(state_.now, x);
    if (map_.law_violation(laws_, cables_.force, x) > -least) return broken(imprecise);
    if (!is_in_equilibrium(rounded_totals * most)) return map_.has_slack() ? free_node() : imprecise;
    for (int i = 0; i < model_.segments; ++i)
      if (!(cables_.force[i] >= least)) {
        const int c = model_.cable_of(i);
        return broken(
            Status::along(Code::ill_conditioned, Place::segment, c, i - model_.cables[c].first_segment));
      }
    for (int j = 0; j < cables_.joints(); ++j) {
      if (model_.is_self_locking(j)) continue;
      for (const JointState way : {JointState::forward, JointState::backward})
        if (!(laws_.limit(SlipMode::of(j, way)).of(cables_.force) >= least))
          return broken(cables_.at_joint(Code::ill_conditioned, j));
    }
    return Status::success();
  }
  /// `pulled_through` if two jacks on one cable differ by all the friction between them, and more so as the
  /// loads go.
  Status pulled_through() const {
    if constexpr (max_jacks<Cap> < 2) return Status::success();
    for (int c = 0; c < model_.cables.size(); ++c) {
      const auto& cable = model_.cables[c];
      const bool both = !cable.closed && cable.ends[0] == End::jacked && cable.ends[1] == End::jacked &&
                        !state_.goal.jack[c][0].locked && !state_.goal.jack[c][1].locked;
      if (!both) continue;
      Real carried = 1;
      for (int k = 0; k < cable.joints(); ++k) carried *= laws_.rho(cable.first_joint + k);
      for (std::size_t end = 0; end < 2; ++end) {
        const auto& small = state_.now.jack[c][end];
        const auto& big = state_.now.jack[c][1 - end];
        const Real room = small.force - carried * big.force;
        const Real rate = state_.goal.jack[c][end].force - small.force -
                          carried * (state_.goal.jack[c][1 - end].force - big.force);
        if (room <= Real(64) * tolerance * larger(small.force, big.force) + epsilon * state_.peak && rate < 0)
          return Status::at(Code::pulled_through, Place::cable, c);
      }
    }
    return Status::success();
  }
  /// `mechanism`, at a joint of a span that should hold its node and has no tension, or at a cable that has
  /// no joint: then it is a node at its end.
  Status free_node() const {
    for (int r = 0; r < spans_.size(); ++r)
      if ((state_.slack[r] || state_.rests[r]) && spans_[r].joint_near() >= 0)
        return cables_.at_joint(Code::mechanism, spans_[r].joint_near());
    for (int r = 0; r < spans_.size(); ++r)
      if (state_.slack[r] || state_.rests[r])
        return Status::at(Code::mechanism, Place::cable, spans_[r].cable);
    return cables_.joints() > 0 ? cables_.at_joint(Code::mechanism, 0)
                                : Status::at(Code::mechanism, Place::cable, 0);
  }

 private:
  /// A level holds while the sum of all tensions, and each of the shifts of geometry, are between its limits.
  void shorten_to_level(const Inputs& x, const Inputs& dx, const Tensions& rate, Real& step,
                        Ending& ending) const {
    Real sum = 0, growth = 0;
    for (int i = 0; i < model_.segments; ++i) {
      sum += cables_.force[i];
      growth += rate[i];
    }
    const auto until = [&](Real room, Real closing) {
      if (!(closing > 0) || room > closing * step) return;
      step = room > 0 ? room / closing : Real(0);
      ending = {};
      ending.step = step;
      ending.ends_level = true;
    };
    until(model_.most_sum - sum, growth);
    until(sum - model_.least_sum, -growth);
    for (int n = 0; n < model_.shift_count(); ++n) {
      const Real shift = cables_.template shift_at<Real>(n, x, map_.anchor());
      Real shifting = 0;
      for (int k = 0; k < map_.inputs(); ++k) shifting += dx[k] * static_cast<Real>(cables_.shifts.by[k][n]);
      until(model_.most_shift - shift, shifting);
      until(model_.most_shift + shift, -shifting);
    }
  }

  /// Of the largest force: what may be lost where a cable moves much further than it stretches.
  static constexpr Real rounded_totals = Real(1e-10);

  /// Whether the tensions are those of all slips, which stay known: where slack cables alone hold a node, it
  /// goes so far away that rounding of the slips shows.
  bool is_in_equilibrium(Real tolerated) const {
    cables_.total = cables_.totals(cables_.slip_state());
    for (int i = 0; i < model_.segments; ++i)
      if (!(std::fabs(cables_.total[i] - cables_.force[i]) <= tolerated)) return false;
    return true;
  }

  Cables& cables_;
  const typename Cables::Model& model_;
  const SlidingSpans<Cap>& spans_;
  const Laws& laws_;
  State& state_;
  Map& map_;
};

}  // namespace taut
