#include "lib/report/record_page.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "lib/files/verdict.hpp"
#include "lib/report/html.hpp"
#include "lib/report/names.hpp"
#include "lib/report/number_text.hpp"
#include "lib/report/stressing_record.hpp"

namespace taut::host {
namespace {

constexpr double mm = 1000;
constexpr std::size_t forces_abreast = 2;  // columns of the table of forces

std::string cell(const char* look, const std::string& text) {
  return element("td", {{"class", look}}, escaped(text));
}
std::string head_cell(const char* look, const std::string& text) {
  return element("th", {{"class", look}, {"scope", "col"}}, escaped(text));
}
std::string table(const std::string& name, const std::string& head, const std::string& rows) {
  return element(
      "div", {{"class", "wide"}, {"role", "region"}, {"aria-label", name}, {"tabindex", "0"}},
      element("table", {}, element("thead", {}, element("tr", {}, head)) + element("tbody", {}, rows)));
}

// Of a text in letters; those of Chinese count twice.
std::size_t breadth(const std::string& text) {
  std::size_t letters = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    letters += byte < 0x80 || (byte >= 0xC0 && byte < 0xE3) ? 1 : byte >= 0xE3 ? 2 : 0;
  }
  return letters;
}

// On paper on one page, if it fits on one.
std::string together(const std::string& html) { return element("div", {{"class", "together"}}, html); }
// A short table with its title; a long one goes on on the next page, with its head.
std::string rows_together(std::size_t rows, const std::string& html) {
  constexpr std::size_t few = 8;
  return rows <= few ? together(html) : html;
}

class RecordPage {
 public:
  explicit RecordPage(const ReportView& view)
      : view_(view),
        say(view.say),
        scene_(view.scene),
        record_(view.record),
        sheet_(view.content.sheet),
        job_(view.content.sheet.job),
        jacks_(jack_records(view.scene, view.record, view.content.sheet.job)) {}

  std::string operator()() {
    std::string stages;
    for (const JackRecord& jack : jacks_) stages += stage_table(jack);
    if (!jacks_.empty()) stages += paragraph("note", escaped(stage_note()));
    const std::string forces = force_table(), losses = loss_table();
    return element("section", {{"class", "record"}},
                   element("h1", {}, escaped(say("Stressing record"))) + head() + instruments() + stages +
                       losses + forces + together(result() + signatures()));
  }

 private:
  // Name and value; what is not known is a line to write on.
  std::string entry(const std::string& name, const std::string& value) const {
    return element(
        "div", {{"class", value.empty() ? "entry open-line" : "entry"}},
        element("span", {{"class", "note"}}, escaped(name)) + " " + element("span", {}, escaped(value)));
  }
  std::string head() const {
    const auto hashed = [](const std::string& file, const std::string& hash) {
      return hash.empty() ? file : file + " \u00b7 " + hash;
    };
    std::string cables;
    for (const CableDescription& cable : scene_.cables)
      if (cable.is_jacked(0) || cable.is_jacked(1)) cables += (cables.empty() ? "" : ", ") + cable.name;
    const std::string date = !job_.date.empty() ? job_.date : sheet_.began;
    std::string html = entry(say("Project"), job_.project) + entry(say("Structure"), scene_.name) +
                       entry(say("Cable"), shortened(cables, 60)) + entry(say("Drawing"), job_.drawing) +
                       entry(say("Contractor"), job_.contractor) + entry(say("Date"), date) +
                       entry(say("Crew"), job_.crew) + entry(say("Witness"), job_.witness);
    html = element("div", {{"class", "entries"}}, html);
    return html + element("p", {{"class", "files"}},
                          escaped(say("Scene")) + " <code>" +
                              escaped(hashed(view_.content.scene_file, sheet_.scene_hash)) + "</code><br/>" +
                              escaped(say("Log")) + " <code>" +
                              escaped(hashed(view_.content.log_file, sheet_.log_hash)) + "</code><br/>" +
                              escaped(say("SHA-256 of the files; taut {1}", {sheet_.version})));
  }

