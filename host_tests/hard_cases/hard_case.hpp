// The list of hard cases, each a test and a row of the table.
#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "hard_cases/follow.hpp"

namespace hard {

struct HardCase {
  const char* word;  ///< for names of files
  const char* name;
  const char* reason;  ///< why it is hard
  Measured (*measure)();
};

inline std::vector<HardCase>& hard_cases() {
  static std::vector<HardCase> all;
  return all;
}

struct Registered {
  Registered(const char* word, const char* name, const char* reason, Measured (*measure)()) {
    hard_cases().push_back({word, name, reason, measure});
  }
};

/// Parts of the largest force so far. The tracker takes forces within 1e-12 of it for equal, and 1e-6 in a
/// sample without an event in float.
constexpr double accepted_double = 1e-9, accepted_float = 1e-5;

inline void check(const Deviation& found, double accepted) {
  CHECK(found.trouble == "");
  CHECK(found.from_reference <= accepted);
  CHECK(found.verified <= accepted);
}
inline void judge_in_double(const Measured& measured) {
  CHECK(measured.several_answers == 0);
  check(measured.in_double, accepted_double);
}
inline void judge_in_float(const Measured& measured) { check(measured.in_float, accepted_float); }
inline void judge(const Measured& measured) {
  judge_in_double(measured);
  judge_in_float(measured);
}

}  // namespace hard

/// A test case whose body returns what was measured; it is also a row of the table.
#define HARD_CASE(function, name, reason)                                                 \
  static hard::Measured function();                                                       \
  static const hard::Registered registered_##function{#function, name, reason, function}; \
  TEST_CASE(name) {                                                                       \
    INFO(reason);                                                                         \
    hard::judge(function());                                                              \
  }                                                                                       \
  static hard::Measured function()
