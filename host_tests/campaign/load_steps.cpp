#include "campaign/load_steps.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/bars.hpp"
#include "support/random.hpp"

namespace campaign {
namespace {

using reference::Index;
using reference::Matrix;
using reference::Vector;

/// w = q + M z >= 0, z >= 0, w z = 0. The first pairs belong together in twos, of which only one may have z >
/// 0: a joint slides one way.
class Pivoting {
 public:
  Pivoting(const Matrix& M, const Vector& q, Index twos, Exact coarsest)
      : n_(q.size()), twos_(twos), coarsest_(coarsest), M_(M), q_(q) {}

  /// By changing which z are at work where signs disagree: first all at once, then the first one.
  bool change_in_turn(support::Random& random, bool from_rest, Vector& z) const {
    std::vector<bool> at_work(std::size_t(n_), false);
    for (Index i = 0; !from_rest && i < n_; ++i)
      at_work[std::size_t(i)] =
          random.below(3) == 0 && !(i < twos_ && i % 2 == 1 && at_work[std::size_t(i - 1)]);
    for (Index count = 0; count < 2 * n_ + 16; ++count) {
      if (!solve_with(at_work, z)) return false;
      const Vector w = q_ + M_ * z;
      bool changed = false;
      for (Index i = 0; i < n_ && !(changed && count >= 8); ++i) {
        const bool works = at_work[std::size_t(i)];
        if (works ? z[i] >= 0 : w[i] >= -tiny()) continue;
        at_work[std::size_t(i)] = !works;
        if (!works && i < twos_) at_work[std::size_t(i ^ 1)] = false;
        changed = true;
      }
      if (!changed) return holds(z);
    }
    return false;
  }

  /// Whether there is nothing to solve.
  bool nothing() const { return n_ == 0; }
  /// Whether there are few enough combinations to try them all.
  bool few() const { return combinations() <= 20000; }
  /// The answer of all combinations with the least largest z.
  bool try_all(Vector& z) const {
    std::vector<bool> at_work(std::size_t(n_), false);
    bool found = false;
    Vector trial;
    do {
      if (!solve_with(at_work, trial) || !(trial.minCoeff() >= -tiny()) || !holds(trial)) continue;
      if (found && trial.maxCoeff() >= z.maxCoeff()) continue;
      z = trial;
      found = true;
    } while (next(at_work));
    return found;
  }

  /// By Lemke's method, with a covering vector at random unless `even`.
  bool solve(support::Random& random, bool even, Vector& z) {
    z = Vector::Zero(n_);
    if (n_ == 0 || q_.minCoeff() >= 0) return true;
    // Columns: w, z, cover, right-hand side; row i reads w_i - (M z)_i - d_i cover = q_i.
    tableau_.setZero(n_, 2 * n_ + 2);
    tableau_.leftCols(n_).setIdentity();
    tableau_.middleCols(n_, n_) = -M_;
    basic_.resize(std::size_t(n_));
    const Exact mild = even ? 0 : Exact(random.between(0.1, 3));
    Index row = 0;
    Exact most = 0;
    for (Index i = 0; i < n_; ++i) {
      basic_[std::size_t(i)] = i;
      const Exact d = 1 + mild * Exact(random.between(0, 1));
      tableau_(i, 2 * n_) = -d;
      // Ties are broken by numbers far below what counts.
      tableau_(i, 2 * n_ + 1) = q_[i] + Exact(1e-16L) * Exact(random.between(0, 1)) * size();
      if (-tableau_(i, 2 * n_ + 1) / d > most) {
        most = -tableau_(i, 2 * n_ + 1) / d;
        row = i;
      }
    }
    if (!(most > 0)) return true;
    Index entering = 2 * n_;
    for (Index count = 0; count < 4 * n_ + 24; ++count) {
      const Index leaving = basic_[std::size_t(row)];
      pivot(row, entering);
      if (leaving == 2 * n_) {
        read(z);
        return holds(z);
      }
      entering = leaving < n_ ? leaving + n_ : leaving - n_;
      row = shortest(entering);
      if (row < 0) return false;
    }
    return false;
  }

