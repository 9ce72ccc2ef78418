#include "lib/report/structure_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lib/files/result_file.hpp"
#include "lib/report/chart.hpp"
#include "lib/report/colour_scale.hpp"
#include "lib/report/html.hpp"
#include "lib/report/names.hpp"
#include "lib/report/projection.hpp"

namespace taut::host {
namespace {

std::string title(const std::string& text) { return element("title", {}, escaped(text)); }

std::string line(const char* look, const CurvePoint& from, const CurvePoint& to) {
  return void_element("line", {{"class", look},
                               {"x1", coordinate(from.x)},
                               {"y1", coordinate(from.y)},
                               {"x2", coordinate(to.x)},
                               {"y2", coordinate(to.y)}});
}

std::string moved_to(const CurvePoint& at) {
  return "translate(" + coordinate(at.x) + " " + coordinate(at.y) + ")";
}

std::string turned(const CurvePoint& at, const CurvePoint& along) {
  const double degrees = std::atan2(along.y, along.x) * 57.29577951308232;
  return moved_to(at) + " rotate(" + coordinate(degrees) + ")";
}

constexpr const char* hinge_outline = "M-4,0 a4,4 0 1,0 8,0 a4,4 0 1,0 -8,0 z";

CurvePoint difference(const CurvePoint& a, const CurvePoint& b) { return {a.x - b.x, a.y - b.y}; }

class StructureDrawing {
 public:
  StructureDrawing(const SceneDescription& scene, const RunRecord& record, const ForceUnit& unit,
                   const ForceScale& scale, const Words& words)
      : scene_(scene), record_(record), unit_(unit), scale_(scale), say(words), points_(scene) {}

  std::string operator()() const {
    const std::string says = say("The structure {1} with cables coloured by force", {scene_.name});
    std::string parts = substructures() + beams() + struts() + supports();
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) parts += segments(c);
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) parts += jacks(c) + joints(c);
    parts += node_labels();
    if (scene_.dimension == 3) parts += axes();
    return element("svg",
                   {{"class", "structure"},
                    {"role", "img"},
                    {"aria-label", says},
                    {"viewBox", "0 0 " + coordinate(Projection::width) + " " + coordinate(points_.height())}},
                   parts);
  }

 private:
  bool has_answer() const { return record_.rows > 0; }

  std::string struts() const {
    std::string drawn;
    for (std::size_t i = 0; i < scene_.struts.size(); ++i) {
      const auto& nodes = scene_.struts[i].nodes;
      const double force = has_answer() ? record_.end.strut[i] : 0;
      std::string name = say("strut {1} ({2}\u2013{3})", {std::to_string(i + 1), node_name(scene_, nodes[0]),
                                                          node_name(scene_, nodes[1])});
      if (has_answer())
        name += ": " + unit_.text(force) +
                (force > 0   ? say(", tension")
                 : force < 0 ? say(", compression")
                             : std::string());
      const CurvePoint from = points_.at(nodes[0]), to = points_.at(nodes[1]);
      const std::string lean = has_answer() && scene_.second_order ? lean_of(i) : "";
      if (!lean.empty()) name += say("; leans: {1} of friction used", {lean});
      drawn += element(
          "g", {},
          line("hit", from, to) + line(force > 0 ? "strut tension" : "strut", from, to) + title(name));
    }
    return drawn;
  }

