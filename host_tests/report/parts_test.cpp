// What a report is made of.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "lib/files/alarm_words.hpp"
#include "lib/kinds/learned_mu.hpp"
#include "lib/report/alarm_meaning.hpp"
#include "lib/report/alarm_record.hpp"
#include "lib/report/axis.hpp"
#include "lib/report/colour_scale.hpp"
#include "lib/report/curve.hpp"
#include "lib/report/html.hpp"
#include "lib/report/number_text.hpp"
#include "lib/report/report_tables.hpp"
#include "lib/report/run_record.hpp"
#include "lib/report/state_strip.hpp"

using taut::Alarm;
using namespace taut::host;

namespace {

LogRow row_number(std::size_t row) {
  LogRow made;
  made.row = row;
  made.time = static_cast<double>(row) / 2;
  return made;
}

SceneDescription one_cable() {
  SceneDescription scene;
  CableDescription cable;
  cable.name = "C";
  cable.path = {0, 1};
  scene.cables = {cable};
  return scene;
}

// The record of rows with these verdicts, row 1 at 0.5 s and so on.
double since(const std::vector<std::string>& verdicts) {
  const SceneDescription scene = one_cable();
  RunRecord record(scene);
  Answer answer;
  answer.tension = {1};
  answer.deviation = {0};
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    LogRow row = row_number(i + 1);
    row.cables.resize(1);
    answer.verdict = verdicts[i];
    record.add(row, answer);
  }
  return record.verdict_since;
}

}  // namespace

TEST_CASE("a verdict has held since forces were trusted or in doubt without a break, for whatever reasons") {
  CHECK(since({"trust"}) == 0.5);
  CHECK(since({"trust", "trust", "trust"}) == 0.5);
  CHECK(since({"do not trust: a"}) == 0.5);
  CHECK(since({"trust", "do not trust: a", "do not trust: b; a", "do not trust: b"}) == 1);
  CHECK(since({"trust", "do not trust: a", "trust", "trust"}) == 1.5);
  CHECK(since({"do not trust: a", "trust", "do not trust: a"}) == 1.5);
}

TEST_CASE("notices are kept apart from alarms, an episode once, and mark no time as one of an alarm") {
  const SceneDescription scene = one_cable();
  RunRecord record(scene);
  Answer answer;
  answer.tension = {1};
  answer.deviation = {0};
  for (std::size_t i = 1; i <= 9; ++i) {
    LogRow row = row_number(i);
    row.cables.resize(1);
    answer.notices = i % 4 >= 2 ? "no-information:C.start" : "";
    answer.alarms = i == 9 ? "mu:C" : "";
    record.add(row, answer);
  }
  REQUIRE(record.notices.runs().size() == 2);
  CHECK(record.notices.runs()[0].first_row == 2);
  CHECK(record.notices.runs()[0].last_row == 3);
  CHECK(record.notices.runs()[1].first_row == 6);
  CHECK(record.alarms.count() == 1);
  const auto& spans = record.alarm_spans.cells();
  CHECK(std::count_if(spans.begin(), spans.end(), [](const AlarmSpan& span) { return span.any; }) == 1);
}

TEST_CASE("a curve of a million points keeps its ends, minima and maxima in a thousand") {
  Curve curve;
  for (int i = 0; i < 1000000; ++i) curve.add(i, i == 123456 ? 7 : i == 777777 ? -5 : std::sin(1e-5 * i));
  const CurvePoints points = curve.points();
  CHECK(points.size() <= Curve::usual_points);
  CHECK(points.size() > Curve::usual_points / 4);
  CHECK(points.front().x == 0);
  CHECK(points.back().x == 999999);
  const auto has = [&](double x, double y) {
    return std::any_of(points.begin(), points.end(), [&](const auto& p) { return p.x == x && p.y == y; });
  };
  CHECK(has(123456, 7));
  CHECK(has(777777, -5));
  CHECK(std::is_sorted(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; }));
}

TEST_CASE("a short curve is kept as it is, with its gaps") {
  Curve curve;
  for (int i = 0; i < 250; ++i) curve.add(i, i == 40 ? std::numeric_limits<double>::quiet_NaN() : i % 7);
  const CurvePoints points = curve.points();
  REQUIRE(points.size() == 250);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(points[i].x == static_cast<double>(i));
    if (i == 40) {
      CHECK(std::isnan(points[i].y));
    } else {
      CHECK(points[i].y == static_cast<double>(i % 7));
    }
  }
}

TEST_CASE("spans of states count every row once") {
  Thinned<StateSpan> spans(10);
  for (std::size_t i = 0; i < 1003; ++i) {
    const auto time = static_cast<double>(i);
    spans.add({time, time, {StateCounts{i % 2, 1 - i % 2, 0, 0}}});
  }
  CHECK(spans.cells().size() <= 10);
  CHECK(spans.cells().front().first_time == 0);
  CHECK(spans.cells().back().last_time == 1002);
  std::size_t rows = 0;
  for (const StateSpan& span : spans.cells()) rows += span.joints[0][0] + span.joints[0][1];
  CHECK(rows == 1003);
}