 private:
  Exact size() const { return std::max(q_.cwiseAbs().maxCoeff(), Exact(1e-30L)); }
  Exact tiny() const { return Exact(1e-15L) * size(); }
  double combinations() const { return std::pow(3.0, double(twos_ / 2)) * std::pow(2.0, double(n_ - twos_)); }
  bool next(std::vector<bool>& at_work) const {
    for (Index i = 0; i < twos_; i += 2) {
      const bool forward = at_work[std::size_t(i)], backward = at_work[std::size_t(i + 1)];
      at_work[std::size_t(i)] = !forward && !backward;
      at_work[std::size_t(i + 1)] = forward;
      if (!backward) return true;
    }
    for (Index i = twos_; i < n_; ++i) {
      at_work[std::size_t(i)] = !at_work[std::size_t(i)];
      if (at_work[std::size_t(i)]) return true;
    }
    return false;
  }
  /// w = 0 where z is at work, z = 0 elsewhere; false if that says nothing.
  bool solve_with(const std::vector<bool>& at_work, Vector& z) const {
    std::vector<Index> chosen;
    for (Index i = 0; i < n_; ++i)
      if (at_work[std::size_t(i)]) chosen.push_back(i);
    const Index n = Index(chosen.size());
    z = Vector::Zero(n_);
    if (n == 0) return true;
    Matrix A(n, n);
    Vector b(n);
    for (Index i = 0; i < n; ++i) {
      b[i] = -q_[chosen[std::size_t(i)]];
      for (Index k = 0; k < n; ++k) A(i, k) = M_(chosen[std::size_t(i)], chosen[std::size_t(k)]);
    }
    Eigen::FullPivLU<Matrix> factored(A);
    factored.setThreshold(Exact(1e-16L));
    const Vector found = factored.solve(b);
    if (!factored.isInvertible() && !((A * found - b).cwiseAbs().maxCoeff() <= tiny())) return false;
    for (Index i = 0; i < n; ++i) z[chosen[std::size_t(i)]] = found[i];
    return true;
  }
  void pivot(Index row, Index entering) {
    tableau_.row(row) /= tableau_(row, entering);
    for (Index i = 0; i < n_; ++i) {
      const Exact by = tableau_(i, entering);
      if (i != row && by != 0) tableau_.row(i) -= by * tableau_.row(row);
    }
    basic_[std::size_t(row)] = entering;
  }
  Index shortest(Index entering) const {
    const Exact least = Exact(1e-14L) * std::max(Exact(1), tableau_.col(entering).cwiseAbs().maxCoeff());
    Index best = -1;
    Exact shortest = 0;
    for (Index i = 0; i < n_; ++i) {
      if (tableau_(i, entering) <= least) continue;
      const Exact ratio = std::max(tableau_(i, 2 * n_ + 1), Exact(0)) / tableau_(i, entering);
      const bool cover = basic_[std::size_t(i)] == 2 * n_;
      if (best >= 0 && (cover ? ratio > shortest : ratio >= shortest)) continue;
      best = i;
      shortest = ratio;
    }
    return best;
  }
  void read(Vector& z) const {
    for (Index i = 0; i < n_; ++i) {
      const Index b = basic_[std::size_t(i)];
      if (b >= n_ && b < 2 * n_) z[b - n_] = std::max(tableau_(i, 2 * n_ + 1), Exact(0));
    }
  }
  bool holds(const Vector& z) const {
    const Vector w = q_ + M_ * z;
    const Exact rounding = coarsest_ * (size() + Exact(1e-3L) * (M_.cwiseAbs() * z).cwiseAbs().maxCoeff());
    for (Index i = 0; i < n_; ++i)
      if (!(w[i] >= -rounding) || (z[i] > 0 && !(std::fabs(w[i]) <= rounding))) return false;
    return true;
  }

