// The paper's procedure (section 3, Fig. 6): in every load step assume the joint states, solve the global
// system, check the states, repeat until they agree.
#pragma once

#include <cmath>
#include <limits>

#include "taut/numerics/complementarity.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/sliding_spans.hpp"
#include "taut/scene/validation.hpp"
#include "taut/stepwise/system.hpp"

namespace taut {

/// Follows a scene from sample to sample with one or more global solves a load step.
///
/// The reference that faster methods are measured against. Unknowns are totals, so nothing drifts; what a
/// step hands to the next is where the joints rest and which spans are slack. The step size is the only
/// source of error: within a step every joint slides one way at most.
///
/// SceneType is a Scene<Real, Dimension, Cap>, which must outlive the solver; Scalar may be less precise than
/// Real. The object holds all its storage, mostly the square of (Dimension x nodes + 2 x Dimension x joints)
/// Scalars: make it static.
template <class Scalar, class SceneType>
class Stepwise {
 public:
  using Cap = typename SceneType::Capacity;
  static constexpr int dimension = SceneType::dimension;

  /// Validates the scene and brings its prestrain on in `substeps` load steps, without loads and jack forces.
  Status start(const SceneType& scene, int substeps = 1) {
    scene_ = nullptr;
    const Status valid = validate(scene);
    if (!valid) return valid;
    scene_ = &scene;
    system_.make(scene);
    spans_.find(scene.cables, [this](int j) { return joint(j).limit.is_self_locking(); });
    now_ = {};
    rest_ = {};
    response_ = {};
    goal_ = {};
    goal_.prestrain = 1;
    const Status status = follow(now_, goal_, substeps);
    condition_ = status ? system_.condition() : std::numeric_limits<Scalar>::infinity();
    return status;
  }

  /// Follows the straight path from the present loads to `sample` in `substeps` load steps.
  ///
  /// On failure the state stays at the last load step that has an answer, and response() is that step's:
  /// `not_started` or `bad_sample` (nothing was done), `mechanism`, `pulled_through`, `state_iterations`,
  /// `ill_conditioned`.
  Status advance(const Sample<Scalar, Cap>& sample, int substeps = 1) {
    if (scene_ == nullptr) return Status::at(Code::not_started, Place::none, -1);
    const Status usable = check_sample(scene_->cables, scene_->loads, sample);
    if (!usable) return usable;
    Loads from = now_;
    const auto force = [this](int c, std::size_t end) {
      return response_.tension[scene_->cables[c].end_segment(end)];
    };
    const auto extension = [this](int c, std::size_t end) { return response_.extension[c][end]; };
    set_path(scene_->cables, scene_->loads, sample, force, extension, from, goal_);
    return follow(from, goal_, substeps);
  }

  /// The state at the end of the path.
  const Response<Scalar, Cap>& response() const { return response_; }
  /// Displacement of a node along an axis [m].
  Scalar displacement(int node, int axis) const {
    return displacement_[node][static_cast<std::size_t>(axis)];
  }
  /// A lower bound of the condition number of the first system, scaled; at 1/epsilon digits run out.
  Scalar condition() const { return condition_; }
  const Elements<Scalar, SceneType>& elements() const { return system_.elements(); }

 private:
  using Loads = Drive<Scalar, Cap>;
  using Assumed = Situation<Scalar, Cap>;
  using Slides = Lemke<Scalar, 2 * Cap::joints>;

  /// What a load step hands to the next.
  struct Rest {
    Assumed assumed;
    FixedArray<Scalar, Cap::segments>
        slack_force;  ///< of slack segments as bars, negative in sum over a span [N]
  };

  static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

  int joints() const { return scene_->mu.size(); }
  int segments() const { return scene_->prestrain.size(); }
  const FrictionElement<Scalar, dimension>& joint(int j) const { return system_.elements().joints[j]; }
  Scalar axial(int segment) const { return system_.elements().segments[segment].axial; }

  /// Forces closer than this are equal: rounding, measured by the largest force so far [N].
  Scalar force_tolerance() const { return 64 * epsilon * system_.force_scale(); }
  Scalar slip_tolerance(int j) const { return force_tolerance() / system_.softer_segment(j); }

  Status follow(const Loads from, const Loads& to, int substeps) {
    for (int step = 1; step <= substeps; ++step) {
      const Loads loads = Loads::between(from, to, static_cast<Scalar>(step) / static_cast<Scalar>(substeps));
      const Status status = solve_step(loads);
      if (!status) return status;
      now_ = loads;
    }
    return Status::success();
  }

