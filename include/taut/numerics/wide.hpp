// The arithmetic in which events are decided.
#pragma once

#include <type_traits>

namespace taut {

/// `double` for scenes in float, else the scalar itself.
///
/// A sample without an event is worked out in the scalar of the scene. Where a state is decided anew, sums of
/// large forces cancel and signs of small ones count: a few thousand operations, seldom, that float would get
/// wrong in one of a hundred random scenes.
template <class Scalar>
using Wide = std::conditional_t<(sizeof(Scalar) < sizeof(double)), double, Scalar>;

}  // namespace taut
