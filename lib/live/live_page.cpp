#include "lib/live/live_page.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/files/result_file.hpp"
#include "lib/live/live_style.hpp"
#include "lib/report/alarm_meaning.hpp"
#include "lib/report/colour_scale.hpp"
#include "lib/report/html.hpp"
#include "lib/report/names.hpp"
#include "lib/report/page_style.hpp"
#include "lib/report/run_record.hpp"
#include "lib/report/structure_drawing.hpp"

namespace taut::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* dash = "\u2013";
constexpr std::size_t few = 4;  // big digits

// Text inside of a script element: nothing in it can end the element, and it is XML.
std::string in_script(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace))
    if (c == '<' || c == '>' || c == '&') {
      constexpr const char* digits = "0123456789abcdef";
      text += std::string("\\u00") + digits[c >> 4] + digits[c & 15];
    } else {
      text += c;
    }
  return text;
}

// Those of this page beside those of the report.
AlarmMeaning meaning_of(const std::string& word) {
  if (word.compare(0, word.find(':'), "plan-limit") == 0)
    return {"A force or a stroke has passed a limit of the goal.",
            "Stop. Let the jack out below the limit, and find out why before it is pulled on."};
  return alarm_meaning(word);
}

class LivePage {
 public:
  LivePage(const SceneDescription& scene, const std::string& log, const LiveBounds& bounds,
           const LiveAnswerPtr& now)
      : scene_(scene), log_(log), bounds_(bounds), now_(now), has_row_(now && now->row > 0), record_(scene) {
    if (has_row_) {
      record_.rows = now->row;
      record_.end = now->answer;
      for (const double force : now->answer.tension) largest_ = std::max(largest_, force);
    }
    unit_ = ForceUnit::for_largest(largest_);
  }

