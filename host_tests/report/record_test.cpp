// The record that is signed: its numbers by hand, its words in all languages, the files that it names.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "files/run_program.hpp"
#include "lib/files/date_time.hpp"
#include "lib/files/sha256.hpp"
#include "lib/files/status_text.hpp"
#include "lib/files/verdict.hpp"
#include "lib/report/alarm_meaning.hpp"
#include "lib/report/stressing_record.hpp"
#include "lib/report/words.hpp"
#include "report/well_formed.hpp"

using namespace taut::host;
namespace fs = std::filesystem;

namespace {

/// Two segments over one saddle, 1 m and 3 m long, jacked at its end.
SceneDescription two_segments() {
  SceneDescription scene;
  for (const double x : {0.0, 1.0, 4.0}) {
    NodeDescription node;
    node.name = std::string(1, static_cast<char>('a' + scene.nodes.size()));
    node.at = {x, 0, 0};
    scene.nodes.push_back(node);
  }
  CableDescription cable;
  cable.name = "C";
  cable.path = {0, 1, 2};
  cable.mu = {0.1};
  cable.ends[1] = taut::End::jacked;
  scene.cables.push_back(cable);
  return scene;
}

/// A tensioning in stages of 200 kN, with a stroke that is expected to grow by 0.1 mm a kN.
struct Jacking {
  SceneDescription scene = two_segments();
  RunRecord record{scene};
  LogRow row;
  double off = 0;  // of the strokes, relative
  std::string alarms;

  explicit Jacking(double strokes_off) : off(strokes_off) { row.cables.resize(1); }

  // Slack and the place of the mark come to 27 mm.
  void stage(double force, bool locked = false, double wedge = 0) {
    row.row++;
    row.time += 600;
    EndRow& end = row.cables[0][1];
    end.force = force;
    end.reading = force;
    end.locked = locked;
    end.stroke = 0.027 + (1 + off) * 1e-7 * force - wedge;
    Answer answer, expected;
    answer.tension = {0.8 * force, locked ? 0.9 * force : force};
    answer.deviation = {1, 1};
    answer.mu = answer.mu_deviation = answer.slip = answer.contact = answer.friction_used = {0};
    answer.state = {taut::JointState::stick};
    answer.verdict = std::string("trust");
    answer.alarms = alarms;
    expected.extension = {{0, 1e-7 * force - wedge}};
    record.add(row, answer, &expected);
  }
  Jacking& whole() {
    for (const double force : {2e5, 4e5, 6e5, 8e5, 1e6}) stage(force);
    stage(1e6, true, 0.006);
    return *this;
  }
};

std::string job_of(const Scratch& scratch, const std::string& text) {
  std::ofstream(scratch.path / "job.json") << text;
  return " --job " + scratch.quoted("job.json");
}

constexpr const char* band = R"({ "taut": 1, "name": "band", "dimension": 2,
  "nodes": { "a": [0, 0], "b": [20, -1], "c": [40, 0] }, "supports": { "a": "xy", "b": "xy", "c": "xy" },
  "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 1.95e11, "A": 1e-3, "start": "anchored", "end": "jacked",
                "seating": 0.005, "friction": { "law": "point", "mu": 0.15, "mu_sd": 0.03 } } ],
  "sensors": { "C.end": { "sd": 500 }, "C.end.stroke": { "sd": 0.001, "zero": "free" } } })";

Outcome report_on(const Scratch& scratch, const std::string& log, const std::string& options) {
  std::ofstream(scratch.path / "scene.json") << band;
  std::ofstream(scratch.path / "log.csv") << log;
  return run_taut(scratch, "report " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv") +
                               " -o " + scratch.quoted("page.html") + options);
}

