#include "lib/files/status_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "lib/files/hanging_joints.hpp"
#include "lib/files/number_range.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

// An item of a list by a number of the core; null if the core means none.
template <class Item>
const Item* item_at(const std::vector<Item>& items, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= items.size()) return nullptr;
  return &items[static_cast<std::size_t>(index)];
}

std::string step(int index) { return "/" + std::to_string(index); }

bool breaks(Code code, double value) {
  if (code == Code::not_finite) return !std::isfinite(value);
  if (code == Code::not_positive) return !(value > 0);
  if (code == Code::negative) return value < 0;
  return false;
}

// A number of the file that a code may be about.
struct Value {
  std::string place;
  double value = 0;
};

// The one of several numbers that the code is about; a place only if the code names none of them.
Value guilty(Code code, const std::string& place, const std::vector<Value>& candidates) {
  for (const Value& candidate : candidates) {
    if (breaks(code, candidate.value)) return {place + candidate.place, candidate.value};
  }
  return {place, std::nan("")};
}

// Finds the place of a status in the scene file.
class PlaceFinder {
 public:
  PlaceFinder(const Status& status, const SceneDescription& scene) : status_(status), scene_(scene) {}

  // JSON pointer, and the number there if the code is about one.
  Value find() const {
    const int i = status_.index;
    switch (status_.place) {
      case Place::none:
        return {"", std::nan("")};
      case Place::node:
        return node(i);
      case Place::strut:
        return strut(i);
      case Place::beam:
        return beam(i);
      case Place::cable:
        return cable(i);
      case Place::path:
        return place(cable_place() + "/path" + step(i));
      case Place::segment:
        return segment(i);
      case Place::joint:
        return joint(i);
      case Place::cable_end:
        return place(cable_place() + "/" + end_name(i == 0 ? 0 : 1));
      case Place::substructure:
        return substructure(i);
      case Place::substructure_node:
      case Place::substructure_entry:
        return place("/substructures");
      case Place::load:
        return place(load_place(i));
      case Place::force:
        return force(i);
      case Place::temperature:
        return temperature(i);
    }
    return place("");
  }

 private:
  static Value place(std::string pointer) { return {std::move(pointer), std::nan("")}; }
  std::string cable_place() const { return "/cables" + step(status_.cable); }

  std::string node_name(int i) const {
    const NodeDescription* node = item_at(scene_.nodes, i);
    return node == nullptr ? "" : pointer_step(node->name);
  }
  Value node(int i) const { return place("/nodes" + node_name(i)); }

  Value strut(int i) const {
    const std::string pointer = "/struts" + step(i);
    const StrutDescription* strut = item_at(scene_.struts, i);
    if (strut == nullptr) return place(pointer);
    if (status_.code == Code::repeated_node || status_.code == Code::coincident_nodes)
      return place(pointer + "/nodes");
    return guilty(status_.code, pointer, {{"/E", strut->E}, {"/A", strut->A}});
  }

  // The core numbers the members of all beams together.
  Value beam(int i) const {
    for (std::size_t b = 0; b < scene_.beams.size(); ++b) {
      const BeamDescription& beam = scene_.beams[b];
      if (i >= static_cast<int>(beam.members())) {
        i -= static_cast<int>(beam.members());
        continue;
      }
      const std::string pointer = "/beams" + step(static_cast<int>(b));
      if (status_.code == Code::repeated_node || status_.code == Code::coincident_nodes)
        return place(pointer + "/nodes" + step(i + 1));
      if (status_.code == Code::out_of_range) return place(pointer + "/up");
      std::vector<Value> numbers = {{"/E", beam.E}, {"/A", beam.A}, {"/I", beam.I}};
      if (scene_.dimension == 3)
        numbers = {{"/E", beam.E},   {"/A", beam.A}, {"/Iy", beam.Iy},
                   {"/Iz", beam.Iz}, {"/J", beam.J}, {"/G", beam.G}};
      return guilty(status_.code, pointer, numbers);
    }
    return place("/beams");
  }

  Value cable(int i) const {
    const std::string pointer = "/cables" + step(i);
    const CableDescription* cable = item_at(scene_.cables, i);
    if (cable == nullptr) return place(pointer);
    if (status_.code == Code::path_too_short) return place(pointer + "/path");
    if (status_.code != Code::negative) {
      return guilty(status_.code, pointer, {{"/E", cable->E}, {"/A", cable->A}, {"/alpha", cable->alpha}});
    }
    return guilty(status_.code, pointer,
                  {{"/friction/wobble", cable->wobble},
                   {"/friction/mu_sd", cable->mu_sd},
                   {"/seating", cable->seating}});
  }

