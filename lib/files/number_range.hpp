// The sizes of numbers that files may hold, and that results may have.
#pragma once

#include <cmath>

namespace taut::host {

/// In SI units nothing of a structure or a log is larger.
inline constexpr double largest_input = 1e30;
/// Nor is a stiffness, a cross-section or a standard deviation smaller, unless it is zero.
inline constexpr double smallest_amount = 1e-30;
/// Nor do samples of instruments follow each other faster [s].
inline constexpr double shortest_step = 1e-9;
/// Beyond this an answer has no meaning; what is computed from answers does not overflow below it.
inline constexpr double largest_result = 1e100;

/// What is said after such an answer.
inline constexpr const char* remedy_of_impossible_numbers =
    "look for stiffnesses, lengths and forces that differ by very many powers of ten";

/// Whether a number may stand in a result; a NaN may not.
inline bool is_possible(double result) { return std::fabs(result) <= largest_result; }

}  // namespace taut::host