// Two straight parts that hardly bend: the extension is F L / E A, less what friction takes, mu 2 atan(1/20).
std::string log_with_strokes(double part) {
  std::string log = "time [min],C.end [kN],C.end.stroke [mm],C.end.locked\n";
  const double L = std::hypot(20.0, 1.0), held = std::exp(-0.15 * 2 * std::atan(1 / 20.0));
  double minutes = 0;
  for (const double kN : {100, 200, 300, 400, 500}) {
    const double metres = kN * 1e3 * L * (1 + held) / (1.95e11 * 1e-3);
    log += std::to_string(minutes += 10) + "," + std::to_string(kN) + "," +
           std::to_string(12 + 1e3 * part * metres) + ",0\n";
  }
  return log;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The literals of the first argument of every call of this function in a source, neighbours joined.
std::vector<std::string> said_in(const std::string& source, const std::string& function) {
  std::vector<std::string> found;
  for (std::size_t at = source.find(function + "("); at != std::string::npos;
       at = source.find(function + "(", at + 1)) {
    if (at > 0 && (std::isalnum(static_cast<unsigned char>(source[at - 1])) || source[at - 1] == '_'))
      continue;
    std::string literal;
    bool is_open = false;
    int depth = 0;
    for (std::size_t i = at + function.size(); i < source.size(); ++i) {
      const char c = source[i];
      if (c == '"') {
        is_open = true;
        for (++i; source[i] != '"'; ++i) {
          if (source.compare(i, 6, "\\u2013") == 0)
            literal += "\u2013", i += 5;
          else if (source.compare(i, 6, "\\u00b1") == 0)
            literal += "\u00b1", i += 5;
          else if (source[i] == '\\')
            literal += source[++i];
          else
            literal += source[i];
        }
        continue;
      }
      if (std::isspace(static_cast<unsigned char>(c))) continue;
      if (is_open) found.push_back(literal);
      literal.clear();
      is_open = false;
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      if (depth == 0 || c == '{' || (c == ',' && depth == 1)) break;
    }
  }
  return found;
}

// The first English pattern of a sentence that the table does not have; empty if it has all.
std::string without_words(const Sentence& sentence) {
  if (sentence.is_itself()) return "";
  const bool is_known = std::any_of(begin_of_words(), end_of_words(),
                                    [&](const Translation& row) { return row.english == sentence.words(); });
  if (!is_known) return sentence.words();
  for (const Sentence& part : sentence.parts())
    if (const std::string unknown = without_words(part); !unknown.empty()) return unknown;
  return "";
}

std::set<std::string> places_in(const std::string& pattern) {
  std::set<std::string> places;
  for (std::size_t at = pattern.find('{'); at != std::string::npos; at = pattern.find('{', at + 1))
    places.insert(pattern.substr(at, 3));
  return places;
}

/// With these required forces of the only jack, a stage each [N].
Job job_of(const std::vector<double>& forces) {
  Job job;
  for (const double force : forces) {
    JobStage stage;
    stage.force = {{std::nullopt, force}};
    job.stages.push_back(stage);
  }
  return job;
}

}  // namespace

TEST_CASE(
    "the net elongation has neither slack nor the mark's zero in it, and is compared with the expected one") {
  Jacking jacking(0.03);
  jacking.whole();
  Job job;
  auto jacks = jack_records(jacking.scene, jacking.record, job);
  REQUIRE(jacks.size() == 1);
  const auto& lines = jacks[0].lines;
  REQUIRE(lines.size() == 6);
  CHECK(lines[0].is_reference);
  // At 200 kN 20 mm are expected, and are the reference; to 1000 kN there are 80 mm more, 82.4 with 3 %.
  CHECK(*lines[0].net == doctest::Approx(0.020));
  CHECK(*lines[4].stage.expected == doctest::Approx(0.100));
  CHECK(*lines[4].stage.stroke == doctest::Approx(0.130));
  CHECK(*lines[4].net == doctest::Approx(0.1024));
  CHECK(*lines[4].elongation_off == doctest::Approx(0.024));
  CHECK(lines[4].passes_elongation(job));
  // Below half of the largest force the reading of the stroke counts for too much.
  CHECK_FALSE(lines[1].is_judged);
  CHECK(lines[2].is_judged);
  // The wedge, beside what is computed; no elongation is judged behind it.
  CHECK(lines[5].stage.kind == LoadStage::Kind::locked);
  CHECK_FALSE(lines[5].elongation_off);
  CHECK(*jacks[0].wedge_set == doctest::Approx(0.006));
  CHECK(*jacks[0].expected_wedge_set == doctest::Approx(0.006));

  job.elongation_tolerance = 0.02;
  jacks = jack_records(jacking.scene, jacking.record, job);
  CHECK_FALSE(jacks[0].lines[4].passes_elongation(job));
}

