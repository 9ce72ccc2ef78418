#include "lib/files/date_time.hpp"

#include <cstddef>
#include <cstdlib>

namespace taut::host {
namespace {

constexpr std::int64_t a_second = 1000000000;  // ns

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes a text apart from its start.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  bool at_digit() const { return !rest_.empty() && is_digit(rest_.front()); }
  bool skip(std::string_view any_of) {
    if (rest_.empty() || any_of.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// A number of so many digits within limits; nothing if it is none.
  std::optional<int> number(std::size_t digits, int least, int most) {
    if (rest_.size() < digits) return std::nullopt;
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      if (!is_digit(rest_[i])) return std::nullopt;
      value = 10 * value + (rest_[i] - '0');
    }
    rest_.remove_prefix(digits);
    if (value < least || value > most) return std::nullopt;
    return value;
  }
  /// The digits of a fraction, in 1e-9.
  std::int32_t fraction() {
    std::int32_t value = 0, unit = 100000000;
    for (; at_digit(); rest_.remove_prefix(1), unit /= 10) value += unit * (rest_.front() - '0');
    return value;
  }
  char front() const { return rest_.empty() ? '\0' : rest_.front(); }

 private:
  std::string_view rest_;
};

bool is_leap(int year) { return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0; }

int days_in(int year, int month) {
  constexpr int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return month == 2 && is_leap(year) ? 29 : days[month - 1];
}

// Days from 1970-01-01, by counting the leap days of whole years.
std::int64_t days_since_1970(int year, int month, int day) {
  const auto leap_days_before = [](std::int64_t y) { return (y - 1) / 4 - (y - 1) / 100 + (y - 1) / 400; };
  std::int64_t days = (year - 1970) * std::int64_t{365} + leap_days_before(year) - leap_days_before(1970);
  for (int m = 1; m < month; ++m) days += days_in(year, m);
  return days + day - 1;
}

std::optional<std::int64_t> read_date(Cursor& at) {
  const auto year = at.number(4, 1, 9999);
  if (!year || !at.skip("-")) return std::nullopt;
  const auto month = at.number(2, 1, 12);
  if (!month || !at.skip("-")) return std::nullopt;
  const auto day = at.number(2, 1, days_in(*year, *month));
  if (!day) return std::nullopt;
  return days_since_1970(*year, *month, *day);
}

// What follows the date: adds the time of day.
bool read_time(Cursor& at, Moment& moment) {
  const auto hour = at.number(2, 0, 23);
  if (!hour || !at.skip(":")) return false;
  const auto minute = at.number(2, 0, 59);
  if (!minute) return false;
  moment.seconds += *hour * 3600 + *minute * 60;
  if (!at.skip(":")) return true;
  const auto second = at.number(2, 0, 59);
  if (!second) return false;
  moment.seconds += *second;
  if (!at.skip(".,")) return true;
  if (!at.at_digit()) return false;
  moment.nanoseconds = at.fraction();
  return true;
}

// Z, or how far the place is ahead of UTC.
bool read_zone(Cursor& at, Moment& moment) {
  at.skip(" ");
  moment.has_zone = true;
  if (at.skip("Zz")) return true;
  const int sign = at.front() == '-' ? -1 : 1;
  if (!at.skip("+-")) return false;
  const auto hours = at.number(2, 0, 23);
  if (!hours) return false;
  int minutes = 0;
  if (!at.at_end()) {
    at.skip(":");
    const auto found = at.number(2, 0, 59);
    if (!found) return false;
    minutes = *found;
  }
  moment.seconds -= sign * (*hours * 3600 + minutes * 60);
  return true;
}

}  // namespace

bool is_like_date(std::string_view text) {
  return text.size() >= 5 && is_digit(text[0]) && is_digit(text[1]) && is_digit(text[2]) &&
         is_digit(text[3]) && text[4] == '-';
}

std::optional<Moment> read_moment(std::string_view text) {
  Cursor at(text);
  const auto days = read_date(at);
  if (!days) return std::nullopt;
  Moment moment;
  moment.seconds = *days * 86400;
  if (at.at_end()) return moment;
  if (!at.skip("Tt ") || !read_time(at, moment)) return std::nullopt;
  if (!at.at_end() && !read_zone(at, moment)) return std::nullopt;
  if (!at.at_end()) return std::nullopt;
  return moment;
}

double seconds_between(const Moment& from, const Moment& to) {
  const std::int64_t seconds = to.seconds - from.seconds, rest = to.nanoseconds - from.nanoseconds;
  constexpr std::int64_t exact = 9000000;  // so many seconds are fewer than 2^53 nanoseconds
  if (std::abs(seconds) < exact)
    return static_cast<double>(seconds * a_second + rest) / static_cast<double>(a_second);
  return static_cast<double>(seconds) + static_cast<double>(rest) / static_cast<double>(a_second);
}

std::string moment_text(const Moment& moment) {
  constexpr std::int64_t a_day = 86400;
  std::int64_t days = moment.seconds / a_day, seconds = moment.seconds % a_day;
  if (seconds < 0) seconds += a_day, --days;
  int year = static_cast<int>(1970 + days / 366);
  while (days_since_1970(year + 1, 1, 1) <= days) ++year;
  while (days_since_1970(year, 1, 1) > days) --year;
  int month = 12;
  while (days_since_1970(year, month, 1) > days) --month;
  const auto two = [](std::int64_t number) {
    return std::string(number < 10 ? "0" : "") + std::to_string(number);
  };
  return std::to_string(year) + "-" + two(month) + "-" + two(days - days_since_1970(year, month, 1) + 1) +
         " " + two(seconds / 3600) + ":" + two(seconds / 60 % 60) + (moment.has_zone ? " UTC" : "");
}

}  // namespace taut::host
