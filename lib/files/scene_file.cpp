#include "lib/files/scene_file.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "lib/files/file_text.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/instrument_reader.hpp"
#include "lib/files/json_field.hpp"
#include "lib/files/log_columns.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

const Keys scene_keys = {
    {"taut", true, "1, the version of the format"},
    {"name", true, "a title for the scene"},
    {"dimension", true, "2 or 3"},
    {"nodes", true, "an object that gives every node name its coordinates [m]"},
    {"supports", false, ""},
    {"struts", false, ""},
    {"beams", false, ""},
    {"cables", false, ""},
    {"substructures", false, ""},
    {"loads", false, ""},
    {"sensors", false, ""},
    {"second_order", false, ""},
    {"plausible", false, ""},
};
const Keys strut_keys = {
    {"nodes", true, "a list of two node names"},
    {"E", true, "Young's modulus [N/m2]"},
    {"A", true, "the cross-section [m2]"},
};
const Keys plane_beam_keys = {
    {"nodes", true, "a list of node names, one after the other along the beam"},
    {"E", true, "Young's modulus [N/m2]"},
    {"A", true, "the cross-section [m2]"},
    {"I", true, "the second moment of area [m4]"},
    {"hinges", false, ""},
};
const Keys space_beam_keys = {
    {"nodes", true, "a list of node names, one after the other along the beam"},
    {"E", true, "Young's modulus [N/m2]"},
    {"A", true, "the cross-section [m2]"},
    {"Iy", true, "the second moment of area about the beam's y [m4]"},
    {"Iz", true, "the second moment of area about the beam's z [m4]"},
    {"J", true, "the torsion constant [m4]"},
    {"G", false, ""},
    {"up", false, ""},
    {"hinges", false, ""},
};
const Keys cable_keys = {
    {"name", true, "a name for the columns of the log and the result"},
    {"path", true, "a list of node names"},
    {"E", true, "Young's modulus [N/m2]"},
    {"A", true, "the cross-section [m2]"},
    {"start", false, "\"anchored\" or \"jacked\""},
    {"end", false, "\"anchored\" or \"jacked\""},
    {"closed", false, ""},
    {"friction", false, ""},
    {"prestrain", false, ""},
    {"alpha", false, ""},
    {"seating", false, ""},
    {"E_sd", false, ""},
    {"seating_sd", false, ""},
    {"temperature_sd", false, ""},
};
const Keys friction_keys = {
    {"law", true, "\"point\" or \"capstan\""},
    {"mu", true, "one number, or a list of one a joint"},
    {"wobble", false, ""},
    {"mu_sd", false, ""},
    {"shared", false, ""},
    {"scatter", false, ""},
    {"drift", false, ""},
};
const Keys substructure_keys = {
    {"name", true, "a name for messages"},
    {"nodes", true, "a list of node names"},
    {"stiffness", true, "a symmetric matrix as a list of rows [N/m]"},
    {"geometric_stiffness", false, ""},
};
const Keys second_order_keys = {
    {"target", true, "the loads and jack forces whose geometric stiffness is taken"},
};
const Keys target_keys = {{"loads", false, ""}, {"forces", false, ""}};
const Keys load_keys = {{"forces", false, ""}, {"temperature", false, ""}};
// Turns the tree of a scene file into a description, part by part in the order in which one refers to
// another.
class SceneReader {
 public:
  SceneReader(const Field& root, const std::string& file) : root_(root) { scene_.file = file; }

  SceneDescription read() {
    read_head();
    read_nodes();
    if (const auto supports = root_.find("supports")) read_supports(*supports);
    if (const auto struts = root_.find("struts")) read_struts(*struts);
    if (const auto beams = root_.find("beams")) read_beams(*beams);
    if (const auto supports = root_.find("supports")) require_held_rotations_to_be_there(*supports);
    if (const auto cables = root_.find("cables")) read_cables(*cables);
    if (const auto substructures = root_.find("substructures")) read_substructures(*substructures);
    if (const auto loads = root_.find("loads")) read_loads(*loads);
    if (const auto sensors = root_.find("sensors")) read_instruments(*sensors, scene_);
    if (const auto second_order = root_.find("second_order")) read_second_order(*second_order);
    return std::move(scene_);
  }

 private:
  using NameIndex = std::unordered_map<std::string, int>;

  std::size_t dimension() const { return static_cast<std::size_t>(scene_.dimension); }
  // The axes of the scene as letters.
  std::string axes() const { return scene_.dimension == 2 ? "xy" : "xyz"; }
  std::string vector_shape() const { return scene_.dimension == 2 ? "[x, y]" : "[x, y, z]"; }

