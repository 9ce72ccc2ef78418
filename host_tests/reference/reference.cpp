// Follows the paths by trying the states of the joints at every event.
#include "reference/reference.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "reference/bars.hpp"

namespace reference {
namespace {

/// A part of a cable between anchors, jacks and joints that never slide, in the scene's numbering.
struct Stretch {
  std::vector<int> segments;
  std::vector<int> joints;          ///< inside
  std::array<int, 2> ends{-1, -1};  ///< number of the jacked end (2 x cable + end) it reaches
  bool ring = false;
};

}  // namespace

class Reference::Follower {
 public:
  explicit Follower(const Structure& scene) : scene_(scene), bars_(scene), anatomy_(scene) {
    for (int c = 0; c < scene.cables.size(); ++c) {
      for (int j = 0; j < scene.cables[c].joints(); ++j) add_joint(c, j);
      divide(c);
    }
    const Index moves = joints() + 2 * scene.cables.size() + Index(stretches_.size());
    imposes_ = Matrix::Zero(segments(), moves);
    for (Index j = 0; j < joints(); ++j) {
      imposes_(joint(j).before, j) += 1;
      imposes_(joint(j).after, j) -= 1;
    }
    for (int c = 0; c < scene.cables.size(); ++c)
      for (int end = 0; end < 2 && !scene.cables[c].closed; ++end)
        imposes_(scene.cables[c].end_segment(static_cast<std::size_t>(end)), extension_place(2 * c + end)) =
            1;
    for (std::size_t r = 0; r < stretches_.size(); ++r)
      imposes_(stretches_[r].segments[0], excess_place(r)) = 1;
    moved_ = Vector::Zero(moves);
    slack_.assign(stretches_.size(), false);
    rests_.assign(stretches_.size(), false);
    states_.assign(static_cast<std::size_t>(joints()), 0);
    now_.ends.resize(2 * static_cast<std::size_t>(scene.cables.size()));
    now_.factors = Vector::Zero(scene.loads);
    if (bars_.sound()) by_move_ = product(bars_.elongation(), imposes_);
    for (std::size_t end = 0; end < now_.ends.size(); ++end)
      now_.ends[end].jacked =
          !scene.cables[int(end / 2)].closed && scene.cables[int(end / 2)].ends[end % 2] == taut::End::jacked;
  }

  bool start() {
    if (!bars_.sound()) return false;
    tension_ = Vector::Zero(segments());
    Drive goal = now_;
    goal.prestrain = 1;
    return follow(now_, goal);
  }

  bool advance(const Row& row) {
    Drive from = now_, to = now_;
    for (int i = 0; i < scene_.loads; ++i) to.factors[i] = Exact(row.factor[i]);
    for (std::size_t end = 0; end < now_.ends.size(); ++end)
      if (now_.ends[end].jacked)
        set_end(int(end), row.jack[int(end / 2)][end % 2], from.ends[end], to.ends[end]);
    return follow(from, to);
  }

  Exact fraction() const { return 1 - rest_; }
  int events() const { return events_; }
  int events_with_several_answers() const { return several_; }
  Exact clearance() const { return clearance_; }
  Exact tension(int segment) const { return tension_[segment]; }
  Exact strut(int i) const { return forces_[segments() + i]; }
  Exact slip(int joint) const { return moved_[joint]; }
  Exact extension(int cable, int end) const { return moved_[extension_place(2 * cable + end)]; }
  Exact peak() const { return peak_; }

  std::vector<Vector> possible_rates(const Row& row) const {
    Follower trial = *this;
    trial.collect_ = true;
    trial.advance(row);
    return trial.found_at_start_;
  }

 private:
  struct Joint {
    int before, after;  // segments
    Exact rho;
    bool locked() const { return !(rho > 0); }
  };
  struct EndDrive {
    bool jacked = false;
    bool locked = false;
    Exact force = 0, extension = 0;
  };
  struct Drive {
    Vector factors;
    Exact prestrain = 0;
    std::vector<EndDrive> ends;
  };
  struct Rates {
    Vector tension, moves;
    Exact scale = 0;  ///< the largest rate if all joints stuck: what rounding is measured by
  };
  /// Signs that the rate of a joint's slip may have, beside zero.
  struct Choice {
    Index joint;
    bool forward, backward;
  };

  // The scene.

