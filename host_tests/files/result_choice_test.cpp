// `--columns` and `--every`: which of a result is written.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "files/result_table.hpp"
#include "files/run_program.hpp"
#include "lib/files/text.hpp"

namespace {

const std::string scene = TAUT_FILES "/one_jack.json";

// Pulls up to 20 kN in so many rows; one reading of the jack is far off the others.
std::string ramp(int rows, int wrong_row = 0) {
  std::string log = "time,C.end\n";
  for (int i = 1; i <= rows; ++i)
    log += std::to_string(i) + "," + std::to_string(i == wrong_row ? 15000 : 20000 * i / rows) + "\n";
  return log;
}

Outcome run(const Scratch& scratch, const std::string& command, const std::string& log,
            const std::string& options) {
  std::ofstream(scratch.path / "log.csv") << log;
  return run_taut(scratch, command + " '" + scene + "' " + scratch.quoted("log.csv") + options);
}

}  // namespace

TEST_CASE("chosen columns have what they have in the whole result, after the time, in the order asked for") {
  const Scratch scratch;
  for (const std::string hex : {"", " --hex"}) {
    const Table whole(run(scratch, "estimate", ramp(20), hex).out);
    const Outcome outcome =
        run(scratch, "estimate", ramp(20), hex + " --columns C.sd2,C.T1,verdict,C.state1,C.T1,time");
    REQUIRE(outcome.status == 0);
    const Table chosen(outcome.out);
    CHECK(chosen.header == std::vector<std::string>{"time", "C.sd2", "C.T1", "verdict", "C.state1"});
    REQUIRE(chosen.rows.size() == 20);
    for (const std::string& name : chosen.header) CHECK(chosen.column(name) == whole.column(name));
  }
  CHECK(run(scratch, "simulate", ramp(1), " --columns C.T2").out == "time,C.T2\n1,20000\n");
}

// A plane tripod of stiffness k (1, 1): under a force the free node moves by that force over k.
TEST_CASE("displacements and the friction that is used are columns on request") {
  const Scratch scratch;
  std::ofstream(scratch.path / "tie.json") << R"({ "taut": 1, "name": "tie", "dimension": 2,
    "nodes": { "l": [-3, 0], "r": [3, 0], "m": [0, 0], "d": [0, -2] },
    "supports": { "l": "xy", "r": "xy", "d": "xy" },
    "struts": [ { "nodes": ["l", "m"], "E": 3e10, "A": 1e-3 }, { "nodes": ["d", "m"], "E": 2e10, "A": 1e-3 } ],
    "cables": [ { "name": "C", "path": ["l", "r"], "E": 1.95e11, "A": 8e-4, "start": "anchored", "end": "jacked" } ],
    "loads": { "push": { "forces": { "m": [5000, -2000] } } } })";
  std::ofstream(scratch.path / "log.csv") << "time,push,C.end\n0,0,0\n1,1,1000\n2,-2,1000\n";
  const std::string files = scratch.quoted("tie.json") + " " + scratch.quoted("log.csv");
  const Table table(run_taut(scratch, "simulate " + files + " --columns m.y,C.T1,m.x,l.x").out);
  CHECK(table.header == std::vector<std::string>{"time", "m.y", "C.T1", "m.x", "l.x"});
  REQUIRE(table.rows.size() == 3);
  for (std::size_t row = 0; row < 3; ++row) {
    const double factor = row == 0 ? 0 : row == 1 ? 1 : -2;
    CHECK(table.number(row, "m.x") == doctest::Approx(factor * 5000 / 1e7));
    CHECK(table.number(row, "m.y") == doctest::Approx(factor * -2000 / 1e7));
    CHECK(table.number(row, "l.x") == 0);
  }
  const std::string stepwise = " --method stepwise --columns m.x";
  const Outcome refused = run_taut(scratch, "simulate " + files + stepwise);
  CHECK(refused.status == 2);
  CHECK(refused.err.find("the method stepwise does not give \"m.x\"") != std::string::npos);
  // A joint that slides uses all of its friction; let out until both tensions are the same, none.
  const Table used(run(scratch, "simulate", "time,C.end\n1,20000\n", " --columns C.used1,C.T1").out);
  CHECK(used.number(0, "C.used1") == doctest::Approx(1).epsilon(1e-12));
  const Table whole(run(scratch, "simulate", "time,C.end\n1,20000\n", " --hex --columns C.T1").out);
  const std::string back = "time,C.end\n1,20000\n2," + taut::host::plain(whole.bits(0, "C.T1")) + "\n";
  const Table rest(run(scratch, "simulate", back, " --columns C.used1").out);
  CHECK(std::fabs(rest.number(1, "C.used1")) < 1e-12);
}