  Index n_, twos_;
  Exact coarsest_;
  const Matrix& M_;
  const Vector& q_;
  Matrix tableau_;
  std::vector<Index> basic_;
};

}  // namespace

class LoadSteps::Stepper {
 public:
  explicit Stepper(reference::Structure given)
      : scene_(std::move(given)), bars_(scene_), anatomy_(scene_), random_(1) {
    for (int c = 0; c < scene_.cables.size(); ++c) add_cable(c);
    moved_.slip.assign(joints_.size(), 0);
    moved_.extension.assign(2 * std::size_t(scene_.cables.size()), 0);
    moved_.excess.assign(std::size_t(segments()), 0);
    now_.factors.assign(std::size_t(scene_.loads), 0);
    now_.ends.resize(moved_.extension.size());
    for (std::size_t end = 0; end < now_.ends.size(); ++end) {
      const auto& cable = scene_.cables[int(end / 2)];
      now_.ends[end].jacked = !cable.closed && cable.ends[end % 2] == taut::End::jacked;
    }
    tension_ = Vector::Zero(segments());
    if (bars_.sound()) W_ = bars_.elongation().topRows(segments());
  }

  bool start(int steps) {
    Drive goal = now_;
    goal.prestrain = 1;
    return bars_.sound() && follow(now_, goal, steps);
  }
  bool advance(const reference::Row& row, int steps) {
    Drive from = now_, to = now_;
    for (int i = 0; i < scene_.loads; ++i) to.factors[std::size_t(i)] = Exact(row.factor[i]);
    for (std::size_t end = 0; end < now_.ends.size(); ++end)
      if (now_.ends[end].jacked)
        set_end(int(end), row.jack[int(end / 2)][end % 2], from.ends[end], to.ends[end]);
    return follow(from, to, steps);
  }

  Way probe(const Drive& now, const Drive& goal, const Moves& moves, Exact peak) {
    if (!bars_.sound()) return Way::none;
    now_ = now;
    moved_ = moves;
    peak_ = std::max(peak, size_of(now));
    if (!(peak_ > 0)) peak_ = size_of(goal);
    tension_ = total(now, moves);
    const Exact push = (total(goal, moves) - tension_).cwiseAbs().maxCoeff() + jack_change(now, goal);
    if (!(push > 0)) return Way::none;
    const Moves kept = moved_;
    const Vector before = tension_;
    Exact last = 1;
    bool found = false;
    exhausted_ = true;
    coarsest_ = Exact(1e-15L);
    // Behind joints with a small rho forces change by 1 / rho times as much as in front of them.
    for (const Exact size : {1e-6L, 1e-8L, 1e-10L, 1e-12L}) {
      const Exact part = std::min(Exact(1), size * peak_ / push);
      // What may be off by as much as the step is no answer to it.
      sound_ = std::min(Exact(1e-12L), size / 100);
      const Exact reach = std::max(100 * size, Exact(1e-11L));
      if (!nearest(between(now, goal, part), kept, before, reach * peak_, 10 * size * peak_)) continue;
      const Exact change = (tension_ - before).cwiseAbs().maxCoeff() / peak_;
      found =
          size < Exact(1e-7L) && (change <= 100 * size || (change <= Exact(1e-4L) && change <= last / 10));
      last = change;
      if (found) break;
    }
    moved_ = kept;
    tension_ = before;
    pivot_ = smallest_pivot();
    if (found) return Way::goes_on;
    const Exact part = std::min(Exact(1), Exact(1e-5L) * peak_ / push);
    sound_ = Exact(1e-12L);
    found = nearest(between(now, goal, part), kept, before, 2 * peak_, 2 * peak_);
    // From nothing at all an answer to any part of the way is one to every part.
    const bool nothing = before.cwiseAbs().maxCoeff() <= Exact(1e-12L) * peak_ &&
                         *std::max_element(kept.excess.begin(), kept.excess.end()) <= 0;
    return !found ? Way::none : nothing ? Way::goes_on : Way::jumps;
  }

  Exact tension(int segment) const { return tension_[segment]; }
  Exact extension(int end) const { return moved_.extension[std::size_t(end)]; }
  Exact violation() const { return violation_; }
  Exact largest_change() const { return largest_change_; }
  Exact pivot() const { return pivot_; }
  bool exhausted() const { return exhausted_; }

