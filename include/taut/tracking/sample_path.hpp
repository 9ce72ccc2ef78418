// Samples without an event: a cache of the present piece in the scene's scalar.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "taut/numerics/bits.hpp"
#include "taut/tracking/cable_system.hpp"

namespace taut {

/// Follows samples while no mode changes, Eq. (14) in the scene's scalar. Holds nothing that refresh() does
/// not make anew from the state and its map.
///
/// Where one input alone changes, as in most samples, it knows how far that may go within all limits; a
/// sample then costs two comparisons and a multiplication a segment. Otherwise every limit is looked at:
/// O(segments x inputs).
template <class Cables>
class SamplePath {
 public:
  using Scalar = typename Cables::Scalar;
  using Real = typename Cables::Real;
  using Cap = typename Cables::Cap;
  using Map = typename Cables::Map;
  using Inputs = typename Cables::Inputs;
  using JackedEnd = typename Cables::JackedEnd;
  using Rounded = typename Map::Rounded;
  using Given = FixedArray<Scalar, Map::max_inputs>;

  /// Goes to the sample if no state changes on the way; both ends of the straight path within the limits is
  /// enough. Otherwise nothing is changed.
  [[nodiscard]] bool follow(Cables& cables, const Sample<Scalar, Cap>& sample) {
    if (!cables.state.has_map || !cables.state.arrived || cables.has_redundant_jack) return false;
    Given x;
    if (!read(cables, sample, x)) return false;
    bool keeps = true, regroups = false, moves = false;
    for (int k = 0; k < cables.map.inputs(); ++k) {
      if (x[k] == at_[k]) continue;
      // Not a number is neither.
      if (!(std::fabs(x[k]) <= cables.state.reach[k] && x[k] >= least_[k])) return false;
      moves = true;
      keeps = keeps && cables.map.keeps(k, x[k] > at_[k]);
      regroups = regroups || !cables.state.live[k];
    }
    if (moves && (!keeps || cables.map.has_slack()) && !goes_on(cables, x)) return false;
    if (regroups)
      regroup(cables, x);
    else if (!cables.state.has_range)
      find_range(cables);
    if (!moves) {
      cables.state.last.fill(Real(0));
      return true;
    }
    Rounded T = constant_;
    add_inputs(cables, true, x, T);
    if (!is_within_limits(cables, T) || !is_within_shifts(cables, x)) return false;
    cables.state.tension = T;
    for (int k = 0; k < cables.map.inputs(); ++k) {
      cables.state.last[k] = static_cast<Real>(x[k] - at_[k]);
      if (x[k] == at_[k]) continue;
      go_to(cables, k, x[k]);
    }
    return true;
  }
  /// Goes to the sample if one load alone changes, and stays within the range that is known.
  [[nodiscard]] bool try_to_extend(Cables& cables, const Sample<Scalar, Cap>& sample) {
    return only_ > 0 && stays_in_range(cables, sample);
  }
  /// Goes to this force of a jack, by its number, if it alone changes and stays within the range.
  [[nodiscard]] bool try_to_extend(Cables& cables, int jack, Scalar force) {
    return only_ > 0 && cables.jacks[jack].input == only_ - 1 && goes_to(cables, force);
  }
  /// Whether the force of an unlocked jack can go there, all else left as it is, without a change of modes; a
  /// cable that is wholly at zero is taken to stay there. Cost: two comparisons within the range that is
  /// known, else a pass over the joints.
  [[nodiscard]] bool reaches(const Cables& cables, int jack, Scalar force) const {
    const int k = cables.state.has_map ? cables.jacks[jack].input : -1;
    if (k < 0 || !(force >= 0)) return false;
    const Scalar step = force - at_[k];
    if (step == 0) return true;
    if (!cables.map.keeps(k, step > 0)) return false;
    if (cables.map.has_slack()) {
      Given x = at_;
      x[k] = force;
      if (!goes_on(cables, x)) return false;
    }
    const Scalar dx = force - anchor_[k];
    if (only_ == k + 1 && dx >= range_[0] && dx <= range_[1]) return true;
    Rounded T = cables.state.tension;
    const Rounded& column = cables.map.rounded_column(k);
    // Limits know no scale, but margins are for forces up to the largest so far.
    const Scalar scale =
        static_cast<Scalar>(cables.state.peak) / larger(force, static_cast<Scalar>(cables.state.peak));
    for (int i = 0; i < cables.model->segments; ++i) T[i] = scale * (T[i] + step * column[i]);
    return are_joints_within(cables, T) && are_taut(cables, T, true);
  }
  /// Drops what is known of the range: the next sample is looked at with all limits.
  void forget(Cables& cables) {
    cables.state.has_range = false;
    only_ = 0;
  }
  /// Starts anew from the forces that the last path with events ended in.
  void refresh(Cables& cables) {
    for (int j = 0; j < cables.joints(); ++j) rho_[j] = static_cast<Scalar>(cables.laws.rho(j));
    set_limits(cables);
    load_input_.fill(-1);
    for (JackedEnd& jack : cables.jacks) {
      jack.input = -1;
      jack.locked = cables.state.goal.jack[jack.cable][jack.end].locked;
    }
    for (int i = 0; i < cables.model->loads; ++i)
      factor_[i] = static_cast<Scalar>(cables.state.now.factor[i]);
    for (int i = 0; i < cables.model->segments; ++i)
      cables.state.tension[i] = static_cast<Scalar>(cables.force[i]);
    cables.state.live.fill(false);
    forget(cables);
    for (int k = 0; k < cables.map.inputs(); ++k) {
      const Input& input = cables.map.input(k);
      at_[k] = static_cast<Scalar>(cables.value(input, cables.state.now));
      cables.state.reach[k] = Scalar(16) * std::fabs(at_[k]);
      anchor_[k] = static_cast<Scalar>(cables.map.anchor()[k]);
      least_[k] = std::numeric_limits<Scalar>::lowest();
      if (input.kind == Input::Kind::load) {
        load_input_[input.index] = k;
        cables.state.reach[k] = -larger(-cables.state.reach[k], -cables.model->most_factor[input.index]);
      }
      if (input.kind == Input::Kind::jack_force) {
        cables.state.reach[k] = -larger(-cables.state.reach[k], -cables.model->most_force[input.index / 2]);
        least_[k] = has_resting_ ? std::numeric_limits<Scalar>::infinity() : Scalar(0);
        for (JackedEnd& jack : cables.jacks)
          if (2 * jack.cable + static_cast<int>(jack.end) == input.index) jack.input = k;
      }
    }
  }

