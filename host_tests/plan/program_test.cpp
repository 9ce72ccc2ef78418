// `taut plan` as people run it.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "files/run_program.hpp"
#include "report/well_formed.hpp"

namespace {

const std::string two_bays = R"({ "taut": 1, "name": "bays <&>", "dimension": 2,
  "nodes": { "a": [0, 0], "b": [10, -1], "c": [20, -1.5], "d": [30, -1], "e": [40, 0] },
  "supports": { "a": "xy", "b": "xy", "c": "xy", "d": "xy", "e": "xy" },
  "cables": [ { "name": "C", "path": ["a", "b", "c", "d", "e"], "E": 1.95e11, "A": 1.4e-3, "start": "anchored", "end": "jacked",
                "seating": 0.006, "friction": { "law": "capstan", "mu": 0.25, "mu_sd": 0.05, "shared": true } } ],
  "loads": { "dead": { "forces": { "c": [0, -1000] } } },
  "sensors": { "C.end": { "hysteresis": { "part": 0.02, "calibrated": "up" },
                          "calibration": [[0, 0], [10, 150000], [50, 790000]] } } })";

struct Run {
  Outcome outcome;
  std::string log, sheet;
  bool has_log = false;
};

Run plan(const std::string& scene, const std::string& goal, const std::string& options = "") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene;
  std::ofstream(scratch.path / "goal.json") << goal;
  Run run;
  run.outcome = run_taut(scratch, "plan " + scratch.quoted("scene.json") + " " + scratch.quoted("goal.json") +
                                      " -o " + scratch.quoted("log.csv") + " --report " +
                                      scratch.quoted("sheet.html") + options);
  run.log = text_of(scratch.path / "log.csv");
  run.sheet = text_of(scratch.path / "sheet.html");
  run.has_log = std::filesystem::exists(scratch.path / "log.csv");
  return run;
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) {
      const std::size_t from = field.find_first_not_of(' ');
      rows.back().push_back(from == std::string::npos ? "" : field.substr(from));
    }
  }
  return rows;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The column of this name, without its unit.
std::size_t column(const std::vector<std::string>& header, const std::string& name) {
  for (std::size_t k = 0; k < header.size(); ++k)
    if (header[k] == name || header[k].rfind(name + " [", 0) == 0) return k;
  return header.size();
}

}  // namespace

