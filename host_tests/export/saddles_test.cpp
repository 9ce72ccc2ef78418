#include "saddles.hpp"

#include "exported.hpp"

namespace saddles_test {
namespace {

// The same counts with a structure between the cables.
struct Elastic : saddles::Capacity {
  static constexpr int substructures = 1;
};

}  // namespace

TEST_CASE("a scene between rigid saddles is exported with every bit, and tracked as the program tracks it") {
  exported::check<2, saddles::unknowns>("saddles", saddles::condensed<float>, saddles::prior<float>);
  exported::check<2, saddles::unknowns>("saddles", saddles::condensed<double>, saddles::prior<double>);
}

TEST_CASE("between rigid saddles no coupling matrix is stored") {
  constexpr std::size_t n = saddles::Capacity::segments;
  CHECK(taut::has_rigid_saddles<saddles::Capacity>);
  CHECK(sizeof(saddles::condensed<float>) + (n * n - n) * sizeof(double) ==
        sizeof(taut::Condensed<float, Elastic>));
}

TEST_CASE("where the scene is silent, half of the mean mu is its standard deviation") {
  static_assert(saddles::unknowns == 3 + 1 + 1);
  CHECK(saddles::prior<double>.mu_sd[0] == doctest::Approx(0.075));
  CHECK(saddles::prior<double>.mu_sd[1] == doctest::Approx(0.05));
}

}  // namespace saddles_test
