#include "lib/report/report_tables.hpp"

#include "lib/files/result_file.hpp"
#include "lib/report/alarm_meaning.hpp"
#include "lib/report/html.hpp"
#include "lib/report/names.hpp"
#include "lib/report/number_text.hpp"

namespace taut::host {
namespace {

constexpr int mu_digits = 4;  // decimals
constexpr const char* dash = "\u2013";

// A part that is there is never shown as none.
std::string percent(double part) {
  return part > 0 && part < 0.005 ? "less than 1 %" : fixed(100 * part, 0) + " %";
}

// The cells of one row of a table.
class TableRow {
 public:
  explicit TableRow(const char* kind = "td") : kind_(kind) {}

  TableRow& cell(const char* look, const std::string& text) {
    cells_ += element(kind_, {{"class", look}}, escaped(text));
    return *this;
  }
  TableRow& number(const std::string& text) { return cell("number", text); }
  TableRow& word(const std::string& text) { return cell("short", text); }
  TableRow& text(const std::string& text) { return cell("text", text); }
  std::string finished() const { return element("tr", {}, cells_); }

 private:
  const char* kind_;
  std::string cells_;
};

// Wider than a phone, it can be moved on its own.
std::string table(const std::string& name, const TableRow& head, const std::string& rows) {
  return element("div", {{"class", "wide"}, {"role", "region"}, {"aria-label", name}, {"tabindex", "0"}},
                 element("table", {}, element("thead", {}, head.finished()) + element("tbody", {}, rows)));
}

std::string further_runs(const AlarmRecord& record) {
  std::string list;
  for (const auto& [word, count] : record.further())
    list += (list.empty() ? "" : ", ") + word + " " + std::to_string(count) + " times";
  return list.empty() ? "" : paragraph("note", "Later, and not listed one by one: " + escaped(list) + ".");
}

// How far a force went beyond its limit; empty for other alarms.
std::string peak_text(const ReportView& view, const AlarmRun& run) {
  if (!run.has_peak) return "";
  const bool is_high = run.word.rfind("force-high", 0) == 0;
  return std::string(is_high ? " Peak " : " Lowest ") + view.unit.text(run.peak) + " in segment " +
         run.word.substr(run.word.rfind('T') + 1) + " at " + view.time_text(run.peak_time) + " s.";
}

// Of alarms or notices; what to do about notices is nothing.
std::string run_table(const ReportView& view, const AlarmRecord& record, const std::string& kind,
                      bool tells_what_to_do) {
  std::string rows;
  for (const AlarmRun& run : record.runs()) {
    const bool is_one = run.first_row == run.last_row;
    const AlarmMeaning meaning = alarm_meaning(run.word);
    TableRow row;
    row.number(std::to_string(run.first_row) + (is_one ? "" : dash + std::to_string(run.last_row)))
        .number(view.time_text(run.first_time - view.origin) +
                (is_one ? "" : dash + view.time_text(run.last_time - view.origin)))
        .word(run.word.substr(0, run.word.find(':')))
        .word(alarm_place(run.word))
        .text(meaning.means + peak_text(view, run));
    if (tells_what_to_do) row.text(meaning.to_do);
    rows += row.finished();
  }
  TableRow head("th");
  head.number("Rows")
      .number(view.origin == 0 ? "Time [s]" : "Since " + view.time_text(view.origin) + " [s]")
      .word(kind)
      .word("Where")
      .text("What it means");
  if (tells_what_to_do) head.text("What to do");
  return element("div", {{"class", "alarms"}}, table(kind + "s", head, rows)) + further_runs(record);
}

}  // namespace

std::string alarm_table(const ReportView& view) {
  const AlarmRecord& alarms = view.record.alarms;
  return alarms.count() == 0 ? paragraph("note", "There is none.") : run_table(view, alarms, "Alarm", true);
}

std::string notice_table(const ReportView& view) {
  const AlarmRecord& notices = view.record.notices;
  return notices.count() == 0 ? "" : run_table(view, notices, "Notice", false);
}

std::string learned_sentence(const LearnedFriction& learned) {
  const auto spread = [](double mu, double sd) {
    return fixed(mu, 3) + " \u00b1 " + (sd < 0.002 ? significant(sd, 2) : fixed(sd, 3));
  };
  const std::string before = "mu of " + learned.name + ": " + spread(learned.mu_before, learned.sd_before);
  if (learned.sources.empty()) return before + ", as the scene has it: nothing in the log measured it.";
  std::string sentence = before + " beforehand, " + spread(learned.mu, learned.sd) + " now; ";
  for (std::size_t i = 0; i < learned.sources.size(); ++i) {
    const FrictionSource& source = learned.sources[i];
    sentence += (i == 0 ? "" : ", ") + percent(source.share) + (i == 0 ? " of that from " : " from ") +
                source.column + " (" + std::to_string(source.readings) +
                (i > 0                  ? ")"
                 : source.readings == 1 ? " reading)"
                                        : " readings)");
  }
  return sentence + ".";
}

std::string learned_table(const ReportView& view) {
  std::string html, rows;
  for (const LearnedFriction& learned : view.content.learned) {
    html += paragraph("note", escaped(learned_sentence(learned)));
    for (const FrictionSource& source : learned.sources)
      rows += TableRow()
                  .word(learned.name)
                  .number(fixed(learned.mu_before, mu_digits))
                  .number(significant(learned.sd_before, 2))
                  .number(fixed(learned.mu, mu_digits))
                  .number(significant(learned.sd, 2))
                  .word(source.column)
                  .number(std::to_string(source.readings))
                  .number(percent(source.share))
                  .finished();
  }
  if (rows.empty()) return html;
  TableRow head("th");
  head.word("mu of").number("Beforehand").number("sd").number("Now").number("sd");
  head.word("Learned from").number("Readings used").number("Share of what was learned");
  return html + table("What friction was learned from", head, rows);
}

std::string final_table(const ReportView& view, std::size_t c) {
  const CableDescription& cable = view.scene.cables[c];
  const Answer& end = view.record.end;
  const std::string unit = std::string(" [") + view.unit.name + "]";
  const CableStart first = start_of(view.scene, c);
  const bool has_nominal = !view.content.nominal.tension.empty();
  TableRow head("th");
  head.word("Segment").number("Force" + unit).number("sd" + unit);
  if (has_nominal) head.number("Predicted" + unit);
  // The joint of a hoop lies at the start of its segment, all others at the end.
  head.word(cable.closed ? "Joint at its start" : "Joint at its end")
      .word("State")
      .number("mu")
      .number("sd of mu");
  head.number("Contact force" + unit).number("Friction used");
  std::string rows;
  for (std::size_t i = 0; i < cable.segments(); ++i) {
    const std::size_t s = first.segment + i, j = first.joint + i;
    const auto nodes = segment_nodes(cable, i);
    TableRow row;
    row.word(std::to_string(i + 1) + " (" + node_name(view.scene, nodes[0]) + dash +
             node_name(view.scene, nodes[1]) + ")");
    row.number(view.unit.number(end.tension[s])).number(view.unit.deviation(end.deviation[s]));
    if (has_nominal) row.number(view.unit.number(view.content.nominal.tension[s]));
    if (i < cable.joints()) {
      row.word(std::to_string(i + 1) + " (" + node_name(view.scene, joint_node(cable, i)) + ")");
      row.word(state_word(end.state[j])).number(fixed(end.mu[j], mu_digits));
      row.number(significant(end.mu_deviation[j], 2)).number(view.unit.number(end.contact[j]));
      row.number(percent(end.friction_used[j]));
    } else {
      row.word("").word("").number("").number("").number("").number("");
    }
    rows += row.finished();
  }
  return table("Values of cable " + cable.name + " " + view.at_end(), head, rows);
}

}  // namespace taut::host