  // One load step.

  /// All joints that disagree change at once, as in Fig. 6. Where that does not settle or leads through a
  /// mechanism (two jacks, joints that are all at both limits), the states of all joints are found together.
  Status solve_step(const Loads& loads) {
    const Status holds = check_pull(loads);
    if (!holds) return holds;
    const Status in_turn = change_in_turn(loads);
    if (in_turn || in_turn.code == Code::ill_conditioned) return in_turn;
    const Status together = settle_together(loads);
    // That nothing holds a node says more than that the states do not settle.
    return !together && in_turn.code == Code::mechanism ? in_turn : together;
  }

  Status change_in_turn(const Loads& loads) {
    return iterate(loads, 16 + 2 * (joints() + spans_.size()), [](Assumed&) { return Status::success(); });
  }

  /// The step as one complementarity problem, Eq. (10) with all slips of the step in place of rates:
  /// T = T0 + W dv from one solve a joint, dv the slips either way.
  Status settle_together(const Loads& loads) {
    return iterate(loads, 2 + 2 * spans_.size(), [&](Assumed& trial) { return choose_slides(trial, loads); });
  }

  /// Solves and reviews until the states agree with what they lead to; choose(trial) comes before each.
  template <class Choose>
  Status iterate(const Loads& loads, int most, const Choose& choose) {
    Assumed trial = rest_.assumed;
    begin_ = rest_.assumed.v_s;
    tauten_jacked(trial, loads);
    int changed = -1;
    for (int iteration = 0; iteration < most; ++iteration) {
      Status status = choose(trial);
      if (status) status = system_.solve(trial, loads);
      if (!status) return status;
      changed = review(trial, loads);
      if (changed < 0) {
        commit(trial, loads);
        return Status::success();
      }
    }
    return at_joint(Code::state_iterations, changed);
  }

  Status choose_slides(Assumed& trial, const Loads& loads) {
    FixedList<int, Cap::joints> able;
    for (int j = 0; j < joints(); ++j)
      if (!joint(j).limit.is_self_locking() && trial.contact[j] != Contact::separated) {
        able.add(j);
        trial.contact[j] = Contact::fixed;
        trial.v_s[j] = begin_[j];
      }
    Status status = system_.solve(trial, loads);
    if (!status) return status;
    const int n = able.size();
    slides_.reset(2 * n);
    FixedArray<Scalar, Cap::segments> T0;
    for (int i = 0; i < segments(); ++i) T0[i] = system_.tension(i, trial, loads);
    for (int k = 0; k < n; ++k)
      for (int way = 0; way < 2; ++way) slides_.set_q(2 * k + way, room(able[k], way, T0));
    for (int k = 0; k < n; ++k) {
      const int j = able[k];
      const Scalar step = slip_to_v_s(j, system_.force_scale() / system_.softer_segment(j));
      const Scalar rest = trial.v_s[j];
      trial.v_s[j] = rest + step;
      status = system_.solve(trial, loads);
      trial.v_s[j] = rest;
      if (!status) return status;
      FixedArray<Scalar, Cap::segments> change;
      for (int i = 0; i < segments(); ++i) change[i] = system_.tension(i, trial, loads) - T0[i];
      for (int i = 0; i < n; ++i)
        for (int way = 0; way < 2; ++way) {
          const Scalar effect = room(able[i], way, change);
          slides_.set_M(2 * i + way, 2 * k, effect);
          slides_.set_M(2 * i + way, 2 * k + 1, -effect);
        }
    }
    if (slides_.solve() != Slides::Outcome::solved)
      return n > 0 ? at_joint(Code::state_iterations, able[0])
                   : Status::at(Code::state_iterations, Place::none, -1);
    for (int k = 0; k < n; ++k) {
      const bool forward = slides_.z(2 * k) > 0, backward = slides_.z(2 * k + 1) > 0;
      if (forward == backward) continue;
      trial.contact[able[k]] = Contact::sliding;
      trial.direction[able[k]] = forward ? -joint(able[k]).frame.towards_2 : joint(able[k]).frame.towards_2;
    }
    return Status::success();
  }
  /// T_small - rho T_big for sliding forward (0) or backward (1).
  template <class Tensions>
  Scalar room(int j, int way, const Tensions& T) const {
    const auto& sides = joint(j).segments;
    const Scalar small = T[way == 0 ? sides[0] : sides[1]], big = T[way == 0 ? sides[1] : sides[0]];
    return small - joint(j).limit.rho() * big;
  }
  Scalar slip_to_v_s(int j, Scalar slip) const {
    return -joint(j).frame.towards_2 * slip / joint(j).frame.sin_alpha;
  }