TEST_CASE("alarms of consecutive rows are one, those after a pause another") {
  AlarmRecord record;
  record.add(row_number(1), "");
  record.add(row_number(2), "mu:C outlier:C.end");
  record.add(row_number(3), "mu:C");
  record.add(row_number(4), "");
  record.add(row_number(5), "mu:C mu:C");
  REQUIRE(record.runs().size() == 3);
  CHECK(record.count() == 3);
  CHECK(record.runs()[0].word == "mu:C");
  CHECK(record.runs()[0].first_row == 2);
  CHECK(record.runs()[0].last_row == 3);
  CHECK(record.runs()[0].last_time == 1.5);
  CHECK(record.runs()[1].word == "outlier:C.end");
  CHECK(record.runs()[1].last_row == 2);
  CHECK(record.runs()[2].first_row == 5);
}

TEST_CASE("an alarm of a limit keeps how far the force went, and when, until its next episode") {
  AlarmRecord record;
  const std::string word = "force-high:C.T3";
  record.add(row_number(1), "");
  record.add(row_number(2), word, {{word, 505}});
  record.add(row_number(3), word, {{word, 523}});
  record.add(row_number(4), word + " mu:C", {{word, 523}});
  record.add(row_number(5), "");
  record.add(row_number(6), word, {{word, 501}});
  REQUIRE(record.runs().size() == 3);
  CHECK(record.runs()[0].has_peak);
  CHECK(record.runs()[0].peak == 523);
  CHECK(record.runs()[0].peak_time == 1.5);
  CHECK_FALSE(record.runs()[1].has_peak);
  CHECK(record.runs()[2].peak == 501);
  CHECK(record.runs()[2].peak_time == 3);
}

TEST_CASE("alarms beyond the longest list are counted") {
  AlarmRecord record;
  const std::size_t rows = 2 * AlarmRecord::most_runs + 200;
  for (std::size_t i = 1; i <= rows; ++i) record.add(row_number(i), i % 2 == 0 ? "sensor:C.start" : "");
  CHECK(record.runs().size() == AlarmRecord::most_runs);
  CHECK(record.count() == rows / 2);
  CHECK(record.further().at("sensor:C.start") == 100);
}

TEST_CASE("alarms have words") {
  std::set<std::string> texts{alarm_meaning("no such alarm").means};
  const SceneDescription scene = one_cable();
  // Every kind that there is, as it is written, has its own; the gauges of struts and segments have one.
  for (int kind = 0; kind <= static_cast<int>(Alarm::Kind::early_unlock); ++kind) {
    if (static_cast<Alarm::Kind>(kind) == Alarm::Kind::segment) continue;
    const std::string word = alarm_word(Alarm::of(static_cast<Alarm::Kind>(kind), 0, 0), scene);
    CAPTURE(word);
    const AlarmMeaning meaning = alarm_meaning(word);
    CHECK(texts.insert(meaning.means).second);
    CHECK(std::string(meaning.to_do).size() > 5);
  }
  CHECK(alarm_word(Alarm::of(Alarm::Kind::segment, 0, 0), scene) == "gauge:C.T1");
  CHECK(alarm_place("force-high:a:b.T3") == "a:b.T3");
}

TEST_CASE("what taught a mu is said in a sentence, and that nothing did, too") {
  LearnedFriction learned{"C1", 0.12, 0.04, 0.137, 0.006, {}};
  CHECK(learned_sentence(learned) ==
        "mu of C1: 0.120 \u00b1 0.040, as the scene has it: nothing in the log measured it.");
  learned.sources = {{"C1.start", 412, 0.879}, {"C1.end.stroke", 64, 0.1205}, {"strut2", 1, 0.0005}};
  CHECK(learned_sentence(learned) ==
        "mu of C1: 0.120 \u00b1 0.040 beforehand, 0.137 \u00b1 0.006 now; 88 % of that from C1.start (412 "
        "readings), 12 % from C1.end.stroke (64), less than 1 % from strut2 (1).");
  learned = {"C1.2", 0.12, 0.04, 0.1371, 0.00123, {{"C1.start", 1, 1}}};
  CHECK(learned_sentence(learned) ==
        "mu of C1.2: 0.120 \u00b1 0.040 beforehand, 0.137 \u00b1 0.0012 now; 100 % of that from C1.start (1 "
        "reading).");
}

namespace {

/// The variances of two unknowns of friction.
struct Variances {
  std::array<double, 2> of{};

  const Variances& belief() const { return *this; }
  int friction() const { return 2; }
  double variance(int p) const { return of.at(static_cast<std::size_t>(p)); }
};

}  // namespace

