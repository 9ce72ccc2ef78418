#include "unit/instances.hpp"

template class support::Bench<double, support::Plane>;
template class support::Bench<float, support::Plane>;
template class support::Bench<double, support::Space>;
template class support::Bench<float, support::Space>;
