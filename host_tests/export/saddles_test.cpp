#include "saddles.hpp"

#include "exported.hpp"

namespace {

// The same counts with a structure between the cables.
struct Elastic : saddles::Capacity {
  static constexpr int substructures = 1;
};

}  // namespace

TEST_CASE("a scene between rigid saddles is exported with every bit, and tracked as the program tracks it") {
  exported::check<2>("saddles", saddles::condensed<float>);
  exported::check<2>("saddles", saddles::condensed<double>);
}

TEST_CASE("between rigid saddles no coupling matrix is stored") {
  constexpr std::size_t n = saddles::Capacity::segments;
  CHECK(taut::has_rigid_saddles<saddles::Capacity>);
  CHECK(sizeof(saddles::condensed<float>) + (n * n - n) * sizeof(double) ==
        sizeof(taut::Condensed<float, Elastic>));
}
