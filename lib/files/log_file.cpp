#include "lib/files/log_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <istream>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include "lib/files/file_text.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/number_range.hpp"
#include "lib/files/plausible_scene.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
// Of one kind, about the rows of a log.
constexpr std::size_t most_remarks = 20;

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// In quotes where a spreadsheet has seen a separator in it.
bool is_remark(std::string_view line) {
  line = trimmed(line);
  return line.substr(0, 1) == "#" || line.substr(0, 2) == "\"#";
}

const char* name_of(char separator) {
  return separator == ',' ? "comma" : separator == ';' ? "semicolon" : "tab";
}

bool is_force(Quantity quantity) {
  return quantity == Quantity::force || quantity == Quantity::segment_force ||
         quantity == Quantity::strut_force;
}

const InstrumentDescription& gauge_of(const LogColumn& column, const SceneDescription& scene) {
  if (column.quantity == Quantity::strut_force) return scene.struts[column.index].gauge;
  const CableDescription& cable = scene.cables[column.index];
  return column.quantity == Quantity::force ? cable.cell[column.end] : cable.force[column.end];
}

// As `sep=;`, with which Excel begins what it writes.
bool is_separator_line(std::string_view line) { return line.size() == 5 && line.substr(0, 4) == "sep="; }

bool is_utf16(std::string_view text) {
  return text.size() >= 2 && (text.substr(0, 2) == "\xFF\xFE" || text.substr(0, 2) == "\xFE\xFF");
}

}  // namespace

LogReader::LogReader(std::istream& stream, std::string file, const SceneDescription& scene,
                     const LogRules& rules)
    : stream_(stream), file_(std::move(file)), scene_(scene), rules_(rules), known_(scene) {
  read_header();
}

void LogReader::refuse(const std::string& problem, const std::string& remedy) const {
  throw InputError(file_, "line " + std::to_string(line_), problem, remedy);
}

void LogReader::refuse_field(std::size_t column, const std::string& problem,
                             const std::string& remedy) const {
  throw InputError(file_, place_of(column), problem, remedy);
}

std::string LogReader::place(std::size_t line, const std::string& column) const {
  return place_of(line,
                  static_cast<std::size_t>(std::find(names_.begin(), names_.end(), column) - names_.begin()));
}

std::string LogReader::place_of(std::size_t line, std::size_t column) const {
  std::string place = "line " + std::to_string(line) + ", column " + std::to_string(column + 1);
  if (column < names_.size()) place += " (" + names_[column] + ")";
  return place;
}

// The next line without its end; false if there is none.
bool LogReader::read_line() {
  text_.clear();
  ++line_;
  std::streambuf* const bytes = stream_.rdbuf();
  constexpr int end_of_file = std::char_traits<char>::eof();
  int byte = bytes->sbumpc();
  const bool any = byte != end_of_file;
  for (; byte != end_of_file && byte != '\n'; byte = bytes->sbumpc()) {
    if (text_.size() == longest_line) refuse("the line is longer than 1 MiB", "write one line a row");
    text_ += static_cast<char>(byte);
  }
  if (!text_.empty() && text_.back() == '\r') text_.pop_back();
  if (line_ == 1) {
    if (is_utf16(text_)) refuse("the file is UTF-16", "save it as UTF-8 text");
    if (text_.find('\r') != std::string::npos)
      refuse("lines end with a carriage return alone", "save it with line feeds, or with both");
    if (text_.compare(0, byte_order_mark.size(), byte_order_mark) == 0)
      text_.erase(0, byte_order_mark.size());
  }
  return any;
}

// The next line that is no remark.
bool LogReader::read_line_with_content() {
  while (read_line())
    if (!is_remark(text_)) return true;
  return false;
}

// Where tabs separate fields they are not blanks.
bool LogReader::is_blank(char c) const { return c == ' ' || (c == '\t' && separator_ != '\t'); }

// Spreadsheets leave rows of separators.
bool LogReader::is_blank_row() const {
  return std::all_of(text_.begin(), text_.end(),
                     [&](char c) { return c == ' ' || c == '\t' || c == separator_; });
}

// A logger that was restarted writes its header, and perhaps the byte order mark, anew.
bool LogReader::is_header_again() const {
  std::string_view line = text_;
  if (line.substr(0, byte_order_mark.size()) == byte_order_mark) line.remove_prefix(byte_order_mark.size());
  return trimmed(line) == header_;
}

