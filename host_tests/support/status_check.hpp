// Comparison of statuses that shows both when they differ.
#pragma once

#include <doctest/doctest.h>

#include <ostream>

#include "taut/status.hpp"

namespace taut {

constexpr bool operator==(const Status& a, const Status& b) {
  return a.code == b.code && a.place == b.place && a.index == b.index && a.cable == b.cable &&
         a.amount == b.amount;
}

inline std::ostream& operator<<(std::ostream& out, const Status& status) {
  return out << '"' << describe(status.code) << "\" (" << static_cast<int>(status.code) << "), place "
             << static_cast<int>(status.place) << ", index " << status.index << ", cable " << status.cable
             << ", amount " << status.amount;
}

}  // namespace taut

/// The status is exactly this: code, place, index, and if they matter cable and amount.
#define CHECK_STATUS(status, ...) CHECK((status) == (taut::Status{__VA_ARGS__}))
