// Numbers as people read them.
#pragma once

#include <string>

namespace taut::host {

/// With so many decimals.
std::string fixed(double value, int decimals);
/// With so many significant digits, without an exponent where that is legible.
std::string significant(double value, int digits);
/// Without zeros at the end of its decimals.
std::string trimmed(std::string number);
/// With at most so many decimals: for coordinates of drawings.
std::string coordinate(double value, int decimals = 1);

/// Forces in a unit in which the largest of them is legible.
struct ForceUnit {
  const char* name = "N";
  double newtons = 1;
  int decimals = 1;

  static ForceUnit for_largest(double newtons);
  double of(double force) const { return force / newtons; }
  std::string number(double force) const;
  std::string text(double force) const { return number(force) + " " + name; }
  /// A standard deviation: two digits say all.
  std::string deviation(double sd) const;
};

}  // namespace taut::host
