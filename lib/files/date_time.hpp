// Dates and times as ISO 8601 writes them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace taut::host {

/// A moment of the Gregorian calendar, to the nanosecond; leap seconds are not counted.
struct Moment {
  std::int64_t seconds = 0;  ///< since 1970-01-01T00:00:00, of the place or, with a zone, of UTC
  std::int32_t nanoseconds = 0;
  bool has_zone = false;  ///< the text had Z or an offset
};

/// Whether the text begins like a date: four digits and a hyphen.
bool is_like_date(std::string_view text);

/// Reads `2026-03-01T10:00:00`: a blank may stand in place of T; seconds, their fraction after a point or a
/// comma, and Z or an offset such as +02:00, +0200 or +02 may follow, and the time may be left out, for
/// midnight. Nothing if the text is no such moment. What is finer than a nanosecond is cut off.
std::optional<Moment> read_moment(std::string_view text);

/// `2026-03-01 10:00`, as the text had it that the moment was read from; with a zone in UTC, which it says.
std::string moment_text(const Moment& moment);

/// Time from one moment to another [s], rounded once if they are less than 100 days apart. Both must have a
/// zone, or neither.
double seconds_between(const Moment& from, const Moment& to);

}  // namespace taut::host
