#include "lib/files/plausible_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lib/files/input_error.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr double least_E = 1e9, most_E = 1e12, least_E_of_strut = 1e6, most_A = 100, most_A_of_strut = 1,
                 longest = 1e4, most_on_node = 1e10, most_kelvin = 1000, most_alpha = 1e-3,
                 most_seating = 0.1, most_mu_of_capstan = 2, most_part = 1;
constexpr const char* no_per_cent = "write a part and not per cent";

[[noreturn]] void refuse(const SceneDescription& scene, const std::string& place, const std::string& problem,
                         const std::string& remedy) {
  throw InputError(scene.file, place, problem, remedy + remedy_if_meant);
}

double largest(const std::vector<double>& numbers) {
  return numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
}

void check_cable(std::size_t c, const SceneDescription& scene) {
  const CableDescription& cable = scene.cables[c];
  const std::string place = "/cables/" + std::to_string(c);
  if (cable.E < least_E || cable.E > most_E)
    refuse(scene, place + "/E", "a modulus of " + plain(cable.E) + " N/m2 is that of no cable",
           "write it in N/m2, as in 2e11 for steel");
  if (cable.A > most_A)
    refuse(scene, place + "/A", "a cross-section of " + plain(cable.A) + " m2 is that of no cable",
           "write it in m2, as in 1.4e-3");
  for (std::size_t i = 0; i < cable.prestrain.size(); ++i)
    if (cable.prestrain[i] > largest_plausible_strain)
      refuse(scene,
             place + "/prestrain" + (cable.prestrain_is_list ? "/" + std::to_string(i) : std::string()),
             "a strain of " + plain(cable.prestrain[i]) + " is more than a cable takes",
             "write a part of the length and not per cent, at most 0.02");
  for (const auto& [key, part] :
       {std::pair("/E_sd", cable.E_sd), std::pair("/friction/scatter", cable.scatter)})
    if (part >= most_part)
      refuse(scene, place + key, "a relative standard deviation of " + plain(part) + " tells nothing",
             no_per_cent);
  if (cable.mu_sd >= most_part && cable.mu_sd > 10 * largest(cable.mu))
    refuse(scene, place + "/friction/mu_sd",
           "a standard deviation of " + plain(cable.mu_sd) + " tells nothing of mu", no_per_cent);
  if (cable.law == FrictionLaw::capstan && largest(cable.mu) > most_mu_of_capstan)
    refuse(scene, place + "/friction/mu",
           "a friction coefficient of " + plain(largest(cable.mu)) + " is that of no tendon", no_per_cent);
  for (const auto& [key, drawn] :
       {std::pair("/seating", cable.seating), std::pair("/seating_sd", cable.seating_sd.value_or(0))})
    if (drawn > most_seating)
      refuse(scene, place + key, "no wedge is drawn in by " + plain(drawn) + " m",
             "write it in m, as in 0.006");
  if (std::fabs(cable.alpha) > most_alpha)
    refuse(scene, place + "/alpha",
           "a thermal expansion of " + plain(cable.alpha) + " 1/K is that of no cable",
           "write it in 1/K, as in 1.2e-5 for steel");
  if (cable.temperature_sd > most_kelvin)
    refuse(scene, place + "/temperature_sd",
           "a temperature that is known to " + plain(cable.temperature_sd) + " K is that of no cable",
           "write it in K");
  if (const double length = length_of(cable, scene); length > longest)
    refuse(scene, place + "/path", "the cable is " + plain(std::round(length)) + " m long",
           "write the coordinates of nodes in m");
}

// One load pattern with a factor that stands at `factor_place`; empty: in itself.
void check_load(std::size_t i, double factor, const std::string& factor_place,
                const SceneDescription& scene) {
  const LoadDescription& load = scene.loads[i];
  const auto place = [&](const std::string& own) {
    return factor_place.empty() ? "/loads" + pointer_step(load.name) + own : factor_place;
  };
  for (const ForceDescription& given : load.forces) {
    const std::string& node = scene.nodes[static_cast<std::size_t>(given.node)].name;
    for (const double force : given.force)
      if (std::fabs(factor * force) > most_on_node)
        refuse(scene, place("/forces" + pointer_step(node)),
               "a load of " + plain(factor * force) + " N on a node is that of no structure",
               "write forces in N, factors as multiples of them");
  }
  for (const TemperatureDescription& given : load.temperatures)
    if (std::fabs(factor * given.kelvin) > most_kelvin)
      refuse(scene,
             place("/temperature" + pointer_step(scene.cables[static_cast<std::size_t>(given.cable)].name)),
             "a change of temperature by " + plain(factor * given.kelvin) + " K is that of no cable",
             "write it in K, factors as multiples of it");
}

void check_target(const TargetDescription& target, const SceneDescription& scene) {
  const std::string place = "/second_order/target";
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    check_load(i, target.factor[i], place + "/loads" + pointer_step(scene.loads[i].name), scene);
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end)
      if (const double most = most_force_of(scene.cables[c]); target.force[c][end] > most)
        refuse(scene, place + "/forces" + pointer_step(scene.cables[c].name + "." + end_name(end)),
               "a jack force of " + plain(target.force[c][end]) + " N is more than the cable can carry",
               "write one in N, below " + plain(most));
}

}  // namespace

double most_force_of(const CableDescription& cable) { return breaking_strain * cable.E * cable.A; }

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
  for (std::size_t i = 0; i < scene.loads.size(); ++i) check_load(i, 1, {}, scene);
  if (scene.second_order) check_target(*scene.second_order, scene);
}

}  // namespace taut::host
