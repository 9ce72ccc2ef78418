// A scene as the file gives it: names and lists of any length, in the order of the file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "taut/scene/scene.hpp"

namespace taut::host {

/// A node; in a plane scene the third coordinate is zero and has no meaning. Units: m.
struct NodeDescription {
  std::string name;
  std::array<double, 3> at{};
  std::uint8_t held = held_none;  ///< see Axis
};

/// What the file says of an instrument, by column of the log. Units: those of the column.
struct InstrumentDescription {
  bool is_given = false;
  bool is_assumed = false;  ///< not by the file, as an ordinary one
  bool exact = false;       ///< has no error at all
  std::optional<double> sd, gain_sd, zero_sd;
  double resolution = 0;
  double lag = 0;                ///< time constant of its filter [s]
  bool has_hysteresis = false;   ///< by the file
  double part = 0, part_sd = 0;  ///< hysteresis of a ram, relative to the force
  bool right_while_it_pulls = false;
  std::vector<std::array<double, 2>> calibration;  ///< readings and their forces [N], both ascending
  bool has_free_zero = false;                      ///< a stroke that is read from any mark

  /// The force behind a reading of a calibrated gauge [N]; beyond the table its ends go on straight.
  double force_of(double reading) const {
    if (calibration.size() < 2) return reading;
    std::size_t i = 1;
    while (i + 1 < calibration.size() && reading > calibration[i][0]) ++i;
    const auto &from = calibration[i - 1], &to = calibration[i];
    return from[1] + (reading - from[0]) * (to[1] - from[1]) / (to[0] - from[0]);
  }
};

/// A strut between two nodes of SceneDescription::nodes. Units: N/m2, m2.
struct StrutDescription {
  std::array<int, 2> nodes{};
  double E = 0, A = 0;
  InstrumentDescription gauge;  ///< of its axial force
};

/// A chain of beams between nodes that follow each other. Units: N/m2, m2, m4. In the plane I is what counts;
/// in space Iy, Iz, J, G and up, see BeamSection.
struct BeamDescription {
  std::vector<int> nodes;
  double E = 0, A = 0, I = 0;
  double Iy = 0, Iz = 0, J = 0, G = 0;
  std::array<double, 3> up{0, 0, 1};
  std::vector<int> hinges;  ///< nodes at which the ends of its members are hinged

  std::size_t members() const { return nodes.empty() ? 0 : nodes.size() - 1; }
  bool has_hinge(int node) const {
    for (const int hinge : hinges)
      if (hinge == node) return true;
    return false;
  }
};

/// A cable; the fields mean what they mean in Cable.
struct CableDescription {
  std::string name;
  std::vector<int> path;
  double E = 0, A = 0;
  bool closed = false;
  std::array<End, 2> ends{End::anchored, End::anchored};
  FrictionLaw law = FrictionLaw::point;
  std::vector<double> mu;          ///< of every joint
  bool mu_is_list = false;         ///< the file gives one a joint
  std::vector<double> prestrain;   ///< of every segment
  bool prestrain_is_list = false;  ///< the file gives one a segment
  double wobble = 0, mu_sd = 0;
  bool has_mu_sd = false;  ///< the file gives it
  bool shared_mu = false;
  double alpha = 0, seating = 0;
  double E_sd = 0.03;                           ///< relative standard deviation of E A
  double temperature_sd = 0;                    ///< of what no column says of its temperature once locked [K]
  std::optional<double> seating_sd;             ///< [m]
  bool has_scatter = false;                     ///< the file says it
  double scatter = 0.1, drift = 0;              ///< of mu from joint to joint, and by a pass; relative
  std::array<InstrumentDescription, 2> cell;    ///< load cells at start and end
  std::array<InstrumentDescription, 2> stroke;  ///< of the jacks
  std::vector<InstrumentDescription> force;     ///< of every segment

  std::size_t segments() const { return closed ? path.size() : path.size() - 1; }
  std::size_t joints() const { return closed ? path.size() : path.size() - 2; }
  bool is_jacked(std::size_t end) const { return !closed && ends[end] == End::jacked; }
};

/// A stiffness matrix [N/m] on some nodes, row by row.
struct SubstructureDescription {
  std::string name;
  std::vector<int> nodes;
  std::vector<double> stiffness;
  std::vector<double> geometric_stiffness;  ///< at the target of second-order theory; empty: none
};

/// A force [N a unit factor] of a load pattern.
struct ForceDescription {
  int node = 0;
  std::array<double, 3> force{};
};

/// A temperature change [K a unit factor] of a load pattern.
struct TemperatureDescription {
  int cable = 0;
  double kelvin = 0;
};

struct LoadDescription {
  std::string name;
  std::vector<ForceDescription> forces;
  std::vector<TemperatureDescription> temperatures;
};

/// The state at which second-order theory takes its geometric stiffness.
struct TargetDescription {
  std::vector<double> factor;                ///< of every load pattern
  std::vector<std::array<double, 2>> force;  ///< of the jacks of every cable [N]
};

/// The displacement of a node along an axis, from 0.
struct DisplacementDescription {
  int node = 0;
  int axis = 0;
};

/// A whole scene file. References are indices into `nodes` and `cables`.
struct SceneDescription {
  std::string file;  ///< where it comes from, for messages
  std::string name;
  int dimension = 2;
  bool plausible = true;  ///< what is surely a mistake is refused
  std::vector<NodeDescription> nodes;
  std::vector<StrutDescription> struts;
  std::vector<BeamDescription> beams;
  std::vector<CableDescription> cables;
  std::vector<SubstructureDescription> substructures;
  std::vector<LoadDescription> loads;
  std::optional<TargetDescription> second_order;   ///< absent: linear theory
  std::vector<DisplacementDescription> displaced;  ///< not in the file: whose displacements are asked for
  std::vector<DisplacementDescription> watched;    ///< nor this: those that are looked at, see MemberTurns

  /// Numbers of the first segment and joint of a cable, counted over all cables; of the cable after the last:
  /// how many there are.
  std::size_t first_segment(std::size_t cable) const {
    std::size_t first = 0;
    for (std::size_t c = 0; c < cable; ++c) first += cables[c].segments();
    return first;
  }
  std::size_t first_joint(std::size_t cable) const {
    std::size_t first = 0;
    for (std::size_t c = 0; c < cable; ++c) first += cables[c].joints();
    return first;
  }
};

/// `start` or `end`.
inline const char* end_name(std::size_t end) { return end == 0 ? "start" : "end"; }

}  // namespace taut::host
