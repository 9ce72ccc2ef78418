// Reads a log row by row.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/files/date_time.hpp"
#include "lib/files/log_columns.hpp"
#include "lib/files/log_units.hpp"
#include "lib/files/scene_description.hpp"
#include "lib/files/sentence.hpp"

namespace taut::host {

/// What a log says of one end of a cable.
struct EndRow {
  double force = 0;               ///< last possible force given [N]
  bool locked = false;            ///< last word on the wedge
  bool has_column = false;        ///< the log has one for the force
  std::optional<double> reading;  ///< force given in this row [N]
  std::optional<double> stroke;   ///< extension given in this row [m]
};

/// The force of a segment or a strut, measured in a row [N].
struct MeasuredForce {
  bool of_strut = false;
  std::size_t cable = 0, index = 0;  ///< segment of the cable; or strut
  double reading = 0;
};

/// A row of a log, with what it keeps from the rows before.
struct LogRow {
  std::size_t row = 0;                        ///< counted from 1 without the header
  std::size_t line = 0;                       ///< of the file, from 1
  double time = 0;                            ///< [s]
  std::vector<double> factor;                 ///< of every load pattern
  std::vector<std::array<EndRow, 2>> cables;  ///< start and end of every cable
  std::vector<MeasuredForce> forces;          ///< measured in this row
};

/// What a log may hold beyond its format.
struct LogRules {
  /// The log holds what instruments read: with noise a jack force may be below zero, and what is impossible
  /// is left out. Otherwise neither can be used.
  bool are_readings = false;
  double shortest_step = 0;  ///< least time between rows [s]
  /// Sizes beyond which a factor or a force is impossible, see Condensed; empty: not known.
  std::vector<double> most_factor, most_force;
  /// Sizes beyond which a force that is no reading is surely a mistake; empty: not known, or meant.
  std::vector<double> most_plausible_force;

  bool is_possible_factor(std::size_t load, double factor) const {
    return load >= most_factor.size() || std::fabs(factor) <= most_factor[load];
  }
  bool is_possible_force(std::size_t cable, double force) const {
    return cable >= most_force.size() || std::fabs(force) <= most_force[cable];
  }
};

/// Reads a log from a stream, one row at a time.
///
/// Lines end in LF or CRLF; a byte order mark, lines that begin with # and blank rows at the end are skipped,
/// and with a remark the header where it comes again, as from a logger that was restarted.
/// The header tells what separates fields: commas, else semicolons, with which a decimal comma is taken too,
/// else tabs. Blanks around a field do not count, and a field may be in double quotes. Numbers become SI
/// units by the unit that the header names. Times may be dates: they count in seconds from the first row.
/// Every function throws InputError for what does not fit, with the line of the text and the column as
/// numbers from 1 and the column's name. Cost: linear in the text; memory for one line.
class LogReader {
 public:
  /// Reads the header. The scene and the stream must outlive the reader; `file` is the name for messages.
  LogReader(std::istream& stream, std::string file, const SceneDescription& scene,
            const LogRules& rules = {});

  /// Reads the next row into `row`, which must be the one of the call before; false at the end.
  bool next(LogRow& row);

  /// Where times that are dates count from: that of the first row, or of the log that this one goes on from.
  const std::optional<Moment>& origin() const { return origin_; }
  void count_from(const std::optional<Moment>& origin) { origin_ = origin; }

  /// A row before the first: no load, no force, nothing locked.
  LogRow first_row() const;

  /// Whether the log has this column.
  bool has(const std::string& column) const;
  /// The columns in the order of the file.
  const std::vector<std::string>& names() const { return names_; }
  /// Whether a comma in a number is a decimal one.
  bool takes_decimal_commas() const { return separator_ == ';'; }
  /// The line that the header is in.
  std::size_t header_line() const { return header_line_; }
  /// A place for a message: the line, and the column with this name, which the log has.
  std::string place(std::size_t line, const std::string& column) const;
  /// Where a factor was left out or the header came again, of the rows until now.
  const std::vector<Sentence>& remarks() const { return remarks_; }

 private:
  bool read_line();
  bool read_line_with_content();
  bool is_blank(char c) const;
  bool is_blank_row() const;
  bool is_header_again() const;
  void remark(std::size_t& of_this_kind, const Sentence& each, const Sentence& last);
  void find_separator();
  void read_header();
  const LogUnit& known_unit(std::size_t i, const LogColumn& column, const NameWithUnit& field) const;
  LogColumn known_column(std::size_t i, const std::string& name) const;
  [[noreturn]] void refuse_unknown_column(std::size_t i, const std::string& name) const;
  void split();
  void take(std::size_t i, LogRow& row);
  void take_factor(std::size_t i, double& factor);
  double read_time(std::size_t i);
  void check_time(double time, double before, const std::string& before_text) const;
  bool is_locked(std::size_t i) const;
  std::string with_decimal_point(std::size_t i) const;
  double number(std::size_t i) const;
  double in_si(std::size_t i, double value, const std::string& digits) const;
  void check_jacks(const LogRow& row) const;
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;
  [[noreturn]] void refuse_field(std::size_t column, const std::string& problem,
                                 const std::string& remedy) const;
  std::string place_of(std::size_t line, std::size_t column) const;
  std::string place_of(std::size_t column) const { return place_of(line_, column); }

  std::istream& stream_;
  std::string file_;
  const SceneDescription& scene_;
  LogRules rules_;
  LogColumns known_;
  std::vector<LogColumn> columns_;  // of the file
  std::vector<std::string> names_;  // of the file, without units
  std::vector<LogUnit> units_;      // of the file
  char separator_ = ',';
  std::size_t time_column_ = 0, header_line_ = 0;
  std::optional<Moment> origin_;
  bool has_dates_ = false;
  std::string header_;    // its line
  std::string text_;      // the present line
  std::size_t line_ = 0;  // its number
  std::vector<std::string> fields_;
  std::string time_text_;  // of the present row
  std::size_t rows_ = 0;
  std::vector<Sentence> remarks_;
  std::size_t left_out_ = 0;  // factors
  std::size_t headers_ = 0;   // after the first
};

/// Reads the whole log and throws InputError for the first thing in it that does not fit; returns the number
/// of rows, and adds to `remarks`, if given, what was left out. Every row is shown to `visit`, if there is
/// one.
std::size_t check_log(const std::string& path, const SceneDescription& scene, const LogRules& rules,
                      std::vector<Sentence>* remarks = nullptr,
                      const std::function<void(const LogRow&)>& visit = {});

/// Opens a log for reading. Throws InputError if it is not a file that can be read twice.
std::ifstream open_log(const std::string& path);

}  // namespace taut::host
