// Fills a core scene from the description of a file.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lib/files/scene_description.hpp"
#include "taut/scene/sample.hpp"
#include "taut/scene/scene.hpp"

namespace taut::host {

/// The axes of a scene out of a vector with three.
template <int Dimension>
std::array<double, static_cast<std::size_t>(Dimension)> shortened(const std::array<double, 3>& vector) {
  std::array<double, static_cast<std::size_t>(Dimension)> axes{};
  for (std::size_t i = 0; i < axes.size(); ++i) axes[i] = vector[i];
  return axes;
}

/// What an instrument's description says, for the core: what it does not say is zero. Only at a jack is it
/// known which way a ram goes; elsewhere its friction is one more error of gain.
inline LoadCell<double> load_cell(const InstrumentDescription& described, bool at_jack) {
  LoadCell<double> cell;
  cell.lag = described.lag;
  if (described.exact) return cell;
  // A display that steps scatters by its step.
  const double step = described.resolution;
  if (described.sd) cell.sd = std::sqrt(*described.sd * *described.sd + step * step / 12);
  cell.gain_sd = described.gain_sd.value_or(0);
  cell.zero_sd = described.zero_sd.value_or(0);
  if (!at_jack) {
    cell.gain_sd = std::hypot(cell.gain_sd, described.part, described.part_sd);
    return cell;
  }
  cell.hysteresis_sd = described.part_sd;
  cell.up = described.right_while_it_pulls ? 1 : 1 + described.part;
  cell.down = described.right_while_it_pulls ? 1 - 2 * described.part : 1 - described.part;
  return cell;
}

/// Adds a cable with the friction of every joint and the prestrain of every segment.
template <class SceneType>
void build_cable(const CableDescription& described, SceneType& scene) {
  Cable<double> cable;
  cable.E = described.E;
  cable.A = described.A;
  cable.closed = described.closed;
  cable.ends = described.ends;
  cable.law = described.law;
  cable.wobble = described.wobble;
  cable.mu_sd = described.mu_sd;
  cable.shared_mu = described.shared_mu;
  // A mu that is said to be known exactly is that of every joint, unless scatter is said too.
  if (described.shared_mu && (described.mu_sd > 0 || described.has_scatter))
    cable.scatter = described.scatter;
  cable.alpha = described.alpha;
  // A cable that is stiffer than thought loses more.
  cable.seating_sd =
      std::hypot(described.seating_sd.value_or(described.seating / 4), described.E_sd * described.seating);
  cable.temperature_sd = described.temperature_sd;
  cable.seating = described.seating;
  for (std::size_t end = 0; end < 2; ++end)
    cable.cell[end] = load_cell(described.cell[end], described.is_jacked(end));
  const int index = scene.add_cable(cable, described.path.data(), static_cast<int>(described.path.size()));
  if (index < 0) return;  // validate() reports what had no room
  const Cable<double>& added = scene.cables[index];
  for (int j = 0; j < added.joints() && added.first_joint + j < scene.mu.size(); ++j) {
    scene.mu[added.first_joint + j] = described.mu[static_cast<std::size_t>(j)];
  }
  for (int i = 0; i < added.segments() && added.first_segment + i < scene.prestrain.size(); ++i) {
    scene.prestrain[added.first_segment + i] = described.prestrain[static_cast<std::size_t>(i)];
  }
}

/// Adds a load pattern with its forces and temperatures.
template <class Cap, int Dimension>
void build_load(const LoadDescription& described, Scene<double, Dimension, Cap>& scene) {
  const int load = scene.add_load();
  for (const ForceDescription& force : described.forces) {
    scene.add_force(load, force.node, shortened<Dimension>(force.force));
  }
  for (const TemperatureDescription& change : described.temperatures) {
    scene.add_temperature(load, change.cable, change.kelvin);
  }
}

/// The section of a beam.
template <int Dimension>
BeamSection<double, Dimension> beam_section(const BeamDescription& described) {
  if constexpr (Dimension == 2)
    return {described.E, described.A, described.I};
  else
    return {described.E, described.A, described.Iy, described.Iz, described.J, described.G, described.up};
}

/// Adds the members of a beam.
template <class Cap, int Dimension>
void build_beam(const BeamDescription& described, Scene<double, Dimension, Cap>& scene) {
  const auto section = beam_section<Dimension>(described);
  for (std::size_t i = 0; i < described.members(); ++i) {
    const int from = described.nodes[i], to = described.nodes[i + 1];
    scene.add_beam(from, to, section, {described.has_hinge(from), described.has_hinge(to)});
  }
}

/// Fills an empty scene in the order of the file. What does not fit is left for validate() to report.
template <int Dimension, class Cap>
void build(const SceneDescription& described, Scene<double, Dimension, Cap>& scene) {
  for (const NodeDescription& node : described.nodes)
    scene.add_node(shortened<Dimension>(node.at), node.held);
  for (const StrutDescription& strut : described.struts) {
    scene.add_strut(strut.nodes[0], strut.nodes[1], strut.E, strut.A);
  }
  if constexpr (Cap::beams > 0)
    for (const BeamDescription& beam : described.beams) build_beam(beam, scene);
  for (const CableDescription& cable : described.cables) build_cable(cable, scene);
  for (const SubstructureDescription& substructure : described.substructures) {
    scene.add_substructure(substructure.nodes.data(), static_cast<int>(substructure.nodes.size()),
                           substructure.stiffness.data());
  }
  for (const LoadDescription& load : described.loads) build_load(load, scene);
}

/// The state at which geometric stiffness is taken.
template <class Scalar, class Cap>
Sample<Scalar, Cap> target_of(const TargetDescription& described) {
  Sample<Scalar, Cap> target;
  for (std::size_t i = 0; i < described.factor.size(); ++i)
    target.factor[static_cast<int>(i)] = static_cast<Scalar>(described.factor[i]);
  for (std::size_t c = 0; c < described.force.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      auto& jack = target.jack[static_cast<int>(c)][end];
      jack.force = static_cast<Scalar>(described.force[c][end]);
      // Of two jacks the one without a force is at rest: its wedge holds.
      jack.locked = !(described.force[c][end] > 0) && described.force[c][1 - end] > 0;
    }
  return target;
}
/// Geometric stiffness of all substructures, entry by entry as build() adds their stiffness; empty if none
/// has any.
inline std::vector<double> geometric_entries(const SceneDescription& described) {
  std::vector<double> entries;
  bool any = false;
  for (const SubstructureDescription& substructure : described.substructures) {
    const auto& given = substructure.geometric_stiffness;
    any = any || !given.empty();
    entries.insert(entries.end(), given.begin(), given.end());
    if (given.empty()) entries.resize(entries.size() + substructure.stiffness.size());
  }
  if (!any) entries.clear();
  return entries;
}

}  // namespace taut::host
