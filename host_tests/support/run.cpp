#include "support/run.hpp"

template class support::Run<double, support::Plane>;
template class support::Run<float, support::Plane>;
template class support::Run<double, support::Space>;
template class support::Run<float, support::Space>;
template class support::Run<double, support::Saddles>;
template class support::Run<float, support::Saddles>;
