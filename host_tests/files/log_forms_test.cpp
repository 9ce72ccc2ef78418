// The same log in the forms in which people have it, through the program.
#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "files/result_table.hpp"
#include "files/run_program.hpp"

namespace {

const std::string scene = TAUT_FILES "/one_jack.json";

Outcome run(const Scratch& scratch, const std::string& command, const std::string& log,
            const std::string& options = "") {
  std::ofstream(scratch.path / "log.csv") << log;
  return run_taut(scratch, command + " '" + scene + "' " + scratch.quoted("log.csv") + options);
}

}  // namespace

TEST_CASE(
    "a log in kN, mm and min, between semicolons with decimal commas, has the result of the one in SI") {
  const Scratch scratch;
  const std::string plain = "time,C.end,C.end.stroke\n6,1000,0.0001\n12,33350,0.0087\n18,90010,0.0203\n",
                    of_site =
                        "\xEF\xBB\xBF# site 7\r\nsep=;\r\ntime [min];C.end [kN];C.end.stroke [mm]\r\n"
                        "0,1;1;0,1\r\n# pulled on\r\n0,2;33,35;8,7\r\n0,3;90,01;20,3\r\n;;\r\n\r\n",
                    between_tabs =
                        "time [s]\tC.end [MN]\tC.end.stroke [cm]\n6\t1e-3\t0.01\n12\t0.03335\t0.87\n"
                        "18\t0.09001\t2.03\n";
  for (const std::string command : {"simulate", "estimate"}) {
    const Outcome expected = run(scratch, command, plain, " --hex");
    REQUIRE(expected.status == 0);
    CHECK(run(scratch, command, of_site, " --hex").out == expected.out);
    CHECK(run(scratch, command, between_tabs, " --hex").out == expected.out);
  }
}

TEST_CASE("a log whose header comes again has the result of the one without, from a file and as a stream") {
  const Scratch scratch;
  const std::string head = "time,C.end,C.end.stroke\n", before = "6,1000,0.0001\n12,33350,0.0087\n",
                    after = "18,90010,0.0203\n";
  const std::string remark = "line 4 is the header again; it is skipped, and the log goes on below it\n";
  for (const std::string command : {"simulate", "estimate"}) {
    const Outcome expected = run(scratch, command, head + before + after, " --hex");
    REQUIRE(expected.status == 0);
    const Outcome outcome = run(scratch, command, head + before + head + after, " --hex");
    CHECK(outcome.status == 0);
    CHECK(outcome.out == expected.out);
    CHECK_MESSAGE(outcome.err.find("log.csv: " + remark) != std::string::npos, outcome.err);
  }
  std::ofstream(scratch.path / "log.csv") << head + before + head + after;
  const Outcome streamed = run_taut(scratch, "estimate '" + scene + "' - < " + scratch.quoted("log.csv"));
  CHECK(streamed.status == 0);
  CHECK(Table(streamed.out).column("time") == std::vector<std::string>{"6", "12", "18"});
  CHECK_MESSAGE(streamed.err.find(remark) != std::string::npos, streamed.err);
}

TEST_CASE("of dates and times, the result has the seconds from the first row") {
  const Scratch scratch;
  const Outcome outcome = run(scratch, "simulate",
                              "time,C.end\n2026-03-01T10:00:00,1000\n2026-03-01T10:00:00.25,2000\n"
                              "2026-03-02 10:00:00,3000\n");
  REQUIRE(outcome.status == 0);
  CHECK(Table(outcome.out).column("time") == std::vector<std::string>{"0", "0.25", "86400"});
}

TEST_CASE("a second log with dates counts from the first row of the first, by the state between") {
  const Scratch scratch;
  const std::string head = "time,C.end\n", first = "2026-03-01T10:00:00Z,1000\n2026-03-01T10:00:01Z,1900\n",
                    second = "2026-03-01T12:00:02+02:00,3000\n2026-03-01T12:00:03+02:00,4000\n",
                    state = " --state " + scratch.quoted("state");
  // The second visit begins with what was taken for the cell in the first.
  const Outcome before = run(scratch, "estimate", head + first, state);
  REQUIRE(before.status == 0);
  const Outcome after = run(scratch, "estimate", head + second, state);
  REQUIRE(after.status == 0);
  CHECK(Table(after.out).column("time") == std::vector<std::string>{"2", "3"});
}

TEST_CASE("a row that has no answer is told with its line in the text, remarks and all") {
  const Scratch scratch;
  std::ofstream(scratch.path / "log.csv")
      << "# two jacks\ntime,C.start,C.end\n1,1000,1000\n# torn\n2,9000,1000\n";
  const Outcome outcome =
      run_taut(scratch, "simulate '" TAUT_FILES "/two_jacks.json' " + scratch.quoted("log.csv"));
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("log.csv: line 5 (row 2, time 2 s), after ") != std::string::npos);
}
