// Slips that follow their laws, and the map from inputs to tensions, against dense solutions.
#include "taut/tracking/active_set.hpp"

#include <doctest/doctest.h>

#include <type_traits>

#include "taut/tracking/affine_map.hpp"
#include "unit/any_cable.hpp"

namespace active_set_test {
using namespace support;
using namespace unit;

namespace {

/// What a set is tried on: capacity, and whether segments feel one another.
template <class Cap, bool Coupled>
struct Kind {
  using Capacity = Cap;
  static constexpr bool coupled = Coupled;
};
using Structure = Kind<OnStructure, true>;
using Saddles = Kind<OnSaddles, false>;
using SaddlesAmongStructures = Kind<OnEither, false>;
using StructureAmongSaddles = Kind<OnEither, true>;

constexpr double rounding = 1e-14;

template <class Cable>
using SetOn = taut::ActiveSet<typename Cable::Model, typename Cable::Laws>;

/// The set has these slips and lets them follow as the dense solution says.
template <class Cable>
void check_set(const Cable& cable, const SetOn<Cable>& set, const std::vector<taut::ActiveConstraint>& values,
               Random& random, int passes, const Matrix& coupling) {
  REQUIRE(set.size() == static_cast<int>(values.size()));
  const auto dense = cable.dense(values, coupling);
  const Vector T = random_vector(random, cable.n()), due = random_vector(random, set.size());
  const Vector m = set.size() == 0 ? Vector(0) : solved(dense.RW, due - product(dense.R, T));
  const Vector expected = T + product(coupling, product(dense.E, m));

  typename Cable::Tensions found;
  typename SetOn<Cable>::Values dues, moved;
  fill(found, T);
  fill(dues, due);
  fill(moved, Vector::Ones(set.size()));  // what is there already is added to
  set.settle(cable.laws, dues, found, moved, passes);
  const double lost = set.size() == 0 ? 1 : 1 / rcond(dense.RW);
  CHECK(largest(to_vector(found, cable.n()) - expected) <= rounding * lost * (1 + largest(expected)));
  CHECK(largest(to_vector(moved, set.size()) - m - Vector::Ones(set.size())) <=
        rounding * lost * (1 + largest(m)));
}
template <class Cable>
void check_set(const Cable& cable, const SetOn<Cable>& set, const std::vector<taut::ActiveConstraint>& values,
               Random& random, int passes) {
  check_set(cable, set, values, random, passes, cable.C);
}

/// Appends random slips, those that can be; what can be is said by the rank of the dense matrix.
template <class Cable>
std::vector<taut::ActiveConstraint> fill_at_random(const Cable& cable, SetOn<Cable>& set, Random& random,
                                                   int& refused) {
  std::vector<taut::ActiveConstraint> values;
  for (int count = 0; count < 2 * cable.n(); ++count) {
    const taut::ActiveConstraint slip = cable.any(random);
    std::vector<taut::ActiveConstraint> more = values;
    more.push_back(slip);
    const bool independent =
        more.size() <= static_cast<std::size_t>(cable.n()) && rcond(cable.dense(more).RW) > 1e-11;
    CAPTURE(static_cast<int>(slip.variable.kind));
    CAPTURE(slip.variable.index);
    CAPTURE(static_cast<int>(slip.sense));
    CAPTURE(values.size());
    REQUIRE(set.append(cable.laws, slip) == independent);
    if (independent)
      values = more;
    else
      ++refused;
    CHECK(set.size() == static_cast<int>(values.size()));
  }
  return values;
}

}  // namespace

TEST_CASE_TEMPLATE("slips are taken in while their laws are independent, and follow like the dense solution",
                   On, Structure, Saddles, SaddlesAmongStructures, StructureAmongSaddles) {
  int refused = 0, full = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool closed = random.coin();
    const AnyCable<typename On::Capacity> cable(
        random, closed ? 3 + random.below(most - 2) : 1 + random.below(most), closed, On::coupled);
    SetOn<AnyCable<typename On::Capacity>> set;
    set.begin(cable.model);
    const auto values = fill_at_random(cable, set, random, refused);
    full += set.is_full() ? 1 : 0;
    check_set(cable, set, values, random, 1);
    check_set(cable, set, values, random, 8);
  }
  CHECK(refused >= 200);
  CHECK(full >= 20);
}

