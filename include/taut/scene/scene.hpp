// What is modelled: nodes, struts, beams, cables with friction joints, substructures and load patterns.
#pragma once

#include <array>
#include <cstdint>

#include "taut/numerics/fixed_list.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/scene/load_cell.hpp"

namespace taut {

/// Bits of Node::held: a set bit holds the displacement along that axis at zero, or the rotation about it. In
/// the plane there is one rotation, held_r, about z.
enum Axis : std::uint8_t {
  held_none = 0,
  held_x = 1,
  held_y = 2,
  held_z = 4,
  held_xy = 3,
  held_xyz = 7,
  held_rx = 8,
  held_ry = 16,
  held_rz = 32,
  held_r = held_rz,
};

/// A point of the structure.
template <class Scalar, int Dimension>
struct Node {
  std::array<Scalar, static_cast<std::size_t>(Dimension)> at{};  ///< coordinates [m]
  std::uint8_t held = held_none;                                 ///< supports, see Axis

  constexpr bool is_held(int axis) const { return (held >> axis & 1) != 0; }
  /// Rotation `i` of those that there are: one in the plane, in space about x, y and z.
  constexpr bool is_rotation_held(int i) const { return (held >> (Dimension == 2 ? 5 : 3 + i) & 1) != 0; }
};

/// How many rotations a node has.
template <int Dimension>
constexpr int rotations_of_node = Dimension == 2 ? 1 : 3;

/// A pin-ended bar between two nodes, in tension or compression.
template <class Scalar>
struct Strut {
  std::array<int, 2> nodes{};
  Scalar E = 0;  ///< Young's modulus [N/m2]
  Scalar A = 0;  ///< cross-section [m2]
};

/// Stiffness of a beam of the plane.
template <class Scalar, int Dimension>
struct BeamSection {
  Scalar E = 0;  ///< Young's modulus [N/m2]
  Scalar A = 0;  ///< cross-section [m2]
  Scalar I = 0;  ///< second moment of area [m4]
};
/// Stiffness of a beam in space. Its own axes: x from the first to the second node, z in the plane of x and
/// `up`, y square to both.
template <class Scalar>
struct BeamSection<Scalar, 3> {
  Scalar E = 0;   ///< Young's modulus [N/m2]
  Scalar A = 0;   ///< cross-section [m2]
  Scalar Iy = 0;  ///< second moment of area about y, for deflections along z [m4]
  Scalar Iz = 0;  ///< about z, for deflections along y [m4]
  Scalar J = 0;   ///< torsion constant [m4]
  Scalar G = 0;   ///< shear modulus [N/m2]
  std::array<Scalar, 3> up{0, 0, 1};
};

/// An Euler-Bernoulli member between two nodes, straight and without shear deformation. Beams that share a
/// node are rigid there; a hinged end carries no moment, in space neither bending nor torsion.
template <class Scalar, int Dimension>
struct Beam {
  std::array<int, 2> nodes{};
  BeamSection<Scalar, Dimension> section;
  std::array<bool, 2> hinged{};  ///< at its first and second node
};

/// The beams of a scene.
template <class Scalar, int Dimension, int Capacity>
struct BeamList {
  FixedList<Beam<Scalar, Dimension>, Capacity> beams;
};
/// Where a scene can have none, there is not even room for their number.
template <class Scalar, int Dimension>
struct BeamList<Scalar, Dimension, 0> {
  static constexpr FixedList<Beam<Scalar, Dimension>, 0> beams{};
};

enum class End : std::uint8_t { anchored, jacked };

/// How the largest friction follows from the contact.
enum class FrictionLaw : std::uint8_t {
  point,    ///< one point of contact: |f| <= mu N
  capstan,  ///< a saddle or duct: T_big / T_small <= exp(mu (beta + k s)); EN 1992-1-1 (5.45)
};

/// Where a cable lies in the scene's numbering, and what happens at its ends: all that a running controller
/// needs.
template <class Scalar>
struct CableLayout {
  bool closed = false;                                    ///< the path returns to its first node
  std::array<End, 2> ends{End::anchored, End::anchored};  ///< start and end; without meaning if closed
  Scalar seating = 0;                                     ///< wedge draw-in at lock-off of a jacked end [m]
  int nodes = 0;                                          ///< how many its path has
  int first_segment = 0;                                  ///< in the scene's numbering of segments
  int first_joint = 0;                                    ///< in the scene's numbering of joints

  constexpr int segments() const { return closed ? nodes : nodes - 1; }
  constexpr int joints() const { return closed ? nodes : nodes - 2; }

