#include "support/run.hpp"

namespace support {

template Condense<double, Plane> condense<double, Plane>;
template Condense<float, Plane> condense<float, Plane>;
template Condense<double, Space> condense<double, Space>;
template Condense<float, Space> condense<float, Space>;
template Condense<double, Saddles> condense<double, Saddles>;
template Condense<float, Saddles> condense<float, Saddles>;

template class Run<double, Plane>;
template class Run<float, Plane>;
template class Run<double, Space>;
template class Run<float, Space>;
template class Run<double, Saddles>;
template class Run<float, Saddles>;

}  // namespace support

template class taut::Tracker<taut::Condensed<double, support::PlaneCapacity>>;
