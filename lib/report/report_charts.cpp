#include "lib/report/report_charts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/report/chart.hpp"
#include "lib/report/names.hpp"

namespace taut::host {
namespace {

CurvePoints steps(const std::vector<double>& values) {
  CurvePoints points;
  for (std::size_t i = 0; i < values.size(); ++i) {
    points.push_back({static_cast<double>(i) + 0.5, values[i]});
    points.push_back({static_cast<double>(i) + 1.5, values[i]});
  }
  return points;
}

CurvePoints step(std::size_t i, double value) {
  return {{static_cast<double>(i) + 0.5, value}, {static_cast<double>(i) + 1.5, value}};
}

// What the segments of a cable are to have, not a number where it does not matter; none: nobody said.
std::vector<double> targets(const ReportView& view, std::size_t c) {
  const std::vector<double>& all = view.content.sheet.target;
  std::vector<double> of_cable;
  bool has_any = false;
  for (std::size_t i = 0, s = start_of(view.scene, c).segment; i < view.scene.cables[c].segments(); ++i) {
    const bool matters = s + i < all.size() && all[s + i] > 0;
    has_any = has_any || matters;
    of_cable.push_back(matters ? view.unit.of(all[s + i]) : std::nan(""));
  }
  return has_any ? of_cable : std::vector<double>();
}

struct Limits {
  std::optional<double> least, most;
};
// The goal has one limit for all segments of a cable.
Limits limits_of(const ReportView& view, std::size_t c) {
  const StressingSheet& sheet = view.content.sheet;
  Limits limits;
  if (sheet.least_force > 0) limits.least = view.unit.of(sheet.least_force);
  double most = sheet.most_force.value_or(HUGE_VAL);
  if (const std::size_t s = start_of(view.scene, c).segment; s < sheet.most_segment.size())
    most = std::min(most, sheet.most_segment[s]);
  if (most < HUGE_VAL) limits.most = view.unit.of(most);
  return limits;
}

void include(Range& range, const CurvePoints& points) {
  for (const CurvePoint& point : points) range.include(point.y);
}

// First, middle and last of so many, each once.
std::vector<std::size_t> few_of(std::size_t count) {
  std::vector<std::size_t> few;
  for (const std::size_t i : {std::size_t{0}, count / 2, count - 1})
    if (i < count && std::find(few.begin(), few.end(), i) == few.end()) few.push_back(i);
  return few;
}

bool contains(const std::vector<std::size_t>& list, std::size_t item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

std::string line_look(std::size_t i) { return "line-" + std::to_string(i + 1); }
std::string band_look(std::size_t i) { return "band-" + std::to_string(i + 1); }

bool same(const CurvePoints& a, const CurvePoints& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const CurvePoint& p, const CurvePoint& q) { return p.x == q.x && p.y == q.y; });
}

CurvePoints in_unit(const ReportView& view, const Curve& curve) {
  CurvePoints points = curve.points();
  for (CurvePoint& point : points) point.y = view.unit.of(point.y);
  return points;
}

bool mark_alarms(const ReportView& view, Chart& chart) {
  const auto& spans = view.record.alarm_spans.cells();
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const std::size_t begin = i;
    while (i + 1 < spans.size() && spans[i].any && spans[i + 1].any) ++i;
    if (spans[i].any) chart.bar_above("alarm", spans[begin].first_time, spans[i].last_time);
  }
  return view.record.alarms.count() > 0;
}

bool have_one_mu(const ReportView& view, std::size_t first, std::size_t joints) {
  for (std::size_t j = first + 1; j < first + joints; ++j)
    if (!same(view.record.mu[j].points(), view.record.mu[first].points()) ||
        !same(view.record.most_mu[j].points(), view.record.most_mu[first].points()))
      return false;
  return true;
}

}  // namespace

std::string force_chart(const ReportView& view, std::size_t c) {
  const CableDescription& cable = view.scene.cables[c];
  std::vector<double> force = view.of_cable(view.record.end.tension, c), lower = force, upper = force,
                      predicted;
  const std::vector<double> sd = view.of_cable(view.record.end.deviation, c);
  if (!view.content.nominal.tension.empty()) predicted = view.of_cable(view.content.nominal.tension, c);
  Range range;
  for (std::size_t i = 0; i < force.size(); ++i) {
    force[i] = view.unit.of(force[i]);
    lower[i] = std::max(view.unit.of(lower[i] - band_width * sd[i]), 0.0);
    upper[i] = view.unit.of(upper[i] + band_width * sd[i]);
    range.include(lower[i]);
    range.include(upper[i]);
  }
  for (double& value : predicted) range.include(value = view.unit.of(value));
  for (const LastReading& reading : view.record.read[c])
    if (reading.given) range.include(view.unit.of(reading.force));
  // Friction shows in the differences: zero is part of the chart only where it is near.
  if (range.low() < 0.4 * range.high()) range.include(0);
  const std::vector<double> target = targets(view, c);
  for (const double value : target) range.include(value);
  const Limits limits = limits_of(view, c);
  for (const auto& limit : {limits.least, limits.most})
    if (limit) range.include(*limit);
  Chart chart(Axis::counted(force.size(), 16), Axis::round(range, 6));
  chart.band("band", steps(lower), steps(upper));
  chart.explain("band", view.say("95 % band"));
  chart.curve("estimate", steps(force), view.say("estimate"));
  chart.explain("estimate", view.say("estimate"));
  if (!predicted.empty()) {
    chart.curve("nominal", steps(predicted), view.say("predicted with the friction of the scene"));
    chart.explain("nominal", view.say("predicted with the friction of the scene"));
  }
  const double right = static_cast<double>(force.size()) + 0.5;
  for (const auto& limit : {limits.least, limits.most})
    if (limit) chart.curve("limit", {{0.5, *limit}, {right, *limit}}, view.say("limit"));
  if (limits.least || limits.most) chart.explain("limit", view.say("limit"));
  for (std::size_t i = 0; i < target.size(); ++i)
    if (!std::isnan(target[i])) chart.curve("target", step(i, target[i]), view.say("target"));
  if (!target.empty()) chart.explain("target", view.say("target"));
  bool measured = false;
  for (std::size_t e = 0; e < 2; ++e) {
    const LastReading& reading = view.record.read[c][e];
    if (!reading.given) continue;
    const double at = e == 0 ? 1 : static_cast<double>(force.size());
    chart.mark("measured", {at, view.unit.of(reading.force)},
               view.say("load cell {1}: {2} at {3} s",
                        {cable.name + "." + end_name(e), view.unit.text(reading.force),
                         view.time_text(reading.time)}));
    measured = true;
  }
  if (measured) chart.explain("measured", view.say("last reading of a load cell"));
  return chart.figure(view.say("Force in the segments of cable {1} {2}", {cable.name, view.at_end()}),
                      view.say("segment"), view.say("force [{1}]", {view.unit.name}), "along",
                      start_of(view.scene, c).segment);
}