TEST_CASE("simulate gives for the log the forces that plan prints") {
  for (const std::string rest :
       {R"("stages": 1)", R"("stages": 2)", R"("stages": 5)", R"("stages": 2, "lock": true)",
        R"("stages": 2, "limits": { "C.end": 5.1e5, "C": 5.05e5, "stroke": { "C.end": 0.074 } })"}) {
    CAPTURE(rest);
    const Run run =
        plan(two_bays, R"({ "taut": 1, "loads": { "dead": 1 }, "target": { "C": 5e5 }, )" + rest + " }");
    CHECK(run.outcome.err.empty());
    REQUIRE(run.outcome.status == 0);
    const Scratch scratch;
    std::ofstream(scratch.path / "scene.json") << two_bays;
    std::ofstream(scratch.path / "log.csv") << run.log;
    const Outcome simulated =
        run_taut(scratch, "simulate " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv"));
    REQUIRE(simulated.status == 0);
    const auto printed = rows_of(run.outcome.out), found = rows_of(simulated.out);
    REQUIRE(printed.size() == found.size());
    for (std::size_t row = 1; row < printed.size(); ++row)
      for (const std::string name : {"C.T1", "C.T2", "C.T3", "C.T4"}) {
        const double here = std::stod(printed[row][column(printed[0], name)]);
        const double there = std::stod(found[row][column(found[0], name)]);
        CHECK(std::fabs(here - there) <= 1e-9 * std::fabs(there));
      }
  }
}

TEST_CASE("the log holds what the gauge shows by its calibration, and the sheet the friction of its ram") {
  const Run run = plan(two_bays, R"({ "taut": 1, "target": { "C": 5e5 }, "stages": 2 })");
  REQUIRE(run.outcome.status == 0);
  const auto log = rows_of(run.log), table = rows_of(run.outcome.out);
  const std::size_t gauge = column(log[0], "C.end"), force = column(table[0], "C.end");
  REQUIRE(log.size() == 4);
  for (std::size_t row = 2; row < 4; ++row)
    CHECK(std::stod(log[row][gauge]) ==
          doctest::Approx(10 + (std::stod(table[row][force]) - 150000) * 40 / 640000).epsilon(1e-9));
  // Let out, a gauge that is right while it pulls shows 1 - 2 x 0.02 of the force.
  char shown[32];
  std::snprintf(shown, sizeof shown, ">%.2f<",
                10 + (0.96 * std::stod(table[3][force]) - 150000) * 40 / 640000);
  CHECK(has(run.sheet, shown));
}

TEST_CASE("the sheet is one well-formed page, and the same every time") {
  const std::string goal =
      R"({ "taut": 1, "target": { "C": [5e5, null, 5e5, 5e5] }, "stages": 3, "lock": true })";
  const Run run = plan(two_bays, goal);
  REQUIRE(run.outcome.status == 0);
  CHECK(WellFormed(run.sheet)() == "");
  CHECK_FALSE(has(run.sheet, "http"));
  CHECK(has(run.sheet, "bays &lt;&amp;&gt;"));
  CHECK(has(run.sheet, "105 % and back"));
  CHECK(has(run.sheet, "lock off"));
  const Run again = plan(two_bays, goal);
  // All but the name of the folder.
  CHECK(again.log == run.log);
  CHECK(again.sheet.size() == run.sheet.size());
  CHECK(again.sheet.substr(again.sheet.find("</header>")) == run.sheet.substr(run.sheet.find("</header>")));
}

TEST_CASE("over the prior the mean, the expected and the 95 % error are said side by side") {
  const Run run = plan(two_bays, R"({ "taut": 1, "target": { "C": 5e5 } })");
  CHECK(has(run.outcome.out, "# over what is known of mu: at its mean "));
  CHECK(has(run.outcome.out, ", expected "));
  CHECK(has(run.outcome.out, ", at 95 % "));
  CHECK(has(run.outcome.out, "C.end.stroke.low"));
}

TEST_CASE("a robust plan keeps the limits at the mean of mu, and needs to know how well mu is known") {
  const std::string goal =
      R"({ "taut": 1, "target": { "C": 5e5 }, "stages": 2, "limits": { "C.end": 5.6e5 } })";
  const Run run = plan(two_bays, goal, " --robust");
  for (const auto& row : rows_of(run.outcome.out))
    if (row[0] == "1" || row[0] == "2") CHECK(std::stod(row[2]) <= 5.6e5);
  std::string known = two_bays;
  known.replace(known.find("\"mu_sd\": 0.05"), 13, "\"mu_sd\": 0");
  const Run refused = plan(known, goal, " --robust");
  CHECK(refused.outcome.status == 2);
  CHECK(has(refused.outcome.err, "write mu_sd into \"friction\", or leave --robust out"));
  CHECK_FALSE(refused.has_log);
}

TEST_CASE("limits that leave no way near end with 1, and with the best that was found") {
  const Run run = plan(two_bays, R"({ "taut": 1, "target": { "C": 5e5 }, "limits": { "C.end": 3e5 } })");
  CHECK(run.outcome.status == 1);
  CHECK(has(run.outcome.err, "goal.json: /limits: "));
  CHECK(has(run.outcome.out, " too low) stops it\n"));
  CHECK(run.has_log);
  const auto table = rows_of(run.outcome.out);
  CHECK(std::stod(table[2][column(table[0], "C.end")]) == doctest::Approx(3e5).epsilon(1e-9));
}

TEST_CASE("friction that leaves no way near ends with 0 and names the segments that stop it") {
  const Run run = plan(two_bays, R"({ "taut": 1, "target": { "C": [1e5, 9e5, 1e5, 9e5] } })");
  CHECK(run.outcome.status == 0);
  CHECK(has(run.outcome.out, "no jacking whatever comes nearer than"));
  CHECK(has(run.outcome.out, "differ by more than the joints between them hold"));
}

TEST_CASE("a factor of a load that is more than the cables can carry is refused by its place in the goal") {
  std::string warm = two_bays;
  warm.replace(warm.find("\"seating\""), 0, "\"alpha\": 1.2e-5, ");
  warm.replace(warm.find("\"dead\""), 0, "\"warm\": { \"temperature\": { \"C\": 10 } }, ");
  for (const char* factor : {"1e6", "-1e30"}) {
    const Run run = plan(
        warm, std::string(R"({ "taut": 1, "target": { "C": 5e5 }, "loads": { "warm": )") + factor + " } }");
    CHECK(run.outcome.status == 2);
    CHECK(has(run.outcome.err, "goal.json: /loads/warm: the factor "));
    CHECK(has(run.outcome.err, "is more than the cables can carry; write one of a size below "));
    CHECK_FALSE(run.has_log);
  }
  CHECK(plan(warm, R"({ "taut": 1, "target": { "C": 5e5 }, "loads": { "warm": 2 } })").outcome.status == 0);
}

TEST_CASE("targets and limits that no cable can carry are refused by their place in the goal") {
  for (const auto& [goal, place] :
       {std::pair{R"("target": { "C": 1e30 })", "/target/C: a target of 1e+30 N"},
        std::pair{R"("target": { "C": [5e5, 1e30, 5e5, 5e5] })", "/target/C/1: a target of 1e+30 N"},
        std::pair{R"("target": { "C": 5e5 }, "limits": { "C": 1e30 })",
                  "/limits/C: a segment force of 1e+30 N"},
        std::pair{R"("target": { "C": 5e5 }, "limits": { "C.end": 1e30 })",
                  "/limits/C.end: a jack force of 1e+30 N"}}) {
    const Run run = plan(two_bays, std::string(R"({ "taut": 1, )") + goal + " }");
    CHECK(run.outcome.status == 2);
    CHECK_MESSAGE(has(run.outcome.err, std::string("goal.json: ") + place), run.outcome.err);
    CHECK(has(run.outcome.err, " is more than the cable can carry; write one in N, below "));
    CHECK_FALSE(run.has_log);
  }
}

TEST_CASE("a target in kN is refused by its place in the goal, unless it is meant") {
  const Run run = plan(two_bays, R"({ "taut": 1, "target": { "C": 500 } })");
  CHECK(run.outcome.status == 2);
  CHECK_MESSAGE(has(run.outcome.err, "goal.json: /target: no target strains its cable by as much as 1e-5; "),
                run.outcome.err);
  CHECK_FALSE(run.has_log);
  std::string meant = two_bays;
  meant.insert(meant.find("\"name\""), "\"plausible\": false, ");
  CHECK(plan(meant, R"({ "taut": 1, "target": { "C": 500 } })").outcome.status != 2);
}

TEST_CASE("a goal that cannot be used is refused with its place and a remedy, and nothing is written") {
  struct Bad {
    std::string goal, place, says;
  };
  const std::string head = R"({ "taut": 1, "target": )";
  const std::vector<Bad> all = {
      {"[]", "top level", "a goal"},
      {R"({ "taut": 2, "target": { "C": 5e5 } })", "/taut", "version 2"},
      {R"({ "taut": 1 })", "top level", "\"target\" is missing"},
      {head + R"({ "C": 5e5 }, "stage": 2 })", "/stage", "unknown key \"stage\"; did you mean \"stages\""},
      {head + R"({ "D": 5e5 } })", "/target/D", "there is no cable \"D\""},
      {head + R"({ "C": 0 } })", "/target/C", "a target of 0"},
      {head + R"({ "C": -5 } })", "/target/C", "greater than zero"},
      {head + R"({ "C": [5e5, 5e5] } })", "/target/C", "2 numbers for 4 segments"},
      {head + R"({ "C": [5e5, 5e5, -1, 5e5] } })", "/target/C/2", "greater than zero"},
      {head + R"({ "C": [null, null, null, null] } })", "/target", "no segment has a target"},
      {head + R"({ "C": "5e5" } })", "/target/C", "one force [N], or a list of 4 forces"},
      {head + R"({ "C": 5e5 }, "loads": { "dad": 1 } })", "/loads/dad", "did you mean \"dead\""},
      {head + R"({ "C": 5e5 }, "limits": { "C.start": 1e5 } })", "/limits/C.start", "no cable and no jack"},
      {head + R"({ "C": 5e5 }, "limits": { "C": 0 } })", "/limits/C", "greater than zero"},
      {head + R"({ "C": 5e5 }, "limits": { "stroke": { "C": 1 } } })", "/limits/stroke/C",
       "there is no jack"},
      {head + R"({ "C": 5e5 }, "limits": { "stroke": 0.4 } })", "/limits/stroke",
       "write an object that gives jacks their largest strokes [m]"},
      {head + R"({ "C": 5e5 }, "stages": 0 })", "/stages", "0 moves of jacks"},
      {head + R"({ "C": 5e5 }, "stages": 2.5 })", "/stages", "whole number"},
      {head + R"({ "C": 5e5 }, "lock": 1 })", "/lock", "true or false"},
  };
  for (const Bad& bad : all) {
    const Run run = plan(two_bays, bad.goal);
    CAPTURE(bad.goal);
    CAPTURE(run.outcome.err);
    CHECK(run.outcome.status == 2);
    CHECK(has(run.outcome.err, "goal.json: " + bad.place + ": "));
    CHECK(has(run.outcome.err, bad.says));
    CHECK(run.outcome.out.empty());
    CHECK_FALSE(run.has_log);
  }
}

TEST_CASE("a scene without a jack, and one whose joints lock, are refused") {
  std::string without = two_bays;
  without.replace(without.find("\"end\": \"jacked\""), 15, "\"end\": \"anchored\"");
  std::string no_sensors = without.substr(0, without.find(",\n  \"sensors\"")) + " }";
  const Run anchored = plan(no_sensors, R"({ "taut": 1, "target": { "C": 5e5 } })");
  CHECK(anchored.outcome.status == 2);
  CHECK(has(anchored.outcome.err, "goal.json: /target: the scene \"bays <&>\" has no jack"));
  // A point contact with mu 60 holds whatever comes: kappa = mu cot(alpha) is above one.
  std::string locked = two_bays;
  locked.replace(locked.find("\"capstan\", \"mu\": 0.25"), 21, "\"point\", \"mu\": 60");
  const Run stuck = plan(locked, R"({ "taut": 1, "target": { "C": 5e5 } })");
  CAPTURE(stuck.outcome.err);
  CHECK(stuck.outcome.status == 2);
  CHECK(has(stuck.outcome.err, "goal.json: /target/C: no jack reaches segment 1 of cable \"C\": joint 1"));
}

TEST_CASE("jacks that balance what nothing else holds get no plan, and the node and what helps are named") {
  const auto mast = [](const std::string& left) {
    return R"({ "taut": 1, "name": "mast", "dimension": 2,
      "nodes": { "base": [0, 0], "top": [0, 20], "l": [-15, 0], "r": [15, 0] },
      "supports": { "base": "xy", "l": "xy", "r": "xy" },
      "struts": [ { "nodes": ["base", "top"], "E": 2.06e11, "A": 5e-3 } ],
      "cables": [ { "name": "L", "path": ["top", "l"], "E": 1.6e11, "A": 1e-3, "start": "anchored", "end": ")" +
           left + R"(" },
                  { "name": "R", "path": ["top", "r"], "E": 1.6e11, "A": 1e-3, "start": "anchored", "end": "jacked" } ] })";
  };
  const std::string free =
      "at once: node \"top\": mechanism: nothing holds this node; add a strut, a support or a substructure "
      "that holds it, or make all but one of the jacked ends that pull at it \"anchored\": a jack gives a "
      "force, and holds nothing\n";
  for (const std::string rest :
       {R"("L": 2e5, "R": 2.5e5 }, "limits": { "L.end": 4e5, "R.end": 4e5 }, "stages": 3)",
        R"("L": 2e5, "R": 2e5 }, "stages": 1)", R"("L": 2e5, "R": 2e5 }, "stages": 4, "lock": true)"}) {
    CAPTURE(rest);
    const Run run = plan(mast("jacked"), R"({ "taut": 1, "target": { )" + rest + " }");
    CHECK(run.outcome.status == 1);
    CHECK_MESSAGE(has(run.outcome.err, "scene.json: no jack can be moved; on the way to L.end "),
                  run.outcome.err);
    CHECK_MESSAGE(has(run.outcome.err, free), run.outcome.err);
    CHECK(run.outcome.out.empty());
    CHECK_FALSE(run.has_log);
    CHECK(run.sheet.empty());
  }
  const Run anchored =
      plan(mast("anchored"), R"({ "taut": 1, "target": { "L": 2e5, "R": 2e5 }, "stages": 1 })");
  CHECK(anchored.outcome.status == 0);
  CHECK(has(anchored.outcome.out, "with 1 move the forces come within 0.000 % of their targets"));
}

