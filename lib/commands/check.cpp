#include "lib/commands/check.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "lib/files/output_file.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/files/status_text.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/capacities.hpp"
#include "lib/kinds/condensed_arrays.hpp"
#include "lib/kinds/condensed_kind.hpp"
#include "lib/kinds/condensed_size.hpp"
#include "lib/kinds/make_model.hpp"

namespace taut::host {
namespace {

std::string line(const std::string& label, const std::string& value) {
  constexpr std::size_t column = 24;
  return label + std::string(label.size() < column ? column - label.size() : 1, ' ') + value + "\n";
}

// Beams bring rotations as further unknowns.
std::string beams(const SceneDescription& scene) {
  if (scene.beams.empty()) return "";
  std::vector<bool> turns(scene.nodes.size());
  std::size_t members = 0, rotations = 0;
  for (const BeamDescription& beam : scene.beams) {
    members += beam.members();
    for (const int node : beam.nodes)
      if (!beam.has_hinge(node)) turns[static_cast<std::size_t>(node)] = true;
  }
  for (std::size_t i = 0; i < turns.size(); ++i)
    for (unsigned bit = scene.dimension == 2 ? held_r : held_rx; turns[i] && bit <= held_rz; bit *= 2)
      rotations += (scene.nodes[i].held & bit) == 0 ? 1 : 0;
  return line("beams", counted(scene.beams.size(), "beam") + " of " + counted(members, "member") + "; " +
                           counted(rotations, "rotation") + " unknown beside the displacements");
}

std::string head(const SceneDescription& scene) {
  return line("scene", quote(scene.name)) + line("dimension", std::to_string(scene.dimension));
}

// What the scene needs against what its capacity class holds.
std::string capacities(const SceneDescription& scene) {
  const Amounts needed = needs(scene);
  return with_capacity(scene, [&](auto kind) {
    using Cap = typename decltype(kind)::Capacity;
    const Amounts held = holds<Cap>();
    std::string text = line("capacity class", Cap::name);
    for (std::size_t i = 0; i < needed.size(); ++i)
      text += line(amount_names[i].noun, std::to_string(needed[i]) + " of " + std::to_string(held[i]));
    return text;
  });
}

// What the scene takes on a device, as `taut export` writes it.
std::string memory(const SceneDescription& scene) {
  const CondensedSize size = condensed_size(condensed_counts(scene), ScalarType::float32);
  std::string flash = "about " + counted(size.scene, "byte") + " in float, a condensed scene that fits";
  if (size.strut_rows > 0) flash += "; " + std::to_string(size.strut_rows) + " more for strut forces";
  return line("flash", flash) +
         line("RAM", "about " + counted(size.tracker, "byte") + " in float, the tracker") +
         line("stack", "about " + counted(size.stack, "byte") + " in float, while an event is decided");
}

std::string ends(const CableDescription& cable) {
  if (cable.closed) return "closed";
  const auto kind = [&](std::size_t end) { return cable.is_jacked(end) ? "jacked" : "anchored"; };
  return std::string(kind(0)) + " to " + kind(1);
}

// The joints of a cable that friction locks, by their numbers in the result.
std::string locked(const std::vector<double>& rho, std::size_t first, std::size_t joints) {
  std::string numbers;
  std::size_t count = 0;
  for (std::size_t j = 0; j < joints; ++j) {
    if (rho[first + j] > 0) continue;
    numbers += (count++ == 0 ? ": " : ", ") + std::to_string(j + 1);
  }
  return ", " + std::to_string(count) + " locked by friction" + numbers;
}

// One line a cable; without its friction if the structure does not stand.
std::string cables(const SceneDescription& scene, const CondensedArrays& condensed) {
  std::string text;
  std::size_t first = 0;
  for (const CableDescription& cable : scene.cables) {
    const std::size_t joints = cable.joints();
    text += line("cable " + quote(cable.name),
                 ends(cable) + ", " + counted(cable.segments(), "segment") + ", " + counted(joints, "joint") +
                     (condensed.condensing.status ? locked(condensed.rho, first, joints) : ""));
    first += joints;
  }
  return text;
}

// Whether a joint that slides alone, either way, changes no tension at its limit: then the slip and its node
// move freely together.
bool is_free_to_slide(const CondensedArrays& condensed, std::size_t before, std::size_t after, double rho) {
  const auto& coupling = condensed.coupling;
  const double T1 = coupling[before][before] - coupling[before][after];
  const double T2 = coupling[after][before] - coupling[after][after];
  const double least = 1e-9 * std::fmax(coupling[before][before], coupling[after][after]);
  return std::fabs(T1 - rho * T2) <= least && std::fabs(T2 - rho * T1) <= least;
}

// The joints whose sliding sets their node free.
std::vector<std::string> loose_joints(const SceneDescription& scene, const CondensedArrays& condensed) {
  std::vector<std::string> texts;
  for (std::size_t c = 0; c < condensed.cables.size(); ++c) {
    const CableLayout<double>& cable = condensed.cables[c];
    for (int j = 0; j < cable.joints(); ++j) {
      const auto sides = cable.joint_segments(j);
      const int joint = cable.first_joint + j;
      const double rho = condensed.rho[static_cast<std::size_t>(joint)];
      if (rho > 0 && is_free_to_slide(condensed, static_cast<std::size_t>(sides[0]),
                                      static_cast<std::size_t>(sides[1]), rho))
        texts.push_back(joint_text(scene, static_cast<int>(c), j));
    }
  }
  return texts;
}

std::string condition(double number) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.1e", number);
  return line("condition number", digits.data());
}

// The state whose geometric stiffness is taken.
std::string theory(const SceneDescription& scene) {
  if (!scene.second_order) return "";
  std::string target;
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    if (scene.second_order->factor[i] != 0)
      target += ", " + quote(scene.loads[i].name) + " " + plain(scene.second_order->factor[i]);
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end)
      if (scene.second_order->force[c][end] > 0)
        target += ", " + scene.cables[c].name + "." + end_name(end) + " " +
                  plain(scene.second_order->force[c][end]) + " N";
  return line("theory", is_rigid(scene)
                            ? "linear: nothing leans between rigid saddles"
                            : "second order, with the geometric stiffness at the target" + target);
}