TEST_CASE_TEMPLATE("what is left after slips were taken away follows like the dense solution", On, Structure,
                   Saddles, SaddlesAmongStructures, StructureAmongSaddles) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool closed = random.coin();
    const AnyCable<typename On::Capacity> cable(random, 3 + random.below(most - 2), closed, On::coupled);
    SetOn<AnyCable<typename On::Capacity>> set;
    set.begin(cable.model);
    int refused = 0;
    auto values = fill_at_random(cable, set, random, refused);
    // The order of those that stay may change where a pivot is small: it is read from the set.
    const auto listed = [&] {
      return std::vector<taut::ActiveConstraint>(set.actives().begin(), set.actives().end());
    };
    const int one = random.below(set.size());
    if (!set.remove(cable.laws, one)) continue;  // the others depend on one another without it
    CHECK(set.size() + 1 == static_cast<int>(values.size()));
    check_set(cable, set, listed(), random, 8);
    const int before = set.size();
    std::vector<bool> leaves;
    int leaving = 0;
    for (int i = 0; i < before; ++i) {
      leaves.push_back(random.coin());
      leaving += leaves.back() ? 1 : 0;
    }
    if (!set.remove_if(cable.laws, [&](int i) { return leaves[static_cast<std::size_t>(i)]; })) continue;
    CHECK(set.size() == before - leaving);
    check_set(cable, set, listed(), random, 8);
    set.truncate(set.size() / 2);
    check_set(cable, set, listed(), random, 8);
    set.clear();
    check_set(cable, set, {}, random, 8);
  }
}

TEST_CASE_TEMPLATE("a slip whose law follows from the others is refused", On, Structure, Saddles,
                   SaddlesAmongStructures, StructureAmongSaddles) {
  Random random(17);
  using Cable = AnyCable<typename On::Capacity>;
  SUBCASE("the tension of a segment is given twice") {
    const Cable cable(random, 5, false, On::coupled);
    SetOn<Cable> set;
    set.begin(cable.model);
    CHECK(set.append(cable.laws, cable.extension(1)));
    CHECK_FALSE(set.append(cable.laws, cable.slack_length(4)));
    CHECK(set.append(cable.laws, cable.slack_length(3)));
    check_set(cable, set, {cable.extension(1), cable.slack_length(3)}, random, 8);
  }
  SUBCASE("a joint slides between two segments whose tensions are given") {
    const Cable cable(random, 5, false, On::coupled);
    SetOn<Cable> set;
    set.begin(cable.model);
    CHECK(set.append(cable.laws, cable.slack_length(1)));
    CHECK(set.append(cable.laws, cable.slack_length(2)));
    CHECK_FALSE(set.append(cable.laws, cable.slip(1, true)));
    CHECK(set.append(cable.laws, cable.slip(2, true)));
    CHECK_FALSE(
        set.append(cable.laws, cable.slack_length(3)));  // segment 3 has its tension through the joint
  }
  SUBCASE("a hoop slides around as a whole") {
    const Cable cable(random, 4, true, On::coupled);
    SetOn<Cable> set;
    set.begin(cable.model);
    for (int joint = 0; joint < 3; ++joint) CHECK(set.append(cable.laws, cable.slip(joint, joint != 1)));
    CHECK_FALSE(set.append(cable.laws, cable.slip(3, true)));
    CHECK(set.append(cable.laws, cable.slack_length(2)));
  }
  SUBCASE("a cable slides through from jack to jack") {
    const Cable cable(random, 3, false, On::coupled);
    SetOn<Cable> set;
    set.begin(cable.model);
    CHECK(set.append(cable.laws, cable.extension(0)));
    CHECK(set.append(cable.laws, cable.slip(0, true)));
    CHECK(set.append(cable.laws, cable.slip(1, true)));
    CHECK(set.is_full());
    CHECK_FALSE(set.append(cable.laws, cable.extension(1)));
  }
}