  // How much of friction is used where a strut meets a cable; empty if it meets none.
  std::string lean_of(std::size_t strut) const {
    const auto& nodes = scene_.struts[strut].nodes;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) {
      const CableDescription& cable = scene_.cables[c];
      for (std::size_t j = 0; j < cable.joints(); ++j)
        if (const int at = cable.path[cable.closed ? j : j + 1]; at == nodes[0] || at == nodes[1])
          return used(start_of(scene_, c).joint + j);
    }
    return "";
  }
  std::string used(std::size_t joint) const {
    return fixed(100 * record_.end.friction_used[joint], 0) + " %";
  }

  // Members, and a ring at every hinge.
  std::string beams() const {
    std::string drawn, hinges;
    for (std::size_t b = 0; b < scene_.beams.size(); ++b) {
      const BeamDescription& beam = scene_.beams[b];
      const std::string name = say("beam {1}", {std::to_string(b + 1)});
      for (std::size_t i = 0; i < beam.members(); ++i) {
        const int from = beam.nodes[i], to = beam.nodes[i + 1];
        const std::string span = node_name(scene_, from) + "\u2013" + node_name(scene_, to);
        drawn += element("g", {},
                         line("beam", points_.at(from), points_.at(to)) + title(name + " (" + span + ")"));
      }
      for (const int node : beam.hinges)
        hinges += element("g", {{"transform", moved_to(points_.at(node))}},
                          element("path", {{"class", "hinge"}, {"d", hinge_outline}},
                                  title(say("hinge of {1} at node {2}", {name, node_name(scene_, node)}))));
    }
    return drawn + hinges;
  }

  std::string supports() const {
    std::string drawn;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const NodeDescription& node = scene_.nodes[i];
      if (node.held == held_none) continue;
      std::string axes;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if ((node.held >> axis & 1) != 0) axes += std::string(axes.empty() ? "" : ", ") + "xyz"[axis];
      axes += held_rotations(node.held, axes.empty());
      drawn += element("g", {{"transform", moved_to(points_.at(static_cast<int>(i)))}},
                       element("path", {{"class", "support"}, {"d", support_outline(node.held)}},
                               title(say("support {1}: held in {2}", {node.name, axes}))));
    }
    return drawn;
  }
  std::string held_rotations(std::uint8_t held, bool is_first) const {
    std::string rotations;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((held & static_cast<unsigned>(held_rx) << axis) == 0) continue;
      rotations += (is_first && rotations.empty() ? "" : ", ") +
                   (scene_.dimension == 2 ? say("rotation")
                                          : say("rotation about {1}", {std::string(1, "xyz"[axis])}));
    }
    return rotations;
  }
  // A triangle where a node is held; one on a line where it can move along the line.
  const char* support_outline(std::uint8_t motions) const {
    const unsigned held = motions & held_xyz;
    if (held == (scene_.dimension == 2 ? held_xy : held_xyz)) return "M0,0 L-8,13 L8,13 z";
    if (scene_.dimension == 2 && held == held_x) return "M0,0 L-13,-8 L-13,8 z M-17,-9 V9";
    return "M0,0 L-8,13 L8,13 z M-9,17 H9";
  }

  std::string substructures() const {
    std::string drawn;
    for (const SubstructureDescription& part : scene_.substructures)
      for (const int node : part.nodes)
        drawn += element(
            "g", {{"transform", moved_to(points_.at(node))}},
            element("path", {{"class", "substructure"}, {"d", "M-11,-11 H11 V11 H-11 z"}},
                    title(say("substructure {1} at node {2}", {part.name, node_name(scene_, node)}))));
    return drawn;
  }

  std::string segments(std::size_t c) const {
    const CableDescription& cable = scene_.cables[c];
    const std::size_t first = start_of(scene_, c).segment;
    std::string drawn;
    for (std::size_t i = 0; i < cable.segments(); ++i) {
      const auto nodes = segment_nodes(cable, i);
      const CurvePoint from = points_.at(nodes[0]), to = points_.at(nodes[1]);
      const std::string name = cable.name + ", " + segment_name(scene_, cable, i, say);
      std::string look = "cable", says = name;
      if (has_answer()) {
        const double force = record_.end.tension[first + i];
        look += " " + scale_.look(force);
        says += ": " + unit_.text(force) + ", " + say("sd") + " " +
                unit_.deviation(record_.end.deviation[first + i]);
      }
      drawn += element("g", {{"class", "segment"}, {"data-name", name}},
                       line("hit", from, to) + line("casing", from, to) + line(look.c_str(), from, to) +
                           title(says) + force_label(first + i, from, to));
    }
    return drawn;
  }

  // Along the segment and below it, where there is room for it.
  std::string force_label(std::size_t segment, const CurvePoint& from, const CurvePoint& to) const {
    constexpr double least_length = 40, off = 13;
    const CurvePoint along = difference(to, from);
    const double length = std::hypot(along.x, along.y);
    if (length < least_length || !has_room()) return "";
    const bool is_upright = along.x > 1e-9 * length || (along.x > -1e-9 * length && along.y < 0);
    const CurvePoint reading = is_upright ? along : CurvePoint{-along.x, -along.y};
    const CurvePoint middle{(from.x + to.x) / 2 - off * reading.y / length,
                            (from.y + to.y) / 2 + off * reading.x / length + 3};
    return element("text",
                   {{"class", "force"}, {"transform", turned(middle, reading)}, {"text-anchor", "middle"}},
                   has_answer() ? unit_.number(record_.end.tension[segment]) : "");
  }
  bool has_room() const { return start_of(scene_, scene_.cables.size()).segment <= most_labels; }
  // Of what a cable runs over and ends at; in space they would stand on other things.
  std::string node_labels() const {
    constexpr std::size_t longest_name = 12;
    std::string drawn;
    if (scene_.dimension == 3 || !has_room()) return drawn;
    std::vector<char> is_named(scene_.nodes.size());
    for (const CableDescription& cable : scene_.cables)
      for (const int node : cable.path) is_named[static_cast<std::size_t>(node)] = 1;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      if (!is_named[i]) continue;
      const CurvePoint at = points_.at(static_cast<int>(i));
      drawn += element("text",
                       {{"class", "node"},
                        {"x", coordinate(at.x)},
                        {"y", coordinate(at.y - 11)},
                        {"text-anchor", "middle"}},
                       escaped(shortened(scene_.nodes[i].name, longest_name)));
    }
    return drawn;
  }

  std::string joints(std::size_t c) const {
    const CableDescription& cable = scene_.cables[c];
    const std::size_t first = start_of(scene_, c).joint, nodes = cable.path.size();
    std::string drawn;
    for (std::size_t j = 0; j < cable.joints(); ++j) {
      const std::size_t at = cable.closed ? j : j + 1;
      const CurvePoint before = points_.at(cable.path[(at + nodes - 1) % nodes]);
      const CurvePoint after = points_.at(cable.path[(at + 1) % nodes]);
      const JointState state = has_answer() ? record_.end.state[first + j] : JointState::stick;
      const std::string name =
          cable.name + ", " +
          say("joint {1} at {2}", {std::to_string(j + 1), node_name(scene_, cable.path[at])});
      drawn += element("g",
                       {{"class", "joint"},
                        {"data-name", name},
                        {"transform", turned(points_.at(cable.path[at]), difference(after, before))}},
                       element("path", {{"class", state_word(state)}, {"d", joint_outline(state)}}) +
                           title(has_answer() ? name + ": " + say(state_word(state)) : name));
      if (!has_answer() || !scene_.second_order) continue;
      const CurvePoint here = points_.at(cable.path[at]);
      drawn += element("text",
                       {{"class", "lean"},
                        {"x", coordinate(here.x)},
                        {"y", coordinate(here.y + 19)},
                        {"text-anchor", "middle"}},
                       used(first + j));
    }
    return drawn;
  }

  // An arrow that pulls outwards.
  std::string jacks(std::size_t c) const {
    const CableDescription& cable = scene_.cables[c];
    std::string drawn;
    for (std::size_t e = 0; e < 2; ++e) {
      if (!cable.is_jacked(e)) continue;
      const int node = e == 0 ? cable.path.front() : cable.path.back();
      const int inner = e == 0 ? cable.path[1] : cable.path[cable.path.size() - 2];
      drawn += element(
          "g", {{"transform", turned(points_.at(node), difference(points_.at(node), points_.at(inner)))}},
          element("path", {{"class", "jack"}, {"d", "M3,-2 H15 V-6 L26,0 L15,6 V2 H3 z"}},
                  title(say(e == 0 ? "jack at the start of {1}" : "jack at the end of {1}", {cable.name}))));
    }
    return drawn;
  }

  std::string axes() const {
    constexpr double length = 26;
    std::string drawn;
    const CurvePoint from{34, points_.height() - 30};
    const auto directions = Projection::axes();
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const CurvePoint to{from.x + length * directions[i].x, from.y + length * directions[i].y};
      drawn += line("axis", from, to);
      drawn += element("text",
                       {{"x", coordinate(from.x + 1.4 * (to.x - from.x))},
                        {"y", coordinate(from.y + 1.4 * (to.y - from.y) + 4)},
                        {"text-anchor", "middle"}},
                       std::string(1, "xyz"[i]));
    }
    return element("g", {{"class", "axes"}, {"aria-hidden", "true"}}, drawn);
  }

  static constexpr std::size_t most_labels = 40;  // segments: more are a crowd

  const SceneDescription& scene_;
  const RunRecord& record_;
  const ForceUnit& unit_;
  const ForceScale& scale_;
  const Words& say;
  Projection points_;
};