  void read_head() {
    root_.require_head("scene", "{ \"taut\": 1, ... }", scene_keys);
    scene_.name = root_.at("name").text("a title for the scene");
    const Field field = root_.at("dimension");
    const double found = field.number("2 or 3");
    if (found != 2 && found != 3)
      field.refuse("dimension " + plain(found) + " is not possible", "write 2 or 3");
    scene_.dimension = static_cast<int>(found);
    if (const auto plausible = root_.find("plausible"))
      scene_.plausible = plausible->boolean("true or false");
  }

  // As many numbers as the scene has axes.
  std::array<double, 3> read_vector(const Field& field, const std::string& unit) const {
    const std::string wanted = counted(dimension(), "number") + " " + vector_shape() + " in " + unit;
    const auto items = field.elements(wanted);
    if (items.size() != dimension()) {
      field.refuse("found " + counted(items.size(), "number") + " in a scene of dimension " +
                       std::to_string(scene_.dimension),
                   "write " + wanted);
    }
    std::array<double, 3> vector{};
    for (std::size_t i = 0; i < items.size(); ++i) vector[i] = items[i].number("a number in " + unit);
    return vector;
  }

  void read_nodes() {
    const Field field = root_.at("nodes");
    for (const auto& [name, at] : field.members("an object that gives every node name its coordinates [m]")) {
      if (name.empty()) at.refuse("the node has an empty name", "give it a name");
      node_index_.emplace(name, static_cast<int>(scene_.nodes.size()));
      scene_.nodes.push_back({name, read_vector(at, "m"), held_none});
    }
    if (scene_.nodes.empty())
      field.refuse("the scene has no nodes", "add nodes: \"name\": " + vector_shape());
  }

  // The number of the item called `name`, or a refusal with the name that was probably meant.
  template <class Items>
  static int index_of(const Field& field, const std::string& name, const NameIndex& index, const Items& items,
                      const std::string& noun) {
    const auto found = index.find(name);
    if (found != index.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& item : items) known.push_back(item.name);
    field.refuse("there is no " + noun + " " + quote(name), suggestion(name, known, "the " + noun + "s are"));
  }

  int node(const Field& field, const std::string& name) const {
    return index_of(field, name, node_index_, scene_.nodes, "node");
  }
  int node(const Field& field) const { return node(field, field.text("the name of a node")); }
  int cable(const Field& field, const std::string& name) const {
    return index_of(field, name, cable_index_, scene_.cables, "cable");
  }
  int load(const Field& field, const std::string& name) const {
    return index_of(field, name, load_index_, scene_.loads, "load pattern");
  }

  void read_supports(const Field& field) {
    for (const auto& [name, held] : field.members("an object that gives node names their supports")) {
      const int index = node(held, name);
      scene_.nodes[static_cast<std::size_t>(index)].held = read_support(held);
    }
  }

  // Motions that a support can hold, as they are written; rotations only of beams.
  struct Motion {
    std::string name;
    unsigned bit;
  };
  std::vector<Motion> motions() const {
    std::vector<Motion> all;
    for (std::size_t axis = 0; axis < axes().size(); ++axis) all.push_back({{axes()[axis]}, 1U << axis});
    if (!root_.find("beams")) return all;
    if (scene_.dimension == 2) {
      all.push_back({"r", held_r});
    } else {
      for (std::size_t axis = 0; axis < 3; ++axis)
        all.push_back({std::string("r") + "xyz"[axis], static_cast<unsigned>(held_rx) << axis});
    }
    return all;
  }
  std::string letters_of_supports() const {
    if (!root_.find("beams")) return "letters out of " + quote(axes());
    return scene_.dimension == 2 ? "letters out of \"xyr\"" : "out of \"x y z rx ry rz\"";
  }

  std::uint8_t read_support(const Field& field) const {
    const std::string wanted = letters_of_supports();
    const std::string allowed = "write " + wanted + ", each at most once";
    const std::string& letters = field.text(wanted);
    unsigned held = held_none;
    for (std::size_t i = 0; i < letters.size();) {
      if (letters[i] == ' ') {
        ++i;
        continue;
      }
      const Motion motion = motion_at(field, letters, i, allowed);
      if ((held & motion.bit) != 0) {
        field.refuse("the support " + quote(letters) + " names " +
                         (motion.bit < held_rx ? "axis " : "the rotation ") + motion.name + " twice",
                     allowed);
      }
      held |= motion.bit;
      i += motion.name.size();
    }
    if (held == held_none) field.refuse("the support holds nothing", allowed + ", or leave the node out");
    return static_cast<std::uint8_t>(held);
  }

