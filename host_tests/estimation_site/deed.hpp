// A row of a jacking as it is, not as it is read.
#pragma once

#include <array>
#include <cstddef>
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

/// What is done to one cable.
struct Pull {
  double level = 0;               ///< force that the pump aims at [N]
  std::array<double, 2> gauge{};  ///< what a perfect pressure gauge would show as force [N]
  std::array<double, 2> force{};  ///< of the jacks [N]: the gauge less the friction of the ram
  std::array<bool, 2> locked{};
  std::array<bool, 2>
      shut{};  ///< the valve of a jack: it stays where it is, and its gauge shows what comes of it
  Phase phase = Phase::ramp;
  bool fresh = false;                 ///< of the first 12 rows of a ramp or a hold
  std::array<double, 2> extension{};  ///< of the jacks [m]: what comes of it

  bool is_held(std::size_t end) const { return locked[end] || shut[end]; }
};

struct Deed {
  double time = 0;
  std::vector<Pull> pulls;  ///< by cable
  std::array<double, patterns> factor{};
  double logged_sun = 0;        ///< what the log says of the factor of `sun`
  std::vector<double> tension;  ///< of every segment, cable after cable [N]: what comes of it
};

/// The true force at an end of a cable [N].
template <class CableType>
double tension_at(const Deed& deed, const CableType& cable, std::size_t end) {
  return deed.tension[static_cast<std::size_t>(cable.first_segment + (end == 0 ? 0 : cable.segments() - 1))];
}

}  // namespace estimation_site
