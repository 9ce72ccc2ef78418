// What one jack is to reach, and the moves that come nearest to it.
#pragma once

#include <array>

#include "taut/numerics/fixed_list.hpp"

namespace taut {

/// The forces that the segments are to have when one jack has done with them, and the limits within which it
/// is moved. A plain value; zeros where nothing is said.
template <class Scalar, class Cap>
struct JackGoal {
  FixedArray<Scalar, Cap::segments> target;  ///< of every segment of the scene [N]; 0: does not matter
  Scalar most_force = 0;                     ///< of the jack [N]; 0: what the cable can carry
  Scalar most_tension = 0;                   ///< of every segment, at all times [N]; 0: no limit
  Scalar most_stroke = 0;                    ///< extension of the jack [m]; 0: no limit
  bool lock = false;                         ///< what counts is after lock-off, with the cable's seating
  Scalar worth_a_move = Scalar(5e-4);  ///< a move more is asked for where it brings so much of the error
};

/// What to do with a jack: none, one or two moves, then, where the goal says so, lock it off.
template <class Scalar, class Cap>
struct NextMoves {
  int count = 0;                              ///< 0: it stays where it is
  std::array<Scalar, 2> force{};              ///< of the jack at the end of every move [N]
  Scalar error = 0;                           ///< largest |T - target| / target then, Eq. (49)
  FixedArray<Scalar, Cap::segments> tension;  ///< of every segment then [N]
};

}  // namespace taut