 private:
  struct Joint {
    int before, after;  // segments
    Exact rho;
  };
  /// Between anchors, jacks and joints that never slide.
  struct Stretch {
    std::vector<int> segments, joints;
    std::array<int, 2> ends{-1, -1};
  };

  int segments() const { return bars_.segments(); }
  /// As many as take about a second or two.
  int attempts() const {
    const double n = 2.0 * double(joints_.size()) + 1;
    return int(std::max(8.0, std::min(64.0, 1e8 / (n * n * n))));
  }

  void add_cable(int c) {
    const auto& cable = scene_.cables[c];
    const int n = cable.segments();
    for (int j = 0; j < cable.joints(); ++j) {
      const int before = cable.closed ? (j + n - 1) % n : j, after = cable.closed ? j : j + 1;
      joints_.push_back({cable.first_segment + before, cable.first_segment + after, anatomy_.ratio(c, j)});
    }
    const auto joint_after = [&](int i) {
      if (cable.closed) return cable.first_joint + (i + 1) % n;
      return i + 1 == n ? -1 : cable.first_joint + i;
    };
    const auto ends_after = [&](int i) {
      const int j = joint_after(i);
      return j < 0 || !(joints_[std::size_t(j)].rho > 0);
    };
    int first = -1;
    for (int i = 0; i < n; ++i)
      if (ends_after(i)) first = (i + 1) % n;
    const bool ring = first < 0;
    Stretch stretch;
    for (int k = 0; k < n; ++k) {
      const int i = (std::max(first, 0) + k) % n;
      stretch.segments.push_back(cable.first_segment + i);
      if (!cable.closed && i == 0) stretch.ends[0] = 2 * c;
      if (!cable.closed && i + 1 == n) stretch.ends[1] = 2 * c + 1;
      if (ring || !ends_after(i)) stretch.joints.push_back(joint_after(i));
      if (!ends_after(i) && k + 1 < n) continue;
      stretches_.push_back(stretch);
      stretch = {};
    }
  }

  // The path.

  static bool pulls(const Drive& drive, int end) {
    return end >= 0 && drive.ends[std::size_t(end)].jacked && !drive.ends[std::size_t(end)].locked;
  }
  static bool is_jacked(const Drive& drive, const Stretch& stretch) {
    return pulls(drive, stretch.ends[0]) || pulls(drive, stretch.ends[1]);
  }
  int end_segment(int end) const { return scene_.cables[end / 2].end_segment(std::size_t(end % 2)); }

  void set_end(int end, const taut::Jack<double>& jack, End& from, End& to) {
    to.locked = jack.locked;
    if (jack.locked && !from.locked) {
      from.extension = moved_.extension[std::size_t(end)];
      to.extension = from.extension - Exact(scene_.cables[end / 2].seating);
    } else if (!jack.locked) {
      if (from.locked) {
        from.force = tension_[end_segment(end)];
        draw_straight(end);
      }
      to.force = Exact(jack.force);
    }
    from.locked = to.locked;
  }
  /// A jack that takes hold of a slack stretch takes its excess length.
  void draw_straight(int end) {
    for (const Stretch& stretch : stretches_) {
      if (stretch.ends[0] != end && stretch.ends[1] != end) continue;
      Exact& excess = moved_.excess[std::size_t(stretch.segments[0])];
      moved_.extension[std::size_t(end)] += excess;
      if (stretch.ends[0] != end)
        for (const int j : stretch.joints) moved_.slip[std::size_t(j)] += excess;
      excess = 0;
    }
  }