std::string symbol(const std::string& content, const std::string& words) {
  return element("li", {},
                 element("svg",
                         {{"class", "sample"},
                          {"width", "28"},
                          {"height", "18"},
                          {"viewBox", "-14 -9 28 18"},
                          {"aria-hidden", "true"}},
                         content) +
                     words);
}

std::string joint_symbol(JointState state, const std::string& words) {
  return symbol(element("g", {{"class", "joint"}},
                        element("path", {{"class", state_word(state)}, {"d", joint_outline(state)}})),
                words);
}

}  // namespace

const char* joint_outline(JointState state) {
  switch (state) {
    case JointState::stick:
      return "M-5,0 a5,5 0 1,0 10,0 a5,5 0 1,0 -10,0 z";
    case JointState::forward:
      return "M-6,-7 L8,0 L-6,7 z";
    case JointState::backward:
      return "M6,-7 L-8,0 L6,7 z";
    case JointState::open:
      return "M-6.5,0 a6.5,6.5 0 1,0 13,0 a6.5,6.5 0 1,0 -13,0 z";
  }
  return "";
}

std::string structure_drawing(const SceneDescription& scene, const RunRecord& record, const ForceUnit& unit,
                              const ForceScale& scale, const Words& say) {
  return StructureDrawing(scene, record, unit, scale, say)();
}

