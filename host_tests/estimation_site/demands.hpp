// What must hold: `--check`.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "estimation_site/judge.hpp"

namespace estimation_site {

/// The results of a case, and the way its accuracy was given.
struct Outcome {
  const Case* tried = nullptr;
  std::string way;  ///< plain, declared or silent
  Tally far, alone;
};

/// A demand, and what was found, with what was asked.
struct Judged {
  std::string demand, found;
  bool is_met = false;
};

/// Judges results by what is asked of them.
class Demands {
 public:
  void check(const Outcome& outcome) {
    for (const bool far : {true, false}) {
      const Tally& tally = far ? outcome.far : outcome.alone;
      if (tally.jackings == 0 && tally.refusal.empty()) continue;
      where_ = outcome.tried->name + " (" + outcome.way + (far ? ", far-end cell)" : ", jack alone)");
      check(*outcome.tried, outcome.way, far, tally);
    }
  }
  const std::vector<Judged>& judged() const { return judged_; }

 private:
  void check(const Case& tried, const std::string& way, bool far, const Tally& tally) {
    if (!tally.refusal.empty()) {
      judged_.push_back({where_ + ": an answer", "refused: " + tally.refusal, false});
      return;
    }
    between("runs without a usable result", double(tally.broken), 0, 0);
    const std::string& name = tried.name;
    // Forces are those of the log, wherever it says so late.
    const bool in_stages = tried.jacking.stages && tried.locks_late == 0;
    if (tried.silent) {
      if (name == "typical-mix-silent") between("coverage", tally.all.coverage(), 90, 100);
      return;
    }
    if (tried.demand == Demand::model) {
      between("coverage", tally.all.coverage(), 93, 97);
      if (tally.fresh.count() > 0) between("coverage of first 12 rows", tally.fresh.coverage(), 90, 100);
      between("runs that end with exit 1", double(tally.stopped), 0, 0);
    } else if (name == "year") {
      between("coverage", tally.all.coverage(), 90, 100);
    } else if (way == "declared" && tried.demand == Demand::accuracy) {
      between("coverage", tally.all.coverage(), 90, 99);
      between("sd / rms", tally.all.sd_over_rms(), 0.7, 2.5);
    }
    if (in_stages) {
      between("coverage", tally.all.coverage(), 92, 100);
      if (far || tried.logs_stroke) between("error at end", tally.end.error(), 0, 2);
    }
    // With the jack alone mu is not known, plug or no plug.
    const bool needs_far = name == "loose-plug" || name == "cables-in-turns";
    if (needs_far && far) between("error at end", tally.end.error(), 0, 1);
    if (name == "elongation-loop" && way == "declared") {
      between("sd of mu", tally.mu_sd(), 0, 6);
      // Where the loop is closed: before, nothing has told how much friction there is.
      between("error at end", tally.end.error(), 0, 1);
    }
    if (name == "clean")
      for (const auto& [word, count] : tally.alarms)
        // At a second visit the wedge does come free.
        if (word != "lift-off") between("jackings with the alarm " + word, part(count, tally), 0, 2);
    // Declared, there is nothing to find.
    if (name == "off-by-10-kelvin" && way == "plain")
      between("jackings found odd", part(tally.odd, tally), 80, 100);
    if (name == "off-by-gain-2" && way == "plain")
      between("jackings found odd", part(tally.odd, tally), 50, 100);
    // A far end tells that the wedge holds; without one, of the others the log ends before it says so.
    if (name == "late-locks-in-stages" && far) between("sd / rms", tally.all.sd_over_rms(), 0.7, 2.5);
    if (name == "late-locks-in-stages" && !far)
      between("jackings found odd", part(tally.odd, tally), 75, 100);
    if (name == "gauge-freezes" && way == "declared") {
      between("coverage", tally.all.coverage(), 90, 100);
      between("jackings found odd", part(tally.odd, tally), 90, 100);
    }
    if (name == "frozen-cell") {
      between("jackings found odd", part(tally.odd, tally), 90, 100);
      // Once it is known to be dead it makes no force uncertain.
      if (way == "declared") between("sd / rms", tally.all.sd_over_rms(), 0.7, 2.5);
    }
  }
  static double part(long count, const Tally& tally) { return 100 * double(count) / double(tally.jackings); }
  void between(const std::string& what, double found, double least, double most) {
    char text[100];
    std::snprintf(text, sizeof text, "%.4g, asked are %.4g to %.4g", found, least, most);
    judged_.push_back({where_ + ": " + what, text, found >= least && found <= most});
  }

  std::string where_;
  std::vector<Judged> judged_;
};

}  // namespace estimation_site
