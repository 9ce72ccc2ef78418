#include "host/log_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

namespace monitor::host {
namespace {

constexpr std::array<const char*, 2> end_names{".start", ".end"};
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// For a message: no more of a strange file than fits on a line, and nothing that a terminal would obey.
std::string quoted(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string shown(text.substr(0, most));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return '"' + shown + (text.size() > most ? "...\"" : "\"");
}

}  // namespace

LogReader::LogReader(std::string file, std::vector<std::string> cables)
    : file_(std::move(file)), cables_(std::move(cables)), stream_(file_, std::ios::binary) {
  if (!stream_) throw BadLog(file_ + ": cannot be opened; give the path of a log");
  read_header();
}

void LogReader::refuse(const std::string& problem, const std::string& remedy) const {
  throw BadLog(file_ + ", line " + std::to_string(line_number_) + ": " + problem + "; " + remedy);
}

bool LogReader::read_line() {
  ++line_number_;
  if (!std::getline(stream_, line_)) {
    if (stream_.bad()) refuse("the file cannot be read", "give the path of a log");
    return false;
  }
  if (!line_.empty() && line_.back() == '\r') line_.pop_back();
  return true;
}

std::vector<std::string_view> LogReader::fields() const {
  std::vector<std::string_view> found;
  std::string_view rest = line_;
  for (std::size_t comma = rest.find(','); comma != std::string_view::npos; comma = rest.find(',')) {
    found.push_back(trimmed(rest.substr(0, comma)));
    rest.remove_prefix(comma + 1);
  }
  found.push_back(trimmed(rest));
  return found;
}

void LogReader::read_header() {
  if (!read_line()) refuse("the log is empty", "write a header and rows below it");
  if (line_.compare(0, byte_order_mark.size(), byte_order_mark) == 0) line_.erase(0, byte_order_mark.size());
  for (const std::string_view name : fields()) {
    const Column column = column_named(name);
    for (const Column& other : columns_)
      if (other.is_time == column.is_time && other.cable == column.cable && other.end == column.end)
        refuse("the column " + quoted(name) + " is there twice", "remove one of the two");
    columns_.push_back(column);
  }
  if (std::none_of(columns_.begin(), columns_.end(), [](const Column& column) { return column.is_time; }))
    refuse("there is no column \"time\"", "add one, in seconds");
}

LogReader::Column LogReader::column_named(std::string_view name) const {
  if (name == "time") return {true, 0, 0};
  std::string known = "time";
  for (std::size_t cable = 0; cable < cables_.size(); ++cable)
    for (std::size_t end = 0; end < 2; ++end) {
      const std::string candidate = cables_[cable] + end_names[end];
      if (name == candidate) return {false, cable, end};
      known += ", " + candidate;
    }
  refuse("unknown column " + quoted(name), "the columns can be " + known);
}

bool LogReader::has(std::size_t cable, std::size_t end) const {
  return std::any_of(columns_.begin(), columns_.end(), [=](const Column& column) {
    return !column.is_time && column.cable == cable && column.end == end;
  });
}

std::optional<LogRow> LogReader::next() {
  if (!read_line()) {
    if (!last_time_) refuse("the log has no rows", "write at least one below the header");
    return std::nullopt;
  }
  const std::vector<std::string_view> given = fields();
  if (given.size() != columns_.size())
    refuse("the row has " + std::to_string(given.size()) + " fields under " +
               std::to_string(columns_.size()) + " columns",
           "write one field a column, with commas between them");
  LogRow row;
  row.cables.resize(cables_.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::optional<double> value = number(given[i], i);
    if (columns_[i].is_time && !value) refuse("the row has no time", "write one, in seconds");
    if (columns_[i].is_time)
      row.time = *value;
    else
      row.cables[columns_[i].cable][columns_[i].end] = value;
  }
  if (last_time_ && !(row.time > *last_time_))
    refuse("the time does not increase", "put the rows in the order of their times");
  last_time_ = row.time;
  return row;
}

std::optional<double> LogReader::number(std::string_view field, std::size_t column) const {
  if (field.empty()) return std::nullopt;
  const std::string place = " in column " + std::to_string(column + 1);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
    refuse(quoted(field) + place + " is not a number", "write a plain decimal, or leave it empty");
  if (std::fabs(value) > static_cast<double>(std::numeric_limits<float>::max()))
    refuse(quoted(field) + place + " is too large", "write it in seconds or newtons");
  if (!columns_[column].is_time && columns_[column].end == 1 && value < 0)
    refuse("the jack force " + quoted(field) + place + " is below zero",
           "write zero or more: a jack can only pull");
  return value;
}

}  // namespace monitor::host