TEST_CASE("required stages are found one after the other, and one that was not reached is said") {
  Jacking jacking(0);
  jacking.whole();
  Job job = job_of({4.04e5, 7.5e5, 1e6});
  const auto jacks = jack_records(jacking.scene, jacking.record, job);
  REQUIRE(jacks.size() == 1);
  CHECK(*jacks[0].lines[1].required == 4.04e5);
  CHECK(*jacks[0].lines[1].force_off == doctest::Approx(4e5 / 4.04e5 - 1));
  CHECK(jacks[0].lines[1].passes_force(job));  // 1 % of 2 %
  CHECK(jacks[0].missed == std::vector<std::size_t>{1});
  CHECK(*jacks[0].lines[4].required == 1e6);
  job.force_tolerance = 0.005;
  CHECK_FALSE(jacks[0].lines[1].passes_force(job));
}

TEST_CASE("a required stage that was passed without a rest is on the record where the jack passed it") {
  Jacking jacking(0);
  // One pull in rows of a second.
  for (int i = 1; i <= 50; ++i) {
    jacking.stage(2e4 * i);
    jacking.row.time -= 599;
  }
  const Job job = job_of({4.07e5, 1e6, 1.2e6});
  const auto jacks = jack_records(jacking.scene, jacking.record, job);
  REQUIRE(jacks.size() == 1);
  const auto& lines = jacks[0].lines;
  REQUIRE(lines.size() == 3);  // with the reference at a tenth
  CHECK(lines[1].stage.kind == LoadStage::Kind::passed);
  CHECK(*lines[1].required == 4.07e5);
  CHECK(*lines[1].force_off == doctest::Approx(4e5 / 4.07e5 - 1));
  CHECK(*lines[2].required == 1e6);
  CHECK(jacks[0].missed == std::vector<std::size_t>{2});
}

TEST_CASE("of stages near a required force the nearest is taken, and not one after the jack has gone on") {
  Jacking jacking(0);
  for (const double force : {9.6e5, 1e6, 5e5, 9.99e5}) jacking.stage(force);
  const Job job = job_of({1e6});
  const auto jacks = jack_records(jacking.scene, jacking.record, job);
  REQUIRE(jacks.size() == 1);
  std::vector<double> required;
  for (const StageLine& line : jacks[0].lines)
    if (line.required) required.push_back(line.stage.force);
  CHECK(required == std::vector<double>{1e6});
}

TEST_CASE("an outlier counts as a stage if it lies between the readings about it, and not if it sticks out") {
  for (const bool sticks_out : {false, true}) {
    CAPTURE(sticks_out);
    Jacking jacking(0);
    for (const double force : {2e5, 4e5, 6e5, 8e5, 1e6}) {
      jacking.alarms = force == 6e5 ? "outlier:C.end" : "";
      jacking.stage(force == 6e5 && sticks_out ? 3e6 : force);
    }
    const auto jacks = jack_records(jacking.scene, jacking.record, Job());
    REQUIRE(jacks.size() == 1);
    CHECK(jacks[0].lines.size() == (sticks_out ? 4 : 5));
    CHECK(jacks[0].largest == 1e6);
  }
}

