// A log from standard input, followed as it comes.
#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "files/result_table.hpp"
#include "files/run_program.hpp"

namespace {

/// One cable over three saddles, anchored at its start and jacked at its end.
std::string scene(const std::string& sensors) {
  return R"({ "taut": 1, "name": "chain", "dimension": 2,
  "nodes": { "a": [0, 0], "b": [2, 0.3], "c": [4, 0.4], "d": [6, 0.3], "e": [8, 0] },
  "supports": { "a": "xy", "b": "xy", "c": "xy", "d": "xy", "e": "xy" },
  "cables": [ { "name": "C", "path": ["a", "b", "c", "d", "e"], "E": 1.95e11, "A": 8e-4, "start": "anchored", "end": "jacked",
                "friction": { "law": "point", "mu": 0.2, "mu_sd": 0.1, "shared": true } } ],
  "sensors": { )" +
         sensors + " } }";
}
const std::string all_said =
    R"("C.start": { "sd": 300, "gain_sd": 0.01, "zero_sd": 200 }, "C.end": { "sd": 300, "gain_sd": 0.01, "zero_sd": 200 })";

/// Closed form: a joint holds (1 - mu c) / (1 + mu c), c = cot(alpha).
double far_end(double force, double mu) {
  for (const double turn : {std::atan2(0.3, 2) - std::atan2(0.1, 2), 2 * std::atan2(0.1, 2),
                            std::atan2(0.3, 2) - std::atan2(0.1, 2)})
    force *= (1 - mu * std::tan(turn / 2)) / (1 + mu * std::tan(turn / 2));
  return force;
}

/// A ramp up to 200 kN with mu = 0.3 and noise.
std::string ramp(int rows, double noise, double from = 0) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, noise);
  std::string log = "time,C.start,C.end\n";
  for (int i = 1; i <= rows; ++i) {
    const double force = from + (2e5 - from) * i / rows, read_far = far_end(force, 0.3) + normal(random);
    log += std::to_string(i) + ',' + std::to_string(read_far) + ',' + std::to_string(force + normal(random)) +
           '\n';
  }
  return log;
}

/// From standard input or the file, with the same scene.json.
Outcome run(const Scratch& scratch, const std::string& command, bool streams, const std::string& log,
            const std::string& options = "") {
  std::ofstream(scratch.path / "log.csv") << log;
  const std::string file = scratch.quoted("log.csv");
  return run_taut(scratch,
                  command + " " + scratch.quoted("scene.json") + (streams ? " - < " : " ") + file + options);
}

}  // namespace

TEST_CASE("where the scene says all, a stream has the bits of the file") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene(all_said);
  for (const std::string command :
       {"estimate", "estimate --scalar float", "simulate", "simulate --method stepwise"}) {
    const std::string log = command[0] == 'e' ? ramp(300, 300) : ramp(20, 0);
    const Outcome from_file = run(scratch, command, false, log, " --hex"),
                  streamed = run(scratch, command, true, log, " --hex");
    REQUIRE(from_file.status == 0);
    CHECK(streamed.status == 0);
    CHECK(streamed.out == from_file.out);
    CHECK(streamed.err == from_file.err);
    CHECK(run(scratch, command, true, log, " --hex -o " + scratch.quoted("result")).out.empty());
    CHECK(text_of(scratch.path / "result") == from_file.out);
  }
}

TEST_CASE("every row is answered before the next one comes") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene("");
  // Two pipes; each row is sent only after the answer to the one before has been read.
  std::ofstream(scratch.path / "talk.sh") << R"sh(set -e; cd "$1"; mkfifo rows answers
"$3" "$2" scene.json - < rows > answers 2> err &
exec 3> rows; exec 4< answers
echo 'time,C.end' >&3; read -r answer <&4; echo "$answer"
for i in 1 2 3 4 5; do echo "$i,${i}0000" >&3; read -r answer <&4; echo "$answer"; done
exec 3>&-; wait
)sh";
  for (const std::string command : {"simulate", "estimate"}) {
    std::filesystem::remove(scratch.path / "rows");
    std::filesystem::remove(scratch.path / "answers");
    const std::string talk = "timeout 60 sh " + scratch.quoted("talk.sh") + " " + scratch.quoted("") + " " +
                             command + " '" TAUT_PROGRAM "' > " + scratch.quoted("talk");
    CHECK(std::system(talk.c_str()) == 0);
    CHECK(Table(text_of(scratch.path / "talk")).column("time") ==
          std::vector<std::string>{"1", "2", "3", "4", "5"});
  }
}