  int segments() const { return bars_.segments(); }
  Index joints() const { return Index(joints_.size()); }
  const Joint& joint(Index j) const { return joints_[static_cast<std::size_t>(j)]; }
  Index extension_place(int end) const { return joints() + end; }
  Index excess_place(std::size_t stretch) const {
    return joints() + 2 * scene_.cables.size() + Index(stretch);
  }

  void add_joint(int c, int j) {
    const auto& cable = scene_.cables[c];
    const int n = cable.segments();
    const int before = cable.closed ? (j + n - 1) % n : j, after = cable.closed ? j : j + 1;
    joints_.push_back({cable.first_segment + before, cable.first_segment + after, anatomy_.ratio(c, j)});
  }
  /// The joint after segment `i` of an open or closed cable, -1 at the end.
  int joint_after(const taut::Cable<double>& cable, int i) const {
    if (cable.closed) return cable.first_joint + (i + 1) % cable.segments();
    return i + 1 == cable.segments() ? -1 : cable.first_joint + i;
  }
  void divide(int c) {
    const auto& cable = scene_.cables[c];
    const int n = cable.segments();
    const auto ends_after = [&](int i) {
      const int j = joint_after(cable, i);
      return j < 0 || joint(j).locked();
    };
    int first = -1;
    for (int i = 0; i < n && first < 0; ++i)
      if (ends_after(i)) first = (i + 1) % n;
    Stretch stretch;
    stretch.ring = first < 0;
    for (int k = 0; k < n; ++k) {
      const int i = (std::max(first, 0) + k) % n;
      stretch.segments.push_back(cable.first_segment + i);
      if (!cable.closed && i == 0) stretch.ends[0] = 2 * c;
      if (!cable.closed && i + 1 == n) stretch.ends[1] = 2 * c + 1;
      if (stretch.ring || !ends_after(i)) stretch.joints.push_back(joint_after(cable, i));
      if (!ends_after(i) && k + 1 < n) continue;
      stretches_.push_back(stretch);
      stretch = {};
    }
  }

  // The path.

  void set_end(int end, const taut::Jack<double>& jack, EndDrive& from, EndDrive& to) {
    to.locked = jack.locked;
    if (jack.locked && !from.locked) {
      from.extension = moved_[extension_place(end)];
      to.extension = from.extension - Exact(scene_.cables[end / 2].seating);
    } else if (!jack.locked) {
      if (from.locked) {
        from.force = tension_[scene_.cables[end / 2].end_segment(static_cast<std::size_t>(end % 2))];
        take_up_slack(end);
      }
      to.force = Exact(jack.force);
    }
    from.locked = to.locked;
  }
  /// A jack that takes hold of a slack stretch draws it straight.
  void take_up_slack(int end) {
    for (std::size_t r = 0; r < stretches_.size(); ++r) {
      const Stretch& stretch = stretches_[r];
      if (!slack_[r] || (stretch.ends[0] != end && stretch.ends[1] != end)) continue;
      const Exact length = moved_[excess_place(r)];
      moved_[excess_place(r)] = 0;
      slack_[r] = false;
      moved_[extension_place(end)] += length;
      if (stretch.ends[0] == end) continue;
      for (const int j : stretch.joints) moved_[j] += length;
    }
  }

  bool is_free(int end) const { return pulls(end) && !is_spare(end); }
  /// Two jacks on a cable without a joint: the start's extension rests.
  bool is_spare(int end) const {
    const std::size_t other = static_cast<std::size_t>(end) + 1;
    return end % 2 == 0 && scene_.cables[end / 2].segments() == 1 && now_.ends[other].jacked &&
           !now_.ends[other].locked;
  }
  bool pulls(int end) const {
    if (end < 0) return false;
    const EndDrive& drive = now_.ends[static_cast<std::size_t>(end)];
    return drive.jacked && !drive.locked;
  }
  bool is_jacked(const Stretch& stretch) const { return pulls(stretch.ends[0]) || pulls(stretch.ends[1]); }

  /// Part by which two jacks on a cable without a joint will differ.
  Exact disagreement(const Drive& to) const {
    Exact most = 0;
    for (std::size_t end = 0; end < to.ends.size(); ++end) {
      if (!pulls(int(end)) || !is_spare(int(end))) continue;
      const Exact F0 = to.ends[end].force, F1 = to.ends[end + 1].force;
      if (F0 != F1) most = std::max(most, std::fabs(F0 - F1) / std::max(F0, F1));
    }
    return most;
  }
  bool is_loose(std::size_t r) const { return slack_[r] || rests_[r]; }

