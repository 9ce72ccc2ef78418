// The units that the header of a log may name.
#pragma once

#include <string>
#include <string_view>

#include "lib/files/log_columns.hpp"

namespace taut::host {

/// A unit of a quantity: so many of it are times 10^decimals times `factor` in SI units. Decimals are moved
/// in the text of a number, so that 33.35 kN and 33350 N are the same bits.
struct LogUnit {
  const char* name = "";
  int decimals = 0;
  double factor = 1;
};

/// The unit of a quantity with this name, as it is written; null if there is none.
const LogUnit* find_unit(Quantity quantity, std::string_view name);

/// The units of a quantity for a message, as in `"s", "ms", "min"`.
std::string known_units(Quantity quantity);

/// A header field with a unit in brackets: `C.end` and `kN` out of `C.end [kN]`.
struct NameWithUnit {
  std::string name, unit;
  bool has_unit = false;
};
NameWithUnit split_unit(const std::string& field);

}  // namespace taut::host