  Motion motion_at(const Field& field, const std::string& letters, std::size_t i,
                   const std::string& allowed) const {
    for (const Motion& motion : motions())
      if (letters.compare(i, motion.name.size(), motion.name) == 0) return motion;
    if (letters[i] == 'r' && !root_.find("beams")) {
      field.refuse("the support " + quote(letters) + " holds a rotation in a scene without beams",
                   allowed + ", or add \"beams\"");
    }
    field.refuse(
        quote(letters) + " is not a support in a scene of dimension " + std::to_string(scene_.dimension),
        allowed);
  }

  // A node has rotations only where the end of a beam turns with it.
  void require_held_rotations_to_be_there(const Field& field) const {
    for (const auto& [name, held] : field.members("an object that gives node names their supports")) {
      const int index = node(held, name);
      if (scene_.nodes[static_cast<std::size_t>(index)].held < held_rx || turns(index)) continue;
      held.refuse("no beam turns with node " + quote(name) + ", so it has no rotation to hold",
                  "leave the rotation out, or let a beam without a hinge end here");
    }
  }
  bool turns(int index) const {
    for (const BeamDescription& beam : scene_.beams)
      for (const int each : beam.nodes)
        if (each == index && !beam.has_hinge(index)) return true;
    return false;
  }

  void read_struts(const Field& field) {
    for (const Field& item : field.elements("a list of struts")) {
      item.require_keys(strut_keys, "a strut: { \"nodes\": [..., ...], \"E\": ..., \"A\": ... }");
      const Field nodes = item.at("nodes");
      const auto names = nodes.elements("a list of two node names");
      if (names.size() != 2) {
        nodes.refuse("a strut between " + counted(names.size(), "node"), "write a list of two node names");
      }
      StrutDescription strut;
      for (std::size_t i = 0; i < 2; ++i) strut.nodes[i] = node(names[i]);
      strut.E = item.at("E").amount("Young's modulus [N/m2] as a number");
      strut.A = item.at("A").amount("the cross-section [m2] as a number");
      scene_.struts.push_back(strut);
    }
  }

  void read_beams(const Field& field) {
    const bool in_space = scene_.dimension == 3;
    for (const Field& item : field.elements("a list of beams")) {
      item.require_keys(in_space ? space_beam_keys : plane_beam_keys,
                        in_space ? "a beam: { \"nodes\": [...], \"E\": ..., \"A\": ..., \"Iy\": ..., "
                                   "\"Iz\": ..., \"J\": ..., \"up\": [...] }"
                                 : "a beam: { \"nodes\": [...], \"E\": ..., \"A\": ..., \"I\": ... }");
      BeamDescription beam;
      const Field nodes = item.at("nodes");
      for (const Field& name : nodes.elements("a list of node names")) {
        beam.nodes.push_back(node(name));
        // A beam may close a ring, but not go back where it came from.
        const std::size_t count = beam.nodes.size();
        if (count > 2 && beam.nodes[count - 1] == beam.nodes[count - 3])
          name.refuse("the beam goes back to node " + quote(name.text("")) + " over the same member",
                      "write every member once");
      }
      if (beam.nodes.size() < 2) {
        nodes.refuse("the beam has " + counted(beam.nodes.size(), "node"), "write at least 2");
      }
      beam.E = item.at("E").amount("Young's modulus [N/m2] as a number");
      beam.A = item.at("A").amount("the cross-section [m2] as a number");
      if (in_space)
        read_section_in_space(item, beam);
      else
        beam.I = item.at("I").amount("the second moment of area [m4] as a number");
      if (const auto hinges = item.find("hinges")) read_hinges(*hinges, beam);
      scene_.beams.push_back(std::move(beam));
    }
  }

  void read_section_in_space(const Field& item, BeamDescription& beam) const {
    constexpr double usual_ratio = 2.6;  // E / G of steel, with a Poisson's ratio of 0.3
    beam.Iy = item.at("Iy").amount("the second moment of area about y [m4] as a number");
    beam.Iz = item.at("Iz").amount("the second moment of area about z [m4] as a number");
    beam.J = item.at("J").amount("the torsion constant [m4] as a number");
    const auto G = item.find("G");
    beam.G = G ? G->amount("the shear modulus [N/m2] as a number") : beam.E / usual_ratio;
    if (const auto up = item.find("up")) beam.up = read_vector(*up, "any unit");
  }