  static Drive difference(const Drive& from, const Drive& to) {
    Drive rate = to;
    rate.factors -= from.factors;
    rate.prestrain -= from.prestrain;
    for (std::size_t i = 0; i < rate.ends.size(); ++i) {
      rate.ends[i].force -= from.ends[i].force;
      rate.ends[i].extension -= from.ends[i].extension;
    }
    return rate;
  }
  /// Counted from the end: a force that is released to zero keeps all its digits on the way.
  void go_to(const Drive& to, const Drive& rate) {
    now_ = to;
    now_.factors -= rest_ * rate.factors;
    now_.prestrain -= rest_ * rate.prestrain;
    for (std::size_t i = 0; i < rate.ends.size(); ++i) {
      now_.ends[i].force -= rest_ * rate.ends[i].force;
      now_.ends[i].extension -= rest_ * rate.ends[i].extension;
    }
    compute_forces();
  }
  void compute_forces() {
    forces_ = now_.prestrain * bars_.prestrain() + by_move_ * moved_;
    if (scene_.loads > 0) forces_ += bars_.load() * now_.factors;
    tension_ = forces_.head(segments());
    peak_ = std::max(peak_, tension_.cwiseAbs().maxCoeff());
    tie(states_, tension_);
    for (std::size_t r = 0; r < stretches_.size(); ++r)
      for (const int i : stretches_[r].segments)
        if (is_loose(r)) tension_[i] = 0;
    for (int end = 0; end < int(now_.ends.size()); ++end)
      if (is_free(end)) tension_[end_segment(end)] = now_.ends[static_cast<std::size_t>(end)].force;
  }
  /// Over a joint that slides the smaller tension follows from the larger one: in the sum of large numbers
  /// that it is computed from it may have no digit left.
  void tie(const std::vector<int>& states, Vector& T) const {
    for (Index pass = 0; pass < joints(); ++pass)
      for (Index j = 0; j < joints(); ++j) {
        const Joint& at = joint(j);
        const int state = states[static_cast<std::size_t>(j)];
        if (state > 0) T[at.before] = at.rho * T[at.after];
        if (state < 0) T[at.after] = at.rho * T[at.before];
      }
  }
  int end_segment(int end) const {
    return scene_.cables[end / 2].end_segment(static_cast<std::size_t>(end % 2));
  }
  /// Corrects what moves until all laws at work hold: nothing adds up over the events.
  void settle() {
    Followers laws;
    collect_followers(laws);
    const std::size_t prescribed = laws.moves.size();
    for (std::size_t r = 0; r < stretches_.size(); ++r)
      for (const int j : stretches_[r].joints)
        if (!is_loose(r) && states_[static_cast<std::size_t>(j)] != 0) laws.add(j, -1, -1);
    const Index n = Index(laws.moves.size());
    Matrix system(n, n);
    Vector missing(n);
    for (Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto law = [&](const auto& T) {
        return at < prescribed ? T[laws.tensions[at]]
                               : room(T, laws.moves[at], states_[static_cast<std::size_t>(laws.moves[at])]);
      };
      for (Index k = 0; k < n; ++k) system(i, k) = law(by_move_.col(laws.moves[static_cast<std::size_t>(k)]));
      missing[i] = -law(forces_);
      if (laws.ends[at] >= 0) missing[i] += now_.ends[static_cast<std::size_t>(laws.ends[at])].force;
    }
    if (n == 0) return;
    const Eigen::FullPivLU<Matrix> factored(system);
    if (!factored.isInvertible()) return;
    const Vector by = factored.solve(missing);
    for (Index i = 0; i < n; ++i) moved_[laws.moves[static_cast<std::size_t>(i)]] += by[i];
    compute_forces();
  }

