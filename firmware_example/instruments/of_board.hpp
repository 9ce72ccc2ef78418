// The instruments that a board has itself, beside those on the line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "instruments/reading.hpp"

namespace instruments {

/// Whether a board has
///
///   instruments::Reading instrument(int cable, std::size_t end, instruments::Quantity quantity);
///
/// A board without it pays nothing.
template <class Board, class = void>
struct HasInstruments : std::false_type {};
template <class Board>
struct HasInstruments<
    Board, std::void_t<decltype(std::declval<Board&>().instrument(0, std::size_t{0}, Quantity::force))>>
    : std::true_type {};

/// Puts a reading where the line has none. One with a fault, or older than `oldest` [ms], becomes a NaN,
/// which is out of every range. Nothing changes where the board has no such instrument.
inline void fill(bool& has, float& value, const Reading& own, std::uint32_t now, std::uint32_t oldest) {
  if (has || own.fault == Fault::absent) return;
  has = true;
  value = own.is_good() && now - own.at <= oldest ? own.value : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace instruments