  static Drive between(const Drive& from, const Drive& to, Exact part) {
    if (part >= 1) return to;
    Drive mixed = to;
    const auto mix = [part](Exact a, Exact b) { return a + part * (b - a); };
    mixed.prestrain = mix(from.prestrain, to.prestrain);
    for (std::size_t i = 0; i < to.factors.size(); ++i)
      mixed.factors[i] = mix(from.factors[i], to.factors[i]);
    for (std::size_t i = 0; i < to.ends.size(); ++i) {
      mixed.ends[i].force = mix(from.ends[i].force, to.ends[i].force);
      mixed.ends[i].extension = mix(from.ends[i].extension, to.ends[i].extension);
    }
    return mixed;
  }
  bool follow(const Drive from, const Drive to, int steps) {
    largest_change_ = 0;
    for (int k = 1; k <= steps; ++k) {
      const Drive there = between(from, to, Exact(k) / Exact(steps));
      peak_ = std::max(peak_, size_of(there));
      const Vector before = tension_;
      const Moves kept = moved_;
      const Exact stuck = (total(there, kept) - before).cwiseAbs().maxCoeff() + jack_change(now_, there);
      // There may be several answers: the forces must not jump where they need not.
      if (!nearest(there, kept, before, 2 * peak_, 2 * stuck + Exact(1e-12L) * peak_)) return false;
      now_ = there;
      peak_ = std::max(peak_, tension_.cwiseAbs().maxCoeff());
      if (peak_ > 0) {
        largest_change_ = std::max(largest_change_, (tension_ - before).cwiseAbs().maxCoeff() / peak_);
        violation_ = std::max(violation_, check() / peak_);
      }
    }
    return true;
  }
  /// The largest force that it would cause by any of its parts if all joints stuck.
  Exact size_of(const Drive& drive) const {
    Exact most = (drive.prestrain * bars_.prestrain().head(segments())).cwiseAbs().maxCoeff();
    for (std::size_t k = 0; k < drive.factors.size(); ++k)
      most = std::max(most,
                      (drive.factors[k] * bars_.load().col(Index(k)).head(segments())).cwiseAbs().maxCoeff());
    for (std::size_t end = 0; end < drive.ends.size(); ++end)
      if (pulls(drive, int(end))) most = std::max(most, drive.ends[end].force);
    return most;
  }
  static Exact jack_change(const Drive& now, const Drive& goal) {
    Exact most = 0;
    for (std::size_t end = 0; end < now.ends.size(); ++end)
      if (pulls(goal, int(end))) most = std::max(most, std::fabs(goal.ends[end].force - now.ends[end].force));
    return most;
  }

  // One step.

  /// Tensions of the structure under a drive with what has moved; locked ends are where the drive has them.
  Vector total(const Drive& drive, const Moves& moves) const {
    Vector e = Vector::Zero(segments());
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      e[joints_[j].before] += moves.slip[j];
      e[joints_[j].after] -= moves.slip[j];
    }
    for (std::size_t end = 0; end < drive.ends.size(); ++end) {
      if (!drive.ends[end].jacked) continue;
      e[end_segment(int(end))] += drive.ends[end].locked ? drive.ends[end].extension : moves.extension[end];
    }
    for (int i = 0; i < segments(); ++i) e[i] += moves.excess[std::size_t(i)];
    Vector T = drive.prestrain * bars_.prestrain().head(segments()) + W_ * e;
    for (std::size_t k = 0; k < drive.factors.size(); ++k)
      T += drive.factors[k] * bars_.load().col(Index(k)).head(segments());
    return T;
  }
  template <class Tensions>
  Exact room(const Tensions& T, const Joint& at, int way) const {
    return way == 0 ? T[at.before] - at.rho * T[at.after] : T[at.after] - at.rho * T[at.before];
  }
  /// The worst that the present state violates [N].
  Exact check() const {
    Exact worst = (total(now_, moved_) - tension_).cwiseAbs().maxCoeff();
    worst = std::max(worst, -tension_.minCoeff());
    for (const Joint& at : joints_)
      if (at.rho > 0) worst = std::max({worst, -room(tension_, at, 0), -room(tension_, at, 1)});
    for (int end = 0; end < int(now_.ends.size()); ++end)
      if (pulls(now_, end))
        worst = std::max(worst, std::fabs(tension_[end_segment(end)] - now_.ends[std::size_t(end)].force));
    for (const Stretch& stretch : stretches_) {
      const Exact excess =
          moved_.excess[std::size_t(stretch.segments[0])] * W_(stretch.segments[0], stretch.segments[0]);
      worst = std::max({worst, -excess, std::min(excess, tension_[stretch.segments[0]])});
    }
    return worst;
  }