  bool follow(const Drive from, const Drive to) {
    const Drive rate = difference(from, to);
    rest_ = 1;
    go_to(to, rate);
    clearance_ = disagreement(to);
    if (clearance_ > coarsest) return false;
    const Exact push = size_of(rate);
    widen_peak(to, push);
    found_at_start_.clear();
    usual_ = finest;
    int short_steps = 0;
    for (int count = 0; count < 1000; ++count) {
      find_resting(rate);
      // What is left of the path may be rounding: then there is nothing to decide.
      if (rest_ * push <= rounding * peak_) return arrive(to, rate);
      Rates rates;
      // A breath before the end (of a release to zero, say) rounding decides what is at its limit.
      if (!decide_somehow(rate, rates)) return rest_ * push <= coarsest * peak_ && arrive(to, rate);
      if (collect_) return true;
      const Exact step = std::min(rest_, piece(rates));
      // Joints that come back to their limit again and again are there but for rounding.
      short_steps = step < Exact(1e-12L) * rest_ ? short_steps + 1 : 0;
      if (short_steps > 0 && short_steps % 8 == 0) usual_ = std::min(10 * usual_, coarsest);
      moved_ += step * rates.moves;
      rest_ -= step;
      go_to(to, rate);
      if (rest_ <= 0) return arrive(to, rate);
      settle();
      ++events_;
    }
    return false;
  }
  /// Goes to the end with all that moves as it is, but for what the laws correct.
  bool arrive(const Drive& to, const Drive& rate) {
    rest_ = 0;
    go_to(to, rate);
    find_resting({});
    settle();
    return is_balanced();
  }
  /// Whether the tensions are those of the structure, and within their limits.
  bool is_balanced() const {
    Exact least = tension_.minCoeff() - (tension_ - forces_.head(segments())).cwiseAbs().maxCoeff();
    for (const Stretch& stretch : stretches_)
      for (const int j : stretch.joints)
        least = std::min({least, room(tension_, j, 1), room(tension_, j, -1)});
    return least >= -coarsest * peak_;
  }
  /// Where the jacks of a stretch are at zero and stay there friction has nothing to hold.
  void find_resting(const Drive& rate) {
    for (std::size_t r = 0; r < stretches_.size(); ++r) {
      rests_[r] = is_jacked(stretches_[r]);
      for (const int end : stretches_[r].ends) {
        if (!pulls(end)) continue;
        const auto at = static_cast<std::size_t>(end);
        const bool grows = !rate.ends.empty() && rate.ends[at].force > 0;
        rests_[r] = rests_[r] && !(now_.ends[at].force > 0) && !grows;
      }
    }
  }
  /// Rounding may have put a joint on the wrong side of what counts as its limit: there is no answer then, or
  /// one that ends where it begins.
  bool decide_somehow(const Drive& rate, Rates& rates) {
    const int several = several_;
    clearance_ = 1;
    for (const Exact tolerance :
         {usual_, finest / 100, finest * 10, finest * 100, coarsest, 10 * coarsest, 100 * coarsest}) {
      tolerance_ = tolerance;
      if (decide(rate, rates) && piece(rates) > 0) return true;
      several_ = several;
    }
    return false;
  }
  void widen_peak(Drive to, Exact push) {
    for (EndDrive& end : to.ends) end.extension = 0;
    peak_ = std::max({peak_, push, size_of(to)});
  }
  /// The largest force that it would cause by any of its parts if all joints stuck.
  Exact size_of(const Drive& drive) const {
    Exact most = (drive.prestrain * bars_.prestrain().head(segments())).cwiseAbs().maxCoeff();
    for (int k = 0; k < scene_.loads; ++k)
      most = std::max(most, (drive.factors[k] * bars_.load().col(k).head(segments())).cwiseAbs().maxCoeff());
    for (int end = 0; end < int(drive.ends.size()); ++end) {
      const EndDrive& at = drive.ends[static_cast<std::size_t>(end)];
      if (!at.jacked) continue;
      const Exact k = bars_.elongation()(end_segment(end), end_segment(end));
      most = std::max({most, std::fabs(at.force), std::fabs(k * at.extension)});
    }
    return most;
  }

  /// Where rounding ends: long double, less the digits lost where a long segment follows a very short one.
  Exact tolerance() const { return tolerance_ * peak_; }
  /// The same of rates, as a part of the largest one.
  Exact rate_tolerance() const { return std::max(100 * finest, 100 * tolerance_); }

  // One piece of the path.