TEST_CASE("two jacks that push a girder on rollers get no plan, and the roller that is free is named") {
  const Run run = plan(R"({ "taut": 1, "name": "girder", "dimension": 2,
    "nodes": { "l": [-10, 0], "a": [0, 0], "b": [8, 0], "r": [20, 0] },
    "supports": { "l": "xy", "r": "xy", "a": "y", "b": "y" },
    "struts": [ { "nodes": ["a", "b"], "E": 2.06e11, "A": 5e-3 } ],
    "cables": [ { "name": "L", "path": ["l", "a"], "E": 1.6e11, "A": 1e-3, "start": "jacked", "end": "anchored" },
                { "name": "R", "path": ["b", "r"], "E": 1.6e11, "A": 1e-3, "start": "anchored", "end": "jacked" } ] })",
                       R"({ "taut": 1, "target": { "L": 2e5, "R": 1.9e5 } })");
  CHECK(run.outcome.status == 1);
  CHECK_MESSAGE(has(run.outcome.err, ": node \"b\": mechanism: nothing holds this node; "), run.outcome.err);
  CHECK_FALSE(run.has_log);
}

TEST_CASE("a way under both jacks of a cable over a pinned strut is refused with the joint that is free") {
  const Run run = plan(R"({ "taut": 1, "name": "tower", "dimension": 2,
    "nodes": { "base": [0, 0], "top": [0, 20], "l": [-15, 0], "r": [18, 0] },
    "supports": { "base": "xy", "l": "xy", "r": "xy" },
    "struts": [ { "nodes": ["base", "top"], "E": 2.06e11, "A": 5e-3 } ],
    "cables": [ { "name": "C", "path": ["l", "top", "r"], "E": 1.6e11, "A": 1e-3, "start": "jacked", "end": "jacked",
                  "friction": { "law": "capstan", "mu": 0.15 } } ] })",
                       R"({ "taut": 1, "target": { "C": 2e5 } })");
  CHECK(run.outcome.status == 1);
  CHECK_MESSAGE(has(run.outcome.err, ": joint 1 of cable \"C\" at node \"top\": mechanism: "),
                run.outcome.err);
  CHECK_MESSAGE(has(run.outcome.err, "make all but one of the jacked ends that pull at it \"anchored\""),
                run.outcome.err);
  CHECK_FALSE(run.has_log);
}

