// Logs: what the reader makes of them.
#include <doctest/doctest.h>

#include <clocale>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "lib/files/input_error.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_file.hpp"

using namespace taut::host;

namespace {

const SceneDescription& scene() {
  static const SceneDescription read = read_scene(R"({ "taut": 1, "name": "n", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0] },
    "cables": [ { "name": "C", "path": ["a", "b"], "E": 1, "A": 1, "start": "jacked", "end": "anchored" } ],
    "loads": { "Fy": { "forces": { "b": [0, 1] } }, "wind": {} } })",
                                                  "f");
  return read;
}

std::vector<LogRow> rows(const std::string& text, const LogRules& rules = {}) {
  std::istringstream stream(text);
  LogReader reader(stream, "log", scene(), rules);
  std::vector<LogRow> all;
  LogRow row = reader.first_row();
  while (reader.next(row)) all.push_back(row);
  return all;
}

std::string refusal(const std::string& text, const LogRules& rules = {}) {
  try {
    rows(text, rules);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Writes and reads 1.5 as 1,5.
struct CommaLocale {
  struct Punctuation : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  std::locale before = std::locale::global(std::locale(std::locale(), new Punctuation));
  CommaLocale() { std::setlocale(LC_ALL, "de_DE.UTF-8"); }  // without effect where it is not installed
  ~CommaLocale() {
    std::setlocale(LC_ALL, "C");
    std::locale::global(before);
  }
};

}  // namespace

TEST_CASE("a log with every kind of column is read") {
  const SceneDescription every_key = read_scene_file(TAUT_FILES "/every_key.json");
  CHECK(check_log(TAUT_FILES "/every_column.csv", every_key, {}) == 4);
}

TEST_CASE("columns may come in any order") {
  const auto read = rows("C.start,Fy,time\n1000,0.5,3\n");
  CHECK(read[0].time == 3);
  CHECK(read[0].factor[0] == 0.5);
  CHECK(read[0].cables[0][0].force == 1000);
}

TEST_CASE("lines may end with carriage returns and the last one without a newline") {
  const auto read = rows("time,Fy\r\n0,1\r\n1,2");
  CHECK(read.size() == 2);
  CHECK(read[1].factor[0] == 2);
}

TEST_CASE("a byte order mark before the header does not count") {
  CHECK(rows("\xEF\xBB\xBFtime,Fy\n0,1\n").size() == 1);
}

TEST_CASE("blank lines at the end do not count") { CHECK(rows("time,Fy\n0,1\n\n \r\n\n").size() == 1); }

TEST_CASE("fields may stand in quotes and between blanks") {
  const auto read = rows("\"time\" , \"Fy\"\n 0 ,\t\"1.5\" \n");
  CHECK(read[0].factor[0] == 1.5);
}

TEST_CASE("an empty field keeps the last load factor, jack force and lock") {
  const auto read = rows("time,Fy,C.start,C.start.locked\n0,2,1000,1\n1,,,\n2,,,0\n");
  CHECK(read[1].factor[0] == 2);
  CHECK(read[1].cables[0][0].force == 1000);
  CHECK(read[1].cables[0][0].locked);
  CHECK(read[2].cables[0][0].force == 1000);
  CHECK_FALSE(read[2].cables[0][0].locked);
}

TEST_CASE("whether an end is locked may be written as any number that is 0 or 1") {
  const auto read = rows("time,C.start.locked\n0,1.0\n1,0.00\n2,1e0\n3,-0\n");
  CHECK(read[0].cables[0][0].locked);
  CHECK_FALSE(read[1].cables[0][0].locked);
  CHECK(read[2].cables[0][0].locked);
  CHECK_FALSE(read[3].cables[0][0].locked);
  CHECK(rows("time;C.start.locked\n0;1,0\n")[0].cables[0][0].locked);
  for (const char* none : {"0.5", "2.0", "true", "1.0x", "1 0", "nan"})
    CHECK(refusal("time,C.start.locked\n0," + std::string(none) + "\n").find("neither locked nor unlocked") !=
          std::string::npos);
}

TEST_CASE("an empty field is no measurement") {
  const auto read = rows("time,C.start.stroke,C.end\n0,0.01,500\n1,,\n");
  CHECK(read[0].cables[0][0].stroke == 0.01);
  CHECK(read[0].cables[0][1].reading == 500.0);
  CHECK_FALSE(read[1].cables[0][0].stroke.has_value());
  CHECK_FALSE(read[1].cables[0][1].reading.has_value());
}

TEST_CASE("before anything is given everything is zero and unlocked") {
  const auto read = rows("time,Fy,C.start\n0,,\n");
  CHECK(read[0].factor == std::vector<double>{0, 0});
  CHECK(read[0].cables[0][0].force == 0);
  CHECK_FALSE(read[0].cables[0][0].locked);
}

TEST_CASE("rows and lines are counted from one") {
  const auto read = rows("time\n5\n6\n");
  CHECK(read[1].row == 2);
  CHECK(read[1].line == 3);
}

TEST_CASE("numbers do not depend on the locale") {
  const CommaLocale locale;
  CHECK(rows("time,Fy\n0.25,-1.5e-3\n")[0].factor[0] == -1.5e-3);
}

TEST_CASE("the first time may be negative and times as close as doubles can be") {
  CHECK(rows("time\n-1\n0\n4.9e-324\n1e-300\n").size() == 4);
}

TEST_CASE("a locked end may read below zero, an anchored one too") {
  CHECK(rows("time,C.start,C.start.locked,C.end\n0,-3,1,-5\n").size() == 1);
}

TEST_CASE("a segment that its cable has not is refused with those that it has") {
  CHECK(refusal("time,C.T2\n0,1\n") ==
        "log: line 1, column 2: cable \"C\" has no segment of this number: \"C.T2\"; its only one is "
        "\"C.T1\"");
}

TEST_CASE("a negative jack force is refused, unless readings may carry noise") {
  const std::string log = "time,C.start\n0,-3\n";
  CHECK(refusal(log) ==
        "log: line 2, column 2 (C.start): the jack force -3 is below zero; write zero or more: a jack can "
        "only pull");
  LogRules noisy;
  noisy.are_readings = true;
  CHECK(rows(log, noisy)[0].cables[0][0].reading == -3.0);
}

TEST_CASE("readings that follow each other faster than any instrument are refused") {
  LogRules of_instruments;
  of_instruments.shortest_step = 1e-9;
  CHECK(refusal("time\n0\n1e-30\n", of_instruments) ==
        "log: line 3, column 1 (time): the time 1e-30 is less than 1e-09 s after 0 of the row before; give "
        "the time in seconds");
  CHECK(rows("time\n0\n1e-9\n", of_instruments).size() == 2);
}

TEST_CASE("numbers that no structure has are refused") {
  for (const char* const number : {"1.1e30", "-1.1e30", "1e308"})
    CHECK(refusal("time,Fy\n0," + std::string(number) + "\n") ==
          "log: line 2, column 2 (Fy): the number \"" + std::string(number) +
              "\" is too large; write one of at most 1e+30 in size");
  CHECK(rows("time,Fy\n0,-1e30\n").size() == 1);
}

TEST_CASE(
    "what no cable carries is refused by name; of readings it is left out, and a factor that is kept is "
    "told") {
  LogRules rules;
  rules.most_factor = {50, 1e15};
  rules.most_force = {2e6};
  CHECK(refusal("time,Fy\n0,1\n1,-51\n", rules) ==
        "log: line 3, column 2 (Fy): the factor -51 is more than the cables can carry; write one of a size "
        "below 50: is the unit wrong?");
  CHECK(refusal("time,C.start\n0,2e6\n1,2.1e6\n", rules) ==
        "log: line 3, column 2 (C.start): the jack force 2100000 is more than cable \"C\" can carry, a tenth "
        "of its E A; write a force in N below 2e+06: is the unit wrong?");
  // Nobody looks at it while the end is locked, nor at an anchored end.
  CHECK(rows("time,C.start,C.start.locked,C.end\n0,9.9e37,1,9.9e37\n", rules).size() == 1);
  CHECK(refusal("time,C.start,C.start.locked\n0,9.9e37,1\n1,,0\n", rules)
            .find("line 3, column 2 (C.start): the jack force 9.9e+37 from a row before is more") !=
        std::string::npos);

  rules.are_readings = true;
  std::istringstream stream("time,Fy,C.start\n0,3,1000\n1,9.9e37,9.9e37\n2,,\n3,4,2000\n");
  LogReader reader(stream, "log", scene(), rules);
  LogRow row = reader.first_row();
  REQUIRE(reader.next(row));
  REQUIRE(reader.next(row));
  CHECK(row.factor[0] == 3);
  CHECK(row.cables[0][0].reading == 9.9e37);
  CHECK(row.cables[0][0].force == 1000);
  REQUIRE(reader.next(row));
  CHECK(row.factor[0] == 3);
  CHECK(row.cables[0][0].force == 1000);
  REQUIRE(reader.next(row));
  CHECK(row.factor[0] == 4);
  CHECK(row.cables[0][0].force == 2000);
  REQUIRE(reader.remarks().size() == 1);
  CHECK(reader.remarks()[0].english() ==
        "log: line 3, column 2 (Fy): the factor 9.9e+37 is more than the cables can carry; the one before is "
        "kept");
}

TEST_CASE("units in the header make SI of what is below it, by the bits of the same number in SI") {
  const auto given = rows(
      "time [min],C.start [kN],C.end[MN],C.start.stroke [mm],C.T1 [ lbf ],Fy [%]\n"
      "1.5,33.35,0.03335,8.7,1000,150\n");
  CHECK(given[0].time == 90);
  CHECK(given[0].cables[0][0].force == 33350);
  CHECK(given[0].cables[0][1].reading == 33350.0);
  CHECK(given[0].cables[0][0].stroke == 0.0087);
  CHECK(given[0].forces[0].reading == doctest::Approx(4448.2216152605).epsilon(1e-15));
  CHECK(given[0].factor[0] == 1.5);
}

TEST_CASE("a unit moves the decimal point of numbers with an exponent, also to where they are too small") {
  const auto read = rows("time [ms],C.start [kN]\n1e3,1.5e-3\n2E+3,15e-4\n3000,0e400\n");
  CHECK(read[0].time == 1);
  CHECK(read[1].time == 2);
  CHECK(read[0].cables[0][0].force == 1.5);
  CHECK(read[1].cables[0][0].force == 1.5);
  CHECK(read[2].cables[0][0].force == 0);
  CHECK(refusal("time [ms]\n4.9e-324\n").find("is too large or too small") != std::string::npos);
}

TEST_CASE("hours, days, centimetres, inches, feet and kips are what they are said to be") {
  CHECK(rows("time [h]\n2\n")[0].time == 7200);
  CHECK(rows("time [d]\n0.5\n")[0].time == 43200);
  const auto stroke = [](const std::string& unit) {
    return *rows("time,C.start.stroke [" + unit + "]\n0,3\n")[0].cables[0][0].stroke;
  };
  CHECK(stroke("m") == 3);
  CHECK(stroke("cm") == 0.03);
  CHECK(stroke("in") == doctest::Approx(0.0762).epsilon(1e-15));
  CHECK(stroke("ft") == doctest::Approx(0.9144).epsilon(1e-15));
  CHECK(rows("time,C.start [kip]\n0,2\n")[0].cables[0][0].force ==
        doctest::Approx(8896.443230521).epsilon(1e-15));
}

TEST_CASE("a calibrated column keeps its own unit, whatever it is called") {
  const SceneDescription described = read_scene(R"({ "taut": 1, "name": "n", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0] },
    "cables": [ { "name": "C", "path": ["a", "b"], "E": 1, "A": 1, "start": "jacked", "end": "anchored" } ],
    "sensors": { "C.start": { "calibration": [[0, 0], [10, 2000]] } } })",
                                                "f");
  for (const std::string unit : {"", " [bar]", " [kN]"}) {
    std::istringstream stream("time,C.start" + unit + "\n0,5\n");
    LogReader reader(stream, "log", described, {});
    LogRow row = reader.first_row();
    REQUIRE(reader.next(row));
    CHECK(row.cables[0][0].force == 1000);
  }
}

