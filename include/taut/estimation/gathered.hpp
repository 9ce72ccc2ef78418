// Readings of one load cell that are taken into account together.
#pragma once

#include <cstdint>

namespace taut {

/// As long as nothing happens but that the load of one jack changes, what a cell at the other end should read
/// is a straight line in that load. There the mean of a few readings, at the mean of the loads, says all that
/// they say one by one.
///
/// Of the loads there are two: what the jack read, and what the model was driven to, which derivatives go by.
/// They must not go by the reading: its noise would be in what is measured and in what it is weighed with.
template <class Scalar>
struct Gathered {
  static constexpr int capacity = 16;

  // Of the line.
  Scalar jack_from = 0, driven_from = 0;  ///< the loads of the first reading [N]
  Scalar level = 0, slope = 0;  ///< what the cell should read there [N], and its change with the load [-]
  Scalar spread = 0;            ///< variance of a reading about the line [N^2]
  Scalar of_model = 0;          ///< the part of it that they have in common [N^2]
  Scalar jack_variance = 0;     ///< of a reading of the jack [N^2]
  Scalar lasting = 0;           ///< the largest variance that readings had in common by errors [N^2]
  // Sums.
  Scalar jack_further = 0, driven_further = 0;  ///< loads beyond the first one [N]
  Scalar off = 0;                               ///< how far the cell's readings were off the line [N]
  std::int8_t size = 0;
  std::int8_t room = 0;  ///< so many are taken into account together

  void begin(Scalar jack, Scalar driven, int most) {
    jack_from = jack;
    driven_from = driven;
    jack_further = driven_further = off = lasting = 0;
    size = 0;
    room = static_cast<std::int8_t>(most < capacity ? most : capacity);
  }
  Scalar off_line(Scalar jack, Scalar reading) const {
    return reading - (level + slope * (jack - jack_from));
  }
  void add(Scalar jack, Scalar driven, Scalar off_by) {
    jack_further += jack - jack_from;
    driven_further += driven - driven_from;
    off += off_by;
    ++size;
  }
  bool is_full() const { return size >= room; }
  Scalar share() const { return 1 / static_cast<Scalar>(size); }
  /// Means [N].
  Scalar jack() const { return jack_from + jack_further * share(); }
  Scalar driven() const { return driven_from + driven_further * share(); }
  Scalar reading() const { return level + (slope * jack_further + off) * share(); }
};

}  // namespace taut