  template <class Tensions>
  Exact room(const Tensions& T, Index j, int way) const {
    const Joint& at = joint(j);
    return way > 0 ? T[at.before] - at.rho * T[at.after] : T[at.after] - at.rho * T[at.before];
  }
  /// How far the rates hold, as a part of the whole path.
  Exact piece(const Rates& rates) const {
    const Exact scale = std::max(rates.scale, rates.tension.cwiseAbs().maxCoeff());
    Exact step = 2;
    const auto shorten = [&](Exact left, Exact rate) {
      if (left <= tolerance() && rate >= -rate_tolerance() * scale) return;
      if (rate < 0) step = std::min(step, std::max(left, Exact(0)) / -rate);
    };
    for (std::size_t r = 0; r < stretches_.size(); ++r) {
      const Index first = stretches_[r].segments[0];
      if (slack_[r]) {
        const Exact k = bars_.elongation()(first, first);
        shorten(k * moved_[excess_place(r)], k * rates.moves[excess_place(r)]);
        continue;
      }
      if (rests_[r]) continue;
      shorten(tension_[first], rates.tension[first]);
      for (const int j : stretches_[r].joints)
        for (const int way : {1, -1})
          if (states_[static_cast<std::size_t>(j)] != way)
            shorten(room(tension_, j, way), room(rates.tension, j, way));
    }
    return step;
  }

  // What happens next.

  bool decide(const Drive& rate, Rates& rates) {
    std::vector<std::size_t> asked;
    for (std::size_t r = 0; r < stretches_.size(); ++r)
      if (without_tension(r)) asked.push_back(r);
    // Slack is tried first, then every other combination of slack and taut.
    for (std::size_t taut_ones = 0; taut_ones < (std::size_t(1) << asked.size()); ++taut_ones) {
      for (std::size_t i = 0; i < asked.size(); ++i) {
        slack_[asked[i]] = (taut_ones >> i & 1) == 0;
        moved_[excess_place(asked[i])] = 0;
      }
      if (decide_slides(rate, asked, rates)) return true;
    }
    return false;
  }
  bool without_tension(std::size_t r) const {
    if (is_jacked(stretches_[r])) return false;
    const Index first = stretches_[r].segments[0];
    if (slack_[r]) return moved_[excess_place(r)] * bars_.elongation()(first, first) <= tolerance();
    for (const int i : stretches_[r].segments)
      if (tension_[i] > tolerance()) return false;
    return true;
  }

  /// Everything that follows at once when something else changes: extensions of jacks at work, slack
  /// stretches.
  struct Followers {
    std::vector<Index> moves;
    std::vector<Index> tensions;  ///< prescribed: the jack's force, or zero
    std::vector<int> ends;        ///< of jacks; -1 for zero
    Eigen::FullPivLU<Matrix> system;

    void add(Index move, int tension, int end) {
      moves.push_back(move);
      tensions.push_back(tension);
      ends.push_back(end);
    }
  };
  void collect_followers(Followers& followers) const {
    for (int end = 0; end < int(now_.ends.size()); ++end)
      if (is_free(end)) followers.add(extension_place(end), end_segment(end), end);
    for (std::size_t r = 0; r < stretches_.size(); ++r) {
      const Stretch& stretch = stretches_[r];
      const std::size_t n = stretch.segments.size();
      for (std::size_t i = 0; slack_[r] && i < n; ++i)
        followers.add(i + 1 < n ? Index(stretch.joints[i]) : excess_place(r), stretch.segments[i], -1);
      if (!rests_[r]) continue;
      // Between two jacks the cable may move as a whole: the first joint keeps its place.
      const bool at_start = pulls(stretch.ends[0]), at_end = pulls(stretch.ends[1]);
      for (std::size_t i = at_start && at_end ? 1 : 0; i + 1 < n; ++i)
        followers.add(stretch.joints[i], stretch.segments[at_end ? i : i + 1], -1);
    }
  }
  bool find_followers(Followers& followers) const {
    collect_followers(followers);
    const Index n = Index(followers.moves.size());
    Matrix system(n, n);
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < n; ++k)
        system(i, k) = by_move_(followers.tensions[static_cast<std::size_t>(i)],
                                followers.moves[static_cast<std::size_t>(k)]);
    followers.system.compute(n > 0 ? system : Matrix::Identity(1, 1));
    return followers.system.isInvertible();
  }
  /// Lets the followers move until their tensions change as prescribed.
  void let_follow(const Followers& followers, const Drive* rate, Rates& rates) const {
    const Index n = Index(followers.moves.size());
    if (n == 0) return;
    Vector missing(n);
    for (Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const int end = followers.ends[at];
      missing[i] = -rates.tension[followers.tensions[at]];
      if (rate != nullptr && end >= 0) missing[i] += rate->ends[static_cast<std::size_t>(end)].force;
    }
    const Vector by = followers.system.solve(missing);
    for (Index i = 0; i < n; ++i) {
      const Index move = followers.moves[static_cast<std::size_t>(i)];
      rates.moves[move] += by[i];
      rates.tension += by_move_.col(move).head(segments()) * by[i];
    }
    for (Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const int end = followers.ends[at];
      rates.tension[followers.tensions[at]] =
          rate != nullptr && end >= 0 ? rate->ends[static_cast<std::size_t>(end)].force : Exact(0);
    }
  }