  Value segment(int i) const {
    const CableDescription* cable = item_at(scene_.cables, status_.cable);
    if (cable == nullptr || status_.code == Code::coincident_nodes)
      return place(cable_place() + "/path" + step(i));
    const double* prestrain = item_at(cable->prestrain, i);
    return {cable_place() + "/prestrain" + (cable->prestrain_is_list ? step(i) : ""),
            prestrain == nullptr ? std::nan("") : *prestrain};
  }

  Value joint(int j) const {
    const CableDescription* cable = item_at(scene_.cables, status_.cable);
    if (cable == nullptr || status_.code == Code::folded_cable) {
      return place(cable_place() + "/path" + step(cable != nullptr && cable->closed ? j : j + 1));
    }
    const double* mu = item_at(cable->mu, j);
    return {cable_place() + "/friction/mu" + (cable->mu_is_list ? step(j) : ""),
            mu == nullptr ? std::nan("") : *mu};
  }

  Value substructure(int i) const {
    const std::string pointer = "/substructures" + step(i);
    if (status_.code == Code::repeated_node) return place(pointer + "/nodes");
    if (status_.code == Code::not_symmetric) return place(pointer + "/stiffness" + step(status_.amount));
    return place(pointer + "/stiffness");
  }

  std::string load_place(int i) const {
    const LoadDescription* load = item_at(scene_.loads, i);
    return "/loads" + (load == nullptr ? "" : pointer_step(load->name));
  }

  // The core numbers the forces of all patterns together.
  Value force(int i) const {
    for (const LoadDescription& load : scene_.loads) {
      if (const ForceDescription* force = item_at(load.forces, i)) {
        return place("/loads" + pointer_step(load.name) + "/forces" + node_name(force->node));
      }
      i -= static_cast<int>(load.forces.size());
    }
    return place("/loads");
  }

  Value temperature(int i) const {
    for (const LoadDescription& load : scene_.loads) {
      if (const TemperatureDescription* change = item_at(load.temperatures, i)) {
        const CableDescription* cable = item_at(scene_.cables, change->cable);
        return place("/loads" + pointer_step(load.name) + "/temperature" +
                     (cable == nullptr ? "" : pointer_step(cable->name)));
      }
      i -= static_cast<int>(load.temperatures.size());
    }
    return place("/loads");
  }

  const Status& status_;
  const SceneDescription& scene_;
};

Sentence node_text(const SceneDescription& scene, int i) {
  const NodeDescription* node = item_at(scene.nodes, i);
  return node == nullptr ? Sentence("a node") : Sentence("node {1}", {quote(node->name)});
}

Sentence cable_text(const SceneDescription& scene, int c) {
  const CableDescription* cable = item_at(scene.cables, c);
  return cable == nullptr ? Sentence("a cable") : Sentence("cable {1}", {quote(cable->name)});
}

// The node at which a joint lies.
int joint_node(const SceneDescription& scene, int c, int j) {
  const CableDescription* cable = item_at(scene.cables, c);
  if (cable == nullptr) return -1;
  const int* node = item_at(cable->path, cable->closed ? j : j + 1);
  return node == nullptr ? -1 : *node;
}

// The nodes of a member of a beam, by the number of the core.
std::array<int, 2> member_nodes(const SceneDescription& scene, int member) {
  for (const BeamDescription& beam : scene.beams) {
    if (const int* first = item_at(beam.nodes, member); member < static_cast<int>(beam.members()))
      return {*first, first[1]};
    member -= static_cast<int>(beam.members());
  }
  return {-1, -1};
}

// The two ends of what lies between coincident nodes.
std::string between(const Status& status, const SceneDescription& scene) {
  int first = -1;
  if (status.place == Place::strut) {
    if (const StrutDescription* strut = item_at(scene.struts, status.index)) first = strut->nodes[0];
  } else if (status.place == Place::beam) {
    first = member_nodes(scene, status.index)[0];
  } else if (const CableDescription* cable = item_at(scene.cables, status.cable)) {
    if (const int* node = item_at(cable->path, status.index)) first = *node;
  }
  return node_text(scene, first).english() + " and " + node_text(scene, status.amount).english();
}

