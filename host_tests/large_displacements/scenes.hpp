// Structures as they are built, and the logs of their jackings.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "large_displacements/scene_file.hpp"

namespace large_displacements {

struct Jacking {
  Model model;
  Target target;
  std::vector<Row> rows;
};

/// Radial: along the bisector of the cable's angle; v: two bars a joint; fixed: radial, rigid in the roof
/// beam. All others are pinned at both ends.
enum class Struts { vertical, radial, v, fixed };

/// A roof beam on a pin and a roller with a cable below it from end to end, jacked at the roller.
struct BeamString {
  double span = 80;  ///< [m]
  int struts = 9;
  double mu = 0.1;
  Struts kind = Struts::radial;
  double sag = 1.0 / 12;  ///< of the span; the cable is a parabola
  double rise = 0;        ///< of the roof beam, of the span
  double slenderness =
      120;  ///< span / depth of the roof beam: at 120, 5 % more force lifts it by half a metre
  Law law = Law::point;
};
Jacking beam_string(const BeamString& given);

/// A hoop of a suspen-dome: at each node a strut that stands under the roof, and one or two rods outwards.
struct DomeHoop {
  int nodes = 16, rods = 1;
  double mu = 0.1;
  bool jacked =
      false;  ///< from node 0 all around to a jack that holds on to it; otherwise closed, with prestrain
};
Jacking dome_hoop(const DomeHoop& given);

/// Ramp to the target, `over` more, release to the target, lock-off, then the second load pattern if there is
/// one. The first load pattern grows along with the jacks.
std::vector<Row> ramp_and_lock(const Model& model, const Target& target, double over);

/// The same structures with sizes, counts, laws and friction by chance; loads scattered by 30 % a node, mu by
/// 20 % a joint, and the cable's nodes by 1 % of the distance between them, so that no strut stands as it was
/// meant to. Three of four are beam strings.
Jacking random_jacking(std::uint64_t seed);

/// The first two kinds by name, such as beam-string-80-9-radial-0.1, beam-string-80-9-d40-radial-0.1 and
/// dome-hoop-1-jacked-0.1.
std::vector<std::string> scene_names();
/// These, and random ones: random-7-radial, random-7 for short. Throws std::out_of_range.
Jacking scene_by_name(const std::string& name);

}  // namespace large_displacements