// `last` stands for all that are too many.
void LogReader::remark(std::size_t& of_this_kind, const Sentence& each, const Sentence& last) {
  if (++of_this_kind <= most_remarks + 1) remarks_.push_back(of_this_kind <= most_remarks ? each : last);
}

// Commas can be in no name, so one of them in the header settles it; tabs beside others are blanks.
void LogReader::find_separator() {
  bool in_quotes = false;
  std::string outside;
  for (const char c : trimmed(text_)) {
    if (c == '"') in_quotes = !in_quotes;
    if (!in_quotes) outside += c;
  }
  for (const char separator : {',', ';', '\t'})
    if (outside.find(separator) != std::string::npos) {
      separator_ = separator;
      return;
    }
}

// Splits the line at its separators, minding quotes.
void LogReader::split() {
  fields_.clear();
  std::string_view rest = text_;
  for (bool more = true; more;) {
    const std::size_t column = fields_.size();
    while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
    std::string& field = fields_.emplace_back();
    if (!rest.empty() && rest.front() == '"') {
      std::size_t at = 1;
      for (; at < rest.size(); ++at) {
        if (rest[at] != '"') {
          field += rest[at];
        } else if (at + 1 < rest.size() && rest[at + 1] == '"') {
          field += rest[at++];
        } else {
          break;
        }
      }
      if (at >= rest.size()) refuse_field(column, "the quotes are not closed", "close them on the same line");
      rest.remove_prefix(at + 1);
      while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
      if (!rest.empty() && rest.front() != separator_) {
        refuse_field(column, "there is text after the closing quote",
                     std::string("put a ") + name_of(separator_) + " after it");
      }
      field = trimmed(std::string(field));
    } else {
      const std::size_t length = std::min(rest.find(separator_), rest.size());
      field = trimmed(rest.substr(0, length));
      rest.remove_prefix(length);
    }
    more = !rest.empty();
    if (more) rest.remove_prefix(1);
  }
}

void LogReader::read_header() {
  bool is_there = read_line_with_content();
  // Excel's own line says what the header shows.
  while (is_there && (trimmed(text_).empty() || is_separator_line(trimmed(text_))))
    is_there = read_line_with_content();
  if (!is_there) {
    line_ = 1;
    refuse("the log is empty", "write a header, \"time\" and further columns, and rows below it");
  }
  header_line_ = line_;
  header_ = trimmed(text_);
  find_separator();
  split();
  const std::vector<std::string> header = fields_;
  for (std::size_t i = 0; i < header.size(); ++i) {
    // A name with brackets of its own is not taken apart.
    const NameWithUnit field =
        known_.find(header[i]) != nullptr ? NameWithUnit{header[i], "", false} : split_unit(header[i]);
    const LogColumn column = known_column(i, field.name);
    const auto twin = std::find(names_.begin(), names_.end(), field.name);
    if (twin != names_.end()) {
      const std::string first = std::to_string(twin - names_.begin() + 1);
      refuse_field(i, "the column " + quote(field.name) + " is there twice, first as column " + first,
                   "remove one of the two");
    }
    if (column.quantity == Quantity::time) time_column_ = i;
    units_.push_back(known_unit(i, column, field));
    names_.push_back(field.name);
    columns_.push_back(column);
  }
  if (!has("time")) refuse("there is no column \"time\"", "add one, in seconds");
}

const LogUnit& LogReader::known_unit(std::size_t i, const LogColumn& column,
                                     const NameWithUnit& field) const {
  static const LogUnit its_own;
  // Its table makes forces of what the gauge shows, in whatever unit.
  if (!field.has_unit || (is_force(column.quantity) && !gauge_of(column, scene_).calibration.empty()))
    return its_own;
  if (const LogUnit* unit = find_unit(column.quantity, field.unit)) return *unit;
  refuse_field(i, "the unit " + quote(field.unit) + " of column " + quote(field.name) + " is not known",
               "write one of " + known_units(column.quantity) + ", or none for the first of these");
}

LogColumn LogReader::known_column(std::size_t i, const std::string& name) const {
  if (name.empty()) refuse_field(i, "the column has no name", "name it, or remove it");
  const LogColumn* column = known_.find(name);
  if (column == nullptr) refuse_unknown_column(i, name);
  const bool about_jack = column->quantity == Quantity::locked || column->quantity == Quantity::stroke;
  if (about_jack && !scene_.cables[column->index].is_jacked(column->end)) {
    const std::string end = end_name(column->end), cable = quote(scene_.cables[column->index].name);
    refuse_field(i, "the " + end + " of cable " + cable + " has no jack",
                 "remove the column, or make the end \"jacked\" in the scene");
  }
  return *column;
}