TEST_CASE("the example in the README is what the program prints") {
  const Scratch scratch;
  const std::string data = std::string(TAUT_ROOT) + "/firmware_example/data";
  const Outcome outcome =
      run_taut(scratch, "plan plan_string.json plan_string_goal.json", "cd '" + data + "'");
  REQUIRE(outcome.status == 0);
  const std::string readme = text_of(std::string(TAUT_ROOT) + "/lib/README.md");
  const std::string mark = "<!-- output of the program -->\n```text\n";
  const std::size_t begin = readme.find(mark);
  REQUIRE(begin != std::string::npos);
  const std::string block =
      readme.substr(begin + mark.size(), readme.find("```\n<!-- end -->", begin) - begin - mark.size());
  const auto remarks = [](const std::string& text) {
    std::string all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (!line.empty() && line[0] == '#') all += line + "\n";
    return all;
  };
  CHECK(remarks(block) == remarks(outcome.out));
  const auto there = rows_of(block), here = rows_of(outcome.out);
  REQUIRE(there.size() == here.size());
  for (std::size_t row = 1; row < here.size(); ++row)
    for (std::size_t k = 1; k < here[row].size(); ++k)
      CHECK(std::stod(there[row][k]) == doctest::Approx(std::stod(here[row][k])).epsilon(1e-6));
  // The remarks but for the title.
  const std::string said = remarks(outcome.out);
  CHECK(has(text_of(std::string(TAUT_ROOT) + "/README.md"), said.substr(said.find('\n') + 1)));
}

