#include "net.hpp"

#include "exported.hpp"

namespace net_test {

TEST_CASE("a node that cables alone hold keeps the coupling between their segments") {
  CHECK_FALSE(taut::has_rigid_saddles<net::Capacity>);
  exported::check<3, net::unknowns>("net", net::condensed<float>, net::prior<float>);
  exported::check<3, net::unknowns>("net", net::condensed<double>, net::prior<double>);
}

}  // namespace net_test