  /// The rates if all joints stuck, and what a unit of each slip that may change adds to them.
  struct Problem {
    std::vector<Choice> choices;
    std::vector<std::size_t> asked;
    Rates stuck;
    std::vector<Rates> unit;
    Exact scale = 0;
  };

  bool decide_slides(const Drive& rate, const std::vector<std::size_t>& asked, Rates& rates) {
    Problem problem;
    problem.asked = asked;
    Followers followers;
    if (!find_followers(followers)) return false;
    problem.stuck = rates_if_stuck(rate, followers);
    problem.choices = choices(false);
    for (const Choice& choice : problem.choices)
      problem.unit.push_back(rates_of_slip(choice.joint, followers));
    problem.scale = problem.stuck.scale;
    if (solve(problem, rates)) return true;
    // A breath above zero tension a joint is at both limits by rounding only: keep the nearer one.
    problem.choices = choices(true);
    return solve(problem, rates);
  }
  Rates rates_if_stuck(const Drive& rate, const Followers& followers) const {
    Rates rates;
    rates.moves = Vector::Zero(moved_.size());
    for (std::size_t end = 0; end < rate.ends.size(); ++end)
      if (rate.ends[end].locked) rates.moves[extension_place(int(end))] = rate.ends[end].extension;
    rates.tension = (rate.prestrain * bars_.prestrain() + by_move_ * rates.moves).head(segments());
    if (scene_.loads > 0) rates.tension += (bars_.load() * rate.factors).head(segments());
    rates.scale = rates.tension.cwiseAbs().maxCoeff();
    let_follow(followers, &rate, rates);
    rates.scale = std::max(rates.scale, rates.tension.cwiseAbs().maxCoeff());
    return rates;
  }
  Rates rates_of_slip(Index j, const Followers& followers) const {
    Rates rates;
    rates.moves = Vector::Zero(moved_.size());
    rates.moves[j] = 1;
    rates.tension = by_move_.col(j).head(segments());
    let_follow(followers, nullptr, rates);
    return rates;
  }
  std::vector<Choice> choices(bool only_nearer) const {
    std::vector<Choice> found;
    for (std::size_t r = 0; r < stretches_.size(); ++r)
      for (const int j : stretches_[r].joints) {
        if (is_loose(r)) continue;
        const Exact forward = room(tension_, j, 1), backward = room(tension_, j, -1);
        Choice choice{j, forward <= tolerance(), backward <= tolerance()};
        const Exact larger = std::max(tension_[joint(j).before], tension_[joint(j).after]);
        if (only_nearer && choice.forward && choice.backward && larger > tolerance() / 1000) {
          choice.forward = forward <= backward;
          choice.backward = !choice.forward;
        }
        if (choice.forward || choice.backward) found.push_back(choice);
      }
    return found;
  }

  using States = std::vector<int>;  // of the choices: 0, 1, -1