// Problem and remedy of a scene that validate() has refused.
std::pair<std::string, std::string> explain(const Status& status, const SceneDescription& scene,
                                            double value) {
  const std::string number = std::isnan(value) ? "the number" : plain(value);
  switch (status.code) {
    case Code::not_finite:
      return {"the number is not finite", "write a plain decimal"};
    case Code::not_positive:
      return {number + " is not greater than zero", "write a number greater than zero"};
    case Code::negative:
      return {number + " is below zero", "write zero or more"};
    case Code::repeated_node:
      if (status.place == Place::strut) {
        return {"both ends are at " + node_text(scene, status.amount).english(), "name two different nodes"};
      }
      if (status.place == Place::beam) {
        return {"the beam goes from " + node_text(scene, status.amount).english() + " to itself",
                "name another node here"};
      }
      return {node_text(scene, status.amount).english() + " comes twice", "name every node once"};
    case Code::coincident_nodes:
      return {between(status, scene) + " are at the same point",
              "move one of them, or use one node for both"};
    case Code::path_too_short:
      return {"the path is too short", "name at least 2 nodes, 3 for a closed cable"};
    case Code::folded_cable:
      return {"the cable folds straight back at " +
                  node_text(scene, joint_node(scene, status.cable, status.index)).english(),
              "move this node or a neighbour so that the cable turns by less than 180 degrees"};
    case Code::unsupported:
      return {"the supports leave the structure free to move as a rigid body, " +
                  node_text(scene, status.index).english() + " with it",
              "add supports or a substructure that hold it"};
    case Code::not_symmetric:
      return {"the stiffness matrix is not symmetric: row " + std::to_string(status.amount + 1) +
                  " differs from the column of the same number",
              "give both the same entries"};
    case Code::not_semidefinite:
      return {"the stiffness matrix has a negative eigenvalue",
              "check signs and the order of nodes and axes: a stiffness can only resist"};
    case Code::out_of_range:
      if (status.place == Place::segment) {
        return {"the prestrain " + number + " is out of range", "write a number between -1 and 1"};
      }
      if (status.place == Place::beam) {
        const auto nodes = member_nodes(scene, status.index);
        return {"up is parallel to the beam from " + node_text(scene, nodes[0]).english() + " to " +
                    node_text(scene, nodes[1]).english(),
                "write the vector \"up\" so that it points aside; the beam's z lies in the plane of both"};
      }
      break;
    default:
      break;
  }
  return {describe(status.code), "correct the scene"};
}

// Who a failure of a run is about.
Sentence subject(const Status& status, const SceneDescription& scene) {
  const std::string number = std::to_string(status.index + 1);
  switch (status.place) {
    case Place::node:
      return node_text(scene, status.index);
    case Place::strut:
      return Sentence("strut {1}", {number});
    case Place::cable:
      return cable_text(scene, status.index);
    case Place::path:
      return Sentence("path node {1} of {2}", {number, cable_text(scene, status.cable)});
    case Place::segment:
      return Sentence("segment {1} of {2}", {number, cable_text(scene, status.cable)});
    case Place::joint:
      return Sentence("joint {1} of {2} at {3}",
                      {number, cable_text(scene, status.cable),
                       node_text(scene, joint_node(scene, status.cable, status.index))});
    case Place::cable_end:
      return Sentence(status.index == 0 ? "start of {1}" : "end of {1}", {cable_text(scene, status.cable)});
    case Place::substructure:
      return Sentence("substructure {1}", {number});
    case Place::load: {
      const LoadDescription* load = item_at(scene.loads, status.index);
      return load == nullptr ? Sentence("a load pattern") : Sentence("load pattern {1}", {quote(load->name)});
    }
    default:
      return Sentence("the scene");
  }
}

// The struts that end at a node: `strut 3 from node "a"`.
Sentence struts_at(const SceneDescription& scene, int node) {
  Sentence struts;
  for (std::size_t i = 0; i < scene.struts.size(); ++i) {
    const auto& ends = scene.struts[i].nodes;
    if (ends[0] != node && ends[1] != node) continue;
    const Sentence strut = Sentence(
        "strut {1} from {2}", {std::to_string(i + 1), node_text(scene, ends[0] == node ? ends[1] : ends[0])});
    struts = struts.empty() ? strut : Sentence("{1}, {2}", {struts, strut});
  }
  return struts;
}