TEST_CASE("losses are those of friction at the largest load, and of the segment at the jack since") {
  Jacking jacking(0);
  jacking.whole();
  const auto losses = cable_losses(jacking.scene, jacking.record);
  REQUIRE(losses.size() == 1);
  CHECK(losses[0].jack == 1e6);
  CHECK(losses[0].least_then == 8e5);
  CHECK(losses[0].at_jack_now == 9e5);
  // Over 1 m and 3 m.
  CHECK(losses[0].mean_then == doctest::Approx((1 * 8e5 + 3 * 1e6) / 4));
  CHECK(losses[0].mean_now == doctest::Approx((1 * 8e5 + 3 * 9e5) / 4));
}

TEST_CASE(
    "a record passes where strokes are as computed, and fails where the cable is 10 % softer or stiffer") {
  for (const double part : {1.0, 1.1, 0.9}) {
    CAPTURE(part);
    const Scratch scratch;
    REQUIRE(report_on(scratch, log_with_strokes(part), "").status == 0);
    const std::string page = text_of(scratch.path / "page.html");
    CHECK(WellFormed(page)() == "");
    CHECK(has(page, "<strong>Passes</strong>") == (part == 1.0));
    CHECK(has(page, "<strong>Fails</strong>") == (part != 1.0));
    if (part == 1.0) CHECK(has(page, "all that was required is within its tolerance"));
  }
}

TEST_CASE("a record names project, instruments, required stages, and both files by their hash") {
  const Scratch scratch;
  const std::string job = R"({ "taut": 1, "project": "A < B & \"C\"", "crew": "<script>alert(1)</script>",
    "instruments": { "C.end": { "id": "LC<7>", "calibrated": "2026-05-04", "certificate": "K-1" } },
    "stages": [ { "name": "one <b>", "C.end": 1e5 }, { "C.end": 5e5 }, { "name": "more", "C.end": 6e5 } ],
    "tolerance": { "elongation": 0.07, "force": 0.01 } })";
  REQUIRE(report_on(scratch, log_with_strokes(1.0), job_of(scratch, job)).status == 0);
  const std::string page = text_of(scratch.path / "page.html");
  CHECK(WellFormed(page)() == "");
  for (const char* part : {"A &lt; B &amp; &quot;C&quot;", "&lt;script&gt;alert(1)", "LC&lt;7&gt;",
                           "one &lt;b&gt;", "was not reached", "Forces may differ by 1.00 %",
                           "it may differ by 7.00 %", "<strong>Fails</strong>"}) {
    CAPTURE(part);
    CHECK(has(page, part));
  }
  CHECK(has(page, sha256(text_of(scratch.path / "scene.json"))));
  CHECK(has(page, sha256(text_of(scratch.path / "log.csv"))));
}

TEST_CASE("targets and limits of a goal are in the table of forces and in the chart; a broken limit fails") {
  const Scratch scratch;
  std::ofstream(scratch.path / "goal.json")
      << R"({ "taut": 1, "target": { "C": 490e3 }, "limits": { "C": 450e3 } })";
  REQUIRE(report_on(scratch, log_with_strokes(1.0), " --goal " + scratch.quoted("goal.json")).status == 0);
  const std::string page = text_of(scratch.path / "page.html");
  CHECK(has(page, "490.0"));
  CHECK(has(page, "beyond its limit"));
  CHECK(has(page, "<strong>Fails</strong>"));
  CHECK(has(page, "class=\"target\""));
  CHECK(has(page, "class=\"limit\""));
}

TEST_CASE(
    "the date of the log is on the record, and without strokes, targets and limits there is nothing to judge "
    "by") {
  const Scratch scratch;
  REQUIRE(
      report_on(scratch, "time,C.end\n2026-03-01T08:05:00,1000\n2026-03-01T08:15:00,500000\n", "").status ==
      0);
  const std::string page = text_of(scratch.path / "page.html");
  CHECK(has(page, "2026-03-01 08:05"));
  CHECK(has(page, "Nothing to judge by"));
  CHECK(has(page, "No stroke was measured."));
}