  /// What follows at once from a tension that is given: the extensions of the jacks at work, and the slips of
  /// the joints of a stretch that such a jack leaves without force, where friction has nothing to hold.
  struct Followers {
    struct Law {
      int end = -1, joint = -1;  ///< what moves
      int segment = 0;           ///< whose tension is given
      Exact force = 0;
    };
    std::vector<Law> laws;
    std::vector<bool> rests;  // joints
    Matrix columns;           // segments x laws
    Eigen::FullPivLU<Matrix> factored;

    Vector at(const Vector& T) const {
      Vector forces = Vector::Zero(Index(laws.size()));
      for (Index k = 0; k < forces.size(); ++k) forces[k] = T[laws[std::size_t(k)].segment];
      return forces;
    }
    Vector given() const {
      Vector forces = Vector::Zero(Index(laws.size()));
      for (Index k = 0; k < forces.size(); ++k) forces[k] = laws[std::size_t(k)].force;
      return forces;
    }
    /// Changes T until all laws hold with the given forces; returns by how much everything moves.
    Vector follow(Vector& T, const Vector& forces) const {
      if (laws.empty()) return forces;
      const Vector more = factored.solve(forces - at(T));
      T += columns * more;
      for (Index k = 0; k < forces.size(); ++k) T[laws[std::size_t(k)].segment] = forces[k];
      return more;
    }
  };
  void find_followers(const Drive& drive, Followers& followers) const {
    for (int end = 0; end < int(drive.ends.size()); ++end)
      if (pulls(drive, end))
        followers.laws.push_back({end, -1, end_segment(end), drive.ends[std::size_t(end)].force});
    followers.rests.assign(joints_.size(), false);
    for (const Stretch& stretch : stretches_) {
      bool rests = is_jacked(drive, stretch);
      for (const int end : stretch.ends)
        rests = rests && !(pulls(drive, end) && drive.ends[std::size_t(end)].force > 0);
      if (!rests) continue;
      // Between two jacks the cable may move as a whole: the first joint keeps its place.
      const bool at_end = pulls(drive, stretch.ends[1]), between = at_end && pulls(drive, stretch.ends[0]);
      for (std::size_t i = 0; i < stretch.joints.size(); ++i) {
        followers.rests[std::size_t(stretch.joints[i])] = true;
        if (i == 0 && between) continue;
        followers.laws.push_back({-1, stretch.joints[i], stretch.segments[at_end ? i : i + 1], 0});
      }
    }
    const Index n = Index(followers.laws.size());
    followers.columns.resize(segments(), n);
    Matrix system(n, n);
    for (Index k = 0; k < n; ++k) {
      const auto& law = followers.laws[std::size_t(k)];
      if (law.end >= 0)
        followers.columns.col(k) = W_.col(end_segment(law.end));
      else
        followers.columns.col(k) =
            W_.col(joints_[std::size_t(law.joint)].before) - W_.col(joints_[std::size_t(law.joint)].after);
    }
    for (Index k = 0; k < n; ++k)
      system.row(k) = followers.columns.row(followers.laws[std::size_t(k)].segment);
    followers.factored.compute(n > 0 ? system : Matrix::Identity(1, 1));
  }
  /// What an elongation does to the tensions when the followers follow.
  static Vector effect(const Followers& followers, Vector column) {
    followers.follow(column, Vector::Zero(Index(followers.laws.size())));
    return column;
  }