TEST_CASE("a load pattern may have brackets in its name") {
  const SceneDescription described = read_scene(R"({ "taut": 1, "name": "n", "dimension": 2,
    "nodes": { "a": [0, 0] }, "loads": { "snow [kN]": {} } })",
                                                "f");
  std::istringstream stream("time,snow [kN]\n0,5\n");
  LogReader reader(stream, "log", described, {});
  LogRow row = reader.first_row();
  REQUIRE(reader.next(row));
  CHECK(row.factor[0] == 5);
}

TEST_CASE("semicolons separate fields, and numbers may then have decimal commas") {
  const auto read = rows("time;Fy;C.start\n0,5;-1,25e3;\n1.5;2;7,5\n;;\n");
  REQUIRE(read.size() == 2);
  CHECK(read[0].time == 0.5);
  CHECK(read[0].factor[0] == -1250);
  CHECK(read[1].time == 1.5);
  CHECK(read[1].cables[0][0].force == 7.5);
}

TEST_CASE("tabs separate fields, and an empty one between them is empty") {
  const auto read = rows("time\tFy\tC.start\n0\t2\t\n1\t\t 5 \n");
  CHECK(read[0].factor[0] == 2);
  CHECK(read[1].factor[0] == 2);
  CHECK(read[1].cables[0][0].force == 5);
}