TEST_CASE("a job that does not fit is refused with the place, and nothing is written") {
  const std::vector<std::pair<const char*, const char*>> wrong = {
      {R"({ "project": "x" })", "/taut"},
      {R"({ "taut": 2 })", "/taut: version 2"},
      {R"({ "taut": 1, "projekt": "x" })", "projekt"},
      {R"({ "taut": 1, "project": 5 })", "/project"},
      {R"({ "taut": 1, "instruments": { "C.ende": {} } })", "C.end"},
      {R"({ "taut": 1, "instruments": { "C.end": { "number": "7" } } })", "number"},
      {R"({ "taut": 1, "stages": { "C.end": 1e5 } })", "/stages"},
      {R"({ "taut": 1, "stages": [ { "C.start": 1e5 } ] })", "/stages/0/C.start"},
      {R"({ "taut": 1, "stages": [ { "C.end": -1 } ] })", "/stages/0/C.end"},
      {R"({ "taut": 1, "tolerance": { "force": 5 } })", "/tolerance/force"},
      {R"({ "taut": 1, )", "job.json"}};
  for (const auto& each : wrong) {
    const auto& job = each.first;
    const auto& place = each.second;
    CAPTURE(job);
    const Scratch scratch;
    const Outcome outcome = report_on(scratch, log_with_strokes(1.0), job_of(scratch, job));
    CHECK(outcome.status == 2);
    CHECK(has(outcome.err, "job.json"));
    CHECK(has(outcome.err, place));
    CHECK_FALSE(fs::exists(scratch.path / "page.html"));
  }
  const Scratch scratch;
  CHECK(report_on(scratch, log_with_strokes(1.0), " --language fr").status == 2);
  CHECK_FALSE(fs::exists(scratch.path / "page.html"));
}

TEST_CASE("a report speaks the language that it is asked for, names excepted") {
  for (const auto& each :
       {std::pair{"en", "Stressing record"}, {"zh", "张拉记录"}, {"de", "Spannprotokoll"}}) {
    const char* const code = each.first;
    const char* const title = each.second;
    CAPTURE(code);
    const Scratch scratch;
    REQUIRE(report_on(scratch, log_with_strokes(1.1), std::string(" --language ") + code).status == 0);
    const std::string page = text_of(scratch.path / "page.html");
    CHECK(WellFormed(page)() == "");
    CHECK(has(page, std::string("<html lang=\"") + code + "\">"));
    CHECK(has(page, title));
    if (code == std::string("en")) continue;
    for (const char* english :
         {"Stressing record", "at the end of the log", "Force along", "Segment", "joint sticks",
          "What it means", "Signature", "passes", "95 % band", "is taken for", "Remarks"}) {
      CAPTURE(english);
      CHECK_FALSE(has(page, english));
    }
  }
}

TEST_CASE(
    "remarks, and why an answer ends, are said in the language of the report and in English beside it") {
  const std::string scene = R"({ "taut": 1, "name": "n", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0], "c": [2, 0.5] }, "supports": { "a": "xy", "b": "xy", "c": "xy" },
    "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 2e11, "A": 1e-4, "start": "jacked", "end": "jacked",
                  "friction": { "law": "point", "mu": 0.1 } } ],
    "loads": { "dead": { "forces": { "b": [0, -1] } } } })";
  struct Words {
    const char *code, *ends, *remark;
  };
  for (const auto& words :
       {Words{"de", "das Seil wird durchgezogen", "Seil &quot;C&quot; hat kein &quot;mu_sd&quot;"},
        Words{"zh", "索被整体拉过", "索 &quot;C&quot; 没有 &quot;mu_sd&quot;"}}) {
    CAPTURE(words.code);
    const Scratch scratch;
    std::ofstream(scratch.path / "scene.json") << scene;
    std::ofstream(scratch.path / "log.csv")
        << "time,C.start,C.end\n1,10000,10000\n2,20000,20000\n3,20000,40000\n";
    const Outcome outcome =
        run_taut(scratch, "report " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv") +
                              " -o " + scratch.quoted("page.html") + " --language " + words.code);
    CHECK(has(outcome.err,
              "the cable is pulled through: the jack forces differ by more than all friction; "
              "bring the jack forces closer together, or anchor one end"));
    CHECK(has(outcome.err, "remark: cable \"C\" has no \"mu_sd\": half of mu, 0.05, is taken"));
    CHECK(has(outcome.err, "remark: the log has no column \"dead\""));
    const std::string page = text_of(scratch.path / "page.html");
    CHECK(WellFormed(page)() == "");
    CHECK(has(page, words.ends));
    CHECK(has(page, words.remark));
    for (const char* english : {"pulled through", "closer together", "half of mu", "no column", "taken for",
                                "row 3", "line 4", " time "}) {
      CAPTURE(english);
      CHECK_FALSE(has(page, english));
    }
  }
}

