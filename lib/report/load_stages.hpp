// The stages of a tensioning, found in the readings of a jack: where it rested, turned, and was locked.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace taut::host {

/// What is known of a jack in one row. Units: s, N, m.
struct JackRow {
  std::size_t row = 0;
  double time = 0;
  double force = 0;                ///< of the jack, by its gauge
  bool locked = false;             ///< the wedge holds, and the gauge tells nothing of the cable
  std::optional<double> stroke;    ///< measured
  std::optional<double> expected;  ///< stroke that is computed for this force
  double anchored = 0;             ///< force of the segment at the jack, as estimated
};

/// A mean over rows that follow each other.
class RowMean {
 public:
  void add(double value) { sum_ += value, ++count_; }
  void join(const RowMean& later) { sum_ += later.sum_, count_ += later.count_; }
  bool empty() const { return count_ == 0; }
  double value() const { return sum_ / static_cast<double>(count_); }
  std::optional<double> optional() const { return empty() ? std::nullopt : std::optional<double>(value()); }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

/// The slope of a straight line through points.
class Trend {
 public:
  void add(double x, double y);
  void join(const Trend& later);
  std::size_t count() const { return count_; }
  /// Zero if there is none.
  double slope() const { return xx_ > 0 ? xy_ / xx_ : 0; }

 private:
  std::size_t count_ = 0;
  double x_ = 0, y_ = 0, xx_ = 0, xy_ = 0;  // means, and sums about them
};

/// The noise of readings, from how far each is off the line through the two before: the median tells it, so
/// that neither corners nor outliers count.
class ReadingNoise {
 public:
  void add(double time, double reading);
  /// To a fifth; zero if most readings lie on straight lines, or there are less than a hundred.
  double deviation() const;

 private:
  static constexpr int half_bins = 128;

  std::array<std::size_t, 2 * half_bins> bins_{};  // of squares, by their binary exponent
  std::size_t total_ = 0, count_ = 0;
  double two_before_ = 0, before_ = 0, second_last_ = 0, last_ = 0;
};

/// Where a jack stood for a while. Units: s, N, m; forces and strokes are means over the rows.
struct LoadStage {
  enum class Kind {
    reference,  ///< passed on the way up: from here strokes are counted
    hold,       ///< it rested
    turn,       ///< it turned, or rested too shortly to be seen
    passed,     ///< a force that was asked for was passed without a rest
    locked,     ///< its wedge was set; `force` is that of the segment behind it
    last        ///< the log ends
  };
  Kind kind = Kind::hold;
  std::size_t first_row = 0, last_row = 0;
  double first_time = 0, last_time = 0;
  double force = 0;
  std::optional<double> stroke, expected;
};

/// Takes a jack row by row, however many there are, in bounded memory.
///
/// Rows whose forces lie within a hundredth of the largest are one step; with noisy readings, within eight
/// standard deviations of them and at most five hundredths: with noise of more than a three-hundredth of the
/// largest force rests may be missed. How fast the jack pulls is the speed
/// below which it covers a quarter of its way. It rests in a step whose slope is less than a quarter of that,
/// and which lasts longer than pulling through one and a half; a row that stands alone is a rest if pulling
/// through four takes less than the time to the next, or if that is five minutes or more: a log with a row a
/// second and one with a row a stage are treated alike. A turn is one if the force then comes back by more
/// than a fiftieth of the largest.
class LoadStages {
 public:
  void add(const JackRow& row);

  /// In the order of time, at most `most_stages`, of which the first and the last are kept; none if the jack
  /// never pulled. Stages below a thirtieth of the largest force are left out until it is reached. If
  /// nothing rests below a third of the largest force, the step in which a tenth of it is passed comes first,
  /// as `reference`. Cost: linear in the steps.
  std::vector<LoadStage> stages() const;
  /// The step after this row whose force is nearest to one that is asked for, as `passed`; nothing if no step
  /// is within this part of it. Steps behind a wedge do not count. Cost: linear in the steps.
  std::optional<LoadStage> passing(double force, double part, std::size_t after_row) const;
  double largest() const { return largest_; }

  static constexpr std::size_t most_stages = 48;

 private:
  struct Step {
    std::size_t first_row = 0, last_row = 0;
    double first_time = 0, last_time = 0, least = 0, most = 0;
    bool locked = false, rests = false, turns = false;
    RowMean force, stroke, expected;
    Trend trend;
    double mean() const { return force.value(); }
    double middle() const { return (first_time + last_time) / 2; }
    bool takes(const Step& later, double band) const;
    void join(const Step& later);
    LoadStage stage(LoadStage::Kind kind) const;
  };
  static std::vector<Step> joined(const std::vector<Step>& steps, double band);
  static double pulling_speed(const std::vector<Step>& steps, double idle);
  static std::vector<Step> rested(const std::vector<Step>& steps, double band, double idle);
  static void mark_turns(std::vector<Step>& steps, double least);
  double band() const;

  static constexpr std::size_t most_steps = 4096;

  std::vector<Step> steps_;
  ReadingNoise noise_;
  double largest_ = 0, coarse_ = 1;
};

}  // namespace taut::host