TEST_CASE(
    "a column that the result does not have is refused with those that it has, and nothing is written") {
  const Scratch scratch;
  const Outcome outcome =
      run(scratch, "simulate", ramp(3), " --columns C.T1,C.T9 -o " + scratch.quoted("result"));
  CHECK(outcome.status == 2);
  CHECK(outcome.err ==
        "--columns: the result has no column \"C.T9\"; did you mean \"C.T1\"? the columns are \"time\", "
        "\"C.T1\", \"C.T2\", \"C.slip1\", \"C.state1\", \"C.N1\", \"C.f1\", \"C.end.payout\", and on request "
        "\"C.used1\" to \"right.y\"\n");
  CHECK_FALSE(std::filesystem::exists(scratch.path / "result"));
  // Simulated forces have no deviation.
  CHECK(run(scratch, "simulate", ramp(3), " --columns C.sd1").status == 2);
  CHECK(run(scratch, "simulate", ramp(3), " --columns alarms").err.find("; the columns are \"time\"") !=
        std::string::npos);
}

TEST_CASE("of every third row one is written from the first on, and the last") {
  const Scratch scratch;
  const auto times = [&](int rows) {
    return Table(run(scratch, "simulate", ramp(rows), " --every 3").out).column("time");
  };
  CHECK(times(10) == std::vector<std::string>{"1", "4", "7", "10"});
  CHECK(times(9) == std::vector<std::string>{"1", "4", "7", "9"});
  CHECK(times(2) == std::vector<std::string>{"1", "2"});
  CHECK(times(1) == std::vector<std::string>{"1"});
  CHECK(run(scratch, "simulate", ramp(7), " --every 1").out == run(scratch, "simulate", ramp(7), "").out);
}

TEST_CASE("rows in which an alarm comes or goes are written between the others") {
  const Scratch scratch;
  const std::string log = ramp(100, 50);
  const Table whole(run(scratch, "estimate", log, "").out),
      thinned(run(scratch, "estimate", log, " --every 1000").out);
  std::vector<std::string> expected = {"1"};
  const auto alarms = whole.column("alarms");
  for (std::size_t i = 1; i < alarms.size(); ++i)
    if (alarms[i] != alarms[i - 1]) expected.push_back(std::to_string(i + 1));
  REQUIRE(expected.size() > 2);
  if (expected.back() != "100") expected.push_back("100");
  CHECK(thinned.column("time") == expected);
}

TEST_CASE("the last row before one without an answer is written") {
  const Scratch scratch;
  std::ofstream(scratch.path / "log.csv") << "time,C.start,C.end\n1,1000,1000\n2,1001,1001\n3,9000,1000\n";
  const Outcome outcome = run_taut(
      scratch, "simulate '" TAUT_FILES "/two_jacks.json' " + scratch.quoted("log.csv") + " --every 9");
  CHECK(outcome.status == 1);
  CHECK(Table(outcome.out).column("time") == std::vector<std::string>{"1", "2"});
}

TEST_CASE("every no row is refused") {
  const Scratch scratch;
  for (const std::string count : {"0", "-3", "some"})
    CHECK(run(scratch, "simulate", ramp(3), " --every " + count).status == 2);
}