// What is wrong, where describe() speaks of something else than the place does.
Sentence failure_problem(const Status& status, const SceneDescription& scene) {
  if (status.code == Code::gives_way && status.place == Place::joint) {
    const Sentence struts = struts_at(scene, joint_node(scene, status.cable, status.index));
    if (!struts.empty())
      return Sentence(
          "friction gives way, and what it held runs away ({1}): the structure would jump to a state far "
          "away",
          {struts});
  }
  if (status.code == Code::gives_way && status.place == Place::node)
    return Sentence(
        "under the forces at the target of second-order theory members buckle, and this node moves or turns "
        "most: the target is not reached");
  if (status.code == Code::mechanism && status.place == Place::joint)
    return Sentence("mechanism: when the cable slides over this joint, nothing holds its node");
  if (status.code == Code::not_finite)
    return Sentence("condensed, it has a number that is infinite or out of all range");
  if (status.code == Code::state_iterations) return Sentence("jammed: the joint states do not settle");
  return Sentence(describe(status.code));
}

bool is_on_beam(const SceneDescription& scene, const Status& status) {
  for (const BeamDescription& beam : scene.beams)
    for (const int node : beam.nodes)
      if (status.place == Place::node && status.index == node) return true;
  return false;
}

// Whether linear theory fails where tension holds a node.
bool lacks_tension(const SceneDescription& scene, const Status& status) {
  if (scene.second_order) return false;
  for (const HangingJoint& hanging : hanging_joints(scene)) {
    if (status.place == Place::node && status.index == hanging.node) return true;
    if (status.place == Place::joint && status.cable == static_cast<int>(hanging.cable) &&
        status.index == static_cast<int>(hanging.joint))
      return true;
  }
  return false;
}

template <class Members>
bool touches(const Members& members, int node) {
  return std::any_of(members.begin(), members.end(), [node](const auto& member) {
    return std::any_of(member.nodes.begin(), member.nodes.end(), [node](int other) { return other == node; });
  });
}

// Nothing is between it and any other node.
bool is_unused(const SceneDescription& scene, int node) {
  if (touches(scene.struts, node) || touches(scene.beams, node) || touches(scene.substructures, node))
    return false;
  return std::none_of(scene.cables.begin(), scene.cables.end(), [node](const CableDescription& cable) {
    return std::find(cable.path.begin(), cable.path.end(), node) != cable.path.end();
  });
}

Sentence failure_remedy_alone(const Status& status, const SceneDescription& scene) {
  switch (status.code) {
    case Code::mechanism:
      if (status.place == Place::joint) return Sentence(sliding_remedy);
      if (status.place == Place::node && is_unused(scene, status.index))
        return Sentence(
            "no strut, beam, cable or substructure ends at it or passes it: remove it from \"nodes\", or "
            "connect it");
      return Sentence(is_on_beam(scene, status)
                          ? "add a strut, a support or a substructure that holds it, or hold the rotation of "
                            "a beam that turns freely"
                          : "add a strut, a support or a substructure that holds it");
    case Code::pulled_through:
      return Sentence("bring the jack forces closer together, or anchor one end");
    case Code::gives_way:
      if (status.place == Place::node)
        return Sentence(
            "name a smaller target, make stiffer what is under thrust there (larger I, fewer hinges), or "
            "hold it sideways");
      return Sentence(
          "hold the node of this joint sideways (a second strut, a substructure), or stay below this load");
    case Code::state_iterations:
      // Events are found wherever a row ends: rows in between change nothing.
      return Sentence(scene.second_order
                          ? "hold the nodes of these joints sideways, or stay below this load"
                          : "try taut simulate --method stepwise --substeps 100, or stay below this load");
    case Code::ill_conditioned:
      // With geometric stiffness a structure is condensed in double whatever the tracker computes in.
      if (scene.second_order && status.place == Place::node)
        return Sentence(
            "look for what next to nothing holds, or for stiffnesses that differ by many powers of ten");
      return Sentence(
          "use --scalar double; in double, look for what nothing holds, or for stiffnesses that differ by "
          "many powers of ten");
    case Code::not_finite:
      return Sentence(remedy_of_impossible_numbers);
    case Code::bad_sample:
      return Sentence("write finite numbers, no negative jack forces and no more than the cables can carry");
    default:
      return Sentence("check the scene with: taut check");
  }
}