// The longest search of all.
#ifdef __SANITIZE_ADDRESS__
constexpr bool takes_a_minute = true;
#else
constexpr bool takes_a_minute = false;
#endif

TEST_CASE("a robust plan is said beside that for the mean of mu, expects less, and is that of the README" *
          doctest::skip(takes_a_minute)) {
  const Scratch scratch;
  const Outcome robust = run_taut(
      scratch,
      "plan plan_string.json plan_string_goal.json --robust --report " + scratch.quoted("sheet.html"),
      "cd '" TAUT_ROOT "/firmware_example/data'");
  REQUIRE(robust.status == 0);
  std::string remarks;
  std::istringstream lines(robust.out);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] == '#') remarks += line + "\n";
  CHECK(has(text_of(TAUT_ROOT "/lib/README.md"), "```text\n" + remarks + "```\n"));
  const auto errors = [&](const std::string& line) {
    const std::size_t at = remarks.find(line);
    REQUIRE(at != std::string::npos);
    const std::string said = remarks.substr(at, remarks.find('\n', at) - at);
    const auto number = [&](const std::string& word) {
      return std::stod(said.substr(said.find(word) + word.size()));
    };
    return std::array<double, 3>{number("at its mean "), number("expected "), number("at 95 % ")};
  };
  const auto alone = errors("# the plan for the mean of mu alone"),
             found = errors("# over what is known of mu");
  CHECK(found[0] > alone[0]);
  CHECK(found[1] < alone[1]);
  CHECK(found[2] < alone[2]);
  const std::string sheet = text_of(scratch.path / "sheet.html");
  CHECK(WellFormed(sheet)() == "");
  CHECK(has(sheet, "the plan for the mean of mu alone"));
}

