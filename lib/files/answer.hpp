// The response to a row, without the types of the solver that found it.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "lib/files/sentence.hpp"
#include "taut/scene/sample.hpp"

namespace taut::host {

/// The axial force of a strut and its standard deviation [N].
struct StrutEstimate {
  double force = 0, deviation = 0;
};

/// The fields of Response for what the scene holds. Values of a solver in float are exact, but for a negative
/// zero: it is a positive one, in decimal and in hexadecimal results.
struct Answer {
  std::vector<double> tension, slip, contact, friction;
  std::vector<JointState> state;
  std::vector<std::array<double, 2>> extension;
  std::vector<double> strut;
  std::vector<double> friction_used;     ///< of every joint: 1 where it slides; not of the method stepwise
  std::vector<double> bend_change;       ///< of the cable at every joint, by itself; 0 in linear theory
  std::vector<double> displacement;      ///< those of SceneDescription::displaced [m]
  std::vector<double> deviation;         ///< of the tensions [N]; of `estimate` alone, like the rest
  std::vector<double> mu, mu_deviation;  ///< of every joint
  std::string alarms;                    ///< in words, separated by blanks
  std::map<std::string, double> peaks;   ///< by the word of an alarm: how far a force went beyond a limit [N]
  std::string notices;                   ///< of those, what needs no action: they are not among the alarms
  Sentence verdict;                      ///< whether the numbers are to be trusted
};

}  // namespace taut::host