std::string time_chart(const ReportView& view, std::size_t c) {
  const CableDescription& cable = view.scene.cables[c];
  const std::size_t first = start_of(view.scene, c).segment;
  Range range;
  range.include(0);
  for (std::size_t i = 0; i < cable.segments(); ++i)
    include(range, in_unit(view, view.record.tension[first + i]));
  for (const Curve& cell : view.record.cell[c]) include(range, in_unit(view, cell));
  Chart chart(view.time, Axis::round(range, 6));
  const auto few = few_of(cable.segments());
  for (std::size_t i = 0; i < cable.segments(); ++i)
    if (!contains(few, i))
      chart.curve("other", in_unit(view, view.record.tension[first + i]),
                  segment_name(view.scene, cable, i, view.say));
  for (std::size_t e = 0; e < 2; ++e) {
    if (view.record.cell[c][e].empty()) continue;
    const char* look = e == 0 ? "reading first" : "reading";
    const std::string name =
        view.say(cable.is_jacked(e) ? "{1}, jack load" : "{1}, load cell", {cable.name + "." + end_name(e)});
    chart.curve(look, in_unit(view, view.record.cell[c][e]), name);
    chart.explain(look, name);
  }
  for (std::size_t k = 0; k < few.size(); ++k) {
    const std::string name = segment_name(view.scene, cable, few[k], view.say);
    chart.curve(line_look(k), in_unit(view, view.record.tension[first + few[k]]), name);
    chart.explain(line_look(k), name);
  }
  if (few.size() < cable.segments()) chart.explain("other", view.say("other segments"));
  if (mark_alarms(view, chart)) chart.explain("alarm", view.say("alarms, see the table"));
  return chart.figure(view.say("Force in the segments of cable {1} over time", {cable.name}), view.time_title,
                      view.say("force [{1}]", {view.unit.name}), "over-time");
}

std::string mu_chart(const ReportView& view, std::size_t c) {
  const CableDescription& cable = view.scene.cables[c];
  const std::size_t first = start_of(view.scene, c).joint, joints = cable.joints();
  const bool is_one = have_one_mu(view, first, joints);
  const std::vector<std::size_t> few = is_one ? std::vector<std::size_t>{0} : few_of(joints);
  Range range;
  for (std::size_t j = first; j < first + joints; ++j)
    for (const auto* curves : {&view.record.least_mu, &view.record.most_mu, &view.record.mu})
      if (curves == &view.record.mu || contains(few, j - first)) include(range, (*curves)[j].points());
  if (!cable.mu_is_list) range.include(cable.mu[0]);
  Chart chart(view.time, Axis::round(range, 5), 180);
  for (std::size_t k = 0; k < few.size(); ++k)
    chart.band(band_look(k), view.record.least_mu[first + few[k]].points(),
               view.record.most_mu[first + few[k]].points());
  for (std::size_t j = 0; j < joints && !is_one; ++j)
    if (!contains(few, j))
      chart.curve("other", view.record.mu[first + j].points(),
                  view.say("joint {1}", {std::to_string(j + 1)}));
  if (!cable.mu_is_list) {
    chart.curve("prior", {{view.time.low, cable.mu[0]}, {view.time.high, cable.mu[0]}},
                view.say("mu of the scene"));
    chart.explain("prior", view.say("mu of the scene"));
  }
  for (std::size_t k = 0; k < few.size(); ++k) {
    const std::string name =
        is_one ? view.say(joints == 1 ? "the joint" : "all joints")
               : view.say("joint {1} ({2})",
                          {std::to_string(few[k] + 1), node_name(view.scene, joint_node(cable, few[k]))});
    chart.curve(line_look(k), view.record.mu[first + few[k]].points(), name);
    chart.explain(line_look(k), view.say("{1}, with its 95 % band", {name}));
  }
  if (!is_one && few.size() < joints) chart.explain("other", view.say("other joints"));
  return chart.figure(view.say("Friction coefficient of cable {1} over time", {cable.name}), view.time_title,
                      "mu [-]", "over-time");
}
}  // namespace taut::host
