#include "lib/files/plausible_scene.hpp"

#include <cmath>
#include <cstddef>

#include "lib/files/input_error.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr double least_E = 1e9, most_E = 1e12, least_E_of_strut = 1e6, most_A_of_strut = 1, longest = 1e4;

[[noreturn]] void refuse(const SceneDescription& scene, const std::string& place, const std::string& problem,
                         const std::string& remedy) {
  throw InputError(scene.file, place, problem, remedy + remedy_if_meant);
}

void check_cable(std::size_t c, const SceneDescription& scene) {
  const CableDescription& cable = scene.cables[c];
  const std::string place = "/cables/" + std::to_string(c);
  if (cable.E < least_E || cable.E > most_E)
    refuse(scene, place + "/E", "a modulus of " + plain(cable.E) + " N/m2 is that of no cable",
           "write it in N/m2, as in 2e11 for steel");
  for (std::size_t i = 0; i < cable.prestrain.size(); ++i)
    if (cable.prestrain[i] > largest_plausible_strain)
      refuse(scene,
             place + "/prestrain" + (cable.prestrain_is_list ? "/" + std::to_string(i) : std::string()),
             "a strain of " + plain(cable.prestrain[i]) + " is more than a cable takes",
             "write a part of the length and not per cent, at most 0.02");
  if (const double length = length_of(cable, scene); length > longest)
    refuse(scene, place + "/path", "the cable is " + plain(std::round(length)) + " m long",
           "write the coordinates of nodes in m");
}

}  // namespace

double length_of(const CableDescription& cable, const SceneDescription& scene) {
  double length = 0;
  for (std::size_t i = 0; i < cable.segments(); ++i) {
    const auto node = [&](std::size_t k) {
      return scene.nodes[static_cast<std::size_t>(cable.path[k % cable.path.size()])].at;
    };
    const auto from = node(i), to = node(i + 1);
    length += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  }
  return length;
}

void require_plausible(const SceneDescription& scene) {
  if (!scene.plausible) return;
  for (std::size_t i = 0; i < scene.struts.size(); ++i)
    if (scene.struts[i].E < least_E_of_strut && scene.struts[i].A <= most_A_of_strut)
      refuse(scene, "/struts/" + std::to_string(i) + "/E",
             "a modulus of " + plain(scene.struts[i].E) + " N/m2 is that of no strut",
             "write it in N/m2, as in 2.1e11 for steel");
  for (std::size_t c = 0; c < scene.cables.size(); ++c) check_cable(c, scene);
}

}  // namespace taut::host