  // Of every column that is read: what the scene says of it, and the job.
  std::string instruments() const {
    std::string rows;
    std::size_t count = 0;
    const auto force = [](double newtons) {
      const ForceUnit unit = ForceUnit::for_largest(newtons);
      return significant(unit.of(newtons), 2) + " " + unit.name;
    };
    const auto stroke = [](double metres) { return significant(mm * metres, 2) + " mm"; };
    const auto add = [&](const std::string& column, const InstrumentDescription& known, const auto& amount) {
      const auto found = job_.instruments.find(column);
      if (!known.is_given && !known.is_assumed && found == job_.instruments.end()) return;
      const JobInstrument named = found == job_.instruments.end() ? JobInstrument() : found->second;
      const auto text = [&](const std::optional<double>& value) {
        return value ? amount(*value) : std::string(en_dash);
      };
      const std::string gain =
          known.gain_sd ? significant(100 * *known.gain_sd, 2) + " %" : std::string(en_dash);
      ++count;
      rows += element("tr", {},
                      cell("name", column) + cell("text", named.id) + cell("text", named.calibrated) +
                          cell("text", named.certificate) +
                          cell("number", known.exact ? say("exact") : text(known.sd)) +
                          cell("number", known.exact ? "" : gain) +
                          cell("number", known.exact ? "" : text(known.zero_sd)) +
                          cell("short", known.calibration.empty() ? "" : say("by table")));
    };
    for (const CableDescription& cable : scene_.cables) {
      for (std::size_t end = 0; end < 2; ++end) {
        const std::string name = cable.name + "." + end_name(end);
        add(name, cable.cell[end], force);
        add(name + ".stroke", cable.stroke[end], stroke);
      }
      for (std::size_t i = 0; i < cable.force.size(); ++i)
        add(cable.name + ".T" + std::to_string(i + 1), cable.force[i], force);
    }
    for (std::size_t i = 0; i < scene_.struts.size(); ++i)
      add("strut" + std::to_string(i + 1), scene_.struts[i].gauge, force);
    if (count == 0) return "";
    return rows_together(
        count, heading(say("Instruments")) +
                   table(say("Instruments"),
                         head_cell("name", say("Column")) + head_cell("text", say("Identity")) +
                             head_cell("text", say("Calibrated")) + head_cell("text", say("Certificate")) +
                             head_cell("number", say("sd")) + head_cell("number", say("Gain \u00b1")) +
                             head_cell("number", say("Zero \u00b1")) + head_cell("short", say("Calibration")),
                         rows));
  }

  std::string kind_word(const StageLine& line) const {
    if (!line.name.empty()) return line.name;
    switch (line.stage.kind) {
      case LoadStage::Kind::reference:
      case LoadStage::Kind::passed:
        return say("on the way");
      case LoadStage::Kind::hold:
        return say("hold");
      case LoadStage::Kind::turn:
        return say("turn");
      case LoadStage::Kind::locked:
        return say("locked off");
      case LoadStage::Kind::last:
        return say("end");
    }
    return "";
  }
  static std::string off(const std::optional<double>& part) {
    return part ? (*part < 0 ? "\u2212" : "+") + fixed(100 * std::fabs(*part), 1) + " %" : std::string();
  }
  static std::string length(const std::optional<double>& metres) {
    return metres ? fixed(mm * *metres, 1) : std::string();
  }

