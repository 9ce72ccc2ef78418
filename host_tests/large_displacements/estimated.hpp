// Jackings whose true forces are those at large displacements, read by cells with noise, as `taut estimate`
// finds them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "large_displacements/scenes.hpp"

namespace large_displacements {

/// What is known beforehand, and what is read.
struct Known {
  double mu = 1;         ///< as a part of the mean of what it is
  double mu_sd = 0.3;    ///< of what it is taken for
  double scatter = 0;    ///< from joint to joint
  double noise = 0.003;  ///< of the cells, as a part of the largest load
  bool has_far_end = false;
  bool ramp_alone = false;  ///< not beyond the largest load
  unsigned seed = 1;        ///< of the noise
};

struct Estimated {
  std::vector<std::vector<double>> truth, force, sd;  ///< of every segment [N], one a row
  double full = 0;                                    ///< the largest load [N]
  double mu = 0, mu_sd = 0;                           ///< of the first joint, in the end
  int status = -1;                                    ///< of the program
  std::string said;                                   ///< by the program
  std::size_t rows = 0;                               ///< asked for
};

/// The cable is jacked at its end, in five rows for one of the log, as far as the structure stands, and not
/// beyond rows of which `taut simulate` remarks that its theory is not made for them. `taut` is the program.
/// Nothing if that leaves less than twenty rows.
std::optional<Estimated> estimate(const Jacking& jacking, const Known& known, const std::string& taut);

/// What came of many of them.
struct Summary {
  int jackings = 0, unanswered = 0;
  long count = 0, held = 0;
  double off_squared = 0, share_squared = 0;  ///< relative to the full force; to the standard deviation

  /// Segments with at least 1 % of the full force.
  void add(const Estimated& one);
};

}  // namespace large_displacements
