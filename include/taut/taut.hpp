// taut: the force in every cable segment of a cable-supported structure while it is being tensioned.
#pragma once

#include "taut/condensation/condense.hpp"
#include "taut/elements/elements.hpp"
#include "taut/estimation/bounds.hpp"
#include "taut/estimation/estimator.hpp"
#include "taut/estimation/find_knowledge.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/scene/friction.hpp"
#include "taut/scene/sample.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/validation.hpp"
#include "taut/status.hpp"
#include "taut/stepwise/stepwise.hpp"
#include "taut/tracking/tracker.hpp"
#include "taut/tracking/verify.hpp"
