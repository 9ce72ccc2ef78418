// What was learned of friction, and from which readings.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace taut::host {

/// A column of the log that friction was learned from.
struct FrictionSource {
  std::string column;
  std::size_t readings = 0;  ///< that were used
  double share = 0;          ///< of the information that all sources brought, from 0 to 1
};

/// A mu that was not known: that of a cable with one for all joints, or of one joint.
struct LearnedFriction {
  std::string name;                     ///< `C`, or `C.3` for the third joint of cable C
  double mu_before = 0, sd_before = 0;  ///< beforehand
  double mu = 0, sd = 0;                ///< now
  std::vector<FrictionSource> sources;  ///< the largest share first; empty: nothing measured it
};

}  // namespace taut::host