TEST_CASE("a row of a stream that cannot be used ends it with status 2; the answers before it stay") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene(all_said);
  const std::string log = "time,C.end\n# first\n1,1000\n2,2000\n3,3 kN\n4,4000\n";
  for (const std::string command : {"simulate", "estimate"}) {
    const Outcome outcome = run(scratch, command, true, log);
    CHECK(outcome.status == 2);
    CHECK(Table(outcome.out).column("time") == std::vector<std::string>{"1", "2"});
    CHECK(outcome.err.find("standard input: line 5, column 2 (C.end): \"3 kN\" is not a number; ") !=
          std::string::npos);
    CHECK(run(scratch, command, true, log, " --every 9 -o " + scratch.quoted("result")).status == 2);
    CHECK(Table(text_of(scratch.path / "result")).column("time") == std::vector<std::string>{"1", "2"});
  }
  const Outcome header = run(scratch, "estimate", true, "time,C.ende\n1,1000\n");
  CHECK(header.status == 2);
  CHECK(header.out.empty());
  CHECK(run(scratch, "estimate", true, "").err ==
        "standard input: line 1: the log is empty; write a header, \"time\" and further columns, and rows "
        "below it\n");
}

TEST_CASE("a row of a stream without an answer ends it with status 1 and the answers before it") {
  const Scratch scratch;
  std::filesystem::copy_file(TAUT_FILES "/two_jacks.json", scratch.path / "scene.json");
  const Outcome outcome = run(scratch, "simulate", true, "time,C.start,C.end\n1,1000,1000\n2,9000,1000\n");
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("standard input: line 3 (row 2, time 2 s), after ") != std::string::npos);
  CHECK(Table(outcome.out).rows.size() == 1);
}

TEST_CASE("a stream of an unsaid scene finds mu and forces, within what it says of them") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene("");
  const Outcome outcome = run(scratch, "estimate", true, ramp(1000, 500));
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.find("remark: the load cell \"C.start\" is taken for an ordinary one") !=
        std::string::npos);
  // 0.001 and 0.002 of the force of a strain of 0.5 %, 0.005 E A.
  CHECK(outcome.err.find(": sd 780 N, gain_sd 0.01, zero_sd 1560 N") != std::string::npos);
  const Table table(outcome.out);
  const auto within = [&](const std::string& value, const std::string& sd, double truth) {
    CHECK(std::fabs(table.number(999, value) - truth) < 3 * table.number(999, sd));
  };
  within("C.mu1", "C.mu_sd1", 0.3);
  within("C.T1", "C.sd1", far_end(2e5, 0.3));
  within("C.T4", "C.sd4", 2e5);
  CHECK(table.number(999, "C.mu_sd1") < 0.06);
}

TEST_CASE("a stream that begins under load is doubted at once; a first stage from zero until the next row") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene(all_said);
  const auto alarms = [&](bool streams, const std::string& log) {
    return Table(run(scratch, "estimate", streams, log).out).column("alarms");
  };
  const std::string loaded = ramp(100, 300, 1e5);
  CHECK(alarms(true, loaded) == alarms(false, loaded));
  CHECK(alarms(true, loaded)[5].find("unknown-past:C") != std::string::npos);
  CHECK(run(scratch, "estimate", true, loaded).err.find("remark: the log begins under load") !=
        std::string::npos);

  const std::string stages = "time,C.end\n1,50000\n2,100000\n3,150000\n4,200000\n";
  const Outcome streamed = run(scratch, "estimate", true, stages),
                from_file = run(scratch, "estimate", false, stages);
  CHECK(streamed.err.empty());
  const Table a(streamed.out), b(from_file.out);
  CHECK(a.at(0, "alarms") == "unknown-past:C");
  CHECK(b.at(0, "alarms").empty());
  CHECK(std::vector(a.rows.begin() + 1, a.rows.end()) == std::vector(b.rows.begin() + 1, b.rows.end()));
}

TEST_CASE("a stream goes on where a file ended, by the state between, with the bits of one log") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene(all_said);
  const std::string log = ramp(200, 300), head = log.substr(0, log.find('\n') + 1),
                    state = " --hex --state " + scratch.quoted("state");
  std::size_t at = head.size();
  for (int i = 0; i < 120; ++i) at = log.find('\n', at) + 1;
  const std::string whole = run(scratch, "estimate", false, log, " --hex").out;
  const Outcome first = run(scratch, "estimate", true, log.substr(0, at), state),
                second = run(scratch, "estimate", true, head + log.substr(at), state);
  REQUIRE(second.status == 0);
  CHECK(first.out + second.out.substr(second.out.find('\n') + 1) == whole);
}

// The address sanitizer keeps what is freed.
#ifndef __SANITIZE_ADDRESS__
TEST_CASE("twenty times as many rows take no more memory, from standard input or a file") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene("");
  std::ofstream(scratch.path / "few.csv") << ramp(10000, 300);
  std::ofstream(scratch.path / "many.csv") << ramp(200000, 300);
  // The most that any program run until now has taken [KiB].
  const auto most = [] {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return usage.ru_maxrss;
  };
  const auto follow = [&](const std::string& source) {
    REQUIRE(run_taut(scratch, "estimate " + scratch.quoted("scene.json") + " " + source +
                                  " --columns C.T1 --every 1000 -o " + scratch.quoted("result"))
                .status == 0);
  };
  for (const std::string source : {"- < ", ""}) {
    follow(source + scratch.quoted("few.csv"));
    const auto of_few = most();
    follow(source + scratch.quoted("many.csv"));
    // The log has 6 MB, and a double for every row would be 1600 KiB.
    CHECK(most() - of_few < 1000);
  }
}
#endif
