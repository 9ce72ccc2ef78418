#include "arch.hpp"

#include "exported.hpp"

namespace arch = scene_2_arches_ber;

TEST_CASE("an elastic scene is exported with every bit, and tracked as the program tracks it") {
  exported::check<2>("arch", arch::condensed<float>, &arch::struts<float>);
  exported::check<2>("arch", arch::condensed<double>, &arch::struts<double>);
}

TEST_CASE("names keep their bytes whatever they are") {
  CHECK(std::string(arch::names::cables[1]) == "\xC3\xBC?");
  CHECK(std::string(arch::names::loads[0]) == "snow");
  CHECK(std::string(arch::names::joint_nodes[3]) == "b");
}

TEST_CASE("a joint that is locked by friction is exported as locked") {
  CHECK(arch::condensed<float>.is_locked(3));
  CHECK_FALSE(arch::condensed<float>.is_locked(0));
}
