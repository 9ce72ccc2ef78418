// Where a load was farthest before it came back, from its last readings.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "taut/numerics/decay.hpp"
#include "taut/numerics/larger.hpp"

namespace taut {

/// The load at a turn [N].
template <class Scalar>
struct TurnedLoad {
  Scalar load = 0, sd = 0;
  bool is_known = false;
};

/// Readings of a load, the last ones, and what they say of where it turned. A load that is known to have
/// turned has gone straight to the turn, has perhaps rested there, and has come straight back: all places of
/// both corners are tried, and weighed by how well they fit, Eqs. (59) to (61).
///
/// Where the load is slow beside its noise, means of several readings are kept in place of single ones, so
/// that the turn is still among them when it is noticed. A plain value.
template <class Scalar>
class TurningPoint {
 public:
  /// Means of readings that are kept.
  static constexpr int capacity = 24;

  void clear() {
    size_ = 0;
    missed_ = 0;
  }
  /// A reading [N], `dt` > 0 after the one before, with noise of standard deviation `noise` [N]. A time
  /// without readings that is long beside the usual one begins anew: what the load did then is not known.
  /// Cost: a few operations, and every few readings a pass over what is kept.
  void add(Scalar reading, Scalar dt, Scalar noise) {
    const Scalar step = missed_ + dt;
    missed_ = 0;
    // As long as there is one reading, any step may be usual.
    if (readings_ > 1 && step * static_cast<Scalar>(readings_ - 1) > gap * now_) size_ = 0;
    if (size_ == 0) {
      readings_ = most_ = 1;
      now_ = 0;
    } else {
      ++readings_;
      now_ += step;
      const int last = size_ - 1;
      const Scalar n = at(count_, last), off = reading - at(level_, last);
      if (off * off * n > surprise * surprise * noise * noise * (n + 1)) {
        most_ = 1;
      } else if (at(count_, last) < most_) {
        ++at(count_, last);
        at(level_, last) += off / (n + 1);
        return;
      }
    }
    if (size_ == capacity) make_room(noise);
    at(level_, size_) = reading;
    at(begin_, size_) = now_;
    at(count_, size_) = 1;
    ++size_;
  }
  /// A reading that is none, `dt` after the one before.
  void miss(Scalar dt) { missed_ += dt; }

  /// Where the load was highest, or lowest, before it came back; the next turn is after this one, so what
  /// came before is dropped. Not known if it turned before the readings that are kept, or if no such path
  /// fits any number of the last ones, as where one is hundreds of standard deviations from the next: it
  /// tells enough by itself. Cost: some six hundred times forty operations, at worst six times that.
  [[gnu::noinline]] TurnedLoad<Scalar> find(Scalar noise, bool is_highest) {
    for (int first = 0; noise > 0 && first + fewest <= size_; first += later) {
      Path path;
      load_path(first, noise, is_highest, path);
      const Found found = path.find();
      if (!found.fits) continue;
      const Scalar way = is_highest ? noise : -noise;
      const TurnedLoad<Scalar> turned = {at(level_, first) + way * static_cast<Scalar>(found.level),
                                         noise * static_cast<Scalar>(found.sd), !found.is_before};
      drop(first + found.turn);
      return turned;
    }
    clear();
    return {};
  }

 private:
  /// A step so many times the usual one is a gap.
  static constexpr Scalar gap = 4;
  /// A reading farther from the mean before it than so many standard deviations begins a new one.
  static constexpr Scalar surprise = Scalar(3.5);
  /// Where all that is kept spans less than so many standard deviations of a mean, two become one.
  static constexpr Scalar slow = 7;
  static constexpr int most_in_one = 32;
  /// Means that go for want of room; that are left out if no path fits; and that make a path, at least.
  static constexpr int oldest = 6, later = 4, fewest = 4;

