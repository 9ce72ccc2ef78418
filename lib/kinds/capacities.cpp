#include "lib/kinds/capacities.hpp"

#include <string>

#include "lib/files/input_error.hpp"

namespace taut::host {

const std::array<AmountName, amount_count> amount_names = {{
    {"nodes", "/nodes"},
    {"struts", "/struts"},
    {"beam members", "/beams"},
    {"cables", "/cables"},
    {"segments", "/cables"},
    {"joints", "/cables"},
    {"substructures", "/substructures"},
    {"substructure nodes", "/substructures"},
    {"substructure entries", "/substructures"},
    {"load patterns", "/loads"},
    {"nodal forces", "/loads"},
    {"cable temperatures", "/loads"},
}};

Amounts needs(const SceneDescription& scene) {
  Amounts needed{};
  auto& [nodes, struts, beams, cables, segments, joints, substructures, on_nodes, entries, loads, forces,
         temperatures] = needed;
  nodes = scene.nodes.size();
  struts = scene.struts.size();
  cables = scene.cables.size();
  substructures = scene.substructures.size();
  loads = scene.loads.size();
  for (const BeamDescription& beam : scene.beams) beams += beam.members();
  for (const CableDescription& cable : scene.cables) {
    segments += cable.segments();
    joints += cable.joints();
  }
  for (const SubstructureDescription& substructure : scene.substructures) {
    on_nodes += substructure.nodes.size();
    entries += substructure.stiffness.size();
  }
  for (const LoadDescription& load : scene.loads) {
    forces += load.forces.size();
    temperatures += load.temperatures.size();
  }
  return needed;
}

bool fits(const Amounts& needed, const Amounts& held) {
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (needed[i] > held[i]) return false;
  }
  return true;
}

void refuse_too_large(const SceneDescription& scene, const Amounts& needed, const Amounts& held) {
  std::size_t i = 0;
  while (i + 1 < needed.size() && needed[i] <= held[i]) ++i;
  const std::string noun = amount_names[i].noun;
  throw InputError(scene.file, amount_names[i].place,
                   "the scene has " + std::to_string(needed[i]) + " " + noun,
                   "this program holds at most " + std::to_string(held[i]));
}

}  // namespace taut::host