std::string mechanisms(std::size_t loose) {
  const std::string none = "none before any load";
  return line("mechanisms", loose == 0 ? none : none + "; " + counted(loose, "joint") + " free to slide");
}

int refuse(const SceneDescription& scene, const std::string& reason) {
  std::cerr << scene.file << ": without loads and jack forces: " << reason << '\n';
  return 1;
}

// Whether the prestrain can be brought on.
Status try_start(const SceneDescription& scene) {
  return make_model(scene, methods.front().second, ScalarType::float64)->start(1).status;
}

}  // namespace

int check(const std::string& scene_path) {
  const SceneDescription scene = read_scene_file(scene_path);
  const CondensedArrays condensed = condense(scene, ScalarType::float64);
  OutputFile output("");
  output.write(head(scene) + theory(scene) + capacities(scene) + beams(scene) +
               (scene.second_order ? "" : memory(scene)) + cables(scene, condensed));
  const Status stands = condensed.condensing.status ? try_start(scene) : condensed.condensing.status;
  if (!stands) {
    output.finish();
    return refuse(scene, failure_text(stands, scene));
  }
  const std::vector<std::string> loose = loose_joints(scene, condensed);
  output.write(condition(condensed.condensing.condition) + mechanisms(loose.size()));
  output.finish();
  for (const std::string& joint : loose) {
    std::cerr << "warning: " << joint << ": when the cable slides over it, nothing holds its node; "
              << sliding_remedy << '\n';
  }
  return 0;
}

}  // namespace taut::host