TEST_CASE("lines that begin with # count for nothing but the numbers of lines") {
  const auto read = rows(
      "\xEF\xBB\xBF# made by hand, 2026; \"with quotes\n\ntime,Fy\n# zero\n0,1\n  # one\n"
      "\"# two, in a spreadsheet\"\n1,2\n#\n\n# end\n");
  REQUIRE(read.size() == 2);
  CHECK(read[0].line == 5);
  CHECK(read[1].line == 8);
  CHECK(refusal("time,Fy\n0,1\n\n# a remark\n1,2\n").find("log: line 3: the line is blank") == 0);
}

TEST_CASE("the header again, as of a logger that was restarted, is skipped with a remark") {
  std::istringstream stream("time,Fy\r\n0,1\r\n time,Fy \r\n1,2\r\n\xEF\xBB\xBFtime,Fy\r\n2,3\r\n");
  LogReader reader(stream, "log", scene());
  std::vector<std::size_t> lines;
  for (LogRow row = reader.first_row(); reader.next(row);) lines.push_back(row.line);
  CHECK(lines == std::vector<std::size_t>{2, 4, 6});
  REQUIRE(reader.remarks().size() == 2);
  CHECK(reader.remarks()[0].english() ==
        "log: line 3 is the header again; it is skipped, and the log goes on below it");
  CHECK(refusal("time,Fy\n0,1\ntime,wind\n1,2\n")
            .find("log: line 3, column 1 (time): \"time\" is not a number") == 0);
  CHECK(refusal("time,Fy\n5,1\ntime,Fy\n0,2\n")
            .find("log: line 4, column 1 (time): the time 0 is not after 5") == 0);
  CHECK(refusal("time,Fy\ntime,Fy\n").find("log: line 3: the log has no rows") == 0);
}