  template <class Array>
  static auto& at(Array& array, int i) {
    return array[static_cast<std::size_t>(i)];
  }
  void make_room(Scalar noise) {
    const Scalar span = at(level_, size_ - 1) - at(level_, 0), most = slow * noise;
    if (most_ < most_in_one && span * span * most_ < most * most)
      take_two_by_two();
    else
      drop(oldest);
  }
  void take_two_by_two() {
    size_ /= 2;
    for (int i = 0; i < size_; ++i) {
      const int n = at(count_, 2 * i), m = at(count_, 2 * i + 1);
      const Scalar part = static_cast<Scalar>(m) / static_cast<Scalar>(n + m);
      at(level_, i) = at(level_, 2 * i) + part * (at(level_, 2 * i + 1) - at(level_, 2 * i));
      at(begin_, i) = at(begin_, 2 * i);
      at(count_, i) = static_cast<std::uint8_t>(n + m);
    }
    most_ = static_cast<std::uint8_t>(2 * most_);
  }
  /// Drops the first ones, of which there are more.
  void drop(int first) {
    const Scalar from = at(begin_, first);
    for (int i = 0; i < first; ++i) readings_ -= at(count_, i);
    size_ -= first;
    now_ -= from;
    for (int i = 0; i < size_; ++i) {
      at(level_, i) = at(level_, i + first);
      at(begin_, i) = at(begin_, i + first) - from;
      at(count_, i) = at(count_, i + first);
    }
  }

  // Single precision is enough: levels are in standard deviations of a reading, times in readings.

  struct Found {
    float level = 0, sd = 0;
    int turn = 0;  ///< where the path that fits best comes to rest
    bool fits = false, is_before = false;
  };
  /// A straight line that ends in the turn, at level H: the square of its misfit is a H^2 - 2 b H + c, its
  /// slope (xy - H x) / xx. Slopes have a prior, so that a line of no reading is one, too.
  struct Line {
    static constexpr float steepest = 100;
    float a = 0, b = 0, c = 0, x = 0, xy = 0, xx = 1 / (steepest * steepest);

    void add(float dx, float y, float n) {
      a += n;
      b += n * y;
      c += n * y * y;
      x += n * dx;
      xy += n * dx * y;
      xx += n * dx * dx;
    }
    void end() {
      a -= x * x / xx;
      b -= x * xy / xx;
      c -= xy * xy / xx;
    }
    /// What is added to the misfit at level `H` if the line may not go down, or up, with time.
    float against(float H, bool rises) const {
      const float slope = xy - H * x;
      return (rises ? slope < 0 : slope > 0) ? slope * slope / xx : 0;
    }
  };
  /// A path with its corners at one place.
  struct Tried {
    float misfit, level, precision;
    float likelihood;  ///< beside the misfit
    int turn;          ///< where it comes to rest
    bool is_before;
  };
  /// Of all of them the one that fits best; then, with the `scatter` that it leaves, what all say together.
  struct AllPaths {
    /// No misfit is so large: its square would overflow.
    static constexpr float none = 1e18F;

    float least = none, best = 0, scatter = 0;
    float weights = 0, mean = 0, square = 0, early = 0;  // sums of weights, about `best`
    int turn = 0;

    void take(const Tried& path) {
      if (scatter > 0) return weigh(path);
      if (!(path.misfit < least)) return;
      least = path.misfit;
      best = path.level;
      turn = path.turn;
    }

   private:
    void weigh(const Tried& path) {
      const float weight = path.likelihood * decay((path.misfit - least) / (2 * scatter)),
                  off = path.level - best;
      weights += weight;
      mean += weight * off;
      square += weight * (off * off + scatter / path.precision);
      if (path.is_before) early += weight;
    }
  };
  struct Path {
    /// Of the path that rests at the turn, and that does not.
    static constexpr float rests = 0.8F;
    /// A misfit is too large beyond so many of its standard deviations.
    static constexpr float too_far = 3;
    /// If it is more likely that the load has rested from the first mean on, for fewer, it turned before.
    static constexpr int first_ones = 3;

