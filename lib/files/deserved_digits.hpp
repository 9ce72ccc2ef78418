// The digits that the numbers of a result deserve.
#pragma once

#include "lib/files/answer.hpp"

namespace taut::host {

/// Significant digits of what is computed from exact numbers, of a time, and of a standard deviation; and the
/// fewest of an estimate, however little is known of it.
inline constexpr int computed_digits = 12, time_digits = 15, deviation_digits = 4, fewest_digits = 4;

/// The number with so many significant digits, 1 to 17; zero has no sign.
double rounded(double number, int digits);

/// The number with the decimals that its standard deviation has in four digits, so that it changes by less
/// than a thousandth of that, but with at least `fewest_digits` and at most `computed_digits`; with these if
/// the deviation is zero.
double rounded_as_known(double number, double deviation);

/// Nothing is computed better than with this standard deviation, of the largest force or length of a row:
/// what is smaller than a thousandth of it is zero.
inline constexpr double computed_deviation = 1e-12;

/// The answer as it is written in decimals. Without deviations every number has `computed_digits`, as far as
/// `computed_deviation` goes. With them forces and mu are rounded_as_known(); all else, which follows from
/// the forces, has as many significant digits as that force of a segment that is known best.
Answer with_deserved_digits(const Answer& answer);

}  // namespace taut::host