TEST_CASE("of headers that come again and again only the first are remarked on one by one") {
  std::string text = "time,Fy\n";
  for (int i = 0; i < 30; ++i) text += std::to_string(i) + ",1\ntime,Fy\n";
  std::istringstream stream(text);
  LogReader reader(stream, "log", scene());
  for (LogRow row = reader.first_row(); reader.next(row);) continue;
  REQUIRE(reader.remarks().size() == 21);
  CHECK(reader.remarks()[20].english() ==
        "log: line 43 is the header again, as are perhaps more; they are skipped");
}

TEST_CASE("rows of nothing but separators at the end do not count") {
  CHECK(rows("time,Fy\n0,1\n,\n , \n").size() == 1);
}

TEST_CASE("dates and times count in seconds from the first row") {
  const auto read = rows("time\n2026-02-28T23:59:59.7\n2026-03-01 00:00\n\"2026-03-01T01:00:00,25\"\n");
  CHECK(read[0].time == 0);
  CHECK(read[1].time == 0.3);
  REQUIRE(read.size() == 3);
  CHECK(read[2].time == 3600.55);
  // A leap year, and the days of a century without one.
  CHECK(rows("time\n2024-02-28\n2024-03-01\n")[1].time == 2 * 86400);
  CHECK(rows("time\n1899-12-31\n2000-01-01\n")[1].time == (100 * 365 + 24 + 1) * 86400.0);
}

