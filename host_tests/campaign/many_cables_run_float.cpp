#include "campaign/many_cables_run.hpp"

template class support::Run<float, campaign::PlaneWeb>;
template class support::Run<float, campaign::SpaceWeb>;