  /// The segments (in the scene's numbering) before and after joint `j` of the cable.
  constexpr std::array<int, 2> joint_segments(int j) const {
    if (!closed) return {first_segment + j, first_segment + j + 1};
    return {first_segment + (j == 0 ? nodes - 1 : j - 1), first_segment + j};
  }
  /// The joints (in the scene's numbering) at the start and the end of segment `i` of the cable; -1 at a
  /// cable end.
  constexpr std::array<int, 2> segment_joints(int i) const {
    if (closed) return {first_joint + i, first_joint + (i + 1 == nodes ? 0 : i + 1)};
    return {i == 0 ? -1 : first_joint + i - 1, i + 1 == segments() ? -1 : first_joint + i};
  }
  /// The segment at the start (0) or end (1) of an open cable, in the scene's numbering.
  constexpr int end_segment(std::size_t end) const {
    return end == 0 ? first_segment : first_segment + segments() - 1;
  }
};

/// A strain [-] beyond what any cable carries: wires break at a few per cent.
constexpr double breaking_strain = 0.1;

/// A cable over a path of nodes. The inner nodes, or all nodes of a closed hoop, are friction joints.
///
/// Scene::add_cable() fills the layout but for `closed`, `ends` and `seating`.
template <class Scalar>
struct Cable : CableLayout<Scalar> {
  Scalar E = 0;  ///< Young's modulus [N/m2]
  Scalar A = 0;  ///< cross-section [m2]
  FrictionLaw law = FrictionLaw::point;
  Scalar mu = 0;              ///< friction coefficient [-] that add_cable() gives to every joint
  Scalar wobble = 0;          ///< unintended angle a length, k [rad/m], capstan only
  Scalar mu_sd = 0;           ///< standard deviation of what is known of mu beforehand [-]
  bool shared_mu = false;     ///< one mu holds for all joints
  Scalar scatter = 0;         ///< standard deviation of mu from joint to joint about that, relative [-]
  Scalar seating_sd = 0;      ///< standard deviation of the wedges' draw-in [m]
  Scalar temperature_sd = 0;  ///< of the temperature that no load pattern knows of once it is locked [K]
  Scalar prestrain = 0;       ///< given to every segment: unstressed length is (1 - prestrain) x distance
  Scalar alpha = 0;           ///< thermal expansion [1/K]
  std::array<LoadCell<Scalar>, 2> cell{};  ///< at start and end
  int first_path = 0;                      ///< of its nodes in Scene::path
};

/// A linear elastic body that is known by its stiffness matrix on a few nodes.
struct Substructure {
  int first_node = 0;   ///< of its nodes in Scene::substructure_nodes
  int nodes = 0;        ///< how many
  int first_entry = 0;  ///< of its matrix in Scene::substructure_entries, row by row
};

/// A force on a node in a load pattern [N a unit of the pattern's factor].
template <class Scalar, int Dimension>
struct NodalForce {
  int load = 0;
  int node = 0;
  std::array<Scalar, static_cast<std::size_t>(Dimension)> force{};
};

/// A temperature change of a cable in a load pattern [K a unit of the pattern's factor].
template <class Scalar>
struct Temperature {
  int load = 0;
  int cable = 0;
  Scalar kelvin = 0;
};

/// A cable-supported structure, in SI units, with storage for `Cap` inside itself.
///
/// It is filled by the add functions, at run time or as a constant expression; validate() then says
/// whether it can be used. Nodes, struts, beams, segments and joints are numbered from 0 in the order of
/// addition; the joints and segments of one cable follow one another. Joint j of an open cable (from 0) lies
/// at path node j+1, between segments j and j+1. In a closed hoop joint j is path node j, between segment j-1
/// (the last one for j = 0) and segment j.
template <class Scalar_, int Dimension, class Cap>
struct Scene : BeamList<Scalar_, Dimension, Cap::beams> {
  static_assert(Dimension == 2 || Dimension == 3, "a scene is plane or spatial");
  using Scalar = Scalar_;
  using Capacity = Cap;
  static constexpr int dimension = Dimension;
  using Point = std::array<Scalar, static_cast<std::size_t>(Dimension)>;

  FixedList<Node<Scalar, Dimension>, Cap::nodes> nodes;
  FixedList<Strut<Scalar>, Cap::struts> struts;
  FixedList<Cable<Scalar>, Cap::cables> cables;
  FixedList<int, Cap::segments + Cap::cables> path;  ///< nodes of all cables, one cable after the other
  FixedList<Scalar, Cap::segments> prestrain;        ///< of every segment [-]
  FixedList<Scalar, Cap::joints> mu;                 ///< of every joint [-]
  FixedList<Substructure, Cap::substructures> substructures;
  FixedList<int, Cap::substructure_nodes> substructure_nodes;
  FixedList<Scalar, Cap::substructure_entries> substructure_entries;  ///< [N/m]
  FixedList<NodalForce<Scalar, Dimension>, Cap::forces> forces;
  FixedList<Temperature<Scalar>, Cap::temperatures> temperatures;
  int loads = 0;         ///< number of load patterns
  int excess_loads = 0;  ///< patterns that did not fit

