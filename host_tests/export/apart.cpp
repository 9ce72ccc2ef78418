// The source that compiles the estimators; their trackers are compiled by another one.
#include "apart.hpp"

template class taut::Estimator<taut::Condensed<float, saddles::Capacity>, saddles::unknowns,
                               saddles::reading_unknowns>;
template class taut::Estimator<taut::SecondOrder<float, beam_string::Capacity>, beam_string::unknowns,
                               beam_string::reading_unknowns>;