  void read_hinges(const Field& field, BeamDescription& beam) const {
    for (const Field& name : field.elements("a list of names of its nodes")) {
      const int hinge = node(name);
      if (std::find(beam.nodes.begin(), beam.nodes.end(), hinge) == beam.nodes.end())
        name.refuse("node " + quote(name.text("")) + " is not on this beam", "name nodes of this beam");
      if (beam.has_hinge(hinge))
        name.refuse("node " + quote(name.text("")) + " comes twice", "name every hinge once");
      beam.hinges.push_back(hinge);
    }
  }

  // Cables and loads name columns of CSV files.
  static void require_column_name(const Field& field, const std::string& name, const std::string& noun) {
    const auto breaks = [](char c) {
      return c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    };
    if (name.empty())
      field.refuse("the " + noun + " has an empty name", "give it a name: it heads columns of CSV files");
    if (std::any_of(name.begin(), name.end(), breaks)) {
      field.refuse("the name " + quote(name) + " would break the header of a CSV file",
                   "leave commas, quotes and control characters out of the name of a " + noun);
    }
    if (name.front() == ' ' || name.back() == ' ') {
      field.refuse("the name " + quote(name) + " begins or ends with a blank", "remove the blank");
    }
  }

  void read_cables(const Field& field) {
    for (const Field& item : field.elements("a list of cables")) {
      item.require_keys(cable_keys,
                        "a cable: { \"name\": ..., \"path\": [...], \"E\": ..., \"A\": ..., ... }");
      CableDescription cable;
      read_cable_name(item.at("name"), cable);
      if (const auto closed = item.find("closed")) cable.closed = closed->boolean("true or false");
      read_path(item.at("path"), cable);
      cable.E = item.at("E").amount("Young's modulus [N/m2] as a number");
      cable.A = item.at("A").amount("the cross-section [m2] as a number");
      for (std::size_t end = 0; end < 2; ++end) read_end(item, end, cable);
      cable.mu.assign(cable.joints(), 0);
      if (const auto friction = item.find("friction")) read_friction(*friction, cable);
      cable.prestrain.assign(cable.segments(), 0);
      if (const auto prestrain = item.find("prestrain")) {
        cable.prestrain = one_or_each(*prestrain, cable.segments(), "segment");
        cable.prestrain_is_list = prestrain->is_array();
      }
      if (const auto alpha = item.find("alpha"))
        cable.alpha = alpha->number("the thermal expansion [1/K] as a number");
      if (const auto seating = item.find("seating")) {
        cable.seating = seating->number("the wedge draw-in [m] as a number");
      }
      if (const auto sd = item.find("E_sd")) cable.E_sd = deviation(*sd, "of E A, relative, as a number");
      if (const auto sd = item.find("seating_sd"))
        cable.seating_sd = deviation(*sd, "of the seating [m] as a number");
      if (const auto sd = item.find("temperature_sd"))
        cable.temperature_sd = deviation(*sd, "of the temperature [K] as a number");
      cable.force.resize(cable.segments());
      scene_.cables.push_back(std::move(cable));
    }
  }

  void read_cable_name(const Field& field, CableDescription& cable) {
    cable.name = field.text("the name of the cable as a string");
    require_column_name(field, cable.name, "cable");
    if (!cable_index_.emplace(cable.name, static_cast<int>(scene_.cables.size())).second) {
      field.refuse("there are two cables " + quote(cable.name), "give every cable its own name");
    }
  }

  void read_path(const Field& field, CableDescription& cable) const {
    for (const Field& name : field.elements("a list of node names")) cable.path.push_back(node(name));
    if (cable.closed && cable.path.size() > 1 && cable.path.front() == cable.path.back()) {
      field.refuse("the path of a closed cable ends with its first node",
                   "leave out the last: it closes by itself");
    }
    const std::size_t least = cable.closed ? 3 : 2;
    if (cable.path.size() < least) {
      field.refuse("the path has " + counted(cable.path.size(), "node"),
                   "write at least " + std::to_string(least) + " for " +
                       (cable.closed ? "a closed" : "an open") + " cable");
    }
  }

