// The digits that numbers of a result have, against decimals that printf and long double make.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "lib/files/deserved_digits.hpp"
#include "lib/files/text.hpp"

using namespace taut::host;

namespace {

// Numbers of all sizes that results have, of either sign.
class Numbers {
 public:
  double next() {
    const double size = std::pow(10.0, exponent_(random_));
    return sign_(random_) ? -size : size;
  }

 private:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> exponent_{-20, 15};
  std::bernoulli_distribution sign_{0.5};
};

double by_printf(double number, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*e", digits - 1, number);
  return std::strtod(text.data(), nullptr);
}

std::size_t digits_of(double number) {
  std::string text = plain(number);
  text = text.substr(0, text.find('e'));
  std::string digits;
  for (const char c : text)
    if (c >= '0' && c <= '9') digits += c;
  digits.erase(0, digits.find_first_not_of('0'));
  if (text.find('.') == std::string::npos) digits.erase(digits.find_last_not_of('0') + 1);
  return digits.size();
}

}  // namespace

TEST_CASE("a number is rounded to significant digits as printf rounds it, and has no more of them") {
  Numbers numbers;
  for (int i = 0; i < 20000; ++i) {
    const double number = numbers.next();
    for (const int digits : {4, 12, 15}) {
      CAPTURE(number);
      REQUIRE(rounded(number, digits) == by_printf(number, digits));
      REQUIRE(digits_of(rounded(number, digits)) <= static_cast<std::size_t>(digits));
    }
  }
}

TEST_CASE("what arithmetic adds to the last bits of a number is not shown") {
  CHECK(plain(rounded(33350.00000000001, computed_digits)) == "33350");
  CHECK(plain(rounded(0.1 + 0.2, time_digits)) == "0.3");
  CHECK(plain(rounded(-0.0, computed_digits)) == "0");
  CHECK(plain(rounded(1763999999.025, time_digits)) == "1763999999.025");
}

TEST_CASE(
    "a number changes by less than a thousandth of its standard deviation and ends where that ends, but for "
    "four digits") {
  Numbers numbers;
  for (int i = 0; i < 20000; ++i) {
    const double number = numbers.next(), deviation = std::fabs(number) * std::fabs(numbers.next());
    if (deviation == 0) continue;
    const double known = rounded_as_known(number, deviation);
    CAPTURE(number);
    CAPTURE(deviation);
    const long double change = std::fabs(static_cast<long double>(known) - static_cast<long double>(number));
    if (deviation > std::fabs(number)) {
      REQUIRE(known == by_printf(number, 4));
      continue;
    }
    REQUIRE(change <= std::fmax(1.001e-3L * static_cast<long double>(deviation),
                                5e-12L * std::fabs(static_cast<long double>(number))));
    // A whole number of the last unit that the deviation has in four digits.
    const long double unit = std::pow(10.0L, std::floor(std::log10(static_cast<long double>(deviation))) - 3);
    const long double units = static_cast<long double>(known) / unit;
    if (std::fabs(units) < 1e11L) REQUIRE(std::fabs(units - std::round(units)) < 1e-4L);
  }
}

TEST_CASE("digits of numbers with a standard deviation, by hand") {
  CHECK(rounded_as_known(33350.123456789, 54.3219) == 33350.12);
  CHECK(rounded_as_known(33350.123456789, 5432.19) == 33350);
  CHECK(rounded_as_known(33350.123456789, 5.4e36) == 33350);
  CHECK(rounded_as_known(0.123456789, 0.0321) == 0.12346);
  CHECK(rounded_as_known(33350.123456789123, 0) == 33350.1234568);
  CHECK(rounded_as_known(33350.123456789123, 1e-12) == 33350.1234568);
}

TEST_CASE("of an estimate what has no deviation has as many digits as the force that is known best") {
  Answer answer;
  answer.tension = {41234.56789, 0, 1234.56789};
  answer.deviation = {41.234567, 20, 123.45678};
  answer.mu = {0.123456789};
  answer.mu_deviation = {0.012345678};
  answer.slip = {0.0123456789123};
  answer.contact = answer.friction = answer.friction_used = answer.displacement = answer.slip;
  answer.extension = {{0.0123456789123, 0}};
  answer.strut = {-9876.54321987654};
  Answer written = with_deserved_digits(answer);
  CHECK(written.tension == std::vector<double>{41234.57, 0, 1234.6});
  CHECK(written.deviation == std::vector<double>{41.23, 20, 123.5});
  CHECK(written.mu == std::vector<double>{0.12346});
  CHECK(written.mu_deviation == std::vector<double>{0.01235});
  // 41234.57 has seven.
  for (const auto* numbers :
       {&written.slip, &written.contact, &written.friction, &written.friction_used, &written.displacement})
    CHECK(*numbers == std::vector<double>{0.01234568});
  CHECK(written.extension[0][0] == 0.01234568);
  CHECK(written.strut == std::vector<double>{-9876.543});

  answer.strut.push_back(-4e-12);  // a member without force
  answer.slip.push_back(3e-18);
  written = with_deserved_digits(answer);
  CHECK(written.strut.back() == 0);
  CHECK(written.slip.back() == 0);
  answer.strut.pop_back();
  answer.slip.pop_back();

  answer.deviation = {1e7, 1e7, 1e7};  // nothing is known; four digits remain
  written = with_deserved_digits(answer);
  CHECK(written.strut == std::vector<double>{-9877});
  answer.deviation = {0, 20, 123};  // exact
  CHECK(with_deserved_digits(answer).strut == std::vector<double>{-9876.54321988});
  answer.tension = {0, 0, 0};  // before the first load
  CHECK(with_deserved_digits(answer).strut == std::vector<double>{-9876.54321988});
  answer.tension = {41234.56789, 0, 1234.56789};
  answer.deviation.clear();  // of `simulate`
  written = with_deserved_digits(answer);
  CHECK(written.tension[0] == 41234.56789);
  CHECK(written.strut == std::vector<double>{-9876.54321988});
  // 1e-12 of the largest force has its fourth digit at 1e-11 N.
  answer.strut = {0.123456789012345, 1.2e-11, -4e-12};
  CHECK(with_deserved_digits(answer).strut == std::vector<double>{0.12345678901, 1e-11, 0});
}