  /// Rates under assumed states. False if the sliding joints leave something loose.
  bool rates_under(const Problem& problem, const States& states, Rates& rates) const {
    std::vector<std::size_t> sliding;
    for (std::size_t k = 0; k < states.size(); ++k)
      if (states[k] != 0) sliding.push_back(k);
    const Index n = Index(sliding.size());
    Matrix A(n, n);
    Vector b(n);
    for (Index i = 0; i < n; ++i) {
      const std::size_t row = sliding[static_cast<std::size_t>(i)];
      const Index j = problem.choices[row].joint;
      b[i] = -room(problem.stuck.tension, j, states[row]);
      for (Index k = 0; k < n; ++k)
        A(i, k) = room(problem.unit[sliding[static_cast<std::size_t>(k)]].tension, j, states[row]);
    }
    rates = problem.stuck;
    if (n == 0) return true;
    const Vector columns = A.cwiseAbs().colwise().maxCoeff().transpose();
    for (Index k = 0; k < n; ++k) {
      if (!(columns[k] > 0)) return false;
      A.col(k) /= columns[k];
    }
    for (Index i = 0; i < n; ++i) {
      const Exact largest = A.row(i).cwiseAbs().maxCoeff();
      if (!(largest > 0)) return false;
      A.row(i) /= largest;
      b[i] /= largest;
    }
    Eigen::FullPivLU<Matrix> system(A);
    system.setThreshold(Exact(1e-15L));
    if (!system.isInvertible()) return false;
    const Vector v = system.solve(b);
    for (Index k = 0; k < n; ++k) {
      const Rates& unit = problem.unit[sliding[static_cast<std::size_t>(k)]];
      rates.moves += v[k] / columns[k] * unit.moves;
      rates.tension += v[k] / columns[k] * unit.tension;
    }
    tie(of_joints(problem, states), rates.tension);
    return true;
  }
  std::vector<int> of_joints(const Problem& problem, const States& states) const {
    std::vector<int> all(static_cast<std::size_t>(joints()), 0);
    for (std::size_t k = 0; k < states.size(); ++k)
      all[static_cast<std::size_t>(problem.choices[k].joint)] = states[k];
    return all;
  }

  Exact softer_side(Index j) const {
    const Joint& at = joint(j);
    return std::min(bars_.elongation()(at.before, at.before), bars_.elongation()(at.after, at.after));
  }
  struct Contradiction {
    Exact size = 0;         ///< of the worst one, as a part of the largest rate
    std::size_t first = 0;  ///< choice that contradicts; past them it is a stretch
  };
  /// Between assumed states and the rates under them.
  Contradiction contradiction(const Problem& problem, const States& states, const Rates& rates) const {
    const Exact scale = std::max(problem.scale, rates.tension.cwiseAbs().maxCoeff());
    Contradiction found{0, states.size()};
    const auto consider = [&](Exact rate, std::size_t k) {
      if (rate < -rate_tolerance() * scale) found.first = std::min(found.first, k);
      if (rate < 0) found.size = std::max(found.size, -rate / scale);
    };
    for (std::size_t k = 0; k < states.size(); ++k) {
      const Choice& choice = problem.choices[k];
      consider(Exact(states[k]) * softer_side(choice.joint) * rates.moves[choice.joint], k);
      if (choice.forward && states[k] != 1) consider(room(rates.tension, choice.joint, 1), k);
      if (choice.backward && states[k] != -1) consider(room(rates.tension, choice.joint, -1), k);
    }
    for (const std::size_t r : problem.asked) {
      const Index first = stretches_[r].segments[0];
      if (slack_[r]) consider(rates.moves[excess_place(r)] * bars_.elongation()(first, first), states.size());
      for (const int i : stretches_[r].segments)
        if (!slack_[r]) consider(rates.tension[i], states.size());
    }
    return found;
  }

  /// Not where joints at their limit count as clear of it: that only puts off the decision.
  void note(Exact off) {
    if (tolerance_ >= usual_) clearance_ = std::min(clearance_, off);
  }
  bool accept(const Problem& problem, const States& states) {
    states_ = of_joints(problem, states);
    return true;
  }
  static bool allows(const Choice& choice, int state) {
    return state == 0 || (state > 0 ? choice.forward : choice.backward);
  }

  bool solve(const Problem& problem, Rates& rates) {
    return problem.choices.size() <= 8 ? try_all(problem, rates) : search(problem, rates);
  }
  /// All combinations, the first joint changing fastest; the first one without a contradiction is taken.
  bool try_all(const Problem& problem, Rates& rates) {
    const std::size_t n = problem.choices.size();
    std::vector<Vector> found;
    States states(n, 0);
    for (;;) {
      Rates trial;
      const Exact off = rates_under(problem, states, trial) ? contradiction(problem, states, trial).size : 1;
      note(off);
      if (off <= rate_tolerance()) {
        if (found.empty()) {
          rates = trial;
          accept(problem, states);
        }
        keep_if_new(found, trial.tension, problem.scale);
      }
      std::size_t k = 0;
      while (k < n && !next_state(problem.choices[k], states[k])) ++k;
      if (k == n) break;
    }
    if (found.size() > 1) ++several_;
    if (found_at_start_.empty()) found_at_start_ = found;
    return !found.empty();
  }
  /// 0, 1, -1 and back to 0; false when it is back.
  static bool next_state(const Choice& choice, int& state) {
    do state = state == 0 ? 1 : state == 1 ? -1 : 0;
    while (!allows(choice, state));
    return state != 0;
  }
  static void keep_if_new(std::vector<Vector>& found, const Vector& tension, Exact scale) {
    for (const Vector& known : found)
      if ((known - tension).cwiseAbs().maxCoeff() <=
          Exact(1e-9L) * std::max(scale, tension.cwiseAbs().maxCoeff()))
        return;
    found.push_back(tension);
  }