  std::string stage_table(const JackRecord& jack) {
    const std::string name = scene_.cables[jack.cable].name + "." + end_name(jack.end);
    const bool has_strokes = std::any_of(jack.lines.begin(), jack.lines.end(),
                                         [](const StageLine& line) { return line.net.has_value(); });
    std::string rows;
    for (std::size_t i = 0; i < jack.lines.size(); ++i) rows += stage_row(jack, i, name);
    for (const std::size_t s : jack.missed) {
      const double force = *job_.stages[s].force[jack.cable][jack.end];
      rows += element(
          "tr", {{"class", "fails"}},
          cell("short", job_.stages[s].name) + cell("number", "") + cell("number", view_.unit.number(force)) +
              element("td", {{"class", "text"}, {"colspan", "7"}}, escaped(say("was not reached"))));
      fail(say("{1}: a required stage of {2} was not reached", {name, view_.unit.text(force)}));
    }
    const std::string unit = " [" + std::string(view_.unit.name) + "]";
    std::string html =
        heading(say("Jack {1}", {name})) +
        table(say("Jack {1}", {name}),
              head_cell("short", say("Stage")) + head_cell("number", say("Time [s]")) +
                  head_cell("number", say("Required") + unit) + head_cell("number", say("Measured") + unit) +
                  head_cell("number", say("Difference")) + head_cell("number", say("Expected [mm]")) +
                  head_cell("number", say("Stroke [mm]")) + head_cell("number", say("Net [mm]")) +
                  head_cell("number", say("Difference")) + head_cell("short", say("Result")),
              rows);
    if (const std::string note = jack_note(jack, has_strokes); !note.empty())
      html += paragraph("note", escaped(note));
    return rows_together(jack.lines.size() + jack.missed.size(), html);
  }
  std::string jack_note(const JackRecord& jack, bool has_strokes) const {
    if (!has_strokes)
      return any_line([](const StageLine& line) { return line.net.has_value(); })
                 ? say("No stroke was measured.")
                 : "";
    if (!jack.wedge_set) return "";
    std::string note = say("Wedge set: {1} mm measured", {fixed(mm * *jack.wedge_set, 1)});
    if (jack.expected_wedge_set) note += say(", {1} mm expected", {fixed(mm * *jack.expected_wedge_set, 1)});
    return note + ".";
  }
  // Of all jacks.
  std::string stage_note() const {
    std::string note;
    if (any_line([](const StageLine& line) { return line.required.has_value(); }) ||
        std::any_of(jacks_.begin(), jacks_.end(),
                    [](const JackRecord& jack) { return !jack.missed.empty(); }))
      note += say("Forces may differ by {1} %.", {significant(100 * job_.force_tolerance, 3)}) + " ";
    if (!any_line([](const StageLine& line) { return line.net.has_value(); }))
      return note + say("No stroke was measured.");
    return note + say("Expected: with the friction and the stiffness of the scene, for the measured force. "
                      "Net: what the stroke has grown by since the first stage, and what was expected there. "
                      "From half of the largest force on it may differ by {1} %.",
                      {significant(100 * elongation_tolerance(job_), 3)});
  }
  template <class Is>
  bool any_line(const Is& is) const {
    return std::any_of(jacks_.begin(), jacks_.end(), [&](const JackRecord& jack) {
      return std::any_of(jack.lines.begin(), jack.lines.end(), is);
    });
  }
  std::string stage_row(const JackRecord& jack, std::size_t i, const std::string& name) {
    const StageLine& line = jack.lines[i];
    const LoadStage& stage = line.stage;
    const bool is_good_force = line.passes_force(job_), is_good_net = line.passes_elongation(job_);
    const std::string force = view_.unit.text(stage.force);
    if (!is_good_force)
      fail(say("{1}: the force at {2} is {3} off the required one", {name, force, off(line.force_off)}));
    if (!is_good_net)
      fail(say("{1}: the elongation at {2} is {3} off the expected one",
               {name, force, off(line.elongation_off)}));
    const bool is_judged = line.force_off || (line.is_judged && line.elongation_off);
    judged_ = judged_ || is_judged;
    const std::string result = line.is_reference                 ? say("reference")
                               : !(is_good_force && is_good_net) ? say("fails")
                               : is_judged                       ? say("passes")
                                                                 : std::string();
    const std::string time =
        view_.time_text(stage.first_time - view_.origin) +
        (stage.first_row == stage.last_row ? "" : en_dash + view_.time_text(stage.last_time - view_.origin));
    return element("tr", {{"class", is_good_force && is_good_net ? "" : "fails"}},
                   cell("short", kind_word(line)) + cell("number", time) +
                       cell("number", line.required ? view_.unit.number(*line.required) : "") +
                       cell("number", view_.unit.number(stage.force)) + cell("number", off(line.force_off)) +
                       cell("number", length(stage.expected)) + cell("number", length(stage.stroke)) +
                       cell("number", length(line.net)) + cell("number", off(line.elongation_off)) +
                       cell("short", result));
  }

