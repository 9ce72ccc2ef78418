#include "lib/report/report_page.hpp"

#include "lib/files/result_file.hpp"
#include "lib/files/verdict.hpp"
#include "lib/report/colour_scale.hpp"
#include "lib/report/html.hpp"
#include "lib/report/names.hpp"
#include "lib/report/number_text.hpp"
#include "lib/report/page_style.hpp"
#include "lib/report/record_page.hpp"
#include "lib/report/report_charts.hpp"
#include "lib/report/report_tables.hpp"
#include "lib/report/state_strip.hpp"
#include "lib/report/structure_drawing.hpp"

namespace taut::host {
namespace {

std::string strong(const std::string& text) { return element("strong", {}, escaped(text)); }

class Page {
 public:
  explicit Page(const ReportContent& content)
      : view_(content),
        say(content.say),
        content_(content),
        scene_(content.scene),
        record_(content.record),
        unit_(view_.unit) {}

  std::string operator()() const {
    std::string body = record_page(view_) + element("div", {{"class", "run"}}, header() + structure());
    if (record_.rows > 0)
      body += along_the_cable() + over_time() + mu_over_time() + what_taught_friction() + joint_states();
    body += element("section", {}, heading(say("Alarms")) + alarm_table(view_));
    if (const std::string notices = notice_table(view_); !notices.empty())
      body += element("section", {}, heading(say("Notices")) + notices);
    if (record_.rows > 0) body += final_values();
    return "<!DOCTYPE html>\n" +
           element("html", {{"lang", say.code()}},
                   head() + "\n" + element("body", {}, body + remarks() + script())) +
           "\n";
  }

 private:
  std::string head() const {
    return element(
        "head", {},
        void_element("meta", {{"charset", "utf-8"}}) +
            void_element("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}) +
            void_element("meta", {{"name", "color-scheme"}, {"content", "light dark"}}) +
            element("title", {}, escaped(title())) + "\n" +
            element("style", {}, page_style + force_colour_rules() + foot_of_pages()));
  }
  // What every sheet of paper says of where it belongs.
  std::string foot_of_pages() const {
    const StressingSheet& sheet = content_.sheet;
    constexpr std::size_t few = 40, digits = 12;
    std::string foot;
    const auto add = [&](const std::string& text) {
      if (!text.empty()) foot += (foot.empty() ? "" : " \u00b7 ") + text;
    };
    add(shortened(sheet.job.project, few));
    add(shortened(scene_.name, few));
    if (!sheet.log_hash.empty()) add(say("Log") + " " + sheet.log_hash.substr(0, digits));
    add("taut " + sheet.version);
    return "@page{@bottom-left{content:\"" + css_string(foot) + "\";font:8pt sans-serif}}\n";
  }
  std::string title() const {
    return say("Cable forces: {1}", {scene_.name.empty() ? say("scene") : scene_.name});
  }

  std::string header() const {
    std::string html =
        element("h1", {{"class", "of-run"}}, escaped(title())) + verdict() +
        paragraph("files", escaped(say("Scene {1}, log {2}. Forces and friction estimated by taut report; "
                                       "bands hold the true value with 95 %.",
                                       {content_.scene_file, content_.log_file}))) +
        paragraph("summary", summary());
    if (!content_.end.empty())
      html += paragraph("warning",
                        strong(say("The answer ends before the log does.")) + " " +
                            escaped(say("{1}. What follows shows the rows before it.", {say(content_.end)})));
    return element("header", {{"id", "run"}}, html);
  }

  std::string verdict() const {
    if (record_.rows == 0) return "";
    const bool is_good = is_trust(record_.end.verdict);
    return paragraph(is_good ? "summary" : "warning",
                     escaped(say("Verdict {1}:", {view_.at_end()})) + " " + strong(say(record_.end.verdict)) +
                         escaped(say(is_good ? ", since {1} s" : " (in doubt since {1} s)",
                                     {view_.time_text(record_.verdict_since)})));
  }

  std::string summary() const {
    if (record_.rows == 0) return escaped(say("No row has an answer."));
    const LargestForce& most = record_.largest;
    std::string html =
        strong(say(record_.rows == 1 ? "{1} row" : "{1} rows", {std::to_string(record_.rows)})) + " " +
        escaped(say("in {1} s", {view_.time_text(record_.last_time - record_.first_time)}));
    if (most.force >= 0)
      html += " \u00b7 " + escaped(say("largest force")) + " " + strong(unit_.text(most.force)) + " " +
              escaped(say("(sd {1}) in {2} at {3} s",
                          {unit_.deviation(most.deviation), place_of_segment(most.segment),
                           view_.time_text(most.time)}));
    html += mu_summary();
    const std::size_t count = record_.alarms.count();
    return html + " \u00b7 " +
           strong(count == 0 ? say("no alarm")
                             : say(count == 1 ? "{1} alarm" : "{1} alarms", {std::to_string(count)}));
  }

  std::string place_of_segment(std::size_t segment) const {
    std::size_t c = 0, i = segment;
    while (i >= scene_.cables[c].segments()) i -= scene_.cables[c++].segments();
    return say("{1} of cable {2}", {segment_name(scene_, scene_.cables[c], i, say), scene_.cables[c].name});
  }

  // One value a cable, or from the smallest to the largest of its joints; of many cables from the smallest to
  // the largest of all.
  std::string mu_summary() const {
    constexpr std::size_t most_listed = 3;
    const std::size_t joints = record_.end.mu.size();
    if (joints == 0) return "";
    if (scene_.cables.size() > most_listed) return " \u00b7 mu " + mu_between(0, joints);
    std::string html;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) {
      if (scene_.cables[c].joints() == 0) continue;
      html += " \u00b7 mu " +
              (scene_.cables.size() > 1 ? escaped(say("of cable {1}", {scene_.cables[c].name})) + " " : "") +
              mu_between(start_of(scene_, c).joint, scene_.cables[c].joints());
    }
    return html;
  }
  std::string mu_between(std::size_t first, std::size_t count) const {
    Range mu, sd;
    for (std::size_t j = first; j < first + count; ++j) {
      mu.include(record_.end.mu[j]);
      sd.include(record_.end.mu_deviation[j]);
    }
    const std::string low = significant(mu.low(), 3), high = significant(mu.high(), 3);
    if (low == high) return strong(low) + " " + escaped(say("(sd {1})", {significant(sd.high(), 2)}));
    return strong(low + en_dash + high) + " " + escaped(say("(sd up to {1})", {significant(sd.high(), 2)}));
  }