  Status at_joint(Code code, int j) const {
    for (int c = 0; c < scene_->cables.size(); ++c) {
      const auto& cable = scene_->cables[c];
      if (j >= cable.first_joint && j < cable.first_joint + cable.joints())
        return Status::along(code, Place::joint, c, j - cable.first_joint);
    }
    return Status::at(code, Place::none, -1);
  }

  /// Two jacks on one cable balance only if friction holds their difference.
  Status check_pull(const Loads& loads) const {
    for (int c = 0; c < scene_->cables.size(); ++c) {
      const auto& cable = scene_->cables[c];
      if (!is_jacked(c, 0, loads) || !is_jacked(c, 1, loads)) continue;
      Scalar carried = 1;
      for (int j = 0; j < cable.joints(); ++j) carried *= joint(cable.first_joint + j).limit.rho();
      const Scalar F0 = loads.jack[c][0].force, F1 = loads.jack[c][1].force;
      const Scalar tolerance = 64 * epsilon * std::fmax(F0, F1);
      if (F0 < carried * F1 - tolerance || F1 < carried * F0 - tolerance)
        return Status::at(Code::pulled_through, Place::cable, c);
    }
    return Status::success();
  }

  // Check of the states.

  bool is_jacked(int c, std::size_t end, const Loads& loads) const {
    const auto& cable = scene_->cables[c];
    return !cable.closed && cable.ends[end] == End::jacked && !loads.jack[c][end].locked;
  }

  bool is_prescribed(const SlidingSpan& span, const Loads& loads) const {
    return system_.is_prescribed(span.segment(0), loads) ||
           system_.is_prescribed(span.segment(span.count - 1), loads);
  }
  /// Nothing but friction holds the span along its path.
  bool is_floating(const SlidingSpan& span, const Loads& loads) const {
    return span.ring || (span.count > 1 && system_.is_prescribed(span.segment(0), loads) &&
                         system_.is_prescribed(span.segment(span.count - 1), loads));
  }

  /// Changes the assumptions that the solution contradicts. Returns a joint involved, or -1 if there is none.
  int review(Assumed& trial, const Loads& loads) {
    const Assumed solved = trial;
    int changed = -1;
    for (int r = 0; r < spans_.size(); ++r)
      if (review_span(trial, spans_[r], loads)) changed = larger(0, spans_[r].joint_near());
    Scalar most = 0;
    for (int j = 0; j < joints(); ++j) {
      if (solved.contact[j] == Contact::separated || trial.contact[j] == Contact::separated) continue;
      const Scalar violation = review_joint(solved, j, loads);
      if (!(violation > 0)) continue;
      flip(trial, j);
      if (violation > most) changed = j;
      most = std::fmax(most, violation);
    }
    for (int r = 0; r < spans_.size(); ++r) keep_one_fixed(solved, trial, spans_[r], loads);
    return changed;
  }

  /// How much a joint's assumption is contradicted [N]; 0 if it holds. Table 2.
  Scalar review_joint(const Assumed& solved, int j, const Loads& loads) const {
    if (joint(j).limit.is_self_locking()) return 0;
    const Scalar limit = std::fmax(system_.limit_force(j, solved, loads), Scalar(0));
    // Without contact friction is zero whichever way the cable slides.
    if (solved.contact[j] == Contact::sliding && limit <= force_tolerance()) return 0;
    ContactTrial<Scalar> found;
    // Whether the joint opens is decided by its span as a whole.
    found.sigma_n = std::fmin(system_.internal_force(j, 0), Scalar(0));
    found.sigma_s = system_.internal_force(j, 1);
    found.dv_s = system_.tangential(j) - begin_[j];
    found.f = solved.contact[j] == Contact::sliding ? std::copysign(limit, solved.direction[j])
                                                    : std::copysign(limit, found.sigma_s);
    found.force_tolerance = force_tolerance();
    found.slip_tolerance = slip_tolerance(j);
    if (check_contact(solved.contact[j], found) == solved.contact[j]) return 0;
    return solved.contact[j] == Contact::fixed ? std::fabs(found.sigma_s) - limit
                                               : std::fabs(found.dv_s) * system_.softer_segment(j);
  }

