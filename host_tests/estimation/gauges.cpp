// Gauges: their unknowns, their marks, which of their readings count, and when a cable surely slides.
#include "taut/estimation/gauges.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "support/random.hpp"

namespace gauges_test {
using taut::Gauge;

namespace {

using Cell = taut::LoadCell<double>;
constexpr int capacity = 3;
using Gauges = taut::Gauges<double, capacity>;

Cell with_noise(double sd) {
  Cell cell;
  cell.sd = sd;
  return cell;
}
Cell with_free_zero(double sd) {
  Cell cell = with_noise(sd);
  cell.zero_sd = taut::free_zero<double>;
  return cell;
}
/// Numbers unknowns in turn while there is room.
struct Numbering {
  std::vector<double> deviations;
  int room = 100;
  int operator()(double sd) {
    if (static_cast<int>(deviations.size()) == room) return -1;
    deviations.push_back(sd);
    return static_cast<int>(deviations.size()) - 1;
  }
};
int start(Gauges& gauges, const std::vector<Cell>& cells, Numbering& numbering) {
  return gauges.start(cells, [&](double sd) { return numbering(sd); });
}
Gauges started(const std::vector<Cell>& cells) {
  Gauges gauges;
  Numbering numbering;
  REQUIRE(start(gauges, cells, numbering) == 0);
  return gauges;
}

struct Prediction {
  double value = 0;
  std::array<double, 8> H{};
  bool has_zero = false;
  int zero = 0;
};

}  // namespace

TEST_CASE("gain and zero are unknowns as far as they are not known; hysteresis is none") {
  Cell known = with_noise(1), all = with_noise(2), free = with_free_zero(3);
  all.gain_sd = 0.01;
  all.zero_sd = 50;
  all.hysteresis_sd = 0.1;
  Gauges gauges;
  Numbering numbering;
  REQUIRE(start(gauges, {known, all, free}, numbering) == 0);
  CHECK(gauges.size() == 3);
  // A free zero is renewed where the first reading is taken: until then it is zero.
  CHECK(numbering.deviations == std::vector<double>{0.01, 50, 0});
  CHECK(gauges.unknowns({0}).gain == -1);
  CHECK(gauges.unknowns({0}).zero == -1);
  CHECK(gauges.unknowns({1}).gain == 0);
  CHECK(gauges.unknowns({1}).zero == 1);
  CHECK(gauges.unknowns({2}).gain == -1);
  CHECK(gauges.unknowns({2}).zero == 2);
  for (int g = 0; g < 3; ++g) {
    CHECK(gauges.unknowns({g}).hysteresis == -1);
    CHECK(gauges.sd({g}) == g + 1);
    CHECK(gauges.has({g}));
  }
  CHECK_FALSE(gauges.has({3}));
  CHECK_FALSE(gauges.has({-1}));
}

TEST_CASE("what finds no room is counted") {
  Cell all = with_free_zero(1);
  all.gain_sd = 0.01;
  Gauges gauges;
  for (int room = 0; room <= 8; ++room) {
    CAPTURE(room);
    Numbering numbering;
    numbering.room = room;
    // Three of four instruments, of two unknowns each.
    CHECK(start(gauges, {all, all, all, all}, numbering) == 1 + (room < 6 ? 6 - room : 0));
    CHECK(gauges.size() == capacity);
  }
}

TEST_CASE("started again, nothing is left of before") {
  Gauges gauges = started({with_free_zero(1), with_noise(1)});
  gauges.set_mark({0}, 7);
  gauges.begin_row(100, 100, 1);
  gauges.count({0});
  Numbering numbering;
  REQUIRE(start(gauges, {with_free_zero(2)}, numbering) == 0);
  CHECK(gauges.size() == 1);
  CHECK(gauges.lacks_mark({0}));
  CHECK(gauges.mark({0}) == 0);
  CHECK(gauges.is_due({0}));
  CHECK(gauges.sd({0}) == 2);
  CHECK(gauges.save().largest == 0);
}

TEST_CASE("the derivative of a reading by the gain is what is read, by the zero it is one") {
  Cell both = with_noise(1), zero = with_noise(1), none = with_noise(1);
  both.gain_sd = 0.02;
  both.zero_sd = zero.zero_sd = 5;
  // The first and the last unknown are those of one each.
  const Gauges gauges = started({zero, none, both});
  const std::array<std::array<double, 3>, 3> expected = {{{1, 9, 9}, {9, 9, 9}, {9, -40, 1}}};
  const std::array<int, 3> zeros = {0, -1, 2};
  for (int g = 0; g < 3; ++g) {
    CAPTURE(g);
    Prediction prediction;
    prediction.value = -40;
    prediction.H.fill(9);
    gauges.depend_on_gain({g}, prediction);
    gauges.depend_on_zero({g}, prediction);
    for (std::size_t p = 0; p < 3; ++p) CHECK(prediction.H[p] == expected[static_cast<std::size_t>(g)][p]);
    CHECK(prediction.has_zero == (zeros[static_cast<std::size_t>(g)] >= 0));
    if (prediction.has_zero) CHECK(prediction.zero == zeros[static_cast<std::size_t>(g)]);
  }
}

TEST_CASE("a gain is an unknown wherever it stands in the list") {
  Cell gain = with_noise(1);
  gain.gain_sd = 0.02;
  const Gauges gauges = started({gain, gain});
  for (std::size_t g = 0; g < 2; ++g) {
    Prediction prediction;
    prediction.value = 3;
    gauges.depend_on_gain({static_cast<int>(g)}, prediction);
    CHECK(prediction.H[g] == 3);
    CHECK(prediction.H[1 - g] == 0);
  }
}

TEST_CASE("an instrument with a free zero lacks its mark until it is set, and after marks were forgotten") {
  Gauges gauges = started({with_noise(1), with_free_zero(1), with_free_zero(1)});
  CHECK_FALSE(gauges.lacks_mark({0}));
  CHECK(gauges.lacks_mark({1}));
  gauges.set_mark({1}, -12.5);
  CHECK_FALSE(gauges.lacks_mark({1}));
  CHECK(gauges.mark({1}) == -12.5);
  CHECK(gauges.lacks_mark({2}));
  CHECK(gauges.mark({2}) == 0);
  const auto saved = gauges.save();
  gauges.forget_marks();
  CHECK_FALSE(gauges.lacks_mark({0}));
  CHECK(gauges.lacks_mark({1}));
  gauges.restore(saved);
  CHECK_FALSE(gauges.lacks_mark({1}));
  CHECK(gauges.mark({1}) == -12.5);
}

TEST_CASE("readings count once, and then where the jacks are a part of the largest load away") {
  Gauges gauges = started({with_noise(1), with_noise(1)});
  const double largest = 25600, part = largest / 256;
  CHECK(gauges.is_due({0}));
  gauges.begin_row(largest, largest, 1);
  CHECK(gauges.is_due({0}));
  gauges.count({0});
  CHECK_FALSE(gauges.is_due({0}));
  // The other one has not been read yet.
  CHECK(gauges.is_due({1}));
  gauges.count({1});
  // Down counts as well as ahead; down and up again is nowhere else.
  double load = largest;
  for (const double change : {0.0, -0.5, 0.5, -0.75}) {
    load += change * part;
    gauges.begin_row(load, load, 1);
    CHECK_FALSE(gauges.is_due({0}));
  }
  // The model may be driven on as it likes.
  gauges.begin_row(load - 5 * part, load, 1);
  CHECK_FALSE(gauges.is_due({0}));
  load -= 0.25 * part;
  gauges.begin_row(load, load, 1);
  CHECK(gauges.is_due({0}));
  gauges.count({0});
  CHECK_FALSE(gauges.is_due({0}));
  CHECK(gauges.is_due({1}));
  gauges.begin_row(load - 0.75 * part, load - 0.75 * part, 1);
  CHECK_FALSE(gauges.is_due({0}));
  // The largest load counts, not the present one: far below it the way is as long.
  gauges.begin_row(0, 0, 1);
  gauges.count({0});
  gauges.begin_row(0.99 * part, 0.99 * part, 1);
  CHECK_FALSE(gauges.is_due({0}));
  gauges.begin_row(1.01 * part, 1.01 * part, 1);
  CHECK(gauges.is_due({0}));
  // Read from another mark, the first reading counts again.
  gauges.count({0});
  CHECK_FALSE(gauges.is_due({0}));
  gauges.forget_marks();
  CHECK(gauges.is_due({0}));
}

TEST_CASE("after a saved state all goes on as it would have") {
  Gauges gauges = started({with_noise(1), with_noise(1)});
  gauges.begin_row(256, 256, 1);
  gauges.count({0});
  const auto saved = gauges.save();
  gauges.begin_row(300, 300, 1);
  CHECK(gauges.is_due({0}));
  gauges.restore(saved);
  CHECK_FALSE(gauges.is_due({0}));
  CHECK(gauges.is_due({1}));
}

TEST_CASE("every instrument has a noise of its own, of the readings handed in and their times") {
  const int seed = 3;
  CAPTURE(seed);
  Gauges gauges = started({with_noise(1), with_noise(1), with_noise(1)});
  support::Random random(seed);
  for (int i = 0; i < 2000; ++i) {
    gauges.begin_row(0, 0, 0.5);
    gauges.follow_noise({0}, support::gaussian(random));
    // In every other row, and the last one where rows are not even.
    if (i % 2 == 0) gauges.follow_noise({1}, 4 * support::gaussian(random));
    if (i % 3 != 0) gauges.follow_noise({2}, 4 * support::gaussian(random));
  }
  CHECK(gauges.sd({0}) < 1.3);
  CHECK(gauges.sd({1}) > 3);
  CHECK(gauges.sd({1}) < 6);
  // Its readings are a row and two rows apart in turn: none of them are compared.
  CHECK(gauges.sd({2}) == 1);
}

}  // namespace gauges_test
