// Double words: sums and products without error.
#include "taut/numerics/double_word.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/scenes.hpp"

namespace double_word_test {
using support::Random;
using taut::DoubleWord;

namespace {

/// Of magnitude 2^-20 to 2^20, either sign.
template <class Scalar>
Scalar random_number(Random& random) {
  return static_cast<Scalar>((random.coin() ? 1 : -1) * std::exp2(random.between(-20, 20)));
}

constexpr int draws = 20000;

}  // namespace

TEST_CASE("a float sum with its error is the sum in double") {
  Random random(1);
  for (int i = 0; i < draws; ++i) {
    const float a = random_number<float>(random), b = random_number<float>(random);
    const auto s = DoubleWord<float>::sum(a, b);
    REQUIRE(double(s.hi) + double(s.lo) == double(a) + double(b));
    REQUIRE(s.hi == a + b);
  }
}

TEST_CASE("a float product with its error is the product in double") {
  Random random(2);
  for (int i = 0; i < draws; ++i) {
    const float a = random_number<float>(random), b = random_number<float>(random);
    const auto p = DoubleWord<float>::product(a, b);
    REQUIRE(double(p.hi) + double(p.lo) == double(a) * double(b));
    REQUIRE(p.hi == a * b);
  }
}

TEST_CASE("a double sum leaves exactly what rounding took away") {
  Random random(3);
  for (int i = 0; i < draws; ++i) {
    const double a = random_number<double>(random), b = a * std::exp2(random.between(-52, 0));
    const auto s = DoubleWord<double>::sum(a, b);
    REQUIRE(s.hi == a + b);
    // By Sterbenz: with |a| >= |b| the difference s - a is exact, and so is b less that.
    REQUIRE(s.lo == b - (s.hi - a));
  }
}

TEST_CASE("a double product leaves exactly what a fused multiply-add finds") {
  Random random(4);
  for (int i = 0; i < draws; ++i) {
    const double a = random_number<double>(random), b = random_number<double>(random);
    const auto p = DoubleWord<double>::product(a, b);
    REQUIRE(p.hi == a * b);
    REQUIRE(p.lo == std::fma(a, b, -p.hi));
  }
}

TEST_CASE("what a large number swallowed comes back when the large number goes") {
  DoubleWord<double> total{1e16, 0};
  for (int i = 0; i < 10; ++i) total += DoubleWord<double>{0.1, 0};
  total -= DoubleWord<double>{1e16, 0};
  CHECK(total.value() == doctest::Approx(1.0).epsilon(1e-15));
  CHECK((1e16 + 0.1) - 1e16 != doctest::Approx(0.1));  // plain numbers lose it
}

TEST_CASE("a scalar times a double word keeps the second word") {
  Random random(5);
  for (int i = 0; i < draws; ++i) {
    const float a = random_number<float>(random), b = random_number<float>(random);
    const float c = random_number<float>(random);
    const auto word = DoubleWord<float>::sum(b, c);
    const auto product = a * word;
    const double exact = double(a) * (double(b) + double(c));
    // Two words hold at least 2 x 24 - 2 binary digits.
    REQUIRE(std::fabs(double(product.hi) + double(product.lo) - exact) <= std::ldexp(std::fabs(exact), -45));
    REQUIRE(std::fabs(product.lo) <= std::numeric_limits<float>::epsilon() * std::fabs(product.hi));
  }
}

TEST_CASE("the sum of a double word and its opposite is zero") {
  const auto third = DoubleWord<double>::product(1.0 / 3, 1.0 / 7);
  CHECK((third - third).value() == 0);
  CHECK((third + (-third)).value() == 0);
}

TEST_CASE("double words are constant expressions") {
  constexpr auto s = DoubleWord<double>::sum(1.0, 0x1p-60);
  static_assert(s.hi == 1.0 && s.lo == 0x1p-60);
  constexpr auto p = DoubleWord<float>::product(16777215.0f, 16777215.0f);
  static_assert(double(p.hi) + double(p.lo) == 16777215.0 * 16777215.0);
  CHECK(s.value() == 1.0);
}

}  // namespace double_word_test