  /// The next state under `to`; joints further than `reach` from their limit stick. The state changes only if
  /// one is found.
  bool step(const Drive& to, Exact reach, int attempt) {
    Followers followers;
    find_followers(to, followers);
    if (!followers.factored.isInvertible()) return false;
    Moves moves = moved_;
    std::vector<std::size_t> loose;  // stretches that may be slack
    for (std::size_t r = 0; r < stretches_.size(); ++r) {
      Exact& excess = moves.excess[std::size_t(stretches_[r].segments[0])];
      const bool asked =
          !is_jacked(to, stretches_[r]) && (excess > 0 || tension_[stretches_[r].segments[0]] <= reach);
      if (!asked) continue;
      loose.push_back(r);
      excess = 0;
    }
    Vector T = total(to, moves);
    followers.follow(T, followers.given());

    std::vector<std::size_t> able;
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (joints_[j].rho > 0 && !followers.rests[j] &&
          std::min(room(tension_, joints_[j], 0), room(tension_, joints_[j], 1)) <= reach)
        able.push_back(j);
    const Index m = Index(able.size()), n = 2 * m + Index(loose.size());
    Matrix effects(segments(), m + Index(loose.size()));
    Vector unit(effects.cols());  // metres that stand for the largest force
    for (Index k = 0; k < effects.cols(); ++k) {
      Vector column;
      int stiff = 0;
      if (k < m) {
        const Joint& at = joints_[able[std::size_t(k)]];
        column = W_.col(at.before) - W_.col(at.after);
        stiff = at.before;
      } else {
        stiff = stretches_[loose[std::size_t(k - m)]].segments[0];
        column = W_.col(stiff);
      }
      unit[k] = peak_ / W_(stiff, stiff);
      effects.col(k) = effect(followers, column) * (1 / W_(stiff, stiff));
    }
    Matrix M(n, n);
    Vector q(n);
    const auto laws = [&](const auto& tensions, auto write) {
      for (Index i = 0; i < m; ++i)
        for (int way = 0; way < 2; ++way)
          write(2 * i + way, room(tensions, joints_[able[std::size_t(i)]], way));
      for (std::size_t r = 0; r < loose.size(); ++r)
        write(2 * m + Index(r), tensions[stretches_[loose[r]].segments[0]]);
    };
    laws(T, [&](Index row, Exact value) { q[row] = value / peak_; });
    for (Index k = 0; k < effects.cols(); ++k)
      laws(effects.col(k), [&](Index row, Exact value) {
        if (k < m) {
          M(row, 2 * k) = value;
          M(row, 2 * k + 1) = -value;
        } else {
          M(row, m + k) = value;
        }
      });
    Vector z;
    if (!answer(Pivoting(M, q, 2 * m, coarsest_), attempt, z)) return false;
    for (Index k = 0; k < m; ++k) moves.slip[able[std::size_t(k)]] += (z[2 * k] - z[2 * k + 1]) * unit[k];
    for (std::size_t r = 0; r < loose.size(); ++r)
      moves.excess[std::size_t(stretches_[loose[r]].segments[0])] = z[2 * m + Index(r)] * unit[m + Index(r)];
    return settle(to, followers, moves);
  }
  /// Lemke's method, changes in turn, and if there are few combinations all of them.
  bool answer(Pivoting pivoting, int attempt, Vector& z) {
    if (attempt > 0 && pivoting.nothing()) return false;
    if (attempt == 1 && pivoting.few()) return pivoting.try_all(z);
    exhausted_ = exhausted_ && pivoting.few();
    if (pivoting.solve(random_, attempt == 0, z)) return true;
    return pivoting.change_in_turn(random_, attempt == 0, z);
  }
  /// Takes the state if it is one.
  bool settle(const Drive& to, const Followers& followers, Moves& moves) {
    Vector T = total(to, moves);
    const Vector more = followers.follow(T, followers.given());
    for (std::size_t k = 0; k < followers.laws.size(); ++k) {
      const auto& law = followers.laws[k];
      (law.end >= 0 ? moves.extension[std::size_t(law.end)] : moves.slip[std::size_t(law.joint)]) +=
          more[Index(k)];
    }
    for (std::size_t end = 0; end < to.ends.size(); ++end)
      if (to.ends[end].locked) moves.extension[end] = to.ends[end].extension;
    const Exact least = -sound_ * std::max(peak_, T.cwiseAbs().maxCoeff());
    if (!(T.minCoeff() >= least)) return false;
    for (const Joint& at : joints_)
      if (at.rho > 0 && !(std::min(room(T, at, 0), room(T, at, 1)) >= least)) return false;
    moved_ = moves;
    tension_ = T;
    return true;
  }