TEST_CASE("factors made anew in the order of entry give the same bits") {
  using Cable = AnyCable<OnStructure>;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Cable cable(random, most, false, true);
    SetOn<Cable> set, anew;
    set.begin(cable.model);
    anew.begin(cable.model);
    int refused = 0;
    (void)fill_at_random(cable, set, random, refused);
    if (!set.remove(cable.laws, random.below(set.size()))) continue;
    for (const taut::ActiveConstraint& active : set.actives()) REQUIRE(anew.append(cable.laws, active));
    Cable::Tensions T, again;
    SetOn<Cable>::Values due, moved, moved_again;
    fill(T, random_vector(random, most));
    fill(due, random_vector(random, set.size()));
    again = T;
    moved.fill(0);
    moved_again.fill(0);
    set.settle(cable.laws, due, T, moved);
    anew.settle(cable.laws, due, again, moved_again);
    for (int i = 0; i < most; ++i) CHECK(T[i] == again[i]);
    for (int i = 0; i < set.size(); ++i) CHECK(moved[i] == moved_again[i]);
  }
}

/// The largest difference between derivatives and slips that settle alike from random values: relative, over
/// `lost` by conditioning; and whether derivatives settle in Scalar.
struct Derivatives {
  double off = 0;
  bool in_scalar = false;
};
template <class Scalar, class Cable>
Derivatives settle_derivatives(const Cable& cable, const SetOn<Cable>& set, Random& random, double lost) {
  typename Cable::Tensions T;
  typename SetOn<Cable>::Values due, moved;
  fill(T, random_vector(random, cable.n()));
  fill(due, random_vector(random, set.size()));
  fill(moved, random_vector(random, set.size()));
  Derivatives found;
  set.settle_derivatives(cable.laws, [&](auto zero, const auto& settle) {
    using Number = decltype(zero);
    found.in_scalar = std::is_same<Number, Scalar>::value;
    typename SetOn<Cable>::template Along<Number> followed;
    typename SetOn<Cable>::template By<Number> dues, by;
    for (int i = 0; i < most; ++i) followed[i] = static_cast<Number>(T[i]);
    for (int i = 0; i < set.size(); ++i) {
      dues[i] = static_cast<Number>(due[i]);
      by[i] = static_cast<Number>(moved[i]);
    }
    settle(dues, followed, by);
    set.settle(cable.laws, due, T, moved);
    const auto compare = [&](const auto& some, const auto& others, int n) {
      const double largest_one = 1 + largest(to_vector(others, n));
      for (int i = 0; i < n; ++i)
        found.off =
            std::fmax(found.off, std::fabs(static_cast<double>(some[i]) - others[i]) / (largest_one * lost));
    };
    compare(followed, T, cable.n());
    compare(by, moved, set.size());
  });
  return found;
}
template <class On, class Scalar>
Derivatives settle_derivatives(std::uint64_t seed) {
  using Cable = AnyCable<typename On::Capacity, Scalar>;
  Random random(seed);
  const Cable cable(random, 3 + random.below(most - 2), random.coin(), On::coupled);
  SetOn<Cable> set;
  set.begin(cable.model);
  int refused = 0;
  const auto values = fill_at_random(cable, set, random, refused);
  REQUIRE_FALSE(values.empty());
  return settle_derivatives<Scalar>(cable, set, random, 1 / rcond(cable.dense(values).RW));
}

