// Reads the load cells of a recorded log: CSV, one row a sample.
#pragma once

#include <array>
#include <cstddef>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace monitor::host {

/// A log that cannot be used: what() names the file, the place, what is wrong and what would be right.
struct BadLog : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One row: the readings of the load cells at start and end of every cable [N]; empty where there is none.
struct LogRow {
  using Ends = std::array<std::optional<double>, 2>;
  double time = 0;
  std::vector<Ends> cables;
};

/// The rows of a log file, one after the other.
///
/// The header is `time` and, for any cable, `<cable>.start` and `<cable>.end`. Time must increase. An empty
/// field is no reading.
class LogReader {
 public:
  /// Opens the file and reads its header. Throws BadLog.
  LogReader(std::string file, std::vector<std::string> cables);

  /// The next row, or nothing at the end of the log. Throws BadLog.
  std::optional<LogRow> next();

  /// Whether the log has a column for an end, 0 start or 1 end, of a cable.
  bool has(std::size_t cable, std::size_t end) const;

 private:
  struct Column {
    bool is_time = false;
    std::size_t cable = 0;
    std::size_t end = 0;
  };

  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;
  bool read_line();
  std::vector<std::string_view> fields() const;
  void read_header();
  Column column_named(std::string_view name) const;
  std::optional<double> number(std::string_view field, std::size_t column) const;

  std::string file_;
  std::vector<std::string> cables_;
  std::ifstream stream_;
  std::string line_;
  std::size_t line_number_ = 0;
  std::vector<Column> columns_;
  std::optional<double> last_time_;
};

}  // namespace monitor::host
