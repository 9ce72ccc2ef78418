#include "lib/live/plan_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/files/deserved_digits.hpp"

namespace taut::host {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return rounded(value, computed_digits); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

}  // namespace

Json plan_json(const PlanNow& now) {
  Json json = Json::object();
  json["stages"] = Json::array();
  for (std::size_t s = 0; s < now.stages.size(); ++s) {
    const PlanStageNow& stage = now.stages[s];
    Json jacks = Json::object();
    for (const std::size_t k : stage.jacks)
      jacks[now.jacks[k]] = {{"force", stage.locks ? Json(nullptr) : number(stage.force[k])},
                             {"stroke", number(stage.stroke[k])}};
    json["stages"].push_back({{"name", stage.name},
                              {"say", stage_text(now, s)},
                              {"jacks", std::move(jacks)},
                              {"state", stage.skipped      ? "skipped"
                                        : stage.passed     ? "passed"
                                        : s == now.present ? "present"
                                                           : "to come"}});
  }
  json["stage"] = now.present;
  json["order"] = now.order();
  json["say"] = now.say;
  json["jacks"] = Json::object();
  for (const PlanOrder& each : now.orders)
    json["jacks"][now.jacks[each.jack]] = {
        {"order", order_word(each.order)},
        {"to", each.order == JackOrder::lock ? Json(nullptr) : number(each.to)},
        {"to_go", each.order == JackOrder::lock ? Json(nullptr) : number(each.to_go)},
        {"gauge_to", number(each.gauge_to)},
        {"gauge_to_go", number(each.gauge_to_go)}};
  json["error"] = number(now.error);
  json["expected"] = number(now.expected);
  json["at_95"] = number(now.at_95);
  json["planning"] = now.is_planning;
  json["anew"] = Json::array();
  for (const PlanAnew& anew : now.anew)
    json["anew"].push_back({{"time", rounded(anew.time, time_digits)}, {"say", anew_text(anew)}});
  return json;
}

}  // namespace taut::host
