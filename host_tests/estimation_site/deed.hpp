// A row of a jacking as it is, not as it is read.
#pragma once

#include <array>
#include <vector>

namespace estimation_site {

enum class Phase { ramp, hold, excursion, locked, visit };
constexpr int phases = 5;
inline const char* name_of(Phase phase) {
  constexpr const char* names[] = {"ramp", "hold", "overstress, release", "locked", "second visit"};
  return names[static_cast<int>(phase)];
}

/// Load patterns of the true structure; the log need not have them all.
enum Pattern : int { dead, sun, patterns };

struct Deed {
  double time = 0;
  double level = 0;               ///< force that the pump aims at [N]
  std::array<double, 2> gauge{};  ///< what a perfect pressure gauge would show as force [N]
  std::array<double, 2> force{};  ///< of the jacks [N]: the gauge less the friction of the ram
  std::array<bool, 2> locked{};
  std::array<double, patterns> factor{};
  double logged_sun = 0;  ///< what the log says of the factor of `sun`
  Phase phase = Phase::ramp;
  bool fresh = false;  ///< of the first 12 rows of a ramp or a hold

  // What comes of it.
  std::vector<double> tension;        ///< of every segment [N]
  std::array<double, 2> extension{};  ///< of the jacks [m]
};

}  // namespace estimation_site