  std::string structure() const {
    std::string html = record_.rows > 0 ? heading_now("Structure {1}") : heading(say("Structure"));
    const ForceScale scale(record_.end.tension);
    html += structure_drawing(scene_, record_, unit_, scale, say);
    if (!record_.end.tension.empty()) html += player() + scale.bar(unit_, say);
    html += structure_legend(scene_, say);
    if (scene_.dimension == 3)
      html += paragraph("note",
                        escaped(say("Axonometric projection, seen from the front right and from above.")));
    return element("section", {}, html);
  }

  // A browser without JavaScript leaves it hidden.
  std::string player() const {
    return element(
        "p", {{"class", "player"}, {"id", "player"}, {"hidden", "hidden"}},
        element("label", {{"for", "moment"}}, escaped(say("Show at"))) +
            void_element("input", {{"type", "range"}, {"id", "moment"}, {"min", "0"}, {"step", "1"}}) +
            element("output", {{"for", "moment"}}));
  }

  std::string along_the_cable() const {
    std::string html = heading_now("Force along the cable {1}");
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) html += cable_heading(c) + force_chart(view_, c);
    if (content_.nominal.tension.empty())
      html +=
          paragraph("note", escaped(say("What was predicted with the friction of the scene is left out: {1}.",
                                        {say(content_.nominal.reason)})));
    return element("section", {}, html);
  }
  std::string cable_heading(std::size_t c) const {
    return scene_.cables.size() == 1 ? ""
                                     : element("h3", {}, escaped(say("Cable {1}", {scene_.cables[c].name})));
  }
  std::string over_time() const {
    std::string html = heading(say("Force over time"));
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) html += cable_heading(c) + time_chart(view_, c);
    return element("section", {}, html);
  }

