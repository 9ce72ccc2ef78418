#include "wire.hpp"

#include "exported.hpp"

namespace wire_test {

TEST_CASE("a cable of one segment without joints and loads is exported like any other") {
  exported::check<2, scene_double::unknowns>("wire", scene_double::condensed<float>,
                                             scene_double::prior<float>);
  exported::check<2, scene_double::unknowns>("wire", scene_double::condensed<double>,
                                             scene_double::prior<double>);
}

TEST_CASE("with nothing unknown there is room for one unknown") {
  static_assert(scene_double::unknowns == 1);
}

}  // namespace wire_test
