// A scene as the file gives it: names and lists of any length, in the order of the file.
#pragma once

#include <array>
#include <cstdint>
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

/// A strut between two nodes of SceneDescription::nodes. Units: N/m2, m2.
struct StrutDescription {
  std::array<int, 2> nodes{};
  double E = 0, A = 0;
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
  std::array<double, 2> sensor_sd{};  ///< 0: not given

  std::size_t segments() const { return closed ? path.size() : path.size() - 1; }
  std::size_t joints() const { return closed ? path.size() : path.size() - 2; }
  bool is_jacked(std::size_t end) const { return !closed && ends[end] == End::jacked; }
};

/// A stiffness matrix [N/m] on some nodes, row by row.
struct SubstructureDescription {
  std::string name;
  std::vector<int> nodes;
  std::vector<double> stiffness;
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

/// A whole scene file. References are indices into `nodes` and `cables`.
struct SceneDescription {
  std::string file;  ///< where it comes from, for messages
  std::string name;
  int dimension = 2;
  std::vector<NodeDescription> nodes;
  std::vector<StrutDescription> struts;
  std::vector<CableDescription> cables;
  std::vector<SubstructureDescription> substructures;
  std::vector<LoadDescription> loads;
};

/// `start` or `end`.
inline const char* end_name(std::size_t end) { return end == 0 ? "start" : "end"; }

}  // namespace taut::host