TEST_CASE_TEMPLATE("derivatives settle as slips do, to the digits of the scalar", On, Structure, Saddles,
                   SaddlesAmongStructures, StructureAmongSaddles) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    CHECK(settle_derivatives<On, double>(seed).off == 0);
    const Derivatives in_float = settle_derivatives<On, float>(seed);
    CHECK(in_float.off < 3e-7);
    CHECK(in_float.in_scalar);
  }
}

TEST_CASE_TEMPLATE("derivatives settle as slips do, to the last bit where laws all but depend on one another",
                   On, Structure, StructureAmongSaddles) {
  using Cable = AnyCable<typename On::Capacity, float>;
  Random random(1);
  Cable cable(random, 4, false, true);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) cable.model.coupling.set(i, k, i == k ? 1 + 1e-6 : 1);
  SetOn<Cable> set;
  set.begin(cable.model);
  REQUIRE(set.append(cable.laws, cable.extension(1)));
  CHECK(settle_derivatives<float>(cable, set, random, 1).in_scalar);
  REQUIRE(set.append(cable.laws, cable.slip(0, true)));
  const Derivatives found = settle_derivatives<float>(cable, set, random, 1);
  CHECK_FALSE(found.in_scalar);
  CHECK(found.off == 0);
  set.truncate(1);
  CHECK(settle_derivatives<float>(cable, set, random, 1).in_scalar);
}

TEST_CASE("springs that hold the segments count as stiffness of their own") {
  using Cable = AnyCable<OnStructure>;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Cable cable(random, most, false, true);
    SetOn<Cable> set;
    set.begin(cable.model);
    set.hold(0.5);
    Matrix held = cable.C;
    held.diagonal() *= 1.5;
    std::vector<taut::ActiveConstraint> values;
    for (const int joint : {2, 5, 0}) {
      values.push_back(cable.slip(joint, random.coin()));
      REQUIRE(set.append(cable.laws, values.back()));
    }
    check_set(cable, set, values, random, 1, held);
  }
}

