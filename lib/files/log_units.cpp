#include "lib/files/log_units.hpp"

#include <algorithm>
#include <vector>

#include "lib/files/text.hpp"

namespace taut::host {
namespace {

// The first of each is that of SI.
const std::vector<LogUnit> time_units = {
    {"s", 0, 1}, {"ms", -3, 1}, {"min", 0, 60}, {"h", 0, 3600}, {"d", 0, 86400.0}};
const std::vector<LogUnit> force_units = {
    {"N", 0, 1}, {"kN", 3, 1}, {"MN", 6, 1}, {"lbf", 0, 4.4482216152605}, {"kip", 3, 4.4482216152605}};
const std::vector<LogUnit> length_units = {
    {"m", 0, 1}, {"mm", -3, 1}, {"cm", -2, 1}, {"in", 0, 0.0254}, {"ft", 0, 0.3048}};
const std::vector<LogUnit> factor_units = {{"1", 0, 1}, {"-", 0, 1}, {"%", -2, 1}};
const std::vector<LogUnit> switch_units = {{"1", 0, 1}, {"-", 0, 1}};

const std::vector<LogUnit>& units_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return time_units;
    case Quantity::factor:
      return factor_units;
    case Quantity::locked:
      return switch_units;
    case Quantity::stroke:
      return length_units;
    case Quantity::force:
    case Quantity::segment_force:
    case Quantity::strut_force:
      return force_units;
  }
  return switch_units;
}

std::string without_blanks_around(std::string text) {
  while (!text.empty() && text.back() == ' ') text.pop_back();
  text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

}  // namespace

const LogUnit* find_unit(Quantity quantity, std::string_view name) {
  const std::vector<LogUnit>& units = units_of(quantity);
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const LogUnit& unit) { return name == unit.name; });
  return found == units.end() ? nullptr : &*found;
}

std::string known_units(Quantity quantity) {
  std::string list;
  for (const LogUnit& unit : units_of(quantity)) list += (list.empty() ? "" : ", ") + quote(unit.name);
  return list;
}

NameWithUnit split_unit(const std::string& field) {
  const std::size_t open = field.rfind('[');
  if (open == std::string::npos || field.back() != ']') return {field, "", false};
  return {without_blanks_around(field.substr(0, open)),
          without_blanks_around(field.substr(open + 1, field.size() - open - 2)), true};
}

}  // namespace taut::host