void LogReader::refuse_unknown_column(std::size_t i, const std::string& name) const {
  if (separator_ == ',' && name.find(';') != std::string::npos)
    refuse_field(i, "columns are separated by commas and by semicolons",
                 "use one of the two, in the whole log");
  for (const CableDescription& cable : scene_.cables) {
    const std::string tension = cable.name + ".T";
    const bool is_numbered = name.size() > tension.size() && name.compare(0, tension.size(), tension) == 0 &&
                             name.find_first_not_of("0123456789", tension.size()) == std::string::npos;
    if (is_numbered)
      refuse_field(i, "cable " + quote(cable.name) + " has no segment of this number: " + quote(name),
                   cable.segments() == 1 ? "its only one is " + quote(tension + "1")
                                         : "its segments are " + quote(tension + "1") + " to " +
                                               quote(tension + std::to_string(cable.segments())));
    if (cable.closed && name.compare(0, cable.name.size() + 1, cable.name + ".") == 0) {
      refuse_field(i, "cable " + quote(cable.name) + " is closed and has no ends", "remove the column");
    }
  }
  refuse_field(i, "unknown column " + quote(name), suggestion(name, known_.names(), "the columns can be"));
}

bool LogReader::has(const std::string& column) const {
  return std::find(names_.begin(), names_.end(), column) != names_.end();
}

LogRow LogReader::first_row() const {
  LogRow row;
  row.factor.assign(scene_.loads.size(), 0);
  row.cables.assign(scene_.cables.size(), {});
  for (const LogColumn& column : columns_)
    if (column.quantity == Quantity::force) row.cables[column.index][column.end].has_column = true;
  return row;
}

bool LogReader::next(LogRow& row) {
  std::size_t blank_line = 0;
  while (true) {
    if (!read_line_with_content()) {
      if (rows_ == 0) refuse("the log has no rows", "write at least one below the header");
      return false;
    }
    if (is_header_again()) {
      const std::vector<Sentence> parts = {file_, std::to_string(line_)};
      remark(
          headers_,
          Sentence("{1}: line {2} is the header again; it is skipped, and the log goes on below it", parts),
          Sentence("{1}: line {2} is the header again, as are perhaps more; they are skipped", parts));
      continue;
    }
    if (!is_blank_row()) break;
    if (blank_line == 0) blank_line = line_;
  }
  if (blank_line != 0) {
    line_ = blank_line;
    refuse("the line is blank", "remove it: only the end of a log may have blank lines");
  }
  split();
  if (fields_.size() != columns_.size()) {
    refuse("the row has " + counted(fields_.size(), "field") + " under " + counted(columns_.size(), "column"),
           separator_ == ','
               ? "write one field a column, with decimal points and commas between them"
               : std::string("write one field a column, with ") + name_of(separator_) + "s between them");
  }
  const double time_before = row.time;
  const std::string time_text_before = std::exchange(time_text_, fields_[time_column_]);
  row.row = ++rows_;
  row.line = line_;
  for (auto& cable : row.cables) {
    for (EndRow& end : cable) end.reading = end.stroke = std::nullopt;
  }
  row.forces.clear();
  for (std::size_t i = 0; i < columns_.size(); ++i) take(i, row);
  if (rows_ > 1) check_time(row.time, time_before, time_text_before);
  check_jacks(row);
  return true;
}

void LogReader::check_time(double time, double before, const std::string& before_text) const {
  if (time > before && time - before >= rules_.shortest_step) return;
  // In seconds as it is counted, else as it is written.
  const LogUnit& unit = units_[time_column_];
  const bool is_counted = !has_dates_ && unit.decimals == 0 && unit.factor == 1;
  const std::string found = "the time " + (is_counted ? plain(time) : time_text_),
                    last = is_counted ? plain(before) : before_text;
  if (time > before)
    refuse_field(
        time_column_,
        found + " is less than " + plain(rules_.shortest_step) + " s after " + last + " of the row before",
        is_counted ? "give the time in seconds" : "let the time increase from row to row");
  refuse_field(time_column_, found + " is not after " + last + " of the row before",
               "let the time increase from row to row");
}