  static void read_end(const Field& item, std::size_t end, CableDescription& cable) {
    const std::string key = end_name(end);
    const auto field = item.find(end_name(end));
    const std::string allowed = "\"anchored\" or \"jacked\"";
    if (cable.closed) {
      if (field) field->refuse("a closed cable has no " + key, "remove the key " + quote(key));
      return;
    }
    if (!field) item.refuse("the key " + quote(key) + " is missing", "add " + quote(key) + ": " + allowed);
    const std::string& kind = field->text(allowed);
    if (kind != "anchored" && kind != "jacked") {
      field->refuse("an end cannot be " + quote(kind), "write " + allowed);
    }
    cable.ends[end] = kind == "jacked" ? End::jacked : End::anchored;
  }

  static void read_friction(const Field& field, CableDescription& cable) {
    field.require_keys(friction_keys, "a friction law: { \"law\": \"point\", \"mu\": ... }");
    const Field law_field = field.at("law");
    const std::string& law = law_field.text("\"point\" or \"capstan\"");
    if (law != "point" && law != "capstan") {
      law_field.refuse("there is no friction law " + quote(law), "write \"point\" or \"capstan\"");
    }
    cable.law = law == "point" ? FrictionLaw::point : FrictionLaw::capstan;
    const Field mu = field.at("mu");
    cable.mu = one_or_each(mu, cable.joints(), "joint");
    cable.mu_is_list = mu.is_array();
    if (const auto wobble = field.find("wobble")) {
      cable.wobble = wobble->number("the wobble [rad/m] as a number");
      if (cable.law == FrictionLaw::point) {
        wobble->refuse("a point contact has no wobble", "remove it, or set \"law\" to \"capstan\"");
      }
    }
    if (const auto sd = field.find("mu_sd")) {
      cable.mu_sd = sd->amount("the standard deviation of mu as a number");
      cable.has_mu_sd = true;
    }
    if (const auto shared = field.find("shared")) cable.shared_mu = shared->boolean("true or false");
    if (const auto scatter = field.find("scatter")) {
      cable.scatter = deviation(*scatter, "of mu from joint to joint, relative, as a number");
      cable.has_scatter = true;
    }
    if (const auto drift = field.find("drift")) cable.drift = drift->number("the drift of mu as a number");
  }

  static double deviation(const Field& field, const std::string& of) {
    const double sd = field.amount("the standard deviation " + of);
    if (!(sd >= 0)) field.refuse("a standard deviation of " + plain(sd), "write zero or more");
    return sd;
  }

  // One number for all, or a list with one for each.
  static std::vector<double> one_or_each(const Field& field, std::size_t count, const std::string& noun) {
    const std::string wanted = "one number, or a list of " + counted(count, "number") + ": one a " + noun;
    if (field.is_number()) return std::vector<double>(count, field.number(wanted));
    const auto items = field.elements(wanted);
    if (items.size() != count) {
      field.refuse("the list has " + counted(items.size(), "number") + " for " + counted(count, noun),
                   "write " + wanted);
    }
    std::vector<double> numbers;
    for (const Field& item : items) numbers.push_back(item.number("a number"));
    return numbers;
  }

  void read_substructures(const Field& field) {
    for (const Field& item : field.elements("a list of substructures")) {
      item.require_keys(substructure_keys,
                        "a substructure: { \"name\": ..., \"nodes\": [...], \"stiffness\": [[...], ...] }");
      SubstructureDescription substructure;
      const Field name = item.at("name");
      substructure.name = name.text("the name of the substructure as a string");
      if (substructure.name.empty()) name.refuse("the substructure has an empty name", "give it a name");
      const Field nodes = item.at("nodes");
      for (const Field& each : nodes.elements("a list of node names"))
        substructure.nodes.push_back(node(each));
      if (substructure.nodes.empty()) nodes.refuse("the substructure has no nodes", "name at least one");
      read_stiffness(item.at("stiffness"), substructure.nodes.size(), substructure.stiffness);
      if (const auto geometric = item.find("geometric_stiffness")) {
        read_stiffness(*geometric, substructure.nodes.size(), substructure.geometric_stiffness);
        require_symmetric(*geometric, substructure.geometric_stiffness);
      }
      scene_.substructures.push_back(std::move(substructure));
    }
  }

