#include "lib/plan/plan_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/files/text.hpp"
#include "lib/plan/plan_table.hpp"
#include "lib/report/axis.hpp"
#include "lib/report/chart.hpp"
#include "lib/report/html.hpp"
#include "lib/report/number_text.hpp"
#include "lib/report/page_style.hpp"

namespace taut::host {
namespace {

constexpr const char* dash = "\u2013";
constexpr double mm = 1000;
constexpr const char* sheet_style = R"(
.blank{min-width:3.5rem;border-left:1px solid var(--rule);border-right:1px solid var(--rule)}
@media print{body{font-size:9.5pt;line-height:1.35}h2{margin:3mm 0 1mm}ul{margin:1mm 0}figure{margin:1mm 0}
.note,.files,.legend{font-size:8pt}table{font-size:8pt}}
)";

std::string cell(const char* look, const std::string& html) { return element("td", {{"class", look}}, html); }
std::string head_cell(const char* look, const std::string& text) {
  return element("th", {{"class", look}, {"scope", "col"}}, escaped(text));
}

// The same force over the width of every segment.
CurvePoints steps(const std::vector<double>& values, std::size_t first, std::size_t count, double unit) {
  CurvePoints points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({static_cast<double>(i) + 0.5, values[first + i] / unit});
    points.push_back({static_cast<double>(i) + 1.5, values[first + i] / unit});
  }
  return points;
}

class Sheet {
 public:
  explicit Sheet(const SheetContent& content)
      : content_(content),
        scene_(content.scene),
        goal_(content.goal),
        plan_(content.result.plan),
        unit_(ForceUnit::for_largest(largest_force())) {}

  std::string operator()() const {
    return "<!DOCTYPE html>\n" +
           element("html", {{"lang", "en"}},
                   head() + "\n" + element("body", {}, header() + stages() + along_the_cables() + forces())) +
           "\n";
  }

 private:
  double largest_force() const {
    double most = 0;
    for (const auto& stage : plan_.outcome.tension)
      for (const double force : stage) most = std::max(most, force);
    return most;
  }
  std::string title() const { return "Jacking plan: " + (scene_.name.empty() ? "scene" : scene_.name); }