  std::string operator()() const {
    std::string body = header() + digits() + alarms() + plan() + structure();
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) body += cable(c);
    body += over_time() + scripts();
    return "<!DOCTYPE html>\n" +
           element("html", {{"lang", "en"}}, head() + "\n" + element("body", {}, body)) + "\n";
  }

 private:
  std::string head() const {
    return element(
        "head", {},
        void_element("meta", {{"charset", "utf-8"}}) +
            void_element("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}) +
            void_element("meta", {{"name", "color-scheme"}, {"content", "light dark"}}) +
            void_element("link", {{"rel", "icon"}, {"href", "data:,"}}) +
            element("title", {}, escaped(title())) + "\n" +
            element("style", {}, std::string(page_style) + live_style + force_colour_rules()));
  }
  std::string title() const { return "taut: " + (scene_.name.empty() ? "scene" : scene_.name); }

  std::string header() const {
    const std::string time = has_row_ ? coordinate(now_->time, 3) + " s" : "no row yet";
    return element("header", {},
                   element("h1", {}, escaped(scene_.name.empty() ? "scene" : scene_.name)) +
                       element("p", {{"class", "status"}},
                               element("b", {{"id", "time"}}, time) +
                                   element("span", {{"class", "link"}, {"id", "link"}}, "as loaded") +
                                   element("span", {{"class", "files"}}, "Rows from " + escaped(log_))));
  }

  std::string box(const char* key, const std::string& name, const std::string& title_text,
                  const std::string& value, const std::string& more) const {
    return element("div", {{key, name}},
                   element("span", {}, escaped(title_text)) + element("strong", {}, escaped(value)) +
                       element("small", {}, escaped(more)));
  }

  // What is read from afar: every jack, and of every cable its least force.
  std::string digits() const {
    std::string boxes;
    std::size_t count = 0;
    if (has_row_)
      for (const JackNow& jack : now_->jacks) {
        const std::string name = scene_.cables[jack.cable].name + "." + end_name(jack.end);
        boxes += box("data-jack", name, "jack " + name, unit_.number(jack.force),
                     std::string(" ") + unit_.name +
                         (jack.stroke ? ", " + fixed(1000 * *jack.stroke, 1) + " mm" : ""));
        ++count;
      }
    else
      for (const std::string& name : jack_names())
        boxes += box("data-jack", name, "jack " + name, dash, ""), ++count;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c, ++count) {
      const std::string& name = scene_.cables[c].name;
      if (!has_row_) {
        boxes += box("data-least", name, name + ", least", dash, "");
        continue;
      }
      const auto begin =
          now_->answer.tension.begin() + static_cast<std::ptrdiff_t>(start_of(scene_, c).segment);
      const auto least =
          std::min_element(begin, begin + static_cast<std::ptrdiff_t>(scene_.cables[c].segments()));
      const auto i = static_cast<std::size_t>(least - now_->answer.tension.begin());
      boxes += box("data-least", name, name + ", least: segment " + std::to_string(least - begin + 1),
                   unit_.number(*least),
                   " \u00b1 " + unit_.deviation(band_width * now_->answer.deviation[i]) + " " + unit_.name);
    }
    return element("section", {{"class", count > few ? "big many" : "big"}}, boxes);
  }

  std::string alarms() const {
    std::string list;
    const auto add = [&](const std::string& word, const char* look) {
      const AlarmMeaning meaning = meaning_of(word);
      list += element("li", {{"class", look}},
                      element("b", {}, escaped(word)) +
                          element("div", {}, escaped(std::string(meaning.means) + " " + meaning.to_do)));
    };
    if (now_) {
      for (const std::string& word : now_->alarms) add(word, "");
      for (const std::string& word : now_->notices) add(word, "notice");
    }
    if (list.empty())
      list = element("li", {{"class", "notice"}}, now_ ? "No alarm." : "No row has come yet.");
    return element("section", {{"aria-live", "polite"}},
                   element("ul", {{"class", "alarms-now"}, {"id", "alarms"}}, list));
  }

  // The order, which is read from afar, and the stages.
  std::string plan() const {
    if (!now_ || !now_->plan) return "";
    const PlanNow& plan = *now_->plan;
    std::string stages, anew;
    for (std::size_t s = 0; s < plan.stages.size(); ++s) {
      const PlanStageNow& stage = plan.stages[s];
      const bool is_present = s == plan.present;
      stages += element("tr", {{"class", is_present ? "present" : ""}},
                        cell(escaped(stage_text(plan, s)), "text") + cell(stage.skipped  ? "skipped"
                                                                          : stage.passed ? "passed"
                                                                          : is_present   ? "present"
                                                                                         : "to come",
                                                                          "short"));
    }
    for (const PlanAnew& each : plan.anew) anew += element("li", {}, escaped(anew_text(each)));
    return element("section", {{"id", "plan"}},
                   heading("Plan") +
                       element("p", {{"class", "order"}, {"id", "order"}, {"data-order", plan.order()}},
                               escaped(plan.say)) +
                       paragraph("note", element("span", {{"id", "plan-error"}}, escaped(error_text(plan)))) +
                       element("div", {{"class", "wide"}},
                               element("table", {},
                                       "<thead><tr><th>stage</th><th>is</th></tr></thead>" +
                                           element("tbody", {{"id", "stages"}}, stages))) +
                       element("ul", {{"class", "note"}, {"id", "anew"}}, anew));
  }

  std::string structure() const {
    const std::vector<double> forces = has_row_ ? now_->answer.tension : std::vector<double>{0};
    const ForceScale scale(forces);
    std::string html = heading("Structure") + structure_drawing(scene_, record_, unit_, scale) +
                       scale.bar(unit_) + structure_legend(scene_);
    if (scene_.dimension == 3)
      html += paragraph("note", "Axonometric projection, seen from the front right and from above.");
    return element("section", {}, html);
  }

  static std::string chart(const std::string& id, const std::string& says) {
    return element("svg", {{"class", "live-chart"}, {"id", id}, {"role", "img"}, {"aria-label", says}}, "");
  }
  static std::string cell(const std::string& html, const char* look = "number") {
    return element("td", {{"class", look}}, html);
  }

  std::string cable(std::size_t c) const {
    const CableDescription& cable = scene_.cables[c];
    const CableStart first = start_of(scene_, c);
    std::string segments, joints;
    for (std::size_t i = 0; i < cable.segments(); ++i) {
      std::string force = dash, half = dash, band = dash;
      if (has_row_) {
        const double T = now_->answer.tension[first.segment + i],
                     sd = now_->answer.deviation[first.segment + i];
        const auto [low, high] = force_band(T, sd);
        force = unit_.text(T);
        half = "\u00b1 " + unit_.deviation(band_width * sd);
        band = unit_.number(low) + " " + dash + " " + unit_.number(high);
      }
      segments += element(
          "tr", {{"data-cable", cable.name}, {"data-segment", std::to_string(i)}},
          cell(escaped(segment_name(scene_, cable, i)), "text") + cell(force) + cell(half) + cell(band));
    }
    for (std::size_t j = 0; j < cable.joints(); ++j) {
      std::string state = dash, mu = dash;
      if (has_row_) {
        state = state_word(now_->answer.state[first.joint + j]);
        mu = fixed(now_->answer.mu[first.joint + j], 3) + " \u00b1 " +
             significant(band_width * now_->answer.mu_deviation[first.joint + j], 2);
      }
      joints += element("tr", {{"data-cable", cable.name}, {"data-joint", std::to_string(j)}},
                        cell("joint " + std::to_string(j + 1) + " (" +
                                 escaped(node_name(scene_, joint_node(cable, j))) + ")",
                             "text") +
                            cell(state, "short") + cell(mu));
    }
    const auto table = [](const char* look, const char* columns, const std::string& rows) {
      return element("div", {{"class", "wide"}},
                     element("table", {{"class", look}}, columns + element("tbody", {}, rows)));
    };
    std::string html = heading("Cable " + cable.name) +
                       chart("along" + std::to_string(c), "Force along cable " + cable.name);
    html +=
        table("forces",
              "<thead><tr><th>segment</th><th class=\"number\">force</th><th class=\"number\">95 %</th><th "
              "class=\"number\">from \u2013 to</th></tr></thead>",
              segments);
    if (!joints.empty())
      html += table("joints",
                    "<thead><tr><th>joint</th><th>state</th><th class=\"number\">mu, 95 %</th></tr></thead>",
                    joints);
    return element("section", {}, html);
  }

  std::vector<std::string> jack_names() const {
    std::vector<std::string> names;
    for (const CableDescription& cable : scene_.cables)
      for (std::size_t end = 0; end < 2; ++end)
        if (cable.is_jacked(end)) names.push_back(cable.name + "." + end_name(end));
    return names;
  }

  std::string over_time() const {
    std::string html;
    const std::vector<std::string> names = jack_names();
    for (std::size_t j = 0; j < names.size(); ++j) {
      const std::string number = std::to_string(j);
      html += heading("Jack " + names[j]) +
              element("div", {{"class", "y-title"}, {"id", "unit-load" + number}}, "Load") +
              chart("load" + number, "Load of " + names[j] + " over time") +
              element("div", {{"class", "y-title"}, {"id", "unit-stroke" + number}}, "Stroke") +
              chart("stroke" + number, "Stroke of " + names[j] + " over time");
    }
    return html.empty() ? "" : element("section", {}, html);
  }

  std::string scripts() const {
    Json data = Json::object();
    data["unit"] = {{"name", unit_.name}, {"newtons", unit_.newtons}, {"decimals", unit_.decimals}};
    data["span"] = ForceScale::least_span;
    data["colours"] = force_colours;
    data["cables"] = Json::array();
    for (const CableDescription& cable : scene_.cables) data["cables"].push_back(cable.name);
    data["jacks"] = jack_names();
    data["targets"] = Json::array();
    data["limits"] = Json::array();
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) {
      const std::size_t first = start_of(scene_, c).segment;
      Json targets = Json::array();
      double most = bounds_.most_force;
      for (std::size_t i = first; i < first + scene_.cables[c].segments(); ++i) {
        if (i < bounds_.target.size())
          targets.push_back(bounds_.target[i] > 0 ? Json(bounds_.target[i]) : Json(nullptr));
        if (i < bounds_.most_segment.size()) most = std::min(most, bounds_.most_segment[i]);
      }
      data["targets"].push_back(std::move(targets));
      data["limits"].push_back({bounds_.least_force > 0 ? Json(bounds_.least_force) : Json(nullptr),
                                most < HUGE_VAL ? Json(most) : Json(nullptr)});
    }
    for (int s = 0; s < 4; ++s) {
      const auto state = static_cast<JointState>(s);
      data["outlines"][state_word(state)] = joint_outline(state);
    }
    for (const char* kind :
         {"outlier",        "sensor",    "mu",           "stuck",  "elongation", "force-high",   "force-low",
          "no-information", "gauge",     "model-misfit", "frozen", "gain",       "unknown-past", "lift-off",
          "unread",         "late-lock", "early-unlock", "silent", "unreadable", "plan-limit"}) {
      const AlarmMeaning meaning = meaning_of(kind);
      data["meanings"][kind] = {meaning.means, meaning.to_do};
    }
    const Json answer = now_ ? Json::parse(now_->json) : Json(nullptr);
    return element("script", {{"type", "application/json"}, {"id", "scene"}}, in_script(data)) +
           element("script", {{"type", "application/json"}, {"id", "answer"}}, in_script(answer)) +
           element("script", {}, live_script);
  }

  const SceneDescription& scene_;
  const std::string& log_;
  const LiveBounds& bounds_;
  const LiveAnswerPtr& now_;
  bool has_row_;
  RunRecord record_;
  double largest_ = 0;
  ForceUnit unit_;
};

}  // namespace

std::string live_page(const SceneDescription& scene, const std::string& log, const LiveBounds& bounds,
                      const LiveAnswerPtr& now) {
  return LivePage(scene, log, bounds, now)();
}

}  // namespace taut::host
