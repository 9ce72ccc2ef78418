// The object `plan` of answer.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lib/live/plan_now.hpp"

namespace taut::host {

nlohmann::ordered_json plan_json(const PlanNow& now);

}  // namespace taut::host