// Seconds; of dates, from the first one on.
double LogReader::read_time(std::size_t i) {
  const std::string& text = fields_[i];
  if (rows_ == 1) has_dates_ = is_like_date(text);
  if (has_dates_ != is_like_date(text) && (has_dates_ || rows_ > 1))
    refuse_field(i,
                 quote(text) + (has_dates_ ? " is no date and time, as the first row has"
                                           : " is a date and time, where the first row has a number"),
                 "write all times in one way");
  if (!has_dates_) return number(i);
  const std::optional<Moment> moment = read_moment(text);
  if (!moment)
    refuse_field(i, quote(text) + " is not a date and time",
                 "write one such as 2026-03-01T10:00:00, with Z or an offset such as +02:00 after it where "
                 "it is known");
  if (!origin_) origin_ = moment;
  if (origin_->has_zone != moment->has_zone)
    refuse_field(i,
                 quote(text) + (moment->has_zone ? " has an offset from UTC, those before have none"
                                                 : " has no offset from UTC, those before have one"),
                 "write it everywhere or nowhere");
  return seconds_between(*origin_, *moment);
}

// Puts a field where it belongs. An empty one keeps what was there.
void LogReader::take(std::size_t i, LogRow& row) {
  const LogColumn& column = columns_[i];
  if (fields_[i].empty()) {
    if (column.quantity == Quantity::time) refuse_field(i, "the row has no time", "write one, in seconds");
    return;
  }
  if (column.quantity == Quantity::time) {
    row.time = read_time(i);
    return;
  }
  if (column.quantity == Quantity::factor) {
    take_factor(i, row.factor[column.index]);
    return;
  }
  if (column.quantity == Quantity::segment_force) {
    const InstrumentDescription& instrument = scene_.cables[column.index].force[column.end];
    row.forces.push_back({false, column.index, column.end, instrument.force_of(number(i))});
    return;
  }
  if (column.quantity == Quantity::strut_force) {
    row.forces.push_back({true, 0, column.index, scene_.struts[column.index].gauge.force_of(number(i))});
    return;
  }
  EndRow& end = row.cables[column.index][column.end];
  if (column.quantity == Quantity::stroke) {
    end.stroke = number(i);
  } else if (column.quantity == Quantity::locked) {
    end.locked = is_locked(i);
  } else {
    end.reading = scene_.cables[column.index].cell[column.end].force_of(number(i));
    // A reading that is impossible is for the estimator to refuse.
    if (!rules_.are_readings || rules_.is_possible_force(column.index, *end.reading))
      end.force = *end.reading;
  }
}

void LogReader::take_factor(std::size_t i, double& factor) {
  const double given = number(i);
  const std::size_t load = columns_[i].index;
  if (rules_.is_possible_factor(load, given)) {
    factor = given;
    return;
  }
  if (!rules_.are_readings)
    refuse_field(i, "the factor " + plain(given) + " is more than the cables can carry",
                 "write one of a size below " + plain(rules_.most_factor[load]) + ": is the unit wrong?");
  const std::vector<Sentence> parts = {file_, std::to_string(line_), std::to_string(i + 1), names_[i],
                                       plain(given)};
  remark(left_out_,
         Sentence("{1}: line {2}, column {3} ({4}): the factor {5} is more than the cables can carry; "
                  "the one before is kept",
                  parts),
         Sentence("{1}: line {2}, column {3} ({4}): the factor {5} is more than the cables can carry, "
                  "as are perhaps more; the ones before are kept",
                  parts));
}

// Tables with empty fields write 0 and 1 as any other number: 1.0.
bool LogReader::is_locked(std::size_t i) const {
  const std::string digits = with_decimal_point(i);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = error == std::errc() && end == digits.data() + digits.size();
  if (!is_whole || (value != 0 && value != 1))
    refuse_field(i, quote(fields_[i]) + " is neither locked nor unlocked",
                 "write 1 for locked, 0 for unlocked");
  return value == 1;
}

// Between semicolons a number may have a decimal comma; with a point beside it, it is one of thousands.
std::string LogReader::with_decimal_point(std::size_t i) const {
  std::string digits = fields_[i];
  if (separator_ == ';' && digits.find('.') == std::string::npos && digits.find(',') != std::string::npos)
    digits[digits.find(',')] = '.';
  return digits;
}

