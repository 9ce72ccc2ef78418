#include "lib/commands/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/commands/balancing_jacks.hpp"
#include "lib/commands/compared_theories.hpp"
#include "lib/commands/log_follower.hpp"
#include "lib/files/hanging_joints.hpp"
#include "lib/files/log_file.hpp"
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
std::string memory(const SceneDescription& scene, const CondensedArrays& condensed) {
  const CondensedSize size = condensed_size(condensed_counts(scene, condensed), ScalarType::float32);
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
std::vector<HangingJoint> loose_joints(const SceneDescription& scene, const CondensedArrays& condensed) {
  std::vector<HangingJoint> found;
  for (std::size_t c = 0; c < condensed.cables.size(); ++c) {
    const CableLayout<double>& cable = condensed.cables[c];
    for (int j = 0; j < cable.joints(); ++j) {
      const auto sides = cable.joint_segments(j);
      const int joint = cable.first_joint + j;
      const double rho = condensed.rho[static_cast<std::size_t>(joint)];
      const int node = scene.cables[c].path[static_cast<std::size_t>(cable.closed ? j : j + 1)];
      if (rho > 0 && is_free_to_slide(condensed, static_cast<std::size_t>(sides[0]),
                                      static_cast<std::size_t>(sides[1]), rho))
        found.push_back({c, static_cast<std::size_t>(j), node, 1});
    }
  }
  return found;
}

std::string condition(double number) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.1e", number);
  return line("condition number", digits.data());
}

// The state whose geometric stiffness is taken.
std::string theory(const SceneDescription& scene) {
  if (is_rigid(scene)) return line("theory", "linear: nothing leans between rigid saddles");
  if (!scene.second_order) return line("theory", "linear");
  std::string target;
  for (std::size_t i = 0; i < scene.loads.size(); ++i)
    if (scene.second_order->factor[i] != 0)
      target += ", " + quote(scene.loads[i].name) + " " + plain(scene.second_order->factor[i]);
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end)
      if (scene.second_order->force[c][end] > 0)
        target += ", " + scene.cables[c].name + "." + end_name(end) + " " +
                  plain(scene.second_order->force[c][end]) + " N";
  return line("theory", "second order, with the geometric stiffness at the target" + target);
}

// `joint 3`, `joints 1, 2 and 5 to 9`, from ascending numbers that count from 0.
std::string joint_numbers(const std::vector<std::size_t>& joints) {
  std::vector<std::string> runs;
  for (std::size_t i = 0, next = 0; i < joints.size(); i = next) {
    next = i + 1;
    while (next < joints.size() && joints[next] == joints[next - 1] + 1) ++next;
    if (next == i + 2) --next;
    const std::string first = std::to_string(joints[i] + 1);
    runs.push_back(next == i + 1 ? first : first + " to " + std::to_string(joints[next - 1] + 1));
  }
  std::string text = joints.size() == 1 ? "joint " : "joints ";
  for (std::size_t i = 0; i < runs.size(); ++i)
    text += (i == 0 ? "" : i + 1 == runs.size() ? " and " : ", ") + runs[i];
  return text;
}

// Joints of one cable with their nodes, as many as fit into a line.
std::string joints_text(const SceneDescription& scene, std::size_t cable,
                        const std::vector<std::size_t>& joints) {
  if (joints.size() == 1)
    return joint_text(scene, static_cast<int>(cable), static_cast<int>(joints[0])).english();
  return joint_numbers(joints) + " of cable " + quote(scene.cables[cable].name);
}

// One text a cable.
std::vector<std::string> by_cable(const SceneDescription& scene, const std::vector<HangingJoint>& joints) {
  std::map<std::size_t, std::vector<std::size_t>> cables;
  for (const HangingJoint& each : joints) cables[each.cable].push_back(each.joint);
  std::vector<std::string> texts;
  for (const auto& [cable, numbers] : cables) texts.push_back(joints_text(scene, cable, numbers));
  return texts;
}

bool contains(const std::vector<HangingJoint>& joints, const HangingJoint& one) {
  return std::any_of(joints.begin(), joints.end(), [&](const HangingJoint& each) {
    return each.cable == one.cable && each.joint == one.joint;
  });
}

// One line a cable and number of directions.
std::string held_by_cable(const SceneDescription& scene, const std::vector<HangingJoint>& joints) {
  std::map<std::pair<std::size_t, int>, std::vector<std::size_t>> groups;
  for (const HangingJoint& each : joints) groups[{each.cable, each.directions}].push_back(each.joint);
  if (groups.empty()) return line("on the cable alone", "no joint");
  std::string text;
  for (const auto& [group, numbers] : groups)
    text += line("on the cable alone", joints_text(scene, group.first, numbers) + ", in " +
                                           counted(static_cast<std::size_t>(group.second), "direction"));
  return text;
}

std::string per_cent(double part) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), part < 5e-5 ? "less than 0.01 %%" : "%.2g %%", 100 * part);
  return digits.data();
}

// How far linear theory is off, in words.
std::string gaps(const ComparedTheories& compared) {
  std::string text;
  const auto add = [&](const std::optional<double>& part, const char* of) {
    if (part) text += (text.empty() ? "" : ", ") + per_cent(*part) + of;
  };
  add(compared.segments, " in the segments");
  add(compared.struts, " in the struts");
  add(compared.extensions, " in the extensions");
  return text;
}

// Forces off by what a usual load cell is, extensions by what the alarm `elongation` tolerates.
bool is_far_off(const ComparedTheories& compared) {
  constexpr double most_of_forces = 0.01, most_of_extensions = 0.05;
  return compared.segments.value_or(0) > most_of_forces || compared.struts.value_or(0) > most_of_forces ||
         compared.extensions.value_or(0) > most_of_extensions;
}

