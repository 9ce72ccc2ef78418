// The source that compiles load filters and trackers, those of estimators and one by itself.
#include "apart.hpp"

template class taut::LoadFilter<float>;
template class taut::Tracker<taut::Condensed<float, saddles::Capacity>, saddles::unknowns>;
template class taut::Tracker<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns>;
template class taut::Tracker<taut::Condensed<float, saddles::Capacity>>;
