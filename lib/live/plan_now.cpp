#include "lib/live/plan_now.hpp"

namespace taut::host {
namespace {

std::string percent(double part) { return fixed(100 * part, 2) + " %"; }

}  // namespace

const char* order_word(JackOrder order) {
  switch (order) {
    case JackOrder::pull:
      return "pull";
    case JackOrder::let_out:
      return "let out";
    case JackOrder::lock:
      return "lock";
    case JackOrder::stop:
      break;
  }
  return "stop";
}

std::string PlanNow::order() const {
  if (is_over()) return "done";
  for (const PlanOrder& each : orders)
    if (each.order != JackOrder::stop) return order_word(each.order);
  return order_word(JackOrder::stop);
}

std::optional<double> PlanNow::mark(std::size_t jack) const {
  for (const PlanOrder& each : orders)
    if (each.jack == jack && each.order != JackOrder::lock) return each.to;
  return std::nullopt;
}

std::string anew_text(const PlanAnew& anew) {
  return "planned anew at " + coordinate(anew.time, 3) + " s: because " + anew.why;
}

std::string error_text(const PlanNow& now) {
  std::string text = "at the end " + percent(now.error) + " off target";
  if (now.expected && now.at_95)
    text += ", expected " + percent(*now.expected) + ", at 95 % " + percent(*now.at_95);
  return text;
}

std::string stage_text(const PlanNow& now, std::size_t stage) {
  const PlanStageNow& at = now.stages[stage];
  std::string text = at.locks ? "" : at.name + " ";
  for (std::size_t i = 0; i < at.jacks.size(); ++i) {
    const std::size_t k = at.jacks[i];
    double before = 0;
    for (std::size_t s = 0; s < stage; ++s)
      if (!now.stages[s].locks) before = now.stages[s].force[k];
    if (i > 0) text += "; ";
    text += at.locks ? "lock " + now.jacks[k]
                     : std::string(at.force[k] >= before ? "pull " : "let out ") + now.jacks[k] + " to " +
                           now.unit.text(at.force[k]) + ", " + fixed(1000 * at.stroke[k], 1) + " mm";
  }
  return text;
}

}  // namespace taut::host