  /// From all sticking, all sliding towards one place along the cable, then from anywhere.
  bool search(const Problem& problem, Rates& rates) {
    const std::size_t n = problem.choices.size();
    for (std::size_t turn = 0; turn <= n; ++turn)
      for (const int way : {1, -1}) {
        States states(n);
        for (std::size_t k = 0; k < n; ++k) states[k] = k < turn ? way : -way;
        if (change_in_turn(problem, states, rates)) return true;
      }
    std::uint64_t random = 88172645463325252u;
    for (int attempt = 0; attempt < 3000; ++attempt) {
      States states(n, 0);
      for (int& state : states) {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        state = attempt == 0 ? 0 : int(random % 3) - 1;
      }
      if (change_in_turn(problem, states, rates)) return true;
    }
    return false;
  }
  bool change_in_turn(const Problem& problem, States states, Rates& rates) {
    for (std::size_t k = 0; k < states.size(); ++k)
      if (!allows(problem.choices[k], states[k])) states[k] = 0;
    for (std::size_t count = 0; count < 8 * states.size(); ++count) {
      if (!rates_under(problem, states, rates)) return false;
      const Contradiction wrong = contradiction(problem, states, rates);
      note(wrong.size);
      if (wrong.size <= rate_tolerance()) return accept(problem, states);
      const std::size_t k = wrong.first;
      if (k == states.size()) return false;
      states[k] = states[k] != 0 ? 0 : wants(problem.choices[k], rates.tension);
    }
    return false;
  }
  int wants(const Choice& choice, const Vector& rate) const {
    return choice.forward && room(rate, choice.joint, 1) < 0 ? 1 : -1;
  }

  const Structure& scene_;
  Bars bars_;
  Anatomy anatomy_;
  std::vector<Joint> joints_;
  std::vector<Stretch> stretches_;
  Matrix imposes_;  // elongations of the segments from every move: slips, extensions, excess lengths
  Matrix by_move_;  // forces of all bars from every move
  Vector moved_, forces_, tension_;
  std::vector<bool> slack_, rests_;
  std::vector<int> states_;  // of all joints on the present piece
  Drive now_;
  static constexpr Exact rounding = 1e-17L, finest = 1e-15L, coarsest = 1e-12L;
  Exact usual_ = finest, tolerance_ = finest;  // of forces, as a part of the largest one
  Exact peak_ = 0, rest_ = 0;                  // of the path
  Exact clearance_ = 1;
  int events_ = 0, several_ = 0;
  bool collect_ = false;
  std::vector<Vector> found_at_start_;
};

Reference::Reference(Structure structure)
    : structure_(std::move(structure)), follower_(std::make_unique<Follower>(structure_)) {}
Reference::~Reference() = default;

bool Reference::start() { return follower_->start(); }
bool Reference::advance(const Row& row) { return follower_->advance(row); }
Exact Reference::fraction() const { return follower_->fraction(); }
int Reference::events() const { return follower_->events(); }
int Reference::events_with_several_answers() const { return follower_->events_with_several_answers(); }
Exact Reference::clearance() const { return follower_->clearance(); }
Exact Reference::tension(int segment) const { return follower_->tension(segment); }
Exact Reference::strut(int i) const { return follower_->strut(i); }
Exact Reference::slip(int joint) const { return follower_->slip(joint); }
Exact Reference::extension(int cable, int end) const { return follower_->extension(cable, end); }
Exact Reference::peak() const { return follower_->peak(); }

std::vector<std::vector<Exact>> Reference::possible_rates(const Row& row) const {
  std::vector<std::vector<Exact>> all;
  for (const Vector& rates : follower_->possible_rates(row)) all.emplace_back(rates.begin(), rates.end());
  return all;
}

}  // namespace reference
