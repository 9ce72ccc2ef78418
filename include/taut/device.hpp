// taut on a device: all that follows a scene that `taut export` wrote, in linear or second-order theory.
//
// Tracker, verify(), Estimator, UnknownPast, find_bounds() and JackPlanner, with what they are given:
// Condensed, SecondOrder, FrictionPrior, Sample, Readings, JackGoal. taut.hpp says of each when it fails and
// what it costs. It needs no Eigen, and of the C library square roots alone. What has still to be condensed
// needs taut.hpp.
//
// A static Tracker or Estimator is all zeros until start(): it lies in .bss, and takes no flash. advance()
// before start() fails with `not_started`; what returns no Status says zero then.
#pragma once

// Headers of boards define these, and the standard library does not bear it.
#pragma push_macro("abs")
#pragma push_macro("max")
#pragma push_macro("min")
#pragma push_macro("round")
#undef abs
#undef max
#undef min
#undef round

#include "taut/condensation/condensed.hpp"
#include "taut/condensation/second_order.hpp"
#include "taut/estimation/bounds.hpp"
#include "taut/estimation/estimator.hpp"
#include "taut/estimation/friction_prior.hpp"
#include "taut/estimation/gauges.hpp"
#include "taut/estimation/unknown_past.hpp"
#include "taut/planning/jack_planner.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/scene/sample.hpp"
#include "taut/status.hpp"
#include "taut/tracking/tracker.hpp"
#include "taut/tracking/verify.hpp"

#pragma pop_macro("abs")
#pragma pop_macro("max")
#pragma pop_macro("min")
#pragma pop_macro("round")