TEST_CASE("offsets from UTC are taken off, as when clocks are put forward") {
  const auto read = rows(
      "time\n2026-03-29T01:59:00+01:00\n2026-03-29T03:00:00+0200\n2026-03-29T01:02:00Z\n"
      "2026-03-28T22:03:00-03\n");
  CHECK(read[1].time == 60);
  CHECK(read[2].time == 180);
  CHECK(read[3].time == 240);
}

TEST_CASE("what no clock shows is no date and time") {
  for (const char* const text :
       {"2026-00-01T00:00", "2026-13-01T00:00", "2026-04-31T00:00", "2026-04-30T24:00", "2026-04-30T10:60",
        "2026-04-30T10:00:60", "2026-04-30T10", "2026-04-30T10:00:00.", "2026-04-30T10:00:00+25:00",
        "2026-04-30T10:00:00 o'clock", "2026-4-30", "0000-01-01"})
    CHECK_MESSAGE(
        refusal("time\n" + std::string(text) + "\n").find("is not a date and time") != std::string::npos,
        text);
}

TEST_CASE("a line without end is refused before it takes all memory") {
  CHECK(refusal("time\n" + std::string(2000000, '1')) ==
        "log: line 2: the line is longer than 1 MiB; write one line a row");
}

TEST_CASE("a million rows are read one by one") {
  std::string text = "time,Fy,C.start\n";
  for (int i = 0; i < 1000000; ++i) text += std::to_string(i) + ",0.5,1000\n";
  std::istringstream stream(text);
  LogReader reader(stream, "log", scene());
  LogRow row = reader.first_row();
  while (reader.next(row)) {
  }
  CHECK(row.row == 1000000);
  CHECK(row.time == 999999);
}

TEST_CASE("measured forces of segments and struts are read, by their calibration where there is one") {
  const SceneDescription described = read_scene(R"({ "taut": 1, "name": "n", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0], "c": [2, 1] },
    "struts": [ { "nodes": ["a", "b"], "E": 1, "A": 1 }, { "nodes": ["b", "c"], "E": 1, "A": 1 } ],
    "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 1, "A": 1, "start": "jacked", "end": "anchored" } ],
    "sensors": { "C.start": { "calibration": [[0, 0], [10, 2000]] }, "C.T2": { "calibration": [[1, 0], [2, 500]] } } })",
                                                "f");
  std::istringstream stream("time,C.start,strut2,C.T2\n0,5,-70,3\n1,5,,\n");
  LogReader reader(stream, "log", described, {});
  LogRow row = reader.first_row();
  REQUIRE(reader.next(row));
  CHECK(row.cables[0][0].force == 1000);
  REQUIRE(row.forces.size() == 2);
  CHECK(row.forces[0].of_strut);
  CHECK(row.forces[0].index == 1);
  CHECK(row.forces[0].reading == -70);
  CHECK_FALSE(row.forces[1].of_strut);
  CHECK(row.forces[1].cable == 0);
  CHECK(row.forces[1].index == 1);
  CHECK(row.forces[1].reading == 1000);
  REQUIRE(reader.next(row));
  CHECK(row.forces.empty());
}