  void flip(Assumed& trial, int j) const {
    if (trial.contact[j] == Contact::fixed) {
      trial.contact[j] = Contact::sliding;
      trial.direction[j] = std::copysign(Scalar(1), system_.internal_force(j, 1));
    } else {
      trial.contact[j] = Contact::fixed;
      trial.v_s[j] = begin_[j];
    }
  }

  /// A floating span in which every joint slides has no place of its own; the joint that slides least rests.
  void keep_one_fixed(const Assumed& solved, Assumed& trial, const SlidingSpan& span,
                      const Loads& loads) const {
    if (!is_floating(span, loads) || span.joints() == 0) return;
    int least = -1;
    Scalar smallest = std::numeric_limits<Scalar>::max();
    for (int i = 0; i < span.joints(); ++i) {
      const int j = span.joint(i);
      if (trial.contact[j] != Contact::sliding) return;
      const bool slid = solved.contact[j] == Contact::sliding;
      const Scalar motion = slid ? std::fabs(system_.tangential(j) - begin_[j]) * system_.softer_segment(j)
                                 : review_joint(solved, j, loads);
      if (motion < smallest) {
        smallest = motion;
        least = j;
      }
    }
    trial.contact[least] = Contact::fixed;
    trial.v_s[least] = begin_[least];
  }

  /// Taut spans must be stretched, slack ones too long.
  bool review_span(Assumed& trial, const SlidingSpan& span, const Loads& loads) {
    if (is_prescribed(span, loads)) return false;
    Scalar excess = 0, flexibility = 0;
    for (int i = 0; i < span.count; ++i) {
      const int segment = span.segment(i);
      excess += system_.bar_force(segment, loads) / axial(segment);
      flexibility += Scalar(1) / axial(segment);
    }
    const bool slack = trial.slack[span.segment(0)];
    const Scalar mean = excess / flexibility;
    if (slack ? mean <= force_tolerance() : mean >= -force_tolerance()) return false;
    set_slack(trial, span, !slack);
    if (slack) rest_where_it_closed(trial, span, loads);
    return true;
  }

  void set_slack(Assumed& trial, const SlidingSpan& span, bool slack) const {
    for (int i = 0; i < span.count; ++i) trial.slack[span.segment(i)] = slack;
    const auto& cable = scene_->cables[span.cable];
    for (int k = 0; k < cable.joints(); ++k) {
      const int j = cable.first_joint + k;
      const bool open = trial.slack[joint(j).segments[0]] && trial.slack[joint(j).segments[1]];
      if (open)
        trial.contact[j] = Contact::separated;
      else if (trial.contact[j] == Contact::separated)
        trial.contact[j] = Contact::fixed;
    }
  }

  /// Table 1, separated to fixed: the cable comes to rest where it was at the part of the step at which the
  /// span had its unstressed length; then no segment is strained, which gives the slip of every joint.
  void rest_where_it_closed(Assumed& trial, const SlidingSpan& span, const Loads& loads) {
    const bool was_slack = rest_.assumed.slack[span.segment(0)];
    if (!was_slack) {
      for (int i = 0; i < span.joints(); ++i) trial.v_s[span.joint(i)] = rest_.assumed.v_s[span.joint(i)];
      return;
    }
    Scalar before = 0, after = 0;
    for (int i = 0; i < span.count; ++i) {
      const int segment = span.segment(i);
      before += rest_.slack_force[segment] / axial(segment);
      after += system_.bar_force(segment, loads) / axial(segment);
    }
    const Scalar part = before < after ? -before / (after - before) : Scalar(0);
    const auto strain_length = [&](int i) {
      const int segment = span.segment(i);
      const Scalar start = rest_.slack_force[segment];
      return (start + part * (system_.bar_force(segment, loads) - start)) / axial(segment);
    };
    lay_unstrained(trial, span, loads, strain_length);
  }

  /// A jack that takes hold of a slack span draws it straight.
  void tauten_jacked(Assumed& trial, const Loads& loads) {
    for (int r = 0; r < spans_.size(); ++r) {
      const SlidingSpan& span = spans_[r];
      if (!trial.slack[span.segment(0)] || !is_prescribed(span, loads)) continue;
      set_slack(trial, span, false);
      lay_unstrained(trial, span, loads, [&](int i) {
        const int segment = span.segment(i);
        return rest_.slack_force[segment] / axial(segment);
      });
    }
  }