  std::string loss_table() const {
    std::string rows;
    const auto part = [](double loss, double of) {
      return of > 0 ? " (" + fixed(100 * loss / of, 1) + " %)" : "";
    };
    std::size_t count = 0;
    for (const CableLosses& cable : cable_losses(scene_, record_)) {
      ++count;
      const auto lost = [&](double from, double to) {
        return view_.unit.number(from - to) + part(from - to, from);
      };
      rows += element("tr", {},
                      cell("name", scene_.cables[cable.cable].name) +
                          cell("number", view_.unit.number(cable.jack)) +
                          cell("number", lost(cable.jack, cable.least_then)) +
                          cell("number", lost(cable.jack, cable.at_jack_now)) +
                          cell("number", view_.unit.number(cable.mean_then)) +
                          cell("number", view_.unit.number(cable.mean_now)));
    }
    if (count == 0) return "";
    const std::string unit = " [" + std::string(view_.unit.name) + "]";
    return rows_together(
        count, heading(say("Losses")) +
                   table(say("Losses"),
                         head_cell("name", say("Cable")) + head_cell("number", say("Largest force") + unit) +
                             head_cell("number", say("By friction then") + unit) +
                             head_cell("number", say("At the jack since") + unit) +
                             head_cell("number", say("Mean then") + unit) +
                             head_cell("number", say("Mean now") + unit),
                         rows));
  }

  // One cell line of the table of forces: name, force, half of the band, target, difference, result.
  std::string segment_cells(std::size_t c, std::size_t i, std::size_t s) {
    const CableDescription& cable = scene_.cables[c];
    const double force = record_.end.tension[s], half = band_width * record_.end.deviation[s];
    const std::string name =
        (scene_.cables.size() > 1 ? cable.name + " " : "") + segment_name(scene_, cable, i, say);
    std::string target, difference, result;
    if (s < sheet_.target.size() && sheet_.target[s] > 0) {
      target = view_.unit.number(sheet_.target[s]);
      difference = off(force / sheet_.target[s] - 1);
    }
    // A band that lies across a limit neither keeps it nor breaks it.
    const double most = std::min(sheet_.most_force.value_or(HUGE_VAL),
                                 s < sheet_.most_segment.size() ? sheet_.most_segment[s] : HUGE_VAL);
    const bool has_limits = most < HUGE_VAL || sheet_.least_force > 0;
    if (force - half > most || force + half < sheet_.least_force) {
      result = say("beyond its limit");
      fail(say("{1}: {2} is beyond its limit", {cable.name, segment_name(scene_, cable, i, say)}));
    } else if (has_limits) {
      result = force + half > most || force - half < sheet_.least_force ? say("at its limit") : say("within");
    }
    judged_ = judged_ || has_limits;
    return name_cell(name) + cell("number", view_.unit.number(force)) +
           cell("number", "\u00b1 " + view_.unit.deviation(half)) +
           (has_targets() ? cell("number", target) + cell("number", difference) : "") +
           (has_some_limits() ? cell("short", result) : "");
  }
  // Long ones have more than one line.
  std::string name_cell(const std::string& name) {
    longest_ = std::max(longest_, breadth(name));
    return cell("name", name);
  }
  std::string strut_cells(std::size_t i) {
    const auto& nodes = scene_.struts[i].nodes;
    const auto& known = view_.content.struts;
    const bool has_band = i < known.size();
    const double force = has_band ? known[i].force : record_.end.strut[i];
    return name_cell(say("strut {1} ({2}\u2013{3})",
                         {std::to_string(i + 1), node_name(scene_, nodes[0]), node_name(scene_, nodes[1])})) +
           cell("number", view_.unit.number(force)) +
           cell("number", has_band ? "\u00b1 " + view_.unit.deviation(band_width * known[i].deviation) : "") +
           (has_targets() ? cell("number", "") + cell("number", "") : "") +
           (has_some_limits() ? cell("short", "") : "");
  }
  bool has_targets() const {
    return std::any_of(sheet_.target.begin(), sheet_.target.end(), [](double force) { return force > 0; });
  }
  bool has_some_limits() const {
    return sheet_.least_force > 0 || sheet_.most_force ||
           std::any_of(sheet_.most_segment.begin(), sheet_.most_segment.end(),
                       [](double force) { return force < HUGE_VAL; });
  }