  /// Of some answers to one step the one with the least change, or the first with less than `enough`.
  bool nearest(const Drive& to, const Moves& from, const Vector& before, Exact reach, Exact enough) {
    Moves best;
    Vector best_T;
    Exact least = -1;
    for (int attempt = 0; attempt < attempts() && !(least >= 0 && least <= enough); ++attempt) {
      moved_ = from;
      tension_ = before;
      if (!step(to, reach, attempt)) continue;
      const Exact change = (tension_ - before).cwiseAbs().maxCoeff();
      if (least >= 0 && change >= least) continue;
      least = change;
      best = moved_;
      best_T = tension_;
    }
    if (least < 0) return false;
    moved_ = best;
    tension_ = best_T;
    return true;
  }

  Exact smallest_pivot() const {
    Followers followers;
    find_followers(now_, followers);
    std::vector<std::pair<const Joint*, int>> at_limit;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Joint& at = joints_[j];
      const Exact forward = room(tension_, at, 0), backward = room(tension_, at, 1);
      if (at.rho > 0 && !followers.rests[j] && std::min(forward, backward) <= Exact(1e-9L) * peak_)
        at_limit.emplace_back(&at, forward <= backward ? 0 : 1);
    }
    const Index n = Index(at_limit.size());
    if (n == 0) return 1;
    Matrix A(n, n);
    for (Index k = 0; k < n; ++k) {
      const Joint& at = *at_limit[std::size_t(k)].first;
      const Vector column =
          effect(followers, Vector(W_.col(at.before) - W_.col(at.after))) * (1 / W_(at.before, at.before));
      for (Index i = 0; i < n; ++i)
        A(i, k) = room(column, *at_limit[std::size_t(i)].first, at_limit[std::size_t(i)].second);
    }
    const Eigen::FullPivLU<Matrix> factored(A);
    const Vector pivots = factored.matrixLU().diagonal().cwiseAbs();
    return pivots.maxCoeff() > 0 ? pivots.minCoeff() / pivots.maxCoeff() : Exact(0);
  }

  const reference::Structure scene_;
  reference::Bars bars_;
  reference::Anatomy anatomy_;
  support::Random random_;
  std::vector<Joint> joints_;
  std::vector<Stretch> stretches_;
  Matrix W_;  // tensions from elongations
  Moves moved_;
  Drive now_;
  Vector tension_;
  Exact peak_ = 0, violation_ = 0, largest_change_ = 0, pivot_ = 1;
  bool exhausted_ = false;
  Exact coarsest_ = 1e-10L;  ///< what the solution of a step may violate
  Exact sound_ = 1e-10L;     ///< what a state may violate, as a part of the largest force
};

LoadSteps::LoadSteps(reference::Structure structure)
    : stepper_(std::make_unique<Stepper>(std::move(structure))) {}
LoadSteps::~LoadSteps() = default;

bool LoadSteps::start(int steps) { return stepper_->start(steps); }
bool LoadSteps::advance(const reference::Row& row, int steps) { return stepper_->advance(row, steps); }
Exact LoadSteps::tension(int segment) const { return stepper_->tension(segment); }
Exact LoadSteps::extension(int end) const { return stepper_->extension(end); }
Exact LoadSteps::violation() const { return stepper_->violation(); }
Exact LoadSteps::largest_change() const { return stepper_->largest_change(); }
LoadSteps::Way LoadSteps::probe(const Drive& now, const Drive& goal, const Moves& moves, Exact peak) {
  return stepper_->probe(now, goal, moves, peak);
}
Exact LoadSteps::pivot() const { return stepper_->pivot(); }
bool LoadSteps::exhausted() const { return stepper_->exhausted(); }

}  // namespace campaign