  void read_stiffness(const Field& field, std::size_t nodes, std::vector<double>& stiffness) const {
    const std::size_t size = nodes * dimension();
    const std::string shape =
        counted(size, "row") + " of " + counted(size, "number") + " [N/m] for " + counted(nodes, "node");
    const auto rows = field.elements(shape);
    if (rows.size() != size) field.refuse("the matrix has " + counted(rows.size(), "row"), "write " + shape);
    for (const Field& row : rows) {
      const auto entries = row.elements("a row of " + counted(size, "number") + " [N/m]");
      if (entries.size() != size)
        row.refuse("the row has " + counted(entries.size(), "number"), "write " + shape);
      for (const Field& entry : entries) stiffness.push_back(entry.number("a number [N/m]"));
    }
  }
  // The core looks at the stiffness itself, and never at its geometric part.
  static void require_symmetric(const Field& field, const std::vector<double>& matrix) {
    const auto size = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(matrix.size()))));
    double most = 0;
    for (const double entry : matrix) most = std::fmax(most, std::fabs(entry));
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (std::fabs(matrix[i * size + k] - matrix[k * size + i]) > 1e-9 * most)
          field.refuse("the matrix is not symmetric: row " + std::to_string(i + 1) + ", number " +
                           std::to_string(k + 1) + " differs from row " + std::to_string(k + 1) +
                           ", number " + std::to_string(i + 1),
                       "write the same number in both places");
  }

  void read_second_order(const Field& field) {
    field.require_keys(second_order_keys, "second-order theory: { \"target\": { ... } }");
    const Field target = field.at("target");
    target.require_keys(target_keys, "a target: { \"loads\": { ... }, \"forces\": { ... } }");
    TargetDescription described;
    described.factor.assign(scene_.loads.size(), 0);
    described.force.assign(scene_.cables.size(), {0, 0});
    if (const auto loads = target.find("loads"))
      for (const auto& [name, factor] : loads->members("an object that gives load patterns their factors"))
        described.factor[static_cast<std::size_t>(load(factor, name))] =
            factor.number("a factor as a number");
    if (const auto forces = target.find("forces"))
      for (const auto& [name, force] : forces->members("an object that gives jacks their forces [N]")) {
        const auto [c, end] = jack(force, name);
        const double newton = force.number("a force [N] as a number");
        if (newton < 0) force.refuse("a jack force of " + plain(newton) + " N", "write zero or more");
        described.force[c][end] = newton;
      }
    scene_.second_order = std::move(described);
  }
  // The jack whose column of the log has this name.
  std::pair<std::size_t, std::size_t> jack(const Field& field, const std::string& name) const {
    std::vector<std::string> known;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end) {
        if (!scene_.cables[c].is_jacked(end)) continue;
        known.push_back(scene_.cables[c].name + "." + end_name(end));
        if (known.back() == name) return {c, end};
      }
    field.refuse("there is no jack " + quote(name), suggestion(name, known, "the jacks are"));
  }

  void read_loads(const Field& field) {
    LogColumns reserved(scene_);
    for (const auto& [name, item] : field.members("an object that gives every load pattern a name")) {
      require_column_name(item, name, "load pattern");
      if (reserved.find(name) != nullptr) {
        item.refuse("the name " + quote(name) + " already heads another column of the log",
                    "give the load pattern another name");
      }
      item.require_keys(load_keys, "a load pattern: { \"forces\": { ... }, \"temperature\": { ... } }");
      LoadDescription load;
      load.name = name;
      if (const auto forces = item.find("forces")) read_forces(*forces, load);
      if (const auto temperature = item.find("temperature")) read_temperature(*temperature, load);
      load_index_.emplace(name, static_cast<int>(scene_.loads.size()));
      scene_.loads.push_back(std::move(load));
    }
  }

  void read_forces(const Field& field, LoadDescription& load) const {
    for (const auto& [name, force] : field.members("an object that gives node names their forces [N]")) {
      const int index = node(force, name);
      load.forces.push_back({index, read_vector(force, "N")});
    }
  }

  void read_temperature(const Field& field, LoadDescription& load) const {
    for (const auto& [name, kelvin] :
         field.members("an object that gives cable names their temperatures [K]")) {
      const int index = cable(kelvin, name);
      load.temperatures.push_back({index, kelvin.number("a temperature change [K] as a number")});
    }
  }

  Field root_;
  SceneDescription scene_;
  NameIndex node_index_, cable_index_, load_index_;
};

}  // namespace

SceneDescription read_scene(std::string_view text, const std::string& file) {
  const JsonValue tree = parse_json(text, file);
  return SceneReader(Field(tree, "", file), file).read();
}

SceneDescription read_scene_file(const std::string& path) {
  return read_scene(read_text(path, largest_json_file, "scene file"), path);
}

}  // namespace taut::host