  std::string force_table() {
    if (record_.rows == 0) return "";
    std::vector<std::string> lines;
    std::size_t s = 0;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t i = 0; i < scene_.cables[c].segments(); ++i) lines.push_back(segment_cells(c, i, s++));
    for (std::size_t i = 0; i < record_.end.strut.size(); ++i) lines.push_back(strut_cells(i));
    // Few have room below each other. On half of the paper's width, names have what other columns leave of
    // it.
    constexpr std::size_t few = 12, letters = 44, letters_of_target = 22, letters_of_limit = 13;
    const std::size_t room =
        letters - (has_targets() ? letters_of_target : 0) - (has_some_limits() ? letters_of_limit : 0);
    const std::size_t abreast = lines.size() > few && longest_ <= room ? forces_abreast : 1;
    const std::size_t height = (lines.size() + abreast - 1) / abreast;
    std::string head, rows;
    const std::string unit = " [" + std::string(view_.unit.name) + "]";
    const std::string one =
        head_cell("name", say("Segment or strut")) + head_cell("number", say("Force") + unit) +
        head_cell("number", say("95 % band")) +
        (has_targets() ? head_cell("number", say("Target") + unit) + head_cell("number", say("Difference"))
                       : "") +
        (has_some_limits() ? head_cell("short", say("Limit")) : "");
    for (std::size_t k = 0; k < abreast; ++k) head += one;
    for (std::size_t i = 0; i < height; ++i) {
      std::string row;
      for (std::size_t k = 0; k < abreast; ++k)
        if (i + k * height < lines.size()) row += lines[i + k * height];
      rows += element("tr", {}, row);
    }
    const std::string title =
        is_locked_off() ? say("Forces after lock-off") : say("Forces {1}", {view_.at_end()});
    return rows_together(height, heading(title) + table(title, head, rows));
  }
  bool is_locked_off() const {
    if (!view_.content.end.empty() || jacks_.empty()) return false;
    return std::all_of(jacks_.begin(), jacks_.end(), [](const JackRecord& jack) {
      return jack.lines.back().stage.kind == LoadStage::Kind::locked;
    });
  }

  void fail(const std::string& reason) {
    constexpr std::size_t most = 5;
    if (++failures_ <= most) reasons_ += element("li", {}, escaped(reason));
    if (failures_ == most + 1) reasons_ += element("li", {}, "\u2026");
  }
  std::string result() const {
    if (record_.rows == 0 || !view_.content.end.empty())
      return heading(say("Result")) +
             paragraph("warning", element("strong", {}, escaped(say("Not complete"))) + " " +
                                      escaped(say(view_.content.end)));
    const bool is_trusted = is_trust(record_.end.verdict);
    std::string said = failures_ > 0 ? say("Fails")
                       : !is_trusted ? say("In doubt")
                       : judged_     ? say("Passes")
                                     : say("Nothing to judge by");
    std::string why = failures_ > 0 ? ""
                      : !is_trusted ? say(record_.end.verdict)
                      : judged_     ? say("all that was required is within its tolerance")
                                    : say("no required force, stroke, target or limit was given");
    std::string html = element("strong", {}, escaped(said)) + (why.empty() ? "" : escaped(say(": ") + why));
    if (!reasons_.empty()) html += element("ul", {}, reasons_);
    html = element("div", {{"class", failures_ > 0 || !is_trusted ? "warning" : "summary"}}, html);
    if (!job_.remarks.empty()) html += paragraph("note", escaped(job_.remarks));
    return heading(say("Result")) + html;
  }
  std::string signatures() const {
    std::string boxes;
    for (const char* who : {"Contractor", "Supervision", "Designer"})
      boxes += element("div", {{"class", "signature"}},
                       element("span", {{"class", "note"}}, escaped(say(who))) +
                           element("span", {{"class", "note"}}, escaped(say("name, signature, date"))));
    return element("div", {{"class", "signatures"}}, boxes);
  }

  const ReportView& view_;
  const Words& say;
  const SceneDescription& scene_;
  const RunRecord& record_;
  const StressingSheet& sheet_;
  const Job& job_;
  std::vector<JackRecord> jacks_;
  std::string reasons_;
  std::size_t failures_ = 0;
  bool judged_ = false;
  std::size_t longest_ = 0;  // breadth of the names in the table of forces
};

}  // namespace

std::string record_page(const ReportView& view) { return RecordPage(view)(); }

}  // namespace taut::host
