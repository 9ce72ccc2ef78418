// The decision of an event, against all combinations of what sticks, slides and goes slack.
#include "taut/tracking/mode_solver.hpp"

#include <doctest/doctest.h>

#include "unit/any_cable.hpp"

namespace mode_solver_test {
using namespace support;
using namespace unit;

namespace {

using taut::JointState;

/// What a solver is tried on: capacity, and whether segments feel one another.
template <class Cap, bool Coupled>
struct Kind {
  using Capacity = Cap;
  static constexpr bool coupled = Coupled;
};
using Structure = Kind<OnStructure, true>;
using Saddles = Kind<OnSaddles, false>;

constexpr double rounding = 1e-9;  // of dense solutions whose condition is at most 1e5
constexpr double none = 1e-13;

/// Rates: tensions, and one for every pair.
struct Rates {
  Vector T, v;
  std::vector<bool> active;
};

/// A rate problem: slips that follow whatever happens with what their laws are due, pairs that may.
template <class Cap>
struct Problem {
  explicit Problem(const AnyCable<Cap>& on) : cable(on) {}

  const AnyCable<Cap>& cable;
  std::vector<taut::ActiveConstraint> follow;
  std::vector<double> due;
  std::vector<taut::ActiveConstraint> pairs;
  std::vector<double> least;  // of a segment's rate of tension
  Vector stuck;

  /// w of a pair: T_small - rho T_big of a joint, T - L of a segment.
  double slack(std::size_t pair, const Vector& T) const {
    const Vector product_of = cable.law(pairs[pair]).cwiseProduct(T);
    return product_of.sum() - (pairs[pair].slides() ? 0 : least[pair]);
  }
  /// The rates if just these pairs are active; false if nothing determines them.
  bool solve(int code, Rates& rates) const {
    std::vector<taut::ActiveConstraint> values = follow;
    Vector dues = Vector::Zero(static_cast<int>(follow.size() + pairs.size()));
    for (std::size_t i = 0; i < due.size(); ++i) dues[static_cast<int>(i)] = due[i];
    rates.active.assign(pairs.size(), false);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      if ((code >> p) % 2 == 0) continue;
      rates.active[p] = true;
      if (!pairs[p].slides()) dues[static_cast<int>(values.size())] = least[p];
      values.push_back(pairs[p]);
    }
    rates.T = stuck;
    rates.v = Vector::Zero(static_cast<int>(pairs.size()));
    if (values.empty()) return true;
    if (values.size() > static_cast<std::size_t>(cable.n())) return false;
    const auto dense = cable.dense(values);
    if (rcond(dense.RW) < 1e-5) return false;
    const Vector m = solved(dense.RW, dues.head(static_cast<int>(values.size())) - product(dense.R, stuck));
    rates.T += product(cable.C, product(dense.E, m));
    for (std::size_t p = 0, at = follow.size(); p < pairs.size(); ++p)
      if (rates.active[p]) {
        rates.v[static_cast<int>(p)] = (pairs[p].sense < 0 ? -1 : 1) * m[static_cast<int>(at)];
        ++at;
      }
    return true;
  }
  bool holds(const Rates& rates) const {
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      if (rates.v[static_cast<int>(p)] < -rounding) return false;
      if (!rates.active[p] && slack(p, rates.T) < -rounding) return false;
    }
    return true;
  }
  /// The rates of every combination that contradicts nothing.
  std::vector<Rates> all_rates() const {
    std::vector<Rates> found;
    for (int code = 0; code < (1 << pairs.size()); ++code) {
      Rates rates;
      if (solve(code, rates) && holds(rates)) found.push_back(rates);
    }
    return found;
  }
};

template <class Cap>
struct Decision {
  using Model = typename AnyCable<Cap>::Model;
  using Laws = typename AnyCable<Cap>::Laws;
  using Solver = taut::ModeSolver<Model, Laws>;
  using Outcome = typename Solver::Outcome;

  taut::ActiveSet<Model, Laws> set;
  Solver solver;

  /// `begun`: slips that are in the set from the start.
  Outcome decide(const Problem<Cap>& problem, bool go_on,
                 const std::vector<taut::ActiveConstraint>& begun = {}) {
    const auto& cable = problem.cable;
    set.begin(cable.model);
    for (const taut::ActiveConstraint& active : problem.follow) REQUIRE(set.append(cable.laws, active));
    for (const taut::ActiveConstraint& active : begun) REQUIRE(set.append(cable.laws, active));
    solver.begin(cable.model, cable.laws, set);
    for (std::size_t p = 0; p < problem.pairs.size(); ++p) {
      const taut::ActiveConstraint& pair = problem.pairs[p];
      if (pair.slides())
        solver.add_slip(taut::SlipMode::of(pair.variable.index,
                                           pair.sense > 0 ? JointState::forward : JointState::backward));
      else
        solver.add_segment(pair.on, problem.least[p]);
    }
    typename Solver::Tensions stuck;
    typename Solver::Values due;
    fill(stuck, problem.stuck);
    due.fill(0);
    for (std::size_t i = 0; i < problem.due.size(); ++i) due[static_cast<int>(i)] = problem.due[i];
    return solver.solve(stuck, due, none, go_on);
  }

