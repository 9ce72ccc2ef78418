#include "wire.hpp"

#include "exported.hpp"

TEST_CASE("a cable of one segment without joints and loads is exported like any other") {
  exported::check<2>("wire", scene_double::condensed<float>);
  exported::check<2>("wire", scene_double::condensed<double>);
}