  /// Adds a node at `at` [m] with the given supports; returns its number, -1 if there is no room.
  constexpr int add_node(const Point& at, std::uint8_t held = held_none) { return nodes.add({at, held}); }

  /// Adds a strut; returns its number, -1 if there is no room.
  constexpr int add_strut(int from, int to, Scalar E, Scalar A) { return struts.add({{from, to}, E, A}); }

  /// Adds a beam, hinged where `hinged` says so; returns its number, -1 if there is no room. Only where the
  /// capacity has room for beams at all.
  constexpr int add_beam(int from, int to, const BeamSection<Scalar, Dimension>& section,
                         std::array<bool, 2> hinged = {}) {
    static_assert(Cap::beams > 0, "Capacity::beams says how many beams there can be");
    return this->beams.add({{from, to}, section, hinged});
  }

  /// Adds a cable over `count` nodes; `properties.mu` and `.prestrain` go to its joints and segments, where
  /// they can be changed one by one. Returns its number, -1 if there is no room.
  constexpr int add_cable(Cable<Scalar> properties, const int* over, int count) {
    properties.first_path = path.size();
    properties.first_segment = prestrain.size();
    properties.first_joint = mu.size();
    properties.nodes = count;
    for (int i = 0; i < count; ++i) path.add(over[i]);
    for (int i = 0; i < properties.segments(); ++i) prestrain.add(properties.prestrain);
    for (int i = 0; i < properties.joints(); ++i) mu.add(properties.mu);
    return cables.add(properties);
  }
  template <std::size_t Count>
  constexpr int add_cable(const Cable<Scalar>& properties, const int (&over)[Count]) {
    return add_cable(properties, over, static_cast<int>(Count));
  }

  /// Adds a substructure on `count` nodes with a symmetric stiffness matrix [N/m] of (count x Dimension)
  /// squared entries, row by row, axis by axis within a node. Returns its number, -1 if there is no room.
  constexpr int add_substructure(const int* on, int count, const Scalar* stiffness) {
    const Substructure added{substructure_nodes.size(), count, substructure_entries.size()};
    const int entries = count * Dimension * count * Dimension;
    for (int i = 0; i < count; ++i) substructure_nodes.add(on[i]);
    for (int i = 0; i < entries; ++i) substructure_entries.add(stiffness[i]);
    return substructures.add(added);
  }

  /// Adds an empty load pattern; returns its number, -1 if there is no room.
  constexpr int add_load() {
    if (loads == Cap::loads) {
      ++excess_loads;
      return -1;
    }
    return loads++;
  }
  /// Adds a force on a node to a load pattern [N a unit factor].
  constexpr int add_force(int load, int node, const Point& force) { return forces.add({load, node, force}); }
  /// Adds a temperature change of a cable to a load pattern [K a unit factor].
  constexpr int add_temperature(int load, int cable, Scalar kelvin) {
    return temperatures.add({load, cable, kelvin});
  }

  /// The node before, at and after joint `j` of a cable (both zero-based).
  struct JointNodes {
    int before, at, after;
  };
  constexpr JointNodes joint_nodes(const Cable<Scalar>& cable, int j) const {
    const int at = cable.closed ? j : j + 1;
    const int before = at == 0 ? cable.nodes - 1 : at - 1;
    const int after = at == cable.nodes - 1 ? 0 : at + 1;
    return {path[cable.first_path + before], path[cable.first_path + at], path[cable.first_path + after]};
  }

  /// The two nodes of segment `i` of a cable (both zero-based).
  constexpr std::array<int, 2> segment_nodes(const Cable<Scalar>& cable, int i) const {
    const int next = i + 1 == cable.nodes ? 0 : i + 1;
    return {path[cable.first_path + i], path[cable.first_path + next]};
  }

  /// Displacements of a node, and the rotations if there can be beams.
  static constexpr int motions_of_node = Dimension + (Cap::beams > 0 ? rotations_of_node<Dimension> : 0);

  /// Whether the end of a beam turns with a node.
  constexpr bool can_turn(int node) const {
    for (const auto& beam : this->beams)
      for (std::size_t end = 0; end < 2; ++end)
        if (beam.nodes[end] == node && !beam.hinged[end]) return true;
    return false;
  }
  /// Whether a motion of a node (displacements first, then rotations) is no unknown of the structure: held by
  /// a support, or a rotation of which nobody knows.
  constexpr bool is_fixed(int node, int motion) const {
    if constexpr (Cap::beams > 0)
      if (motion >= Dimension) return nodes[node].is_rotation_held(motion - Dimension) || !can_turn(node);
    return nodes[node].is_held(motion);
  }

  static constexpr std::array<int, 2> joint_segments(const Cable<Scalar>& cable, int j) {
    return cable.joint_segments(j);
  }
  static constexpr std::array<int, 2> segment_joints(const Cable<Scalar>& cable, int i) {
    return cable.segment_joints(i);
  }
};

}  // namespace taut
