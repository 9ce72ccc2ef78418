// The benches that most tests use, compiled once for all of them.
#pragma once

#include "support/bench.hpp"
#include "support/scenes.hpp"

extern template class support::Bench<double, support::Plane>;
extern template class support::Bench<float, support::Plane>;
extern template class support::Bench<double, support::Space>;
extern template class support::Bench<float, support::Space>;
