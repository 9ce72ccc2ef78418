#include "campaign/many_cables_run.hpp"

template class support::Run<double, campaign::PlaneWeb>;
template class support::Run<double, campaign::SpaceWeb>;
