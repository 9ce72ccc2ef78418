// What the reference found, as CSV with the columns of `taut simulate` and some of its own.
#pragma once

#include <ostream>

#include "large_displacements/path.hpp"

namespace large_displacements {

/// `C.used1..`: part of the friction at a joint that is used, 1 where it slides. `node.x`: displacement.
/// `stability`: smallest eigenvalue of the tangent.
void write_header(std::ostream& out, const Model& model);
void write_row(std::ostream& out, double time, const Path& path);

/// Part of the friction limit that is used, negative where the segment in front of the joint has more
/// tension.
double friction_used(const Path& path, int cable, int joint);

}  // namespace large_displacements