TEST_CASE("every text that a report says has its words in every language, with the same places for names") {
  std::set<std::string> known;
  for (const Translation* row = begin_of_words(); row != end_of_words(); ++row) {
    CAPTURE(row->english);
    CHECK(known.insert(row->english).second);
    for (const std::string other : {row->chinese, row->german}) {
      CAPTURE(other);
      CHECK_FALSE(other.empty());
      CHECK(places_in(row->english) == places_in(other));
    }
  }
  std::map<std::string, std::size_t> texts;
  for (const auto& entry : fs::recursive_directory_iterator(TAUT_HOST_SOURCES)) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string source = text_of(entry.path());
    for (const char* function : {"say", "Sentence"})
      for (const std::string& text : said_in(source, function)) {
        CAPTURE(entry.path());
        CAPTURE(text);
        CHECK(known.count(text) == 1);
        ++texts[function];
      }
  }
  CHECK(texts["say"] > 100);
  CHECK(texts["Sentence"] > 50);
  for (const char* kind :
       {"outlier",        "sensor",    "mu",           "stuck",  "elongation", "force-high",   "force-low",
        "no-information", "gauge",     "model-misfit", "frozen", "gain",       "unknown-past", "lift-off",
        "unread",         "late-lock", "early-unlock", "silent", "unreadable", "no such alarm"}) {
    const AlarmMeaning meaning = alarm_meaning(kind);
    CHECK(known.count(meaning.means) == 1);
    CHECK(known.count(meaning.to_do) == 1);
  }
}

TEST_CASE("verdicts are said in other languages with the names that they have") {
  const Words german(Language::german);
  CHECK(german(Verdict().take("")) == "vertrauen");
  for (const char* word :
       {"unknown-past:Seil", "frozen:Seil.start", "model-misfit:Seil.start", "sensor:Seil.start",
        "unread:Seil.end", "late-lock:Seil.end", "elongation:Seil.end", "gauge:strut2", "outlier:Seil.end"}) {
    Verdict verdict;
    Sentence sentence;
    for (int i = 0; i < 10; ++i) sentence = verdict.take(word);
    CAPTURE(sentence.english());
    REQUIRE_FALSE(is_trust(sentence));
    CHECK(without_words(sentence).empty());
    const std::string said = german(sentence);
    CHECK(said != sentence.english());
    CHECK(has(said, "nicht vertrauen: "));
    CHECK_FALSE(has(said, " the "));
    CHECK_FALSE(has(said, "does not"));
    CHECK(has(said, std::string(word).substr(std::string(word).find(':') + 1)));
  }
}

TEST_CASE("what has no words in the table, and what stands for itself, stays as it is") {
  const Words german(Language::german);
  CHECK(german(Sentence("{1}: the moon", {std::string("a node")})) == "a node: the moon");
  CHECK(german(Sentence("{1}: {2}; {3}", {Sentence("a node"), std::string("{2}"), Sentence("the scene")})) ==
        "ein Knoten: {2}; die Szene");
  CHECK(without_words(Sentence("{1}; {2}", {Sentence("the moon"), Sentence("a node")})) == "the moon");
}