  /// Goes on from slips that are in the set: what is decided is one of `found`, and a ray if there is none.
  /// Returns whether it was solved.
  bool check_going_on(const Problem<Cap>& problem, const std::vector<Rates>& found,
                      const std::vector<taut::ActiveConstraint>& begun) {
    const Outcome outcome = decide(problem, true, begun);
    CHECK(outcome == (found.empty() ? Outcome::ray : Outcome::solved));
    if (outcome != Outcome::solved) return false;
    CHECK(is_among(problem, found));
    check_sides(problem);
    return true;
  }

  /// What was decided is one of these.
  bool is_among(const Problem<Cap>& problem, const std::vector<Rates>& found) const {
    const int n = problem.cable.n();
    for (const Rates& rates : found)
      if (largest(to_vector(solver.rates(), n) - rates.T) <= rounding * (1 + largest(rates.T))) return true;
    return false;
  }
  /// Rates and sides agree with one another, by a dense solution with the same pairs active.
  void check_sides(const Problem<Cap>& problem) const {
    int code = 0, active = 0;
    for (std::size_t p = 0; p < problem.pairs.size(); ++p)
      if (solver.is_active(static_cast<int>(p))) {
        code |= 1 << p;
        ++active;
      }
    CHECK(set.size() == static_cast<int>(problem.follow.size()) + active);
    Rates rates;
    if (!problem.solve(code, rates)) return;  // ill-conditioned: the dense solution has no digits to compare
    CHECK(problem.holds(rates));
    const int n = problem.cable.n();
    CHECK(largest(to_vector(solver.rates(), n) - rates.T) <= rounding * (1 + largest(rates.T)));
    for (std::size_t p = 0; p < problem.pairs.size(); ++p) {
      const int i = static_cast<int>(p);
      const double unit = set.stiffness(problem.pairs[p].variable);
      CHECK(std::fabs(solver.value(i) - unit * rates.v[i]) <= rounding * unit * (1 + largest(rates.v)));
    }
  }
};

/// Joints at their limit in a cable under tension that one jack may pull.
template <class Cap>
Problem<Cap> under_tension(const AnyCable<Cap>& cable, Random& random) {
  Problem<Cap> problem(cable);
  if (!cable.model.cables[0].closed && random.coin()) {
    problem.follow.push_back(cable.extension(1));
    problem.due.push_back(random.between(-1, 1));
  }
  for (int j = 0; j < cable.model.joints; ++j)
    if (random.below(4) > 0) {
      problem.pairs.push_back(cable.slip(j, random.coin()));
      problem.least.push_back(0);
    }
  problem.stuck = random_vector(random, cable.n());
  return problem;
}

/// A cable without tension, between anchors or with a jack at its end that begins to pull: every segment may
/// stay slack, or with what friction leaves of the jack's force, and every joint may slide either way.
template <class Cap>
Problem<Cap> from_zero_tension(const AnyCable<Cap>& cable, Random& random) {
  Problem<Cap> problem(cable);
  double pull = 0;
  if (!cable.model.cables[0].closed && random.coin()) {
    pull = random.between(0.1, 1);
    problem.follow.push_back(cable.extension(1));
    problem.due.push_back(pull);
  }
  for (int i = 0; i < cable.n() - static_cast<int>(problem.follow.size()); ++i) {
    double left = pull;
    for (int j = i; pull > 0 && j < cable.model.joints; ++j) left *= cable.model.rho[j];
    problem.pairs.push_back(cable.slack_length(i));
    problem.least.push_back(left);
  }
  for (int j = 0; j < cable.model.joints; ++j)
    for (const bool forward : {true, false}) problem.pairs.push_back(cable.slip(j, forward));
  problem.least.resize(problem.pairs.size(), 0);
  problem.stuck = random_vector(random, cable.n());
  return problem;
}

}  // namespace

