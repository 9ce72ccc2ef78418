// A wedge that is drawn in by nobody knows how much: how far joints slide back is not in proportion to that.
// Error bars against a closed form between rigid saddles, with draw-ins from another generator.
#include <doctest/doctest.h>

#include "estimation/jacked_chain.hpp"
#include "taut/estimation/draw_in.hpp"

using namespace estimation;

namespace {

constexpr double uncertain = 0.05;

std::vector<double> alike(support::Random& random) {
  return std::vector<double>(segments - 1, mu * (1 + uncertain * support::gaussian(random)));
}
Said said(double far_sd, double seating_sd) {
  Said said;
  said.mu_sd = uncertain * mu;
  said.jack_sd = 2e-3 * full;
  said.far_sd = far_sd;
  said.seating_sd = seating_sd;
  return said;
}
void check_score(const Score& score) {
  CHECK(score.share() > 0.92);
  CHECK(score.share() < 0.995);
  CHECK(score.rms() > 0.6);
  CHECK(score.rms() < 1.15);
}

}  // namespace

TEST_CASE("what a wedge leaves is as uncertain as its draw-in, whichever joint it reaches") {
  const auto scores = lock_off(said(0, 0.5), 3, alike);
  check_score(scores.at_once);
  check_score(scores.later);
}

TEST_CASE("a far end that a wedge did not reach tells that its draw-in is less, and not by how much") {
  const auto scores = lock_off(said(2e-3 * full, 0.5), 40, alike);
  check_score(scores.at_once);
  check_score(scores.later);
}