std::string structure_legend(const SceneDescription& scene, const Words& say) {
  std::string entries;
  if (!scene.struts.empty()) {
    entries += symbol(line("strut", {-13, 0}, {13, 0}), say("strut in compression")) +
               symbol(line("strut tension", {-13, 0}, {13, 0}), say("strut in tension"));
  }
  if (!scene.beams.empty()) entries += symbol(line("beam", {-13, 0}, {13, 0}), say("beam"));
  const auto has_hinge = [](const BeamDescription& beam) { return !beam.hinges.empty(); };
  if (std::any_of(scene.beams.begin(), scene.beams.end(), has_hinge))
    entries += symbol(element("path", {{"class", "hinge"}, {"d", hinge_outline}}), say("hinge of a beam"));
  const auto has_jack = [](const CableDescription& cable) {
    return cable.is_jacked(0) || cable.is_jacked(1);
  };
  bool jacks = false, joints = false;
  for (const CableDescription& cable : scene.cables) {
    jacks = jacks || has_jack(cable);
    joints = joints || cable.joints() > 0;
  }
  entries += symbol(element("path", {{"class", "support"}, {"d", "M0,-6 L-8,7 L8,7 z"}}), say("support"));
  if (!scene.substructures.empty())
    entries += symbol(element("path", {{"class", "substructure"}, {"d", "M-8,-8 H8 V8 H-8 z"}}),
                      say("substructure"));
  if (jacks)
    entries += symbol(element("path", {{"class", "jack"}, {"d", "M-12,-2 H0 V-6 L11,0 L0,6 V2 H-12 z"}}),
                      say("jack"));
  if (joints) {
    entries += joint_symbol(JointState::stick, say("joint sticks")) +
               joint_symbol(JointState::forward, say("slides to the end of the cable")) +
               joint_symbol(JointState::backward, say("slides to its start")) +
               joint_symbol(JointState::open, say("open"));
  }
  if (joints && scene.second_order && !scene.struts.empty())
    entries +=
        element("li", {},
                say("per cent at a joint: how much of friction is used there, by a strut that leans or by "
                    "sliding, at the end"));
  return element("ul", {{"class", "legend"}}, entries);
}

}  // namespace taut::host
