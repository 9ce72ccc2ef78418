#include "net.hpp"

#include "exported.hpp"

TEST_CASE("a node that cables alone hold keeps the coupling between their segments") {
  CHECK_FALSE(taut::has_rigid_saddles<net::Capacity>);
  exported::check<3>("net", net::condensed<float>);
  exported::check<3>("net", net::condensed<double>);
}
