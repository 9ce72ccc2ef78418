// What apart.cmake compiles: estimators that every source uses, one alone compiles, and another their
// trackers. With TOGETHER each source compiles what it uses.
#pragma once

#include "taut/device.hpp"

#include "beam_string.hpp"
#include "saddles.hpp"

using Linear =
    taut::Estimator<taut::Condensed<float, saddles::Capacity>, saddles::unknowns, saddles::reading_unknowns>;
using Leaning = taut::Estimator<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns,
                                beam_string::reading_unknowns>;

#ifndef TOGETHER
extern template class taut::LoadFilter<float>;
extern template class taut::Tracker<taut::Condensed<float, saddles::Capacity>, saddles::unknowns>;
extern template class taut::Tracker<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns>;
extern template class taut::Tracker<taut::Condensed<float, saddles::Capacity>>;
extern template class taut::Estimator<taut::Condensed<float, saddles::Capacity>, saddles::unknowns,
                                      saddles::reading_unknowns>;
extern template class taut::Estimator<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns,
                                      beam_string::reading_unknowns>;
#endif
