#include "mast.hpp"

#include "exported.hpp"

namespace mast_test {

TEST_CASE("in space a bar leans along two normals, and all of them are exported") {
  static_assert(mast::Capacity::normals == 2);
  exported::check<3, mast::unknowns, mast::reading_unknowns>("mast", mast::condensed<float>,
                                                             mast::prior<float>, &mast::struts<float>);
  exported::check<3, mast::unknowns, mast::reading_unknowns>("mast", mast::condensed<double>,
                                                             mast::prior<double>, &mast::struts<double>);
}

}  // namespace mast_test