TEST_CASE_TEMPLATE(
    "under tension the rates are those of a combination that contradicts nothing, if there is one", On,
    Structure, Saddles) {
  using Decider = Decision<typename On::Capacity>;
  int sliding = 0, impossible = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool closed = random.coin();
    const AnyCable<typename On::Capacity> cable(random, 3 + random.below(4), closed, On::coupled);
    const auto problem = under_tension(cable, random);
    const auto found = problem.all_rates();
    impossible += found.empty() ? 1 : 0;
    // From nothing that slides, and from slips of before that go on or come to rest.
    std::vector<taut::ActiveConstraint> before;
    for (const taut::ActiveConstraint& pair : problem.pairs)
      if (static_cast<int>(before.size()) < 2 && random.coin()) before.push_back(pair);
    for (const auto& begun : {std::vector<taut::ActiveConstraint>{}, before}) {
      CAPTURE(begun.size());
      Decider decision;
      if (!decision.check_going_on(problem, found, begun)) continue;
      sliding += decision.set.size() > static_cast<int>(problem.follow.size()) ? 1 : 0;
    }
  }
  CHECK(sliding >= 300);
  CHECK(impossible >= 2);
}

TEST_CASE_TEMPLATE("from zero tension there are always rates, and they contradict nothing", On, Structure,
                   Saddles) {
  using Decider = Decision<typename On::Capacity>;
  int slack = 0, taut = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool closed = random.below(4) == 0;
    const AnyCable<typename On::Capacity> cable(random, closed ? 3 : 1 + random.below(4), closed,
                                                On::coupled);
    const auto problem = from_zero_tension(cable, random);
    const auto found = problem.all_rates();
    Decider decision;
    REQUIRE(decision.decide(problem, false) == Decider::Outcome::solved);
    CHECK(decision.is_among(problem, found));
    decision.check_sides(problem);
    for (std::size_t p = 0; p < problem.pairs.size(); ++p)
      if (!problem.pairs[p].slides()) ++(decision.solver.is_active(static_cast<int>(p)) ? slack : taut);
  }
  CHECK(slack >= 50);
  CHECK(taut >= 50);
}

TEST_CASE_TEMPLATE("a hoop whose joints all give way the same way ends on a ray of free motion", On,
                   Structure, Saddles) {
  using Decider = Decision<typename On::Capacity>;
  Random random(4);
  const AnyCable<typename On::Capacity> cable(random, 3, true, On::coupled);
  Problem<typename On::Capacity> problem(cable);
  for (int j = 0; j < 3; ++j) problem.pairs.push_back(cable.slip(j, true));
  problem.least.assign(3, 0);
  problem.stuck = Vector::Constant(3, -1);  // T_small - rho T_big falls at every joint
  REQUIRE(problem.all_rates().empty());
  Decider decision;
  CHECK(decision.decide(problem, true) == Decider::Outcome::ray);
  CHECK(decision.solver.is_free());
  CHECK(decision.solver.last_pair() >= 0);
}

TEST_CASE_TEMPLATE("slips that begin the wrong way turn round, or stop", On, Structure, Saddles) {
  using Decider = Decision<typename On::Capacity>;
  int turned = 0, stopped = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const AnyCable<typename On::Capacity> cable(random, 3 + random.below(3), false, On::coupled);
    // Pulled at its end from zero: both limits of every joint hold.
    Problem<typename On::Capacity> problem(cable);
    problem.follow.push_back(cable.extension(1));
    problem.due.push_back(random.between(0.1, 1));
    std::vector<taut::ActiveConstraint> begun;
    for (int j = 0; j < cable.model.joints; ++j) {
      for (const bool forward : {true, false}) problem.pairs.push_back(cable.slip(j, forward));
      begun.push_back(cable.slip(j, random.coin()));
    }
    problem.least.resize(problem.pairs.size(), 0);
    problem.stuck = Vector::Zero(cable.n());
    Decider decision;
    if (!decision.check_going_on(problem, problem.all_rates(), begun)) continue;
    for (int j = 0; j < cable.model.joints; ++j) {
      const bool was_forward = begun[static_cast<std::size_t>(j)].sense > 0;
      turned += decision.solver.is_active(2 * j + (was_forward ? 1 : 0)) ? 1 : 0;
      stopped += !decision.solver.is_active(2 * j) && !decision.solver.is_active(2 * j + 1) ? 1 : 0;
    }
  }
  CHECK(turned >= 100);
  // Between saddles all slide toward the jack.
  CHECK((stopped >= 20 || !On::coupled));
}

TEST_CASE("where nothing is violated nothing slides") {
  Random random(5);
  const AnyCable<OnStructure> cable(random, 4, false, true);
  Problem<OnStructure> problem(cable);
  for (int j = 0; j < 3; ++j) problem.pairs.push_back(cable.slip(j, j == 1));
  problem.least.assign(3, 0);
  problem.stuck = Vector::Constant(4, 1);
  Decision<OnStructure> decision;
  REQUIRE(decision.decide(problem, true) == Decision<OnStructure>::Outcome::solved);
  CHECK(decision.set.size() == 0);
  for (int i = 0; i < 4; ++i) CHECK(decision.solver.rates()[i] == 1);
}

}  // namespace mode_solver_test
