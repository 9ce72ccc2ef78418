#include "host/jacking/page.hpp"

#include <functional>

#include "lib/report/chart.hpp"
#include "lib/report/html.hpp"
#include "lib/report/number_text.hpp"
#include "lib/report/page_style.hpp"

namespace monitor::host {
namespace {

using taut::host::Axis;
using taut::host::Chart;
using taut::host::CurvePoints;
using taut::host::element;
using taut::host::escaped;
using taut::host::fixed;
using taut::host::Range;

constexpr double band_width = 1.96;

// Curves of one quantity, drawn alike wherever they are.
struct Lines {
  CurvePoints truth, estimate, lower, upper, nominal;

  void add(double x, const Compared& value) {
    truth.push_back({x, value.truth});
    estimate.push_back({x, value.estimate});
    lower.push_back({x, value.estimate - band_width * value.deviation});
    upper.push_back({x, value.estimate + band_width * value.deviation});
    nominal.push_back({x, value.nominal});
  }
  Range range() const {
    Range range;
    for (const CurvePoints* points : {&truth, &lower, &upper, &nominal})
      for (const auto& point : *points) range.include(point.y);
    return range;
  }
  void draw(Chart& chart) const {
    chart.band("band", lower, upper);
    chart.curve("nominal", nominal, "as told: mu 0.12, exact cells");
    chart.curve("estimate", estimate, "estimate");
    chart.curve("line-3", truth, "true");
    chart.explain("line-3", "true");
    chart.explain("estimate", "estimate");
    chart.explain("band", "95 % band");
    chart.explain("nominal", "as told: mu 0.12, exact cells");
  }
};

std::string over_time(const std::vector<RecordedRow>& rows, const std::string& title, const std::string& unit,
                      const std::function<Compared(const RecordedRow&)>& value) {
  Lines lines;
  Range time;
  for (const RecordedRow& row : rows) {
    time.include(row.time);
    lines.add(row.time, value(row));
  }
  Chart chart(Axis::exact(time, 8), Axis::round(lines.range(), 6));
  lines.draw(chart);
  return taut::host::heading(title) + chart.figure(title, "time [s]", unit);
}

std::string along(const RecordedRow& row) {
  const std::string title = "Along the tendon at the end";
  Lines lines;
  for (std::size_t i = 0; i < row.segment.size(); ++i)
    for (const double x : {0.5, 1.5}) lines.add(static_cast<double>(i) + x, row.segment[i]);
  Chart chart(Axis::counted(row.segment.size(), 16), Axis::round(lines.range(), 6));
  lines.draw(chart);
  return taut::host::heading(title) +
         chart.figure(title, "segment, from the anchor to the jack", "force [kN]");
}

std::string final_values(const RecordedRow& row) {
  const auto line = [](const char* kind, const std::vector<std::string>& texts) {
    std::string cells;
    for (const std::string& text : texts) cells += element(kind, {{"class", "number"}}, escaped(text));
    return element("tr", {}, cells);
  };
  std::string lines = line("th", {"segment", "true [kN]", "estimate [kN]", "95 % [kN]", "off", "as told"});
  for (std::size_t i = 0; i < row.segment.size(); ++i) {
    const Compared& value = row.segment[i];
    const auto off = [&](double force) { return fixed(100 * (force / value.truth - 1), 2) + " %"; };
    lines +=
        line("td", {std::to_string(i + 1), fixed(value.truth, 0), fixed(value.estimate, 0),
                    "± " + fixed(band_width * value.deviation, 0), off(value.estimate), off(value.nominal)});
  }
  return element("div", {{"class", "wide"}}, element("table", {}, lines));
}

}  // namespace

std::string jacking_page(const std::string& title, const std::vector<std::string>& summary,
                         const std::vector<RecordedRow>& rows, std::size_t shown) {
  std::string body = element("h1", {}, escaped(title));
  for (const std::string& text : summary) body += taut::host::paragraph("summary", escaped(text));
  body += along(rows.back()) + final_values(rows.back());
  const std::string segment = "Segment " + std::to_string(shown + 1);
  body += over_time(rows, segment + ", where nothing is read", "force [kN]",
                    [shown](const RecordedRow& row) { return row.segment[shown]; });
  body +=
      over_time(rows, segment + ", less its true force", "difference [kN]", [shown](const RecordedRow& row) {
        const auto [truth, estimate, deviation, nominal] = row.segment[shown];
        return Compared{0, estimate - truth, deviation, nominal - truth};
      });
  body += over_time(rows, "Friction", "mu", [](const RecordedRow& row) { return row.mu; });
  const auto head = taut::host::void_element("meta", {{"charset", "utf-8"}}) +
                    taut::host::void_element(
                        "meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}) +
                    element("title", {}, escaped(title)) + element("style", {}, taut::host::page_style);
  return "<!DOCTYPE html>\n" +
         element("html", {{"lang", "en"}}, element("head", {}, head) + element("body", {}, body)) + "\n";
}

}  // namespace monitor::host