  std::string head() const {
    return element(
        "head", {},
        void_element("meta", {{"charset", "utf-8"}}) +
            void_element("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}) +
            void_element("meta", {{"name", "color-scheme"}, {"content", "light dark"}}) +
            element("title", {}, escaped(title())) + "\n" +
            element("style", {}, std::string(page_style) + sheet_style));
  }

  std::string header() const {
    std::string html = element("h1", {}, escaped(title())) +
                       paragraph("files", "Scene " + escaped(content_.scene_file) + ", goal " +
                                              escaped(goal_.file) + ". Planned by <code>taut plan</code>.");
    std::string list;
    for (const std::string& said : plan_sentences(scene_, goal_, content_.result))
      list += element("li", {}, escaped(said));
    html += element("ul", {{"class", plan_.limits_stop_it ? "warning" : "summary"}}, list);
    return element("header", {}, html);
  }

  // What a gauge shows while its jack pulls, or is let out.
  std::string gauge_text(std::size_t k, double force, bool pulls) const {
    const InstrumentDescription& gauge = scene_.cables[plan_.jacks[k].cable].cell[plan_.jacks[k].end];
    const double reading = gauge_shows(gauge, force, pulls);
    return gauge.calibration.empty() ? unit_.text(reading) : significant(reading, 4);
  }

  // Strokes count from the mark that is made before the first jack pulls.
  double stroke(std::size_t stage, std::size_t k) const {
    return plan_.outcome.stroke[stage][k] - plan_.before.stroke[k];
  }
  // What mu and E A leave open, both at 95 %.
  struct Tolerance {
    double low, high;
  };
  Tolerance tolerance(std::size_t stage, std::size_t k) const {
    const double expected = stroke(stage, k);
    const double by_E = 2 * scene_.cables[plan_.jacks[k].cable].E_sd * std::fabs(expected);
    double below = 0, above = 0;
    if (content_.result.prior && !content_.result.prior->stroke.empty()) {
      const auto& band = content_.result.prior->stroke[stage][k];
      below = std::max(0.0, plan_.outcome.stroke[stage][k] - band[0]);
      above = std::max(0.0, band[1] - plan_.outcome.stroke[stage][k]);
    }
    return {expected - std::hypot(below, by_E), expected + std::hypot(above, by_E)};
  }

  std::string row_of(std::size_t stage, const std::string& name, std::size_t k) const {
    const PlanStage& now = plan_.stages[stage];
    const double before = stage == 0 ? 0 : plan_.stages[stage - 1].force[k];
    const bool locks = now.locked[k] != 0 && (stage == 0 || plan_.stages[stage - 1].locked[k] == 0);
    const bool pulls = now.force[k] >= before;
    const Tolerance allowed = tolerance(stage, k);
    const PlanJack& jack = plan_.jacks[k];
    std::string stop = "stroke outside";
    if (jack.most_stroke < no_limit) stop += ", or above " + significant(mm * jack.most_stroke, 4) + " mm";
    if (!locks && goal_.most_force[jack.cable][jack.end] < no_limit)
      stop += "; gauge above " + gauge_text(k, jack.most_force, true);
    return element(
        "tr", {},
        cell("short", escaped(name)) + cell("short", escaped(jack.name)) +
            cell("short", locks   ? "lock off"
                          : pulls ? "pull"
                                  : "let out") +
            cell("number", locks ? dash : escaped(unit_.text(now.force[k]))) +
            cell("number", locks ? dash : escaped(gauge_text(k, now.force[k], pulls))) +
            cell("number", significant(mm * stroke(stage, k), 4)) +
            cell("number", significant(mm * allowed.low, 4) + dash + significant(mm * allowed.high, 4)) +
            cell("text", escaped(stop)) + cell("blank", "") + cell("blank", ""));
  }

  std::string stages() const {
    std::string rows =
        element("tr", {},
                head_cell("short", "stage") + head_cell("short", "jack") + head_cell("short", "what") +
                    head_cell("number", "force") + head_cell("number", "gauge shows") +
                    head_cell("number", "stroke [mm]") + head_cell("number", "from\u2013to [mm]") +
                    head_cell("text", "stop and ask if") + head_cell("blank", "gauge read") +
                    head_cell("blank", "stroke read"));
    const std::size_t first = plan_.loads_come_first ? 1 : 0;
    for (std::size_t s = 0; s < plan_.stages.size(); ++s)
      for (const std::size_t k : plan_.shape[s].jacks) rows += row_of(s, stage_name(plan_, s + first), k);
    std::string note =
        "Strokes count from a mark that is made before the first jack pulls, with the loads of the goal on. "
        "Their tolerance is that of E A (95 %)";
    note += content_.result.prior ? " and of mu (95 %)." : "; mu is taken as the scene has it.";
    for (const PlanJack& jack : plan_.jacks) {
      const InstrumentDescription& gauge = scene_.cables[jack.cable].cell[jack.end];
      if (!gauge.calibration.empty())
        note += " The gauge of " + jack.name + " is in the unit of its calibration.";
      if (gauge.part > 0) note += " Its ram's friction is in the reading of " + jack.name + ".";
    }
    return element("section", {},
                   heading("Stages") + element("div", {{"class", "wide"}}, element("table", {}, rows)) +
                       paragraph("note", escaped(note)));
  }

  std::string along_the_cables() const {
    std::string html = heading("Force along the cable after the last stage");
    std::size_t first = 0;
    for (const CableDescription& cable : scene_.cables) {
      html += chart_of(cable, first);
      first += cable.segments();
    }
    return element("section", {}, html);
  }
  std::string chart_of(const CableDescription& cable, std::size_t first) const {
    const std::size_t count = cable.segments();
    struct Line {
      const char* look;
      std::string name;
      const std::vector<double>* force;
    };
    std::vector<Line> lines;
    const auto usual = [&](const char* look, const std::string& name, const UsualJacking& jacking) {
      if (jacking.outcome.whole && !jacking.outcome.tension.empty())
        lines.push_back({look, name + " (" + part_text(jacking.outcome.error) + " off)",
                         &jacking.outcome.tension.back()});
    };
    usual("line-2", "straight pull", content_.straight);
    usual("line-3", "105 % and back", content_.rule);
    lines.push_back(
        {"line-1", "plan (" + part_text(plan_.outcome.error) + " off)", &plan_.outcome.tension.back()});
    Range range;
    CurvePoints target;
    for (std::size_t i = 0; i < count; ++i) {
      for (const Line& line : lines) range.include((*line.force)[first + i] / unit_.newtons);
      const double wanted = goal_.matters(first + i) ? goal_.target[first + i] / unit_.newtons : std::nan("");
      if (goal_.matters(first + i)) range.include(wanted);
      target.push_back({static_cast<double>(i) + 0.5, wanted});
      target.push_back({static_cast<double>(i) + 1.5, wanted});
    }
    if (range.low() < 0.4 * range.high()) range.include(0);
    Chart chart(Axis::counted(count, 16), Axis::round(range, 6));
    chart.curve("prior", target, "target");
    chart.explain("prior", "target");
    for (const Line& line : lines) {
      chart.curve(line.look, steps(*line.force, first, count, unit_.newtons), line.name);
      chart.explain(line.look, line.name);
    }
    return (scene_.cables.size() == 1 ? "" : element("h3", {}, "Cable " + escaped(cable.name))) +
           chart.figure("Force in the segments of cable " + cable.name +
                            " after the plan, after a straight pull and "
                            "after 105 % and back",
                        "segment", std::string("force [") + unit_.name + "]");
  }

  std::string forces() const {
    std::string html = heading("Forces of the segments [" + std::string(unit_.name) + "]");
    std::size_t first = 0;
    for (const CableDescription& cable : scene_.cables) {
      std::string row = head_cell("short", "stage");
      for (std::size_t i = 0; i < cable.segments(); ++i)
        row += head_cell("number", cable.name + ".T" + std::to_string(i + 1));
      std::string rows = element("tr", {}, row);
      const auto add = [&](const std::string& name, const std::vector<double>& force, bool is_target) {
        std::string cells = cell("short", escaped(name));
        for (std::size_t i = first; i < first + cable.segments(); ++i)
          cells += cell("number", is_target && !goal_.matters(i) ? dash : escaped(unit_.number(force[i])));
        rows += element("tr", {}, cells);
      };
      const std::size_t before = plan_.loads_come_first ? 1 : 0;
      for (std::size_t s = 0; s < plan_.stages.size(); ++s)
        add(stage_name(plan_, s + before), plan_.outcome.tension[s], false);
      add("target", goal_.target, true);
      html += element("div", {{"class", "wide"}}, element("table", {}, rows));
      first += cable.segments();
    }
    return element("section", {}, html);
  }

  const SheetContent& content_;
  const SceneDescription& scene_;
  const PlanGoal& goal_;
  const Plan& plan_;
  ForceUnit unit_;
};

}  // namespace

std::string plan_sheet(const SheetContent& content) { return Sheet(content)(); }

}  // namespace taut::host