TEST_CASE("an account has what every instrument took from a variance, and columns get their share") {
  SceneDescription scene = one_cable();
  const Alarm cell = Alarm::of(Alarm::Kind::sensor, 0, 0), stroke = Alarm::of(Alarm::Kind::elongation, 0, 1),
              segment = Alarm::of(Alarm::Kind::segment, 0, 0), strut = Alarm::of(Alarm::Kind::strut, -1, 1);
  FrictionAccount account;
  account.begin(Variances{{1.0, 4.0}});
  account.learned(cell, 16, Variances{{0.5, 4.0}});      // information 1 to 2
  account.learned(stroke, 1, Variances{{0.25, 4.0}});    // to 4
  account.learned(cell, 3, Variances{{0.125, 4.0}});     // to 8
  account.learned(segment, 1, Variances{{0.125, 4.0}});  // nothing
  account.learned(strut, 1, Variances{{0.1, 2.0}});      // to 10, and of the other one all there is
  const auto first = sources_of(0, account, scene), second = sources_of(1, account, scene);
  REQUIRE(first.size() == 3);
  CHECK(first[0].column == "C.start");
  CHECK(first[0].readings == 19);
  CHECK(std::fabs(first[0].share - 5.0 / 9) < 1e-12);
  double sum = 0;
  for (const FrictionSource& source : first) {
    sum += source.share;
    if (source.column == "C.start") continue;
    CHECK((source.column == "C.end.stroke" || source.column == "strut2"));
    CHECK(source.readings == 1);
    CHECK(std::fabs(source.share - 2.0 / 9) < 1e-12);
  }
  CHECK(std::fabs(sum - 1) < 1e-12);
  REQUIRE(second.size() == 1);
  CHECK(second[0].column == "strut2");
  CHECK(second[0].share == 1);
  CHECK(column_of({Alarm::Kind::segment, 0, 2}, scene) == "C.T3");
  CHECK(column_of({Alarm::Kind::elongation, 0, 0}, scene) == "C.start.stroke");
}

TEST_CASE("text cannot break out of its element") {
  CHECK(escaped("<a href=\"x\">&") == "&lt;a href=&quot;x&quot;&gt;&amp;");
  CHECK(escaped("a\nb\x01") == "a b\xEF\xBF\xBD");
  CHECK(escaped("\xC3\xA9") == "\xC3\xA9");
  CHECK(escaped("\xE9 of Latin-1") == "\xEF\xBF\xBD of Latin-1");
  CHECK(element("p", {{"class", "\"<"}}, "x") == "<p class=\"&quot;&lt;\">x</p>");
  CHECK(shortened("\xC3\xA9\xC3\xA9\xC3\xA9", 3) == "\xC3\xA9\xC3\xA9\xC3\xA9");
  CHECK(shortened("\xC3\xA9\xC3\xA9\xC3\xA9", 2) == "\xC3\xA9\xE2\x80\xA6");
}

TEST_CASE("numbers are legible") {
  CHECK(fixed(-0.0001, 2) == "0.00");
  CHECK(significant(123.4, 2) == "123");
  CHECK(significant(0.01234, 2) == "0.012");
  CHECK(coordinate(2.50) == "2.5");
  CHECK(coordinate(1700000000.25, 2) == "1700000000.25");
  CHECK(ForceUnit::for_largest(98765).text(98765) == "98.77 kN");
  CHECK(ForceUnit::for_largest(12).text(3) == "3.00 N");
  CHECK(ForceUnit::for_largest(0).text(0) == "0.0 N");
  CHECK(ForceUnit::for_largest(5e6).text(5e6) == "5.000 MN");
}

TEST_CASE("axes have round numbers and hold their range") {
  Range range;
  range.include(182.3);
  range.include(204);
  const Axis axis = Axis::round(range, 6);
  CHECK(axis.low == 180);
  CHECK(axis.high == 205);
  REQUIRE(axis.ticks.size() == 6);
  CHECK(axis.ticks[1].label == "185");
  Range one;
  one.include(5);
  CHECK(Axis::round(one, 5).part(5) > 0);
  CHECK(Axis::round(one, 5).part(5) < 1);
  CHECK(Axis::round(Range(), 5).ticks.size() > 1);
  CHECK(Axis::counted(256, 16).ticks.size() <= 17);
}

TEST_CASE("equal forces have no colours of noise, and no forces none at all") {
  const ForceScale equal({1000, 1000.1, 999.9});
  CHECK(equal.low < 960);
  CHECK(equal.look(1000) == equal.look(999.9));
  CHECK(ForceScale({0, 0}).look(0) == "c0");
  const ForceScale wide({100, 200});
  CHECK(wide.look(100) == "c0");
  CHECK(wide.look(200) == "c31");
}