std::string where(const TheoryEnd& end) {
  return end.loads.empty() ? end.place : "from " + end.loads + " on (" + end.place + ")";
}

// How far linear theory is off on the way.
std::string accuracy(const SceneDescription& scene, const std::optional<ComparedTheories>& compared) {
  if (!compared)
    return scene.second_order ? "" : line("linear theory", "how far it is off says: taut check SCENE LOG");
  if (!compared->begins && scene.cables.empty()) return "";
  if (!compared->begins)
    return line("linear theory", "how far it is off is not known: no cable has tension at the largest load");
  const std::string off = gaps(*compared);
  if (off.empty()) return "";
  const bool ends = compared->linear || compared->second;
  return line("linear theory", (scene.second_order ? "would be off by " : "is off by ") + off +
                                   (ends ? ", as far as both have an answer" : ""));
}

// `; write .. into the scene`.
std::string second_order_remedy(const SceneDescription& scene, const ComparedTheories& compared) {
  return "; write " + second_order_key(scene, compared.target) + " into the scene";
}

// Of joints that linear theory cannot hold.
std::vector<std::string> joint_warnings(const SceneDescription& scene, bool is_compared,
                                        const std::vector<HangingJoint>& loose,
                                        const std::vector<HangingJoint>& hanging) {
  std::vector<std::string> texts;
  const std::string remedy = scene.second_order ? "" : std::string(tension_remedy) + ", or ";
  for (const std::string& joints : by_cable(scene, loose))
    texts.push_back(joints + ": when the cable slides there, nothing holds the node; " + remedy +
                    sliding_remedy);
  if (scene.second_order || is_compared) return texts;
  std::vector<HangingJoint> others;
  for (const HangingJoint& each : hanging)
    if (!contains(loose, each)) others.push_back(each);
  for (const std::string& joints : by_cable(scene, others))
    texts.push_back(joints + ": friction alone holds the node; " + tension_remedy);
  return texts;
}

// Of what linear theory does not see, refuses, or is far off in.
std::vector<std::string> theory_warnings(const SceneDescription& scene, const ComparedTheories& compared) {
  std::vector<std::string> texts;
  if (compared.second) {
    SceneDescription leaning = scene;
    leaning.second_order = compared.target;
    std::string text = "second-order theory has no answer " + where(*compared.second) + ": " +
                       reason_to_stop(compared.second->path, leaning).english();
    if (compared.linear)
      text += "; linear theory has none " + where(*compared.linear);
    else if (!scene.second_order)
      text += "; linear theory does not see it and goes on";
    texts.push_back(text);
  }
  if (scene.second_order) return texts;
  const std::string remedy = second_order_remedy(scene, compared);
  if (compared.linear && !compared.second)
    texts.push_back("linear theory has no answer " + where(*compared.linear) + ", second-order theory has" +
                    remedy);
  else if (is_far_off(compared))
    texts.push_back("linear theory is off by " + gaps(compared) + remedy);
  return texts;
}

std::string mechanisms(std::size_t loose) {
  const std::string none = "none before any load";
  return line("mechanisms", loose == 0 ? none : none + "; " + counted(loose, "joint") + " free to slide");
}

int refuse(const SceneDescription& scene, const std::string& reason) {
  std::cerr << scene.file << ": without loads and jack forces: " << reason << '\n';
  return 1;
}

// Whether prestrain is all that tensions the cables: then there is something to compare without a log.
bool has_prestrain_alone(const SceneDescription& scene) {
  bool any = false;
  for (const CableDescription& cable : scene.cables) {
    if (cable.is_jacked(0) || cable.is_jacked(1)) return false;
    for (const double strain : cable.prestrain) any = any || strain > 0;
  }
  return any;
}

// Whether the prestrain can be brought on.
Status try_start(const SceneDescription& scene) {
  return make_model(scene, methods.front().second, ScalarType::float64)->start(1).status;
}

}  // namespace

int check(const std::string& scene_path, const std::string& log_path) {
  const SceneDescription scene = read_scene_file(scene_path);
  const CondensedArrays condensed = condense(scene, ScalarType::float64);
  const bool rigid = is_rigid(scene);
  std::optional<ComparedTheories> compared;
  if (!rigid && (!log_path.empty() || scene.second_order || has_prestrain_alone(scene)))
    compared = compare_theories(scene, log_path);
  else if (!log_path.empty())
    check_log(log_path, scene, {});
  OutputFile output("");
  output.write(head(scene) + theory(scene) + capacities(scene) + beams(scene) +
               (scene.second_order ? "" : memory(scene, condensed)) + cables(scene, condensed));
  const Status stands = condensed.condensing.status ? try_start(scene) : condensed.condensing.status;
  if (!stands) {
    output.finish();
    const bool helps = !scene.second_order && compared && compared->begins && !compared->second;
    const std::string remedy =
        helps ? "second-order theory has an answer" + second_order_remedy(scene, *compared) : "";
    return refuse(scene, failure_text(stands, scene, remedy).english());
  }
  const std::vector<HangingJoint> loose = loose_joints(scene, condensed), hanging = hanging_joints(scene);
  output.write(condition(condensed.condensing.condition) + mechanisms(loose.size()) +
               (rigid ? "" : held_by_cable(scene, hanging) + accuracy(scene, compared)));
  output.finish();
  if (const std::string text = balance_warning(scene, condensed); !text.empty())
    std::cerr << "warning: " << text << '\n';
  for (const std::string& text : joint_warnings(scene, compared && compared->begins, loose, hanging))
    std::cerr << "warning: " << text << '\n';
  if (compared)
    for (const std::string& text : theory_warnings(scene, *compared))
      std::cerr << "warning: " << text << '\n';
  return 0;
}

}  // namespace taut::host
