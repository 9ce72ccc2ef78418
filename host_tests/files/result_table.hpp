// A result of the program, as columns by name.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

/// The fields of a line of a result.
inline std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) found.push_back(field);
  if (!line.empty() && line.back() == ',') found.emplace_back();
  return found;
}

struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  explicit Table(const std::string& text) {
    std::istringstream stream(text);
    std::string line;
    std::getline(stream, line);
    header = fields(line);
    while (std::getline(stream, line)) rows.push_back(fields(line));
  }
  const std::string& at(std::size_t row, const std::string& column) const {
    const auto found = std::find(header.begin(), header.end(), column);
    REQUIRE(found != header.end());
    return rows.at(row).at(static_cast<std::size_t>(found - header.begin()));
  }
  double number(std::size_t row, const std::string& column) const {
    return std::strtod(at(row, column).c_str(), nullptr);
  }
  /// The same of a result with `--hex`: decimals have only the digits that they deserve.
  double bits(std::size_t row, const std::string& column) const {
    const std::uint64_t digits = std::strtoull(at(row, column).c_str(), nullptr, 16);
    double number = 0;
    std::memcpy(&number, &digits, sizeof number);
    return number;
  }
  /// A column, row by row.
  std::vector<std::string> column(const std::string& name) const {
    std::vector<std::string> found;
    for (std::size_t row = 0; row < rows.size(); ++row) found.push_back(at(row, name));
    return found;
  }
};