  /// Slips that leave no segment strained, given the elongation of each without slip [m]; from the end that
  /// is not a jack.
  template <class Lengths>
  void lay_unstrained(Assumed& trial, const SlidingSpan& span, const Loads& loads, Lengths elongation) {
    const int last = span.count - 1;
    Scalar slip = 0;
    if (!span.ring && system_.is_prescribed(span.segment(0), loads)) {
      for (int i = last; i > 0; --i) set_slip(trial, span.joint(i - 1), slip += elongation(i));
      return;
    }
    if (span.ring) slip = response_.slip[span.joint(last)];
    for (int i = 0; i < last; ++i) set_slip(trial, span.joint(i), slip -= elongation(i));
    if (span.ring) set_slip(trial, span.joint(last), response_.slip[span.joint(last)]);
  }
  void set_slip(Assumed& trial, int j, Scalar slip) { begin_[j] = trial.v_s[j] = slip_to_v_s(j, slip); }

  // The state reached.

  void commit(const Assumed& trial, const Loads& loads) {
    for (int i = 0; i < segments(); ++i) {
      response_.tension[i] = std::fmax(system_.tension(i, trial, loads), Scalar(0));
      rest_.slack_force[i] = trial.slack[i] ? system_.bar_force(i, loads) : Scalar(0);
    }
    for (int j = 0; j < joints(); ++j) commit_joint(trial, j);
    rest_.assumed.slack = trial.slack;
    for (int i = 0; i < scene_->struts.size(); ++i) response_.strut[i] = system_.strut_force(i);
    for_each_jacked_end(scene_->cables, [&](int c, std::size_t end) {
      response_.extension[c][end] = extension(c, end, loads);
    });
    for (int i = 0; i < scene_->nodes.size(); ++i)
      for (int axis = 0; axis < dimension; ++axis)
        displacement_[i][static_cast<std::size_t>(axis)] = system_.node_displacement(i, axis);
    system_.accept();
  }

  void commit_joint(const Assumed& trial, int j) {
    const auto& element = joint(j);
    const auto& frame = element.frame;
    const Scalar T1 = response_.tension[element.segments[0]], T2 = response_.tension[element.segments[1]];
    Scalar v_s = trial.v_s[j], moved = 0;
    response_.state[j] = JointState::stick;
    if (trial.contact[j] == Contact::separated) {
      response_.state[j] = JointState::open;
      v_s = rest_.assumed.v_s[j];
    } else if (trial.contact[j] == Contact::sliding) {
      v_s = system_.tangential(j);
      moved = -frame.towards_2 * (v_s - begin_[j]);
      if (moved > slip_tolerance(j)) response_.state[j] = JointState::forward;
      if (moved < -slip_tolerance(j)) response_.state[j] = JointState::backward;
    }
    rest_.assumed.contact[j] = trial.contact[j];
    rest_.assumed.direction[j] = trial.direction[j];
    rest_.assumed.v_s[j] = v_s;
    response_.slip[j] = -frame.towards_2 * v_s * frame.sin_alpha;
    response_.contact[j] = (T1 + T2) * frame.cos_alpha;
    response_.friction[j] = (T2 - T1) * frame.sin_alpha;
  }

  /// What the jack has drawn out: the elongation that its force asks for and the structure does not give.
  Scalar extension(int c, std::size_t end, const Loads& loads) const {
    if (loads.jack[c][end].locked) return loads.jack[c][end].extension;
    const int segment = scene_->cables[c].end_segment(end);
    const Scalar drawn = (loads.jack[c][end].force - system_.bar_force(segment, loads)) / axial(segment);
    // On a cable of one segment with two jacks the end takes what the start does not.
    const bool shared = scene_->cables[c].segments() == 1 && end == 1 && !loads.jack[c][0].locked &&
                        scene_->cables[c].ends[0] == End::jacked;
    return shared ? drawn - response_.extension[c][0] : drawn;
  }

  const SceneType* scene_ = nullptr;
  System<Scalar, SceneType> system_;
  SlidingSpans<Cap> spans_;
  Slides slides_;
  Loads now_, goal_;
  Rest rest_;
  FixedArray<Scalar, Cap::joints> begin_;  // v_s from which the joints slide in this step
  Response<Scalar, Cap> response_;
  FixedArray<std::array<Scalar, static_cast<std::size_t>(dimension)>, Cap::nodes> displacement_;
  Scalar condition_ = 0;
};

}  // namespace taut
