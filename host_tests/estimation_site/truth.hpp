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
  row.jack.add(
      {taut::Jack<double>{deed.force[0], deed.locked[0]}, taut::Jack<double>{deed.force[1], deed.locked[1]}});
  return row;
}

/// Follows the rows of a jacking and writes the forces into them.
///
/// Rows on one straight line of the loads are gone through in steps of at most a `fineness`-th of the full
/// force, forces between the ends of a step on a straight line.
class Truth {
 public:
  Truth(reference::Structure structure, double full, int fineness)
      : segments_(structure.prestrain.size()),
        full_(full),
        fineness_(fineness),
        steps_(std::move(structure)) {
    good_ = steps_.start(1);
    last_.tension.assign(static_cast<std::size_t>(segments_), 0.0);
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
    for (std::size_t end = 0; end < 2; ++end)
      most = std::fmax(most, std::fabs(b.force[end] - a.force[end]) / full_);
    most = std::fmax(most, std::fabs(b.factor[dead] - a.factor[dead]));
    most = std::fmax(most, std::fabs(b.factor[sun] - a.factor[sun]) / 40);
    return most * fineness_;
  }
  /// Whether the loads go on past a row as they came to it.
  bool is_straight(const std::vector<Deed>& rows, std::size_t i) const {
    const Deed &before = i == done_ ? last_ : rows[i - 1], &at = rows[i], &after = rows[i + 1];
    if (before.locked != at.locked || at.locked != after.locked) return false;
    const auto bend = [](double a, double b, double c) { return std::fabs(a - 2 * b + c); };
    double most = 0;
    for (std::size_t end = 0; end < 2; ++end)
      most = std::fmax(most, bend(before.force[end], at.force[end], after.force[end]) / full_);
    for (std::size_t load = 0; load < patterns; ++load)
      most = std::fmax(most, bend(before.factor[load], at.factor[load], after.factor[load]));
    return most < 1e-9;
  }
  /// One straight line up to row `end`.
  void stretch(std::vector<Deed>& rows, std::size_t end) {
    const bool wedge_moves = last_.locked != rows[end].locked;
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
    for (int end = 0; end < 2; ++end)
      deed.extension[static_cast<std::size_t>(end)] = static_cast<double>(steps_.extension(end));
  }
  static void mix(const Deed& a, const Deed& b, double part, Deed& between) {
    between.tension.resize(a.tension.size());
    for (std::size_t i = 0; i < a.tension.size(); ++i)
      between.tension[i] = a.tension[i] + part * (b.tension[i] - a.tension[i]);
    for (std::size_t end = 0; end < 2; ++end)
      between.extension[end] = a.extension[end] + part * (b.extension[end] - a.extension[end]);
  }

  int segments_;
  double full_;
  int fineness_;
  campaign::LoadSteps steps_;
  Deed last_;
  std::size_t done_ = 0;
  bool good_ = true;
};

}  // namespace estimation_site
