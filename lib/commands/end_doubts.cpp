#include "lib/commands/end_doubts.hpp"

#include <cmath>
#include <cstddef>
#include <string>

#include "lib/commands/usual_deviations.hpp"
#include "lib/files/deserved_digits.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

Sentence load_text(double load) { return plain(rounded(load, 4)); }
Sentence line_text(std::size_t line) { return std::to_string(line); }

Sentence doubt(const NeverLocked& never, const std::string& column) {
  return Sentence(
      "the load of {1} falls from {2} N to next to nothing after line {3}, and the end is never locked: "
      "if its wedge was drawn in there, {4} is 1 from line {5} on; if it has none, leave out \"seating\"",
      {quote(column), load_text(never.held()), line_text(never.held_line()), quote(column + ".locked"),
       line_text(never.held_line() + 1)});
}

Sentence doubt(const LockedWithLoad& with, const std::string& column) {
  return Sentence(
      "the load {2} N of {1} in line {3} is not used, for the end is locked in that row, and {4} N before: "
      "if the jack pulled it before the wedge was drawn in, give it a row of its own before that",
      {quote(column), load_text(with.load()), line_text(with.line()), load_text(with.last())});
}

Sentence doubt(const LateLock& late, const std::string& column) {
  return Sentence(
      "the load of {1} falls from {2} to {3} N after line {4}, and the end is locked in line {5}: "
      "if its wedge was drawn in before, {6} is 1 from line {7} on",
      {quote(column), load_text(late.held()), load_text(late.left()), line_text(late.held_line()),
       line_text(late.locked_line()), quote(column + ".locked"), line_text(late.held_line() + 1)});
}

Sentence doubt(const RestOffZero& rest, const std::string& column) {
  return Sentence(
      "{1} reads {2} N in its first {3} rows, before its load rises: if nothing pulls there, "
      "take that off all of its readings, for forces are off by as much",
      {quote(column), load_text(rest.level()), std::to_string(rest.rows())});
}

// An exact cell reads what the jack holds.
bool is_off_zero(const RestOffZero& rest, const InstrumentDescription& cell) {
  const double zero_sd = cell.zero_sd.value_or(usual_zero_sd * rest.largest());
  return !cell.exact && std::fabs(rest.level()) > 3 * zero_sd;
}

}  // namespace

void EndDoubts::take(const LogRow& row, const EndRow& given, double least, bool has_wedge) {
  const double reading = given.reading.value_or(std::nan(""));
  late_.take(row.time, reading, given.locked, least, row.line);
  with_load_.take(reading, given.locked, least, row.line);
  rest_.take(reading, given.locked);
  if (has_wedge) never_.take(reading, given.locked, least, row.line);
}

std::vector<Sentence> EndDoubts::sentences(const std::string& column,
                                           const InstrumentDescription& cell) const {
  std::vector<Sentence> found;
  const auto ask = [&](const auto& finder) {
    if (finder.is_found()) found.push_back(doubt(finder, column));
  };
  ask(never_);
  ask(with_load_);
  ask(late_);
  if (is_off_zero(rest_, cell)) ask(rest_);
  return found;
}

}  // namespace taut::host
