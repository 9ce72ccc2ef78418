// What the estimates of a case are worth.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "estimation_site/files.hpp"
#include "estimation_site/program.hpp"

namespace estimation_site {

/// Segment forces over rows: of a phase, or of all.
class Score {
 public:
  void add(double found, double sd, double truth, double full) {
    // Next to nothing a relative error says nothing.
    if (truth < 0.01 * full) return;
    const double error = found - truth;
    ++count_;
    // The truth is known to that.
    const double rounding = 2e-5 * full;
    if (std::fabs(error) <= 1.96 * sd + rounding) ++held_;
    error_ += error * error / (full * full);
    variance_ += sd * sd / (full * full);
    const double normalized = std::fmin(100, std::fabs(error) / std::fmax(sd, rounding));
    normalized_ += normalized * normalized;
    if (truth < 0.1 * full) return;
    ++relative_count_;
    relative_ += error * error / (truth * truth);
  }
  long count() const { return count_; }
  /// Of the 95 % intervals that hold the truth [%].
  double coverage() const { return 100 * double(held_) / double(count_); }
  /// Relative to the true force of the segment, where that is above a tenth of the full force [%].
  double error() const { return 100 * std::sqrt(relative_ / double(relative_count_)); }
  double sd_over_rms() const { return std::sqrt(variance_ / error_); }
  /// rms of error / sd, none counted for more than 100.
  double normalized() const { return std::sqrt(normalized_ / double(count_)); }

 private:
  long count_ = 0, held_ = 0, relative_count_ = 0;
  double error_ = 0, variance_ = 0, normalized_ = 0, relative_ = 0;
};

/// A case with or without far-end cell.
struct Tally {
  long jackings = 0, stopped = 0;  ///< exit status 1
  long broken = 0;                 ///< killed, not finite, rows missing
  Score all, fresh, end;
  std::array<Score, phases> phase;
  double mu_error = 0, mu_variance = 0;  ///< relative to the nominal mu, at the end
  long mu_count = 0;
  std::map<std::string, long>
      alarms;           ///< jackings with that word, without its place; not `mu` where it is right
  long odd = 0;         ///< jackings with an alarm that says that something does not fit
  std::string refusal;  ///< why the program calls the input unusable

  double mu_rms() const { return 100 * std::sqrt(mu_error / double(mu_count)); }
  double mu_sd() const { return 100 * std::sqrt(mu_variance / double(mu_count)); }
};

/// Whether a word says that instruments and model do not fit, and not what friction or forces are.
inline bool is_odd(const std::string& word) {
  static const std::set<std::string> others = {"no-information", "unknown-past", "lift-off", "force-low",
                                               "force-high",     "unknown-past", "mu",       "stuck",
                                               "outlier"};
  return others.count(word) == 0;
}

/// Whether mu is nearly as far from its nominal value as the alarm about it says, or farther.
inline bool is_mu_far_off(const Jacked& jacked) {
  for (std::size_t c = 0; c < jacked.reality.size(); ++c) {
    const Cable& cable = jacked.ground.cables[c];
    for (const double mu : jacked.reality[c].mu)
      if (std::fabs(mu - cable.mu) > 1.9 * cable.mu_sd) return true;
  }
  return false;
}

/// Counts what the program has found of a cable; returns whether all of it is finite.
inline bool judge_cable(const Jacked& jacked, std::size_t c, const Result& result, Tally& tally) {
  const Cable& cable = jacked.ground.cables[c];
  const auto segments = static_cast<std::size_t>(cable.segments()),
             first = static_cast<std::size_t>(cable.first_segment);
  std::vector<std::size_t> T, sd, mu, mu_sd;
  for (std::size_t i = 1; i <= segments; ++i) {
    const std::string name = cable_name(c), n = std::to_string(i);
    T.push_back(result.column(name + ".T" + n));
    sd.push_back(result.column(name + ".sd" + n));
    if (i == segments) continue;
    mu.push_back(result.column(name + ".mu" + n));
    mu_sd.push_back(result.column(name + ".mu_sd" + n));
  }
  bool sound = true;
  const std::size_t rows = std::min(result.rows(), jacked.rows.size());
  for (std::size_t row = 0; row < rows; ++row) {
    const Deed& deed = jacked.rows[row];
    const Pull& pull = deed.pulls[c];
    for (std::size_t i = 0; i < segments; ++i) {
      const double found = result.number(row, T[i]), deviation = result.number(row, sd[i]),
                   truth = deed.tension[first + i];
      if (!std::isfinite(found) || !std::isfinite(deviation) || deviation < 0) {
        sound = false;
        continue;
      }
      tally.all.add(found, deviation, truth, cable.full);
      tally.phase[static_cast<std::size_t>(pull.phase)].add(found, deviation, truth, cable.full);
      if (pull.fresh) tally.fresh.add(found, deviation, truth, cable.full);
      if (row + 1 == jacked.rows.size()) tally.end.add(found, deviation, truth, cable.full);
    }
  }
  if (rows == jacked.rows.size())
    for (std::size_t j = 0; j < mu.size(); ++j) {
      const double error = result.number(rows - 1, mu[j]) - jacked.reality[c].mu[j];
      tally.mu_error += std::pow(error / cable.mu, 2);
      tally.mu_variance += std::pow(result.number(rows - 1, mu_sd[j]) / cable.mu, 2);
      ++tally.mu_count;
    }
  return sound;
}

/// Counts what the program has found; returns whether that is an answer to all rows.
inline bool judge(const Jacked& jacked, int status, const Result& result, Tally& tally) {
  ++tally.jackings;
  if (status == 1) ++tally.stopped;
  bool sound = status == 1 || (status == 0 && result.rows() == jacked.rows.size());
  for (std::size_t c = 0; c < jacked.ground.cables.size(); ++c)
    sound = judge_cable(jacked, c, result, tally) && sound;
  const std::size_t alarms = result.column("alarms"), rows = std::min(result.rows(), jacked.rows.size());
  std::set<std::string> words;
  for (std::size_t row = 0; row < rows; ++row) {
    std::istringstream stream(result.word(row, alarms));
    for (std::string word; stream >> word;) words.insert(word.substr(0, word.find(':')));
  }
  if (is_mu_far_off(jacked)) words.erase("mu");
  bool odd = false;
  for (const std::string& word : words) {
    ++tally.alarms[word];
    odd = odd || is_odd(word);
  }
  if (odd) ++tally.odd;
  if (!sound) ++tally.broken;
  return sound && status == 0;
}

}  // namespace estimation_site
