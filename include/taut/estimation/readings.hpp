// What a site reads off its instruments at one instant.
#pragma once

#include <array>

#include "taut/scene/sample.hpp"

namespace taut {

/// One end of a cable. What is not read stays false.
template <class Scalar>
struct EndReading {
  bool has_force = false;   ///< a new reading of the load cell
  bool has_stroke = false;  ///< a new reading of the extension
  /// [N]; at an unlocked jack it drives the model, at an anchored end it is measured. At a locked end it is
  /// that of a jack put back on it, and tells when the wedge is free.
  Scalar force = 0;
  Scalar stroke = 0;  ///< extension of a jacked end since the start [m]
};

/// A row of readings. The load factors and locks of `sample` hold; its jack forces have no meaning.
template <class Scalar, class Cap>
struct Readings {
  Sample<Scalar, Cap> sample;
  FixedArray<std::array<EndReading<Scalar>, 2>, Cap::cables> ends;
  /// Time since the row before [s], > 0. Zero in a call that goes on with a row, see Estimator::advance();
  /// readings that come with it count as far apart as those of the row before.
  Scalar dt = 1;
};

}  // namespace taut
