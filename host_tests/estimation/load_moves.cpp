// Whether a load goes on, beside its noise.
#include "taut/estimation/load_moves.hpp"

#include <doctest/doctest.h>

#include "support/random.hpp"

namespace load_moves_test {
namespace {

constexpr double noise = 100;

/// Rows of a load that goes on by so much in each; how many of them it has gone on in.
int gone(taut::LoadMoves<double>& moves, double& load, double by, int rows, bool after_pause = false) {
  int count = 0;
  for (int row = 0; row < rows; ++row) {
    moves.follow(load += by, noise, after_pause);
    count += moves.has_gone() ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("a load that goes on by the noise in every row does so every few rows, and rests after eight") {
  taut::LoadMoves<double> moves;
  double load = 0;
  CHECK(gone(moves, load, noise, 100) == 25);
  CHECK(moves.is_fast());
  CHECK(gone(moves, load, 0, 8) == 0);
  CHECK(moves.is_fast());
  CHECK(gone(moves, load, 0, 1) == 0);
  CHECK_FALSE(moves.is_fast());
}

TEST_CASE("a load that creeps goes on now and then, and counts as one that rests") {
  taut::LoadMoves<double> moves;
  double load = 0;
  for (int row = 0; row < 10; ++row) {
    CHECK(gone(moves, load, noise / 10, 31) == 1);
    CHECK_FALSE(moves.is_fast());
  }
}

TEST_CASE("after a pause one row tells whether a load goes on or rests") {
  taut::LoadMoves<double> moves;
  double load = 0;
  CHECK(gone(moves, load, 1e4, 3, true) == 3);
  CHECK(moves.is_fast());
  CHECK(gone(moves, load, 0, 1, true) == 0);
  CHECK_FALSE(moves.is_fast());
}

TEST_CASE("noise alone is no load that goes on") {
  support::Random random(20261126);
  int gone = 0;
  taut::LoadMoves<double> moves;
  // A best estimate is no noisier than a reading.
  for (int row = 0; row < 10000; ++row) {
    moves.follow(noise * support::gaussian(random) / 2, noise, false);
    gone += moves.has_gone() ? 1 : 0;
  }
  CHECK(gone < 20);
  CHECK_FALSE(moves.is_fast());
}

}  // namespace load_moves_test