  /// Goes on where the saved state was, after refresh(): the same sums in the same order.
  void restore(Cables& cables, const typename Cables::State& saved) {
    cables.state.reach = saved.reach;
    cables.state.live = saved.live;
    sum_up_constant(cables);
    if (saved.has_range) find_range(cables);
    cables.state.tension = saved.tension;
    cables.state.arrived = saved.arrived;
  }
  /// Inputs reached, and those at which the piece was begun.
  const Given& at() const { return at_; }
  const Given& anchor() const { return anchor_; }

 private:
  /// Forces closer than this part of the largest force so far are equal.
  static constexpr Scalar quick_tolerance = sizeof(Scalar) == sizeof(float) ? Scalar(1e-6) : Scalar(1e-12);

  /// Goes to the sample where the only input that changes has a range: false if anything else changes, or it
  /// leaves it.
  bool stays_in_range(Cables& cables, const Sample<Scalar, Cap>& sample) {
    const int k = only_ - 1;
    Scalar x = at_[k];
    for (int n = 0; n < cables.jacks.size(); ++n) {
      const JackedEnd& jack = cables.jacks[n];
      const Jack<Scalar>& given = sample.jack[cables.number_of(jack.cable)][jack.end];
      if (given.locked != jack.locked) return false;
      if (jack.input == k)
        x = given.force;
      else if (jack.input >= 0 && given.force != at_[jack.input])
        return false;
    }
    for (int i = 0; i < cables.patterns(); ++i) {
      if (sample.factor[i] == factor_[i]) continue;
      if (load_input_[i] != k) return false;
      x = sample.factor[i];
    }
    return goes_to(cables, x);
  }
  /// Goes to this value of the only input that changes.
  bool goes_to(Cables& cables, Scalar x) {
    const int k = only_ - 1;
    const Scalar step = x - at_[k];
    if (step != 0) {
      const Scalar dx = x - anchor_[k];
      if (!(dx >= range_[0] && dx <= range_[1]) || !cables.map.keeps(k, step > 0)) return false;
      // The three never overlap, which the compiler cannot know.
      Scalar* const __restrict T = cables.state.tension.items.data();
      const Scalar* const __restrict base = constant_.items.data();
      const Scalar* const __restrict column = cables.map.rounded_column(k).items.data();
      // A fixed trip count: the compiler unrolls.
      const int n = Cap::segments <= 16 ? Cap::segments : cables.model->segments;
      for (int i = 0; i < n; ++i) T[i] = base[i] + dx * column[i];
      go_to(cables, k, x);
    }
    cables.state.last[k] = static_cast<Real>(step);
    return true;
  }
  [[gnu::always_inline]] void go_to(Cables& cables, int k, Scalar x) {
    const Input& input = cables.map.input(k);
    at_[k] = x;
    if (input.kind == Input::Kind::load)
      cables.state.now.factor[input.index] = static_cast<Real>(factor_[input.index] = x);
    if (input.kind == Input::Kind::jack_force) {
      const auto end = static_cast<std::size_t>(input.index);
      cables.state.now.jack[cables.number_of(static_cast<int>(end / 2))][end % 2].force =
          static_cast<Real>(x);
    }
  }
  /// What a sample says of the map's inputs; false if it changes anything else.
  bool read(const Cables& cables, const Sample<Scalar, Cap>& sample, Given& x) const {
    for (int k = 0; k < cables.map.inputs(); ++k) x[k] = at_[k];
    for (const JackedEnd& jack : cables.jacks) {
      const Jack<Scalar>& given = sample.jack[jack.cable][jack.end];
      if (given.locked != jack.locked) return false;
      if (jack.input >= 0) x[jack.input] = given.force;
    }
    for (int i = 0; i < cables.model->loads; ++i) {
      if (load_input_[i] >= 0)
        x[load_input_[i]] = sample.factor[i];
      else if (sample.factor[i] != factor_[i])
        return false;
    }
    return true;
  }
  bool goes_on(const Cables& cables, const Given& given) const {
    Inputs x, dx;
    for (int k = 0; k < cables.map.inputs(); ++k) {
      x[k] = static_cast<Real>(given[k]);
      dx[k] = static_cast<Real>(given[k] - at_[k]);
    }
    return cables.map.keeps(dx, x);
  }
  /// Inputs that do not change are added up once.
  void regroup(Cables& cables, const Given& x) {
    for (int k = 0; k < cables.map.inputs(); ++k) cables.state.live[k] = x[k] != at_[k];
    forget(cables);
    sum_up_constant(cables);
  }
  /// Where one input alone changes, as in most samples: how far it may go from its anchor within all limits.
  /// Found when a second sample is like the first; from then on a sample asks for nothing else. Where none
  /// changes, as in a hold, that is not far.
  void find_range(Cables& cables) {
    cables.state.has_range = true;
    only_ = 0;
    int live = 0;
    for (int k = 0; k < cables.map.inputs(); ++k)
      if (cables.state.live[k]) {
        ++live;
        only_ = k + 1;
      }
    if (live == 0 && cables.map.inputs() > 0) {
      only_ = 1;
      range_ = {1, -1};
      return;
    }
    // A slack span has limits of its own.
    if (live != 1 || cables.map.has_slack()) {
      only_ = 0;
      return;
    }
    const int only = only_ - 1;
    range_ = {larger(least_[only], -cables.state.reach[only]) - anchor_[only],
              cables.state.reach[only] - anchor_[only]};
    const Rounded& column = cables.map.rounded_column(only);
    for (int j = 0; j < cables.joints(); ++j) {
      const auto& sides = cables.laws.sides(j);
      for (int way = 0; way < 2; ++way) {
        const int small = sides[static_cast<std::size_t>(way)],
                  big = sides[static_cast<std::size_t>(1 - way)];
        narrow(constant_[small] - rho_[j] * constant_[big] - slip_margin_[j],
               column[small] - rho_[j] * column[big]);
      }
    }
    for (int r = 0; r < cables.spans.size(); ++r) {
      const int segment = cables.state.representative[r];
      narrow(constant_[segment] - least_tension(r), column[segment]);
    }
    if constexpr (Cables::Model::has_level) {
      narrow(sum_of(cables, constant_) - least_sum(cables), sum_of(cables, column));
      narrow(most_sum(cables) - sum_of(cables, constant_), -sum_of(cables, column));
      Given x = at_;
      x[only] = anchor_[only];
      for (int n = 0; n < cables.model->shift_count(); ++n) {
        const Scalar shift = cables.template shift_at<Scalar>(n, x, anchor_);
        const auto shifting = static_cast<Scalar>(cables.shifts.by[only][n]);
        narrow(most_shift(cables) - shift, -shifting);
        narrow(most_shift(cables) + shift, shifting);
      }
    }
  }
  /// To where room + dx slope >= 0.
  void narrow(Scalar room, Scalar slope) {
    if (slope > 0) range_[0] = larger(range_[0], -room / slope);
    if (slope < 0) range_[1] = -larger(-range_[1], room / slope);
    if (!(slope > 0) && !(slope < 0) && !(room >= 0)) range_ = {1, -1};
  }
  void sum_up_constant(const Cables& cables) {
    for (int i = 0; i < cables.model->segments; ++i) constant_[i] = cables.map.rounded_base(i);
    add_inputs(cables, false, at_, constant_);
  }
  /// Of those that change, or of the others.
  void add_inputs(const Cables& cables, bool live, const Given& x, Rounded& T) const {
    for (int k = 0; k < cables.map.inputs(); ++k) {
      if (cables.state.live[k] != live) continue;
      const Scalar dx = x[k] - anchor_[k];
      const Rounded& column = cables.map.rounded_column(k);
      for (int i = 0; i < cables.model->segments; ++i) T[i] += dx * column[i];
    }
  }
  /// The friction cones, and T >= 0: with something to slip_margin where a joint sticks or a span is taut,
  /// give or take rounding where a law holds them at the limit.
  bool is_within_limits(const Cables& cables, const Rounded& T) const {
    return are_joints_within(cables, T) && are_taut(cables, T, false) && is_at_level(cables, T);
  }
  /// Second-order theory: whether all tensions together are those of the present level.
  static bool is_at_level(const Cables& cables, const Rounded& T) {
    if constexpr (Cables::Model::has_level) {
      const Scalar sum = sum_of(cables, T);
      return sum >= least_sum(cables) && sum <= most_sum(cables);
    }
    return true;
  }
  /// And whether its geometry is.
  bool is_within_shifts(const Cables& cables, const Given& x) const {
    if constexpr (Cables::Model::has_level)
      for (int n = 0; n < cables.model->shift_count(); ++n)
        if (!(std::fabs(cables.template shift_at<Scalar>(n, x, anchor_)) <= most_shift(cables))) return false;
    return true;
  }
  static Scalar most_shift(const Cables& cables) { return static_cast<Scalar>(cables.model->most_shift); }
  static Scalar sum_of(const Cables& cables, const Rounded& T) {
    Scalar sum = 0;
    for (int i = 0; i < cables.model->segments; ++i) sum += T[i];
    return sum;
  }
  static Scalar least_sum(const Cables& cables) { return static_cast<Scalar>(cables.model->least_sum); }
  static Scalar most_sum(const Cables& cables) { return static_cast<Scalar>(cables.model->most_sum); }
  bool are_taut(const Cables& cables, const Rounded& T, bool may_rest) const {
    for (int r = 0; r < cables.spans.size(); ++r)
      if (!(T[cables.state.representative[r]] >= least_tension(r)) && !(may_rest && cables.state.rests[r]))
        return false;
    return true;
  }
  bool are_joints_within(const Cables& cables, const Rounded& T) const {
    if constexpr (Cap::joints > 0) {
      for (const auto& cable : cables.model->cables)
        if (!are_joints_of_within(cable, T)) return false;
    }
    return true;
  }
  bool are_joints_of_within(const CableLayout<Scalar>& cable, const Rounded& T) const {
    const int n = cable.segments();
    const Scalar* const t = T.items.data() + cable.first_segment;
    // The joint after segment i is joint i of an open cable, joint i + 1 of a hoop.
    const int after = cable.first_joint + (Cap::hoops && cable.closed ? 1 : 0);
    const Scalar* const rho = rho_.items.data() + after;
    const Scalar* const slip_margin = slip_margin_.items.data() + after;
    BitsOf<Scalar> bits = 0;
    for (int i = 0; i + 1 < n; ++i)
      bits |= bits_of(t[i] - rho[i] * t[i + 1] - slip_margin[i]) |
              bits_of(t[i + 1] - rho[i] * t[i] - slip_margin[i]);
    if (Cap::hoops && cable.closed) {
      const Scalar closing = rho_[cable.first_joint], left = slip_margin_[cable.first_joint];
      bits |= bits_of(t[n - 1] - closing * t[0] - left) | bits_of(t[0] - closing * t[n - 1] - left);
    }
    return bits >= 0;
  }
  Scalar least_tension(int span) const { return may_be_zero_[span] ? -margin_ : margin_; }
  void set_limits(const Cables& cables) {
    margin_ = quick_tolerance * static_cast<Scalar>(cables.state.peak);
    for (int j = 0; j < cables.joints(); ++j)
      slip_margin_[j] =
          cables.state.slides[j] == JointState::stick && cables.can_slide(j) && !cables.glides(j) ? margin_
                                                                                                  : -margin_;
    has_resting_ = false;
    for (int r = 0; r < cables.spans.size(); ++r) {
      may_be_zero_[r] = cables.state.slack[r] || cables.is_jacked(cables.spans[r]);
      has_resting_ = has_resting_ || cables.state.rests[r];
    }
  }

  FixedArray<Scalar, Cap::loads> factor_;  // the loads reached
  FixedArray<Scalar, Cap::joints> rho_;
  Rounded constant_;                              // the map's base and all inputs that do not change
  FixedArray<Scalar, Cap::joints> slip_margin_;   // least T_small - rho T_big of every joint
  FixedArray<bool, max_spans<Cap>> may_be_zero_;  // of spans
  Scalar margin_ = 0;                             // what is to be left where nothing is at its limit
  Given at_, anchor_;
  Given least_;  // a jack does not push, and takes a resting span along only in an event
  FixedArray<int, Cap::loads> load_input_;  // in the map, or -1
  std::array<Scalar, 2> range_{};           // of the only live input, from its anchor: within all limits
  int only_ = 0;                            // that input, counted from 1, or 0
  bool has_resting_ = false;
};

}  // namespace taut