TEST_CASE("every reason for which there may be no answer has its words in every language") {
  SceneDescription scene = two_segments();
  scene.dimension = 2;
  StrutDescription strut;
  strut.nodes = {1, 3};
  strut.E = scene.cables[0].E = 2e11;
  strut.A = scene.cables[0].A = 1e-3;
  scene.struts = {strut, strut};
  NodeDescription foot;
  foot.name = "foot";
  foot.at = {1, -1, 0};
  scene.nodes.push_back(foot);
  BeamDescription beam;
  beam.nodes = {0, 2};
  scene.beams.push_back(beam);
  LoadDescription load;
  load.name = "dead";
  scene.loads.push_back(load);
  scene.cables[0].ends[0] = taut::End::jacked;
  SceneDescription leaning = scene;
  leaning.second_order = TargetDescription();
  std::set<std::string> said;
  for (SceneDescription* const of : {&scene, &leaning})
    for (const double mu : {0.0, 0.1})
      for (int code = 1; code <= static_cast<int>(taut::Code::not_started) + 1; ++code)
        for (int place = 0; place <= static_cast<int>(taut::Place::beam); ++place)
          for (int index = -1; index < 5; ++index)
            for (const int cable : {-1, 0}) {
              of->cables[0].mu = {mu};
              const taut::Status status = taut::Status::along(static_cast<taut::Code>(code),
                                                              static_cast<taut::Place>(place), cable, index);
              const Sentence sentence = failure_text(status, *of);
              CAPTURE(sentence.english());
              REQUIRE(without_words(sentence).empty());
              said.insert(sentence.english());
            }
  const auto is_said = [&](const std::string& part) {
    return std::any_of(said.begin(), said.end(), [&](const std::string& text) { return has(text, part); });
  };
  for (const char* part :
       {"tension count", "add a second strut", "runs away (strut 1 from node \"foot\", strut 2",
        "without friction strut 1", "two jacks at work", "load pattern \"dead\"", "rotation of a beam",
        "end of cable \"C\""}) {
    CAPTURE(std::string(part));
    CHECK(is_said(part));
  }
}

TEST_CASE("texts for names are put in as they are, whatever they hold") {
  const Words say;
  CHECK(say("{1} of cable {2}", {"{2}", "{1}"}) == "{2} of cable {1}");
  CHECK(say("Cable {1}", {}) == "Cable {1}");
  CHECK(say("{9}", {"a"}) == "{9}");
}

TEST_CASE("a hash is that of sha256sum") {
  // FIPS 180-4, examples; and lengths about that of a block.
  CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  const Scratch scratch;
  for (const std::size_t length : {54u, 55u, 56u, 57u, 63u, 64u, 65u, 119u, 120u, 128u}) {
    CAPTURE(length);
    std::ofstream(scratch.path / "bytes", std::ios::binary) << std::string(length, '\xe9');
    const std::string command = "sha256sum " + scratch.quoted("bytes") + " > " + scratch.quoted("sum") +
                                " 2> " + scratch.quoted("err");
    if (std::system(command.c_str()) != 0) break;  // not everywhere
    CHECK(text_of(scratch.path / "sum").substr(0, 64) == sha256(std::string(length, '\xe9')));
  }
}

TEST_CASE("a moment is written as it was read, and with a zone in UTC") {
  for (const char* text : {"1970-01-01 00:00", "1969-12-31 23:59", "2000-02-29 12:30", "2026-11-24 09:05",
                           "1900-03-01 00:00", "2100-12-31 23:59", "0001-01-01 00:00", "9999-12-31 23:59"}) {
    CAPTURE(text);
    const auto moment = read_moment(text);
    REQUIRE(moment);
    const std::string written = moment_text(*moment);
    // Years have four digits at least.
    CHECK(std::string(text).substr(std::string(text).size() - written.size()) == written);
  }
  CHECK(moment_text(*read_moment("2026-03-01T00:30:00+02:00")) == "2026-02-28 22:30 UTC");
}
