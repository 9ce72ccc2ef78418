// The true forces of a jacking: load steps in long double, which share no code with the tracker.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "campaign/load_steps.hpp"
#include "estimation_site/deed.hpp"

namespace estimation_site {

inline reference::Row row_of(const Deed& deed) {
  reference::Row row;
  for (const double factor : deed.factor) row.factor.add(factor);
  for (const Pull& pull : deed.pulls)
    row.jack.add({taut::Jack<double>{pull.force[0], pull.is_held(0)},
                  taut::Jack<double>{pull.force[1], pull.is_held(1)}});
  return row;
}

/// Follows the rows of a jacking and writes the forces into them.
///
/// Rows on one straight line of the loads are gone through in steps of at most a `fineness`-th of the full
/// force of a cable, forces between the ends of a step on a straight line.
class Truth {
 public:
  Truth(reference::Structure structure, std::vector<double> full, int fineness)
      : segments_(structure.prestrain.size()),
        full_(std::move(full)),
        fineness_(fineness),
        steps_(std::move(structure)) {
    good_ = steps_.start(1);
    last_.tension.assign(static_cast<std::size_t>(segments_), 0.0);
    last_.pulls.resize(full_.size());
  }
  bool good() const { return good_; }

  /// Goes on to the last row; false if a step has no answer.
  bool follow(std::vector<Deed>& rows) {
    while (good_ && done_ < rows.size()) {
      std::size_t end = done_;
      while (end + 1 < rows.size() && is_straight(rows, end) && change(last_, rows[end + 1]) <= 1) ++end;
      stretch(rows, end);
    }
    return good_;
  }

 private:
  /// Largest change on the way, 1 being that of one step.
  double change(const Deed& a, const Deed& b) const {
    double most = 0;
    for (std::size_t c = 0; c < full_.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        most = std::fmax(most, std::fabs(b.pulls[c].force[end] - a.pulls[c].force[end]) / full_[c]);
    most = std::fmax(most, std::fabs(b.factor[dead] - a.factor[dead]));
    most = std::fmax(most, std::fabs(b.factor[sun] - a.factor[sun]) / 40);
    return most * fineness_;
  }
  static bool has_same_wedges(const Deed& a, const Deed& b) {
    return std::equal(a.pulls.begin(), a.pulls.end(), b.pulls.begin(),
                      [](const Pull& one, const Pull& other) {
                        return one.locked == other.locked && one.shut == other.shut;
                      });
  }
  /// Whether the loads go on past a row as they came to it.
  bool is_straight(const std::vector<Deed>& rows, std::size_t i) const {
    const Deed &before = i == done_ ? last_ : rows[i - 1], &at = rows[i], &after = rows[i + 1];
    if (!has_same_wedges(before, at) || !has_same_wedges(at, after)) return false;
    const auto bend = [](double a, double b, double c) { return std::fabs(a - 2 * b + c); };
    double most = 0;
    for (std::size_t c = 0; c < full_.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        most = std::fmax(
            most,
            bend(before.pulls[c].force[end], at.pulls[c].force[end], after.pulls[c].force[end]) / full_[c]);
    for (std::size_t load = 0; load < patterns; ++load)
      most = std::fmax(most, bend(before.factor[load], at.factor[load], after.factor[load]));
    return most < 1e-9;
  }
  /// One straight line up to row `end`.
  void stretch(std::vector<Deed>& rows, std::size_t end) {
    const bool wedge_moves = !has_same_wedges(last_, rows[end]);
    const int steps = std::max(wedge_moves ? fineness_ / 4 + 1 : 1,
                               static_cast<int>(std::ceil(change(last_, rows[end]) - 1e-9)));
    good_ = steps_.advance(row_of(rows[end]), steps);
    if (!good_) return;
    read(rows[end]);
    for (std::size_t i = done_; i < end; ++i)
      mix(last_, rows[end], double(i - done_ + 1) / double(end - done_ + 1), rows[i]);
    last_ = rows[end];
    done_ = end + 1;
  }
  void read(Deed& deed) const {
    deed.tension.resize(static_cast<std::size_t>(segments_));
    for (int i = 0; i < segments_; ++i)
      deed.tension[static_cast<std::size_t>(i)] = static_cast<double>(steps_.tension(i));
    for (std::size_t c = 0; c < full_.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        deed.pulls[c].extension[end] = static_cast<double>(steps_.extension(static_cast<int>(2 * c + end)));
  }
  static void mix(const Deed& a, const Deed& b, double part, Deed& between) {
    between.tension.resize(a.tension.size());
    for (std::size_t i = 0; i < a.tension.size(); ++i)
      between.tension[i] = a.tension[i] + part * (b.tension[i] - a.tension[i]);
    for (std::size_t c = 0; c < a.pulls.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        const double from = a.pulls[c].extension[end], to = b.pulls[c].extension[end];
        between.pulls[c].extension[end] = from + part * (to - from);
      }
  }

  int segments_;
  std::vector<double> full_;  ///< force of every cable [N]
  int fineness_;
  campaign::LoadSteps steps_;
  Deed last_;
  std::size_t done_ = 0;
  bool good_ = true;
};

}  // namespace estimation_site
