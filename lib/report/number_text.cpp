#include "lib/report/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace taut::host {
namespace {

constexpr int most_decimals = 7;
constexpr double longest_plain = 1e13;

std::string written(double value, std::chars_format format, int precision) {
  std::array<char, 64> digits{};
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, format, precision);
  return error == std::errc() ? std::string(digits.data(), end) : std::string("?");
}

int magnitude(double value) { return static_cast<int>(std::floor(std::log10(std::fabs(value)))); }

// Rounding may leave a zero with a sign.
std::string without_sign_of_zero(std::string text) {
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

}  // namespace

std::string fixed(double value, int decimals) {
  if (!(std::fabs(value) < longest_plain)) return written(value, std::chars_format::general, 4);
  return without_sign_of_zero(written(value, std::chars_format::fixed, decimals));
}

std::string significant(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return value == 0 ? "0" : "?";
  const int decimals = digits - 1 - magnitude(value);
  if (decimals > most_decimals) return written(value, std::chars_format::general, digits);
  return fixed(value, std::max(decimals, 0));
}

std::string trimmed(std::string number) {
  if (number.find('.') == std::string::npos || number.find('e') != std::string::npos) return number;
  while (number.back() == '0') number.pop_back();
  if (number.back() == '.') number.pop_back();
  return number;
}

std::string coordinate(double value, int decimals) {
  return trimmed(fixed(std::isfinite(value) ? value : 0, decimals));
}

ForceUnit ForceUnit::for_largest(double newtons) {
  ForceUnit unit;
  if (newtons >= 2e6) {
    unit = {"MN", 1e6, 1};
  } else if (newtons >= 2e3) {
    unit = {"kN", 1e3, 1};
  }
  constexpr int digits = 4;
  if (newtons > 0) unit.decimals = std::clamp(digits - 1 - magnitude(unit.of(newtons)), 1, most_decimals);
  return unit;
}

std::string ForceUnit::deviation(double sd) const {
  constexpr double rounding = 1e-7;  // what is less comes from rounding
  return of(sd) < rounding ? "0" : significant(of(sd), 2);
}

std::string ForceUnit::number(double force) const { return fixed(of(force), decimals); }

}  // namespace taut::host
