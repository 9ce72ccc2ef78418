#include "lib/report/report_tables.hpp"

#include "lib/files/result_file.hpp"
#include "lib/report/alarm_meaning.hpp"
#include "lib/report/html.hpp"
#include "lib/report/names.hpp"
#include "lib/report/number_text.hpp"

namespace taut::host {
namespace {

constexpr int mu_digits = 4;  // decimals

// A part that is there is never shown as none.
std::string percent(const Words& say, double part) {
  return part > 0 && part < 0.005 ? say("less than 1 %") : fixed(100 * part, 0) + " %";
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
  /// With the name that is shown where the head of the table is not.
  TableRow& named(const std::string& name, const std::string& text) {
    cells_ += element(kind_, {{"class", "number"}, {"data-name", name}}, escaped(text));
    return *this;
  }
  TableRow& word(const std::string& text) { return cell("short", text); }
  TableRow& text(const std::string& text) { return cell("text", text); }
  std::string finished() const { return element("tr", {}, cells_); }

 private:
  const char* kind_;
  std::string cells_;
};

// Wider than a phone, it can be moved on its own.
std::string table(const std::string& name, const TableRow& head, const std::string& rows,
                  const std::string& look = "wide") {
  return element("div", {{"class", look}, {"role", "region"}, {"aria-label", name}, {"tabindex", "0"}},
                 element("table", {}, element("thead", {}, head.finished()) + element("tbody", {}, rows)));
}

std::string further_runs(const ReportView& view, const AlarmRecord& record) {
  std::string list;
  for (const auto& [word, count] : record.further())
    list += (list.empty() ? "" : ", ") + view.say("{1} {2} times", {word, std::to_string(count)});
  return list.empty()
             ? ""
             : paragraph("note", escaped(view.say("Later, and not listed one by one: {1}.", {list})));
}

// How far a force went beyond its limit; empty for other alarms.
std::string peak_text(const ReportView& view, const AlarmRun& run) {
  if (!run.has_peak) return "";
  const bool is_high = run.word.rfind("force-high", 0) == 0;
  return " " + view.say(is_high ? "Peak {1} in segment {2} at {3} s." : "Lowest {1} in segment {2} at {3} s.",
                        {view.unit.text(run.peak), run.word.substr(run.word.rfind('T') + 1),
                         view.time_text(run.peak_time)});
}

// Of alarms or notices; what to do about notices is nothing.
std::string run_table(const ReportView& view, const AlarmRecord& record, const std::string& kind,
                      bool tells_what_to_do) {
  const std::string rows_name = view.say("Rows"),
                    time_name = view.origin == 0 ? view.say("Time [s]")
                                                 : view.say("Since {1} [s]", {view.time_text(view.origin)});
  std::string rows;
  for (const AlarmRun& run : record.runs()) {
    const bool is_one = run.first_row == run.last_row;
    const AlarmMeaning meaning = alarm_meaning(run.word);
    TableRow row;
    row.named(rows_name,
              std::to_string(run.first_row) + (is_one ? "" : en_dash + std::to_string(run.last_row)))
        .named(time_name, view.time_text(run.first_time - view.origin) +
                              (is_one ? "" : en_dash + view.time_text(run.last_time - view.origin)))
        .word(run.word.substr(0, run.word.find(':')))
        .word(alarm_place(run.word))
        .text(view.say(meaning.means) + peak_text(view, run));
    if (tells_what_to_do) row.text(view.say(meaning.to_do));
    rows += row.finished();
  }
  TableRow head("th");
  head.number(rows_name).number(time_name).word(kind).word(view.say("Where")).text(view.say("What it means"));
  if (tells_what_to_do) head.text(view.say("What to do"));
  return element("div", {{"class", "alarms"}}, table(kind, head, rows)) + further_runs(view, record);
}

}  // namespace

std::string alarm_table(const ReportView& view) {
  const AlarmRecord& alarms = view.record.alarms;
  return alarms.count() == 0 ? paragraph("note", escaped(view.say("There is none.")))
                             : run_table(view, alarms, view.say("Alarm"), true);
}

std::string notice_table(const ReportView& view) {
  const AlarmRecord& notices = view.record.notices;
  return notices.count() == 0 ? "" : run_table(view, notices, view.say("Notice"), false);
}

std::string learned_sentence(const LearnedFriction& learned, const Words& say) {
  const auto spread = [](double mu, double sd) {
    return fixed(mu, 3) + " \u00b1 " + (sd < 0.002 ? significant(sd, 2) : fixed(sd, 3));
  };
  const std::string before = spread(learned.mu_before, learned.sd_before);
  if (learned.sources.empty())
    return say("mu of {1}: {2}, as the scene has it: nothing in the log measured it.",
               {learned.name, before});
  std::string sources;
  for (const FrictionSource& source : learned.sources)
    sources += say(!sources.empty()       ? ", {1} from {2} ({3})"
                   : source.readings == 1 ? "{1} of that from {2} ({3} reading)"
                                          : "{1} of that from {2} ({3} readings)",
                   {percent(say, source.share), source.column, std::to_string(source.readings)});
  return say("mu of {1}: {2} beforehand, {3} now; {4}.",
             {learned.name, before, spread(learned.mu, learned.sd), sources});
}

std::string learned_table(const ReportView& view) {
  const Words& say = view.say;
  std::string html, rows;
  for (const LearnedFriction& learned : view.content.learned) {
    html += paragraph("note", escaped(learned_sentence(learned, view.say)));
    for (const FrictionSource& source : learned.sources)
      rows += TableRow()
                  .word(learned.name)
                  .number(fixed(learned.mu_before, mu_digits))
                  .number(significant(learned.sd_before, 2))
                  .number(fixed(learned.mu, mu_digits))
                  .number(significant(learned.sd, 2))
                  .word(source.column)
                  .number(std::to_string(source.readings))
                  .number(percent(view.say, source.share))
                  .finished();
  }
  if (rows.empty()) return html;
  TableRow head("th");
  head.word(say("mu of")).number(say("Beforehand")).number(say("sd")).number(say("Now")).number(say("sd"));
  head.word(say("Learned from")).number(say("Readings used")).number(say("Share of what was learned"));
  return html + table(say("What friction was learned from"), head, rows);
}

std::string final_table(const ReportView& view, std::size_t c) {
  const Words& say = view.say;
  const CableDescription& cable = view.scene.cables[c];
  const Answer& end = view.record.end;
  const std::string unit = std::string(" [") + view.unit.name + "]";
  const CableStart first = start_of(view.scene, c);
  const bool has_nominal = !view.content.nominal.tension.empty();
  TableRow head("th");
  head.word(say("Segment")).number(say("Force") + unit).number(say("sd") + unit);
  if (has_nominal) head.number(say("Predicted") + unit);
  // The joint of a hoop lies at the start of its segment, all others at the end.
  head.word(say(cable.closed ? "Joint at its start" : "Joint at its end"))
      .word(say("State"))
      .number("mu")
      .number(say("sd of mu"));
  head.number(say("Contact force") + unit).number(say("Friction used"));
  std::string rows;
  for (std::size_t i = 0; i < cable.segments(); ++i) {
    const std::size_t s = first.segment + i, j = first.joint + i;
    const auto nodes = segment_nodes(cable, i);
    TableRow row;
    row.word(std::to_string(i + 1) + " (" + node_name(view.scene, nodes[0]) + en_dash +
             node_name(view.scene, nodes[1]) + ")");
    row.cell("number force", view.unit.number(end.tension[s]));
    row.cell("number sd", view.unit.deviation(end.deviation[s]));
    if (has_nominal) row.cell("number at-end", view.unit.number(view.content.nominal.tension[s]));
    if (i < cable.joints()) {
      row.word(std::to_string(i + 1) + " (" + node_name(view.scene, joint_node(cable, i)) + ")");
      row.cell("short state", say(state_word(end.state[j]))).cell("number mu", fixed(end.mu[j], mu_digits));
      row.cell("number mu-sd", significant(end.mu_deviation[j], 2));
      row.cell("number contact", view.unit.number(end.contact[j]));
      row.cell("number used", percent(view.say, end.friction_used[j]));
    } else {
      row.word("").word("").number("").number("").number("").number("");
    }
    rows += row.finished();
  }
  return table(say("Values of cable {1} {2}", {cable.name, view.at_end()}), head, rows, "wide values");
}

}  // namespace taut::host
