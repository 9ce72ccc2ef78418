// Readings that a logger writes again until the next one comes: they are no new ones.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/estimation/readings.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/scene.hpp"

namespace taut {

/// A load cell that is read more seldom than rows are written: its last value is written again until the next
/// comes, and counts once, Eq. (77). That is seen where changes hardly follow each other directly, and are
/// large beside how finely the cell reads: its noise would not repeat a reading to the last digit. Steps of a
/// coarse display repeat, too, but are multiples of one; so does a load at rest without noise, but not while
/// it moves. A plain value. Cost: a few operations a row.
template <class Scalar>
class HeldReading {
 public:
  /// What is written for longer was read [s].
  static constexpr Scalar most = 60;

  /// Whether what a row has was read before: it is known to, being no longer there than others were; or may
  /// have been, as long as it is not known how the cell is read.
  enum class Again : std::uint8_t { no, maybe, yes };

  /// What a row has [N], `dt` [s] after the one before; by more than is `possible` [N], or to what is no
  /// number, no load changes.
  Again take(Scalar reading, Scalar dt, const Scalar& possible) {
    age_ += dt;
    if (reading == last_) {
      is_repeated_ = true;
      if (is_known()) return usual_ > fine * step_ && age_ < nearly * longest_ ? Again::yes : Again::no;
      return in_row_ < straight ? Again::maybe : Again::no;
    }
    const Scalar by = std::fabs(reading - last_);
    if (is_repeated_)
      follow(by, possible);
    else if (in_row_ < straight && ++in_row_ == straight)
      held_ = 0;
    before_ = by;
    last_ = reading;
    age_ = 0;
    is_repeated_ = false;
    return Again::no;
  }

 private:
  static constexpr std::uint8_t few = 3, many = 8, straight = 4;  // changes
  static constexpr Scalar fine = 8, nearly = Scalar(0.99), some = 10;

  // Load stages without noise are held for a quarter of a minute, too.
  bool is_known() const { return held_ >= (longest_ > some ? many : few); }
  /// A change that follows a reading that was written again.
  void follow(Scalar by, Scalar possible) {
    const Scalar other = std::fabs(by - before_);
    in_row_ = 0;
    if (age_ > most || !(by <= possible)) return;
    if (held_ == 0) {
      longest_ = usual_ = 0;
      step_ = by;
    }
    if (held_ < many) ++held_;
    longest_ = larger(longest_, age_);
    usual_ += (by - usual_) / static_cast<Scalar>(held_);
    // Steps of a display are multiples of one but for the last digit that is written.
    for (const Scalar step : {by, other})
      if (step > by / 256 && step < step_) step_ = step;
  }

  Scalar last_ = 0;                     // reading [N]
  Scalar age_ = 0;                      // since it was first written [s]
  Scalar longest_ = 0;                  // that one was there until the next came [s]
  Scalar before_ = 0;                   // the last change [N]
  Scalar usual_ = 0;                    // mean of those that followed a reading that was written again [N]
  Scalar step_ = 0;                     // how finely the cell reads, at most [N]
  std::uint8_t held_ = 0, in_row_ = 0;  // readings that were written again; changes one after the other
  bool is_repeated_ = false;
};

/// The load cells of all ends.
template <class Scalar, class Cap>
class HeldCells {
 public:
  /// Returns whether a row of this model has readings that count no more: then drop() takes them out. Of a
  /// far end those do not count that may have been read before either while its jack pulls: what it has
  /// taught of a load of before stays, and a jack that rests is no rare thing. Cost: that of HeldReading for
  /// each.
  template <class Model>
  bool take(const Readings<Scalar, Cap>& readings, const Model& model) {
    using Again = typename HeldReading<Scalar>::Again;
    const auto& cables = model.cables;
    bool any = false;
    may_be_old_ = false;
    for (int c = 0; c < cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        const auto& given = readings.ends[c][end];
        auto& cell = cells_[c][end];
        cell.is_held = cell.may_be_old = false;
        if (!given.has_force) continue;
        const Again again = cell.reading.take(given.force, readings.dt, model.most_force[c]);
        if (again == Again::no) continue;
        const std::size_t other = 1 - end;
        cell.is_held = again == Again::yes ||
                       (cables[c].ends[end] == End::anchored && cables[c].ends[other] == End::jacked &&
                        !readings.sample.jack[c][other].locked);
        // A jack that has no load shows none in every row.
        cell.may_be_old = !cell.is_held && given.force != 0;
        may_be_old_ |= cell.may_be_old;
        any |= cell.is_held;
      }
    return any;
  }
  void drop(Readings<Scalar, Cap>& readings) const {
    for (int c = 0; c < cells_.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (cells_[c][end].is_held) readings.ends[c][end].has_force = false;
  }
  /// Whether what the last row has of an end counts, but may have been read before; of any end.
  bool may_be_old(int cable, std::size_t end) const { return cells_[cable][end].may_be_old; }
  bool any_may_be_old() const { return may_be_old_; }

 private:
  struct Cell {
    HeldReading<Scalar> reading;
    bool is_held = false, may_be_old = false;  // in the last row
  };

  FixedArray<std::array<Cell, 2>, Cap::cables> cells_;
  bool may_be_old_ = false;
};

}  // namespace taut