double LogReader::number(std::size_t i) const {
  const std::string& text = fields_[i];
  const std::string digits = with_decimal_point(i);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = end == digits.data() + digits.size();
  if (error == std::errc() && is_whole && std::isfinite(value)) {
    value = in_si(i, value, digits);
  } else if (error != std::errc::result_out_of_range) {
    const bool is_time = i == time_column_ && i < columns_.size();
    refuse_field(i, quote(text) + " is not a number",
                 is_time ? "write a plain decimal such as 1.5, or a date and time such as 2026-03-01T10:00:00"
                         : "write a plain decimal such as -1.5 or 2e3, or leave it empty");
  }
  if (error == std::errc::result_out_of_range || !std::isfinite(value)) {
    refuse_field(i, "the number " + quote(text) + " is too large or too small",
                 "write one between 1e-307 and " + plain(largest_input) + " in size, or 0");
  }
  // What the cables can carry is asked later, by name.
  const LogColumn* const column = i < columns_.size() ? &columns_[i] : nullptr;
  const bool may_be_impossible =
      column != nullptr &&
      ((column->quantity == Quantity::factor && rules_.are_readings) ||
       (column->quantity == Quantity::force && column->index < rules_.most_force.size()));
  if (std::fabs(value) > largest_input && !may_be_impossible) {
    refuse_field(i, "the number " + quote(text) + " is too large",
                 "write one of at most " + plain(largest_input) + " in size");
  }
  return value;
}

// A number in SI units; a NaN where it is too large or too small.
double LogReader::in_si(std::size_t i, double value, const std::string& digits) const {
  const LogUnit& unit = units_[i];
  if (unit.decimals == 0 || value == 0) return value * unit.factor;
  // The point is moved in the text, so that nothing is rounded twice.
  const std::size_t letter = std::min(digits.find_first_of("eE"), digits.size());
  int exponent = 0;
  if (letter < digits.size()) {
    const std::size_t from = letter + (digits[letter + 1] == '+' ? 2 : 1);
    std::from_chars(digits.data() + from, digits.data() + digits.size(), exponent);
  }
  const std::string moved = digits.substr(0, letter) + "e" + std::to_string(exponent + unit.decimals);
  double shifted = 0;
  const auto error = std::from_chars(moved.data(), moved.data() + moved.size(), shifted).ec;
  return error == std::errc() ? shifted * unit.factor : std::numeric_limits<double>::quiet_NaN();
}

// A jack can only pull, and no more than the cable carries. What counts is the force while the end is not
// locked, also one kept from a row before.
void LogReader::check_jacks(const LogRow& row) const {
  if (rules_.are_readings) return;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const LogColumn& column = columns_[i];
    if (column.quantity != Quantity::force) continue;
    const EndRow& end = row.cables[column.index][column.end];
    const CableDescription& cable = scene_.cables[column.index];
    if (!cable.is_jacked(column.end) || end.locked) continue;
    const std::string force =
        "the jack force " + plain(end.force) + (end.reading ? "" : " from a row before");
    if (end.force < 0) refuse_field(i, force + " is below zero", "write zero or more: a jack can only pull");
    if (column.index < rules_.most_plausible_force.size() &&
        end.force > rules_.most_plausible_force[column.index] &&
        rules_.is_possible_force(column.index, end.force))
      refuse_field(i, force + " strains cable " + quote(cable.name) + " by more than 2 %",
                   "write a force below " + plain(rules_.most_plausible_force[column.index]) +
                       " N: is the unit wrong?" + remedy_if_meant);
    if (rules_.is_possible_force(column.index, end.force)) continue;
    const std::string most = plain(rules_.most_force[column.index]);
    const bool is_newton = units_[i].decimals == 0 && units_[i].factor == 1;
    refuse_field(i, force + " is more than cable " + quote(cable.name) + " can carry, a tenth of its E A",
                 "write a force " + (is_newton ? "in N below " + most : "below " + most + " N") +
                     ": is the unit wrong?");
  }
}

std::ifstream open_log(const std::string& path) {
  require_readable(path, "log file");
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) {
    throw InputError(
        path, "", "is a pipe or a device",
        "save the log as a file, for it is read twice, or write - and send it to standard input");
  }
  return std::ifstream(path, std::ios::binary);
}

std::size_t check_log(const std::string& path, const SceneDescription& scene, const LogRules& rules,
                      std::vector<Sentence>* remarks, const std::function<void(const LogRow&)>& visit) {
  std::ifstream stream = open_log(path);
  LogReader reader(stream, path, scene, rules);
  LogRow row = reader.first_row();
  while (reader.next(row))
    if (visit) visit(row);
  if (remarks != nullptr) remarks->insert(remarks->end(), reader.remarks().begin(), reader.remarks().end());
  return row.row;
}

}  // namespace taut::host
