// How much of everything a scene can hold: one traits struct, known at compile time.
#pragma once

namespace taut {

/// Whom a tracker tells by which Route every event was decided: nobody, which costs nothing.
struct Unwatched {
  template <class Route>
  static constexpr void took(Route) {}
};

/// Whom an Estimator tells what a measurement taught it: nobody, which costs nothing.
struct Unaccounted {
  template <class Filter>
  constexpr void begin(const Filter&) {}
  template <class Source, class Filter>
  constexpr void learned(const Source&, int, const Filter&) {}
};

/// The capacities of a scene. Derive from it and override what differs:
///
///     struct Roof : taut::Capacity {
///       static constexpr int nodes = 40, struts = 90, cables = 1, segments = 12, joints = 11, loads = 2;
///     };
///
/// What is left at zero has no storage and cannot be used. Without struts, beams and substructures the
/// saddles are rigid: all nodes must be held, and nothing elastic but the cables is stored or computed.
struct Capacity {
  static constexpr int nodes = 16;
  static constexpr int struts = 0;
  static constexpr int beams = 0;  ///< members between two nodes
  static constexpr int cables = 1;
  static constexpr int jacks = -1;    ///< jacked ends of all cables together; -1: both ends of every cable
  static constexpr int segments = 8;  ///< of all cables together
  static constexpr int joints = 8;    ///< of all cables together
  static constexpr int substructures = 0;
  static constexpr int substructure_nodes = 0;    ///< of all substructures together
  static constexpr int substructure_entries = 0;  ///< stiffness matrix entries of all substructures together
  static constexpr int loads = 0;                 ///< load patterns
  static constexpr int forces = 0;                ///< nodal forces of all load patterns together
  static constexpr int temperatures = 0;          ///< cable temperatures of all load patterns together
  static constexpr int displacements = 0;  ///< that a condensed scene gives, see CondensedDisplacements
  /// Although there are struts, beams or substructures, some condensed scenes of this capacity lie on rigid
  /// saddles.
  static constexpr bool saddles = false;
  /// Second-order theory: directions across a bar, in which it leans; 1 is enough for plane scenes.
  static constexpr int normals = 2;
  static constexpr int profile = 0;  ///< entries of the structure's factor; 0: enough for any structure
  /// What no scene of this capacity has costs nothing. Who does not know leaves these as they are; a scene
  /// that has it all the same is refused by Condensation, or by Estimator::start(). `taut export` knows, and
  /// says so.
  static constexpr int spans = -1;         ///< sliding spans of all cables together; -1: as many as segments
  static constexpr bool hoops = true;      ///< closed cables
  static constexpr bool prestrain = true;  ///< segments with a prestrain
  static constexpr bool smooth = true;     ///< joints without friction
  static constexpr bool strokes = true;    ///< strokes of jacks that teach an Estimator
  static constexpr bool seating = true;    ///< wedges that are drawn in by an unknown length, to an Estimator
  static constexpr bool lags = true;       ///< instruments behind a filter, to an Estimator
  using Watch = Unwatched;  ///< another type with a static took(Route) is called at every event
  /// An object of another type is in every Estimator: begin(FrictionFilter) is called where it begins, and
  /// learned(Alarm of what was read, number of readings, FrictionFilter) after every update.
  using Account = Unaccounted;
};

/// Jacked ends that there can be.
template <class Cap>
constexpr int max_jacks = Cap::jacks < 0 ? 2 * Cap::cables : Cap::jacks;

/// Sliding spans that there can be.
template <class Cap>
constexpr int max_spans = Cap::spans < 0 ? Cap::segments : Cap::spans;

/// Whether there is one open cable without a self-locking joint.
template <class Cap>
constexpr bool is_one_span = Cap::spans == 1 && !Cap::hoops;

}  // namespace taut
