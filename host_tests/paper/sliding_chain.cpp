// Section 4.2: a cable of four segments that slides over three joints, Eq. (43).
//
// The angles are our own: Fig. 10 is not available, and so are the measured forces of Fig. 14.
#include "checks.hpp"

namespace sliding_chain_test {
namespace {

using namespace paper;

template <class Scalar>
void check_tensions(double tolerance) {
  const auto found = checked_answer<Scalar>(sliding_chain(), chain_drive);
  const std::array<double, 4> expected = chain_by_hand();
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(close(static_cast<double>(found.tension[i]), expected[static_cast<std::size_t>(i)], tolerance));
  }
}

TEST_CASE("Eq. (43) gives the forces of all four segments behind a jack of 400 N") {
  check_tensions<double>(1e-12);
  check_tensions<float>(1e-6);
}

TEST_CASE("every joint of the chain slides towards the jack at its friction limit") {
  const auto found = checked_answer<double>(sliding_chain(), chain_drive);
  for (int j = 0; j < 3; ++j) {
    CAPTURE(j);
    CHECK(found.state[j] == taut::JointState::forward);
    CHECK(close(found.friction[j], chain_mu * found.contact[j], 1e-12));
  }
}

TEST_CASE("over each joint goes what all segments behind it stretch") {
  const auto found = checked_answer<double>(sliding_chain(), chain_drive);
  const std::array<double, 4> T = chain_by_hand();
  double stretch = 0;
  for (int j = 0; j < 4; ++j) {
    CAPTURE(j);
    const auto i = static_cast<std::size_t>(j);
    stretch += T[i] * chain_length[i] / (E_steel * chain_A);
    CHECK(close(j < 3 ? found.slip[j] : found.extension[0][1], stretch, 1e-12));
  }
}

TEST_CASE("the forces of the chain do not depend on the number of load steps") {
  const auto once = checked_answer<double>(sliding_chain(), chain_drive);
  const auto often = checked_answer<double>(sliding_chain(), chain_drive, 100);
  for (int i = 0; i < 4; ++i) CHECK(close(often.tension[i], once.tension[i], 1e-12));
}

}  // namespace

}  // namespace sliding_chain_test