// In second-order theory: what lets a strut run away that hangs on its cable alone; empty if nothing does.
Sentence run_away_text(const Status& status, const SceneDescription& scene) {
  const bool has_no_answer = status.code == Code::mechanism || status.code == Code::gives_way ||
                             status.code == Code::ill_conditioned || status.code == Code::state_iterations;
  if (!scene.second_order || !has_no_answer) return {};
  for (const HangingJoint& hanging : hanging_joints(scene)) {
    const CableDescription& cable = scene.cables[hanging.cable];
    const Sentence joint =
        joint_text(scene, static_cast<int>(hanging.cable), static_cast<int>(hanging.joint));
    const Sentence struts = struts_at(scene, hanging.node);
    if (struts.empty()) continue;
    if (cable.mu[hanging.joint] == 0 && cable.wobble == 0)
      return Sentence(
          "{1}: the cable alone holds this node sideways, and without friction {2} runs away; give the joint "
          "friction, or hold its node ({3})",
          {joint, struts, Sentence(sliding_remedy)});
    // Where it runs away as the lowest level ends, no forces are found at all, and no joint is named.
    const bool is_free =
        status.code == Code::mechanism || (status.code == Code::gives_way && status.place == Place::none);
    if (is_free && cable.is_jacked(0) && cable.is_jacked(1))
      return Sentence(
          "{1}: between two jacks at work the cable can follow this node, and {2} runs away; prescribe the "
          "stroke of one jack (lock its end, or anchor it), or {3}",
          {joint, struts, Sentence(sliding_remedy)});
  }
  return {};
}

// Nothing but cables and struts holds it: no support, and no beam or substructure ends there.
bool hangs_on_bars(const SceneDescription& scene, int node) {
  return scene.nodes[static_cast<std::size_t>(node)].held == held_none && !touches(scene.beams, node) &&
         !touches(scene.substructures, node);
}

// Supports leave it a direction, and no beam and no substructure ends there.
bool is_let_go(const SceneDescription& scene, int node) {
  const unsigned all = scene.dimension == 2 ? held_x | held_y : held_x | held_y | held_z;
  return (scene.nodes[static_cast<std::size_t>(node)].held & all) != all && !touches(scene.beams, node) &&
         !touches(scene.substructures, node);
}

// A mechanism that the core places at a cable without joints is a node at an end of it: one that hangs on
// cables alone, or else one with struts, or else one on rollers.
Status at_its_node(const Status& status, const SceneDescription& scene) {
  if (status.code != Code::mechanism || status.place != Place::cable || status.index < 0 ||
      status.index >= static_cast<int>(scene.cables.size()))
    return status;
  const auto& path = scene.cables[static_cast<std::size_t>(status.index)].path;
  for (const bool has_struts : {false, true})
    for (const int node : {path.front(), path.back()})
      if (hangs_on_bars(scene, node) && touches(scene.struts, node) == has_struts)
        return Status::at(Code::mechanism, Place::node, node);
  for (const int node : {path.front(), path.back()})
    if (is_let_go(scene, node)) return Status::at(Code::mechanism, Place::node, node);
  return status;
}

}  // namespace

InputError scene_error(const Status& status, const SceneDescription& scene) {
  const Value found = PlaceFinder(status, scene).find();
  auto [problem, remedy] = explain(status, scene, found.value);
  return {scene.file, found.place, std::move(problem), std::move(remedy)};
}

Sentence joint_text(const SceneDescription& scene, int cable, int joint) {
  return subject(Status::along(Code::ok, Place::joint, cable, joint), scene);
}

Sentence failure_remedy(const Status& status, const SceneDescription& scene) {
  const Sentence remedy = failure_remedy_alone(status, scene);
  const bool may_lack_tension = status.code == Code::mechanism || status.code == Code::gives_way ||
                                status.code == Code::state_iterations;
  if (!may_lack_tension || !lacks_tension(scene, status)) return remedy;
  return Sentence("{1}, or {2}", {Sentence(tension_remedy), remedy});
}

Sentence failure_text(const Status& found, const SceneDescription& scene, const Sentence& remedy) {
  const Status status = at_its_node(found, scene);
  if (const Sentence text = run_away_text(status, scene); remedy.empty() && !text.empty()) return text;
  return Sentence("{1}: {2}; {3}", {subject(status, scene), failure_problem(status, scene),
                                    remedy.empty() ? failure_remedy(status, scene) : remedy});
}

}  // namespace taut::host