  std::string mu_over_time() const {
    std::string html;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      if (scene_.cables[c].joints() > 0) html += cable_heading(c) + mu_chart(view_, c);
    return html.empty() ? "" : element("section", {}, heading(say("Friction coefficient over time")) + html);
  }
  std::string what_taught_friction() const {
    const std::string html = learned_table(view_);
    return html.empty() ? "" : element("section", {}, heading(say("What friction was learned from")) + html);
  }

  std::string joint_states() const {
    std::string html;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      if (scene_.cables[c].joints() > 0)
        html += cable_heading(c) + state_strip(scene_, c, record_, view_.time, view_.time_title, say);
    return html.empty() ? ""
                        : element("section", {},
                                  heading(say("States of the joints over time")) + state_legend(say) + html);
  }

  std::string final_values() const {
    std::string html = heading_now("Values {1}");
    for (std::size_t c = 0; c < scene_.cables.size(); ++c) html += cable_heading(c) + final_table(view_, c);
    return element("section", {}, html);
  }

  std::string remarks() const {
    std::string list;
    for (const Sentence& remark : content_.remarks) list += element("li", {}, escaped(say(remark)));
    return list.empty() ? "" : element("section", {}, heading(say("Remarks")) + element("ul", {}, list));
  }

  // Of what the slider moves; a script puts another moment in place of the end.
  std::string heading_now(const char* pattern) const {
    const std::string text = say(pattern, {view_.at_end()}), when = view_.at_end();
    const std::size_t at = text.find(when);
    return element("h2", {},
                   escaped(text.substr(0, at)) + element("span", {{"class", "when"}}, escaped(when)) +
                       escaped(text.substr(at + when.size())));
  }

  // Numbers and fixed words only: nothing of a file gets into the script.
  std::string script() const {
    if (record_.end.tension.empty()) return "";
    std::string data =
        "{\"unit\":\"" + std::string(unit_.name) + "\",\"decimals\":" + std::to_string(unit_.decimals) +
        ",\"span\":" + significant(ForceScale::least_span, 4) + ",\"band\":" + significant(band_width, 3) +
        ",\"colours\":" + std::to_string(force_colours) + ",\"at\":\"" + say("at {1} s") + "\",\"end\":\"" +
        view_.at_end() + "\",\"states\":[";
    for (int s = 0; s < 4; ++s) {
      const auto state = static_cast<JointState>(s);
      data += std::string(s == 0 ? "" : ",") + "[\"" + state_word(state) + "\",\"" + joint_outline(state) +
              "\",\"" + say(state_word(state)) + "\"]";
    }
    data += "],\"frames\":[";
    bool is_first = true;
    for (const Frame& frame : record_.frames.cells()) {
      const auto force = [&](double newtons) { return coordinate(unit_.of(newtons), unit_.decimals + 1); };
      const auto digits = [](double number) { return significant(number, 3); };
      data += std::string(is_first ? "\n" : ",\n") + "[\"" + view_.time_text(frame.time) + "\"," +
              list(frame.tension, force) + ",\"";
      for (const JointState state : frame.state) data += static_cast<char>('0' + static_cast<int>(state));
      data += "\"," + coordinate(view_.time.part(frame.time), 4) + "," + list(frame.deviation, force) + "," +
              list(frame.mu, [](double mu) { return coordinate(mu, 4); }) + "," +
              list(frame.mu_deviation, digits) + "," + list(frame.contact, force) + "," +
              list(frame.used, [](double part) { return coordinate(part, 3); }) + "]";
      is_first = false;
    }
    return element("script", {{"type", "application/json"}, {"id", "frames"}}, data + "]}") +
           element("script", {}, page_script);
  }
  template <class Text>
  static std::string list(const std::vector<double>& numbers, const Text& text) {
    std::string all;
    for (const double number : numbers) all += (all.empty() ? "" : ",") + text(number);
    return "[" + all + "]";
  }

  ReportView view_;
  const Words& say;
  const ReportContent& content_;
  const SceneDescription& scene_;
  const RunRecord& record_;
  const ForceUnit& unit_;
};

}  // namespace

std::string report_page(const ReportContent& content) { return Page(content)(); }

}  // namespace taut::host
