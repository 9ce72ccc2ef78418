#include "estimation/site.hpp"

template class estimation::Site<float>;
template class estimation::Site<double>;
template class taut::Tracker<estimation::Site<float>::Model, estimation::most_unknowns>;
template class taut::Tracker<estimation::Site<double>::Model, estimation::most_unknowns>;
template class taut::Estimator<estimation::Site<float>::Model, estimation::most_unknowns>;
template class taut::Estimator<estimation::Site<double>::Model, estimation::most_unknowns>;
template class taut::Tracker<estimation::Site<double>::Model, estimation::most_with_cells>;
template class taut::Estimator<estimation::Site<double>::Model, estimation::most_with_cells, 4>;
