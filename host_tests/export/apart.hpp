// What apart.cmake compiles: an estimator that every source uses and one alone compiles.
#pragma once

#include "taut/device.hpp"

#include "beam_string.hpp"
#include "saddles.hpp"

using Linear =
    taut::Estimator<taut::Condensed<float, saddles::Capacity>, saddles::unknowns, saddles::reading_unknowns>;
using Leaning = taut::Estimator<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns,
                                beam_string::reading_unknowns>;

#ifndef COMPILES_IT
extern template class taut::Estimator<taut::Condensed<float, saddles::Capacity>, saddles::unknowns,
                                      saddles::reading_unknowns>;
extern template class taut::Estimator<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns,
                                      beam_string::reading_unknowns>;
#endif
