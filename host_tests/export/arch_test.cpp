#include "arch.hpp"

#include "exported.hpp"

namespace arch_test {

namespace arch = scene_2_arches_ber;

TEST_CASE("an elastic scene is exported with every bit, and tracked as the program tracks it") {
  exported::check<2, arch::unknowns>("arch", arch::condensed<float>, arch::prior<float>,
                                     &arch::struts<float>);
  exported::check<2, arch::unknowns>("arch", arch::condensed<double>, arch::prior<double>,
                                     &arch::struts<double>);
}

TEST_CASE("names keep their bytes whatever they are") {
  CHECK(std::string(arch::names::cables[1]) == "\xC3\xBC?");
  CHECK(std::string(arch::names::loads[0]) == "snow");
  CHECK(std::string(arch::names::joint_nodes[3]) == "b");
}

TEST_CASE("a joint that locks itself by friction is exported as self-locking") {
  CHECK(arch::condensed<float>.is_self_locking(3));
  CHECK_FALSE(arch::condensed<float>.is_self_locking(0));
}

TEST_CASE(
    "unknowns: one mu for all joints of a cable, none of a self-locking joint, three memories of a noisy "
    "jack beside other loads, a draw-in of every wedge") {
  static_assert(arch::unknowns == 1 + 3 + 2);
}

TEST_CASE("strokes that the scene describes are listed by cable and end, a free zero as unknown altogether") {
  constexpr auto& strokes = arch::strokes<float>;
  static_assert(strokes.size() == 2);
  CHECK(strokes[0].cable == 0);
  CHECK(strokes[0].end == 0);
  CHECK(strokes[0].sd == 0.0004F);
  CHECK(strokes[0].gain_sd == 0.03F);
  CHECK(strokes[0].zero_sd == 0);
  CHECK(strokes[1].end == 1);
  CHECK(arch::strokes<double>[1].sd == 0.0005);
  CHECK(strokes[1].zero_sd == taut::free_zero<float>);
  // A gain each, and one zero.
  static_assert(arch::reading_unknowns == 3);
  taut::Estimator<taut::Condensed<float, arch::Capacity>, arch::unknowns, arch::reading_unknowns> estimator;
  CHECK(estimator.start(arch::condensed<float>, arch::prior<float>, {}, strokes.items).status.ok());
}

TEST_CASE("deviations of mu and of load cells are those of the scene; without one a jack is exact") {
  // 0.03 and, of three joints that scatter by the usual tenth of 0.15, what is left in the sum of their
  // friction.
  CHECK(arch::prior<double>.mu_sd[0] == doctest::Approx(0.03136651279).epsilon(1e-8));
  CHECK(arch::prior<double>.shared[0]);
  CHECK(arch::prior<double>.cell[0][0].sd == 20);
  CHECK(arch::prior<double>.cell[0][1].sd == 0);
}

}  // namespace arch_test