    std::array<float, capacity> level, begin, middle, end, count;
    std::array<Line, capacity> after;
    int size = 0;

    Line line(int from, int to, float turn) const {
      Line line;
      for (int i = from; i < to; ++i) line.add(at(middle, i) - turn, at(level, i), at(count, i));
      line.end();
      return line;
    }
    /// Shows all places of the corners to `all`: where means of readings begin and end, or in the middle of
    /// one.
    void try_all(AllPaths& all) const {
      const auto meet = [&](const Line& before, const Line& rest, const Line& back, float likely, int i,
                            bool is_before) {
        const float A = before.a + rest.a + back.a;
        if (!(A > 0)) return;
        const float B = before.b + rest.b + back.b, H = B / A,
                    misfit =
                        before.c + rest.c + back.c - B * H + before.against(H, true) + back.against(H, false);
        // Not a number, neither.
        if (misfit < AllPaths::none)
          all.take({misfit, H, A, likely / std::sqrt(A * before.xx * back.xx), i, is_before});
      };
      const float long_rest = rests / static_cast<float>(size);
      for (int i = 0; i < size; ++i) {
        const Line before = line(0, i, at(begin, i));
        Line rest;
        for (int j = i; j < size; ++j) {
          rest.add(0, at(level, j), at(count, j));
          const bool is_inside = j == i && at(count, i) > 1, is_before = i == 0 && j < first_ones;
          meet(before, rest, at(after, j), j == i && !is_inside ? 1 - rests : long_rest, i, is_before);
          if (is_inside)
            meet(line(0, i, at(middle, i)), Line(), line(i + 1, size, at(middle, i)), 1 - rests, i,
                 is_before);
        }
      }
    }
    Found find() {
      for (int j = 0; j < size; ++j) at(after, j) = line(j + 1, size, at(end, j));
      const auto n = static_cast<float>(size);
      AllPaths all;
      try_all(all);
      Found found;
      found.turn = all.turn;
      const float beyond = all.least - n;
      found.fits = beyond < 0 || beyond * beyond < too_far * too_far * 2 * n;
      if (!found.fits) return found;
      // A path that is not quite straight tells less.
      all.scatter = larger(1.F, all.least / n);
      try_all(all);
      const float mean = all.mean / all.weights;
      found.level = all.best + mean;
      found.sd = std::sqrt(larger(all.square / all.weights - mean * mean, 0.F));
      found.is_before = all.early > all.weights / 2;
      return found;
    }
  };
  void load_path(int first, Scalar noise, bool is_highest, Path& path) const {
    const Scalar per_sd = (is_highest ? 1 : -1) / noise,
                 per_step = now_ > 0 ? static_cast<Scalar>(readings_ - 1) / now_ : Scalar(1);
    path.size = size_ - first;
    for (int i = 0; i < path.size; ++i) {
      const Scalar level = at(level_, first + i) - at(level_, first),
                   begin = at(begin_, first + i) - at(begin_, first);
      at(path.count, i) = at(count_, first + i);
      at(path.level, i) = static_cast<float>(level * per_sd);
      at(path.begin, i) = static_cast<float>(begin * per_step);
      at(path.end, i) = at(path.begin, i) + at(path.count, i) - 1;
      at(path.middle, i) = (at(path.begin, i) + at(path.end, i)) / 2;
    }
  }

  std::array<Scalar, static_cast<std::size_t>(capacity)> level_{};  // means of readings [N]
  std::array<Scalar, static_cast<std::size_t>(capacity)> begin_{};  // time of the first one of each
  std::array<std::uint8_t, static_cast<std::size_t>(capacity)> count_{};
  Scalar now_ = 0, missed_ = 0;  // time of the last reading; since then
  int size_ = 0, readings_ = 0;
  std::uint8_t most_ = 0;  // readings that make a mean
};

}  // namespace taut
