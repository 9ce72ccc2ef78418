#include "lib/report/report_charts.hpp"

#include <algorithm>

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
  Chart chart(Axis::counted(force.size(), 16), Axis::round(range, 6));
  chart.band("band", steps(lower), steps(upper));
  chart.explain("band", "95 % band");
  chart.curve("estimate", steps(force), "estimate");
  chart.explain("estimate", "estimate");
  if (!predicted.empty()) {
    chart.curve("nominal", steps(predicted), "predicted with the friction of the scene");
    chart.explain("nominal", "predicted with the friction of the scene");
  }
  bool measured = false;
  for (std::size_t e = 0; e < 2; ++e) {
    const LastReading& reading = view.record.read[c][e];
    if (!reading.given) continue;
    const double at = e == 0 ? 1 : static_cast<double>(force.size());
    chart.mark("measured", {at, view.unit.of(reading.force)},
               "load cell " + cable.name + "." + end_name(e) + ": " + view.unit.text(reading.force) + " at " +
                   view.time_text(reading.time) + " s");
    measured = true;
  }
  if (measured) chart.explain("measured", "last reading of a load cell");
  return chart.figure("Force in the segments of cable " + cable.name + " " + view.at_end(), "segment",
                      std::string("force [") + view.unit.name + "]");
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
      chart.curve("other", in_unit(view, view.record.tension[first + i]), segment_name(view.scene, cable, i));
  for (std::size_t e = 0; e < 2; ++e) {
    if (view.record.cell[c][e].empty()) continue;
    const char* look = e == 0 ? "reading first" : "reading";
    const std::string name =
        cable.name + "." + end_name(e) + (cable.is_jacked(e) ? ", jack load" : ", load cell");
    chart.curve(look, in_unit(view, view.record.cell[c][e]), name);
    chart.explain(look, name);
  }
  for (std::size_t k = 0; k < few.size(); ++k) {
    const std::string name = segment_name(view.scene, cable, few[k]);
    chart.curve(line_look(k), in_unit(view, view.record.tension[first + few[k]]), name);
    chart.explain(line_look(k), name);
  }
  if (few.size() < cable.segments()) chart.explain("other", "other segments");
  if (mark_alarms(view, chart)) chart.explain("alarm", "alarms, see the table");
  return chart.figure("Force in the segments of cable " + cable.name + " over time", view.time_title,
                      std::string("force [") + view.unit.name + "]");
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
      chart.curve("other", view.record.mu[first + j].points(), "joint " + std::to_string(j + 1));
  if (!cable.mu_is_list) {
    chart.curve("prior", {{view.time.low, cable.mu[0]}, {view.time.high, cable.mu[0]}}, "mu of the scene");
    chart.explain("prior", "mu of the scene");
  }
  for (std::size_t k = 0; k < few.size(); ++k) {
    const std::string name = is_one ? (joints == 1 ? "the joint" : "all joints")
                                    : "joint " + std::to_string(few[k] + 1) + " (" +
                                          node_name(view.scene, joint_node(cable, few[k])) + ")";
    chart.curve(line_look(k), view.record.mu[first + few[k]].points(), name);
    chart.explain(line_look(k), name + ", with its 95 % band");
  }
  if (!is_one && few.size() < joints) chart.explain("other", "other joints");
  return chart.figure("Friction coefficient of cable " + cable.name + " over time", view.time_title,
                      "mu [-]");
}
}  // namespace taut::host
