#include "estimation/site.hpp"

template class estimation::Site<float>;
template class estimation::Site<double>;