TEST_CASE_TEMPLATE("tensions are the affine map of the inputs that the laws of the active variables give", On,
                   Structure, Saddles, SaddlesAmongStructures) {
  using Cable = AnyCable<typename On::Capacity>;
  using Map = taut::AffineMap<typename Cable::Model, typename Cable::Laws>;
  using Kind = taut::Input::Kind;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Cable cable(random, 3 + random.below(most - 2), false, On::coupled);
    const int n = cable.n();
    Map map;
    map.begin(cable.model);
    map.clear_inputs();
    map.add_input(Kind::load, 1);
    map.add_input(Kind::jack_force, 1);
    map.add_input(Kind::extension, 0);
    map.add_input(Kind::prestrain, 0);
    map.add_input(Kind::load, 0);
    REQUIRE(map.inputs() == 5);
    // The jack at the end pulls and some joints slide; the jack at the start is locked.
    std::vector<taut::ActiveConstraint> active;
    for (int j = cable.model.joints - 1; j >= 0; --j)
      if (random.coin()) active.push_back(cable.slip(j, random.coin()));
    active.insert(active.begin() + random.below(static_cast<int>(active.size()) + 1), cable.extension(1));
    for (const taut::ActiveConstraint& each : active) REQUIRE(map.set().append(cable.laws, each));
    const auto dense = cable.dense(active);
    const double lost = 1 / rcond(dense.RW);
    std::size_t jack = 0;
    while (active[jack].slides()) ++jack;

    // What inputs and frozen slips make while nothing follows, and what the laws are to be.
    const Vector frozen = random_vector(random, n), begun = random_vector(random, map.active());
    const auto followed_by_none = [&](const Vector& x) {
      Vector e = frozen + product(dense.E, begun);
      e[0] += x[2];
      return Vector(product(cable.C, e) + x[0] * to_vector(cable.model.load[1], n) +
                    x[3] * to_vector(cable.model.prestrain, n) + x[4] * to_vector(cable.model.load[0], n));
    };
    const auto moves_at = [&](const Vector& x) {
      Vector due = Vector::Zero(map.active());
      due[static_cast<int>(jack)] = x[1];
      return Vector(solved(dense.RW, due - product(dense.R, followed_by_none(x))));
    };
    const auto tensions_at = [&](const Vector& x) {
      return Vector(followed_by_none(x) + product(cable.C, product(dense.E, moves_at(x))));
    };

    const Vector anchor = random_vector(random, 5);
    typename Map::Inputs anchored, inputs;
    typename Map::Tensions T;
    typename Map::Values values;
    fill(anchored, anchor);
    fill(T, followed_by_none(anchor));
    fill(values, begun);
    map.make(cable.laws, T, values, anchored);
    CHECK_FALSE(map.has_slack());

    const auto mapped = [&](const Vector& x) {
      fill(inputs, x);
      map.tensions(inputs, T);
      return to_vector(T, n);
    };
    const Vector x = 3 * random_vector(random, 5), y = 3 * random_vector(random, 5);
    for (const Vector& at : {anchor, x, y}) {
      const Vector expected = tensions_at(at), moved = begun + moves_at(at);
      CHECK(largest(mapped(at) - expected) <= rounding * lost * (1 + largest(expected)));
      for (int i = 0; i < map.active(); ++i)
        CHECK(std::fabs(map.value(i, inputs) - moved[i]) <= rounding * lost * (1 + largest(moved)));
      CHECK(map.law_violation(cable.laws, T, inputs) <= rounding * lost * (1 + largest(expected)));
    }
    // Affine: halfway between two inputs are the tensions halfway.
    const double scale = 1 + largest(mapped(x)) + largest(mapped(y));
    CHECK(largest(mapped(0.25 * x + 0.75 * y) - 0.25 * mapped(x) - 0.75 * mapped(y)) <= rounding * scale);
    // Rates are differences.
    const Vector difference = mapped(y) - mapped(x);
    fill(inputs, y - x);
    map.tension_rates(inputs, T);
    CHECK(largest(to_vector(T, n) - difference) <= rounding * scale);
    const Vector gone = moves_at(y) - moves_at(x);
    fill(inputs, y - x);
    bool all_go_on = true;
    for (int i = 0; i < map.active(); ++i) {
      CHECK(std::fabs(map.value_rate(i, inputs) - gone[i]) <= rounding * lost * (1 + largest(gone)));
      all_go_on = all_go_on && active[static_cast<std::size_t>(i)].sense * gone[i] >= 0;
    }
    CHECK(map.goes_on(inputs, 0) == all_go_on);
    // And so are columns.
    for (int k = 0; k < 5; ++k) {
      const Vector unit = Vector::Unit(5, k), moved = moves_at(anchor + unit) - moves_at(anchor);
      CHECK(largest(to_vector(map.column(k), n) - (tensions_at(anchor + unit) - tensions_at(anchor))) <=
            10 * rounding * lost * scale);
      bool up = true, down = true;
      for (int i = 0; i < map.active(); ++i) {
        const double along = active[static_cast<std::size_t>(i)].sense * moved[i];
        if (std::fabs(along) > 1e-9) (along > 0 ? down : up) = false;
      }
      CHECK(map.keeps(k, true) == up);
      CHECK(map.keeps(k, false) == down);
    }

    // With springs, laws may imply one another: nothing is kept.
    map.set().clear();
    map.set().hold(1e-8);
    for (const taut::ActiveConstraint& each : active) REQUIRE(map.set().append(cable.laws, each));
    map.make(cable.laws, T, values, anchored);
    CHECK(map.is_held() == On::coupled);
    for (int k = 0; k < map.inputs() && map.is_held(); ++k)
      for (const bool up : {false, true}) CHECK_FALSE(map.keeps(k, up));
    CHECK_FALSE((map.is_held() && map.keeps(inputs, inputs)));
  }
}

}  // namespace active_set_test
