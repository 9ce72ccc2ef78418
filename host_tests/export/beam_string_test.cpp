#include "beam_string.hpp"

#include "exported.hpp"

namespace beam_string_test {

TEST_CASE(
    "a scene in second-order theory is exported with every bit, beams and pinned struts too, and tracked as "
    "the program tracks it") {
  exported::check<2, beam_string::unknowns, beam_string::reading_unknowns>(
      "beam_string", beam_string::condensed<float>, beam_string::prior<float>, &beam_string::struts<float>);
  exported::check<2, beam_string::unknowns, beam_string::reading_unknowns>(
      "beam_string", beam_string::condensed<double>, beam_string::prior<double>,
      &beam_string::struts<double>);
}

}  // namespace beam_string_test