TEST_CASE("a roof that hangs through without its cable is jacked while its load comes on") {
  // Lifted off its props as it is on the site; under all of its load first the cable would be slack by
  // metres.
  const std::string data = std::string(TAUT_ROOT) + "/firmware_example/data/";
  for (const char* name : {"beam_string_radial", "beam_string_vertical"}) {
    CAPTURE(name);
    const Run run = plan(text_of(data + name + ".json"),
                         R"({ "taut": 1, "loads": { "dead": 1 }, "target": { "C": 7.2e5 }, "stages": 2 })");
    CAPTURE(run.outcome.err);
    REQUIRE(run.outcome.status == 0);
    const auto table = rows_of(run.outcome.out);
    REQUIRE(table.size() >= 2);
    CHECK(table[1][0] == "1");  // no row of the loads alone
    const auto log = rows_of(run.log);
    REQUIRE(log.size() >= 2);
    CHECK(std::stod(log[1][3]) > 5e5);  // of the jack, behind time and two loads
    // Segments stand behind stage, time, jack and its stroke with a band.
    REQUIRE(table.back().size() > 6);
    for (std::size_t k = 6; k < table.back().size(); ++k)
      CHECK(std::fabs(std::stod(table.back()[k]) / 7.2e5 - 1) < 0.02);
  }
}
