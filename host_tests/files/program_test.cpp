// The program on usable input: where its result goes and what its exit status says.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "files/result_table.hpp"
#include "files/run_program.hpp"
#include "lib/kinds/capacities.hpp"

namespace fs = std::filesystem;

namespace {

const std::string scene = TAUT_FILES "/two_jacks.json";
const std::string one_jack = TAUT_FILES "/one_jack.json";
const std::string vertical_strut = TAUT_FILES "/vertical_strut.json";
const std::string beam_string = TAUT_FILES "/beam_string.json";

/// The class of a scene that all of them hold.
template <class First, class... Larger>
std::string smallest(taut::host::CapacityList<First, Larger...>) {
  return First::name;
}

// The arguments of a simulation with this log.
std::string simulation(const Scratch& scratch, const std::string& log, const std::string& of = scene) {
  std::ofstream(scratch.path / "log.csv") << log;
  return "simulate '" + of + "' " + scratch.quoted("log.csv");
}

double number(const std::string& field) { return std::strtod(field.c_str(), nullptr); }

// The largest difference of two results relative to the size of the numbers; words must be the same.
double difference(const std::string& a, const std::string& b) {
  std::istringstream first(a), second(b);
  double largest = 0;
  for (std::string x, y; std::getline(first, x) && std::getline(second, y);) {
    const auto xs = fields(x), ys = fields(y);
    REQUIRE(xs.size() == ys.size());
    for (std::size_t i = 0; i < xs.size(); ++i) {
      char* end = nullptr;
      const double value = std::strtod(xs[i].c_str(), &end);
      if (*end != '\0') CHECK(xs[i] == ys[i]);
      if (*end == '\0')
        largest = std::max(largest, std::fabs(value - number(ys[i])) / std::max(std::fabs(value), 1e-3));
    }
  }
  return largest;
}

const std::string even = "time,C.start,C.end\n1,1000,1000\n2,2000,2000\n";
const std::string torn = "time,C.start,C.end\n1,1000,1000\n2,9000,1000\n3,1000,1000\n";

auto lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

}  // namespace

TEST_CASE("a jack force that no cable carries ends a simulation with status 2 before anything is written") {
  const Scratch scratch;
  for (const std::string method : {"tracker", "stepwise"}) {
    CAPTURE(method);
    const Outcome outcome = run_taut(
        scratch, simulation(scratch, "time,C.end\n1,1000\n2,9.9e37\n", one_jack) + " --method " + method);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    // E A is 2e7 N.
    CHECK(
        outcome.err.find("log.csv: line 3, column 2 (C.end): the jack force 9.9e+37 is more than cable \"C\" "
                         "can carry") != std::string::npos);
    CHECK(outcome.err.find("write a force in N below 2e+06: is the unit wrong?") != std::string::npos);
  }
}

TEST_CASE("check describes a usable scene on standard output") {
  const Scratch scratch;
  const Outcome outcome = run_taut(scratch, "check '" + scene + "'");
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.find("capacity class          " + smallest(taut::host::Capacities()) + "\n") !=
        std::string::npos);
  CHECK(outcome.out.find(
            "cable \"C\"               jacked to jacked, 2 segments, 1 joint, 0 locked by friction\n") !=
        std::string::npos);
  CHECK(outcome.out.find("flash                   about 96 bytes in float") != std::string::npos);
  CHECK(outcome.out.find("stack                   about ") != std::string::npos);
  CHECK(outcome.out.find("mechanisms              none before any load\n") != std::string::npos);
}

TEST_CASE("check warns of a joint that sets its node free when it slides, and says what helps") {
  const Scratch scratch;
  const Outcome outcome = run_taut(scratch, "check '" + vertical_strut + "'");
  CHECK(outcome.status == 0);
  CHECK(outcome.out.find("mechanisms              none before any load; 1 joint free to slide\n") !=
        std::string::npos);
  CHECK(
      outcome.err ==
      "warning: joint 1 of cable \"C\" at node \"top\": when the cable slides there, nothing holds the node; "
      "\"second_order\" in the scene makes the cable's tension count, which may hold it, or add a second "
      "strut, a support or a substructure at that node\n");
}

TEST_CASE("check says how many beams there are and what they bring") {
  const Scratch scratch;
  const Outcome outcome = run_taut(scratch, "check '" + beam_string + "'");
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.find("beam members            5 of ") != std::string::npos);
  // Five nodes turn: not the hinge in the middle.
  CHECK(outcome.out.find("beams                   1 beam of 5 members; 5 rotations unknown beside the "
                         "displacements\n") != std::string::npos);
  CHECK(run_taut(scratch, "check '" + scene + "'").out.find("\nbeams ") == std::string::npos);
}

TEST_CASE("the cable under a hinged beam has the force that moments about the hinge ask for") {
  const Scratch scratch;
  // A quarter of the load in the right support, 12 m beside the hinge; T sine pulls there down, and up 2 m
  // beside the hinge.
  const double sine = 2.5 / std::hypot(12, 2.5), T = 1e4 / 4 * 12 / (sine * (12 - 2));
  for (const std::string method : {"tracker", "stepwise"}) {
    CAPTURE(method);
    const Outcome outcome = run_taut(
        scratch, simulation(scratch, "time,weight\n1,1\n2,3\n", beam_string) + " --method " + method);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    const Table table(outcome.out);
    for (const auto& [row, factor] : {std::pair<std::size_t, double>{0, 1}, {1, 3}}) {
      for (const char* segment : {"C.T1", "C.T2"})
        CHECK(std::fabs(table.number(row, segment) - factor * T) < 1e-9 * T);
      // The struts hold up what both segments pull down.
      for (const char* strut : {"strut1", "strut2"})
        CHECK(std::fabs(table.number(row, strut) + factor * T * sine * std::hypot(2, 2.5) / 2.5) < 1e-9 * T);
    }
  }
}

TEST_CASE("a beam in space that turns about its own axis is a mechanism, and what helps is said") {
  const Scratch scratch;
  std::ofstream(scratch.path / "loose.json") << R"({ "taut": 1, "name": "loose", "dimension": 3,
    "nodes": { "a": [0, 0, 0], "b": [4, 0, 0], "c": [9, 0, 0] }, "supports": { "a": "xyz", "c": "yz" },
    "beams": [ { "nodes": ["a", "b", "c"], "E": 2.1e11, "A": 0.02, "Iy": 4e-4, "Iz": 1e-4, "J": 9e-6 } ],
    "cables": [ { "name": "C", "path": ["a", "c"], "E": 2e11, "A": 1e-4, "start": "anchored", "end": "anchored" } ] })";
  const Outcome outcome = run_taut(scratch, "check " + scratch.quoted("loose.json"));
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("mechanism: nothing holds this node; add a strut, a support or a substructure that "
                         "holds it, or hold the rotation of a beam that turns freely\n") !=
        std::string::npos);
}

TEST_CASE("the method is the tracker unless another one is asked for") {
  const Scratch scratch;
  const std::string arguments = simulation(scratch, even) + " --hex";
  CHECK(run_taut(scratch, arguments).out == run_taut(scratch, arguments + " --method tracker").out);
}

TEST_CASE("tracker and stepwise agree where the answer is one straight piece") {
  const Scratch scratch;
  const std::string arguments = simulation(scratch, "time,C.end\n1,1000\n2,30000\n3,90000\n", one_jack);
  const Outcome tracker = run_taut(scratch, arguments);
  const Outcome stepwise = run_taut(scratch, arguments + " --method stepwise");
  CHECK(tracker.status == 0);
  CHECK(stepwise.status == 0);
  CHECK(Table(tracker.out).column("C.state1") == std::vector<std::string>(3, "forward"));
  CHECK(difference(tracker.out, stepwise.out) < 1e-9);
}

TEST_CASE("load steps are accepted and remarked on where the tracker has none to divide") {
  const Scratch scratch;
  const std::string arguments = simulation(scratch, even);
  const Outcome outcome = run_taut(scratch, arguments + " --substeps 7");
  CHECK(outcome.status == 0);
  CHECK(outcome.err.rfind("remark: --substeps has no effect", 0) == 0);
  CHECK(outcome.out == run_taut(scratch, arguments).out);
  CHECK(run_taut(scratch, arguments + " --substeps 7 --method stepwise").err.empty());
}

TEST_CASE("a locked jack keeps its extension less the seating, and takes hold again when it is unlocked") {
  const Scratch scratch;
  const std::string log = "time,C.end,C.end.locked\n1,50000,0\n2,,1\n3,,1\n4,70000,0\n";
  const Outcome outcome = run_taut(scratch, simulation(scratch, log, one_jack));
  CHECK(outcome.status == 0);
  const Table table(outcome.out);
  const auto extension = table.column("C.end.payout"), T2 = table.column("C.T2");
  CHECK(std::fabs(number(extension[1]) - (number(extension[0]) - 0.002)) < 1e-12);
  CHECK(number(T2[1]) < 50000);
  CHECK(extension[2] == extension[1]);
  CHECK(T2[2] == T2[1]);
  CHECK(std::fabs(number(T2[3]) - 70000) < 1e-6);
}

TEST_CASE("a number that is zero has no sign") {
  const Scratch scratch;
  const std::string log = "time,C.end\n1,1000\n2,0\n3,1000\n4,0\n";
  const std::string arguments = simulation(scratch, log, one_jack);
  CHECK(run_taut(scratch, arguments).out.find(",-0,") == std::string::npos);
  CHECK(run_taut(scratch, arguments + " --hex --scalar float").out.find("80000000") == std::string::npos);
}

TEST_CASE("a result has a row for every row of the log, on standard output or in a file") {
  const Scratch scratch;
  const std::string arguments = simulation(scratch, even);
  const Outcome shown = run_taut(scratch, arguments);
  CHECK(shown.status == 0);
  CHECK(shown.err.empty());
  CHECK(shown.out.rfind("time,C.T1,C.T2,C.slip1,C.state1,C.N1,C.f1,C.start.payout,C.end.payout\n1,", 0) == 0);
  CHECK(lines(shown.out) == 3);
  const Outcome kept = run_taut(scratch, arguments + " -o " + scratch.quoted("result.csv"));
  CHECK(kept.status == 0);
  CHECK(kept.out.empty());
  CHECK(text_of(scratch.path / "result.csv") == shown.out);
}

TEST_CASE("hexadecimal results have eight digits in float and sixteen in double") {
  const Scratch scratch;
  const std::string arguments = simulation(scratch, even) + " --hex";
  CHECK(run_taut(scratch, arguments + " --scalar float").out.find("\n3f800000,447a0000,") !=
        std::string::npos);
  CHECK(run_taut(scratch, arguments).out.find("\n3ff0000000000000,408f4") != std::string::npos);
}

TEST_CASE("a row without an answer ends the result with status 1 and the rows before it") {
  const Scratch scratch;
  const Outcome outcome =
      run_taut(scratch, simulation(scratch, torn) + " -o " + scratch.quoted("result.csv"));
  CHECK(outcome.status == 1);
  CHECK(lines(text_of(scratch.path / "result.csv")) == 2);
  CHECK(outcome.err.find("log.csv: line 3 (row 2, time 2 s), after ") != std::string::npos);
  CHECK(outcome.err.find("cable \"C\"") != std::string::npos);
  CHECK(lines(outcome.err) == 1);
}

TEST_CASE("a node that a sliding joint sets free ends the result with the row, the joint and what helps") {
  const Scratch scratch;
  const Outcome outcome =
      run_taut(scratch, simulation(scratch, "time,wind,C.end\n1,0,90000\n2.5,10,90000\n", vertical_strut));
  CHECK(outcome.status == 1);
  CHECK(lines(outcome.out) == 2);
  CHECK(outcome.err.find("log.csv: line 3 (row 2, time 2.5 s), after ") != std::string::npos);
  CHECK(outcome.err.find(
            "joint 1 of cable \"C\" at node \"top\": mechanism: when the cable slides over this "
            "joint, nothing holds its node; \"second_order\" in the scene makes the cable's tension "
            "count, which may hold it, or add a second strut, a support or a substructure at that "
            "node") != std::string::npos);
}

TEST_CASE("jacks that pull the cable through are told with the place on the path where it begins") {
  const Scratch scratch;
  const Outcome outcome = run_taut(scratch, simulation(scratch, torn));
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find(
            "log.csv: line 3 (row 2, time 2 s), after 2.778 % of the path to it: cable \"C\": the cable is "
            "pulled through") != std::string::npos);
}

TEST_CASE(
    "a jack without a force column is remarked on, and nothing but the result goes to standard output") {
  const Scratch scratch;
  const Outcome outcome = run_taut(scratch, simulation(scratch, "time,C.start\n1,0\n"));
  CHECK(outcome.err == "remark: the log has no column \"C.end\": this jack force stays 0\n");
  CHECK(outcome.out.rfind("time,", 0) == 0);
}

TEST_CASE("a result does not overwrite its own input") {
  const Scratch scratch;
  const Outcome outcome = run_taut(scratch, simulation(scratch, even) + " -o " + scratch.quoted("log.csv"));
  CHECK(outcome.status == 2);
  CHECK(text_of(scratch.path / "log.csv") == even);
}

TEST_CASE("a full disk is an error") {
  if (!fs::exists("/dev/full")) return;
  const Scratch scratch;
  const std::string arguments = simulation(scratch, even);
  CHECK(run_taut(scratch, arguments + " -o /dev/full").status == 2);
}

namespace {

// A beam of 20 m on two supports, and a cable that is straight between them; `load` pushes the middle down by
// one metre. It buckles under a thrust of 49348 N.
std::string simple_beam(const Scratch& scratch, const std::string& further) {
  const double EI = 2e11 * 1e-5, metre = 48 * EI / (20.0 * 20 * 20);
  std::ofstream(scratch.path / "beam.json")
      << R"({"taut": 1, "name": "simple beam", "dimension": 2, "nodes": {"l": [0, 0], "m": [10, 0], "r": [20, 0]},
             "supports": {"l": "xy", "r": "y"},
             "beams": [{"nodes": ["l", "m", "r"], "E": 2e11, "A": 0.01, "I": 1e-5}],
             "cables": [{"name": "C", "path": ["l", "r"], "E": 2e11, "A": 1e-3, "start": "anchored", "end": "jacked"}],
             "loads": {"load": {"forces": {"m": [0, )"
      << -metre << "]}}}" << further << "}";
  return (scratch.path / "beam.json").string();
}

}  // namespace

TEST_CASE("displacements that are no small ones are remarked on once, with what helps") {
  // Half a length of the beam is 10 m.
  const Scratch scratch;
  const std::string log = "time,C.end,load\n1,1,0.45\n2,1,-0.51\n3,1,0.6\n";
  const Outcome linear = run_taut(scratch, simulation(scratch, log, simple_beam(scratch, "")));
  CHECK(linear.status == 0);
  CHECK(
      linear.err.find("line 3 (row 2, time 2 s): node \"m\" has moved by 0.51 m, and against node \"l\" by "
                      "5.1 % of their distance; linear theory is made for displacements up to a twentieth") !=
      std::string::npos);
  CHECK(linear.err.find("give the scene \"second_order\"") != std::string::npos);
  CHECK(lines(linear.err) == 1);
  const Outcome small =
      run_taut(scratch, simulation(scratch, "time,C.end,load\n1,1,0.49\n", simple_beam(scratch, "")));
  CHECK(small.err.empty());
  // A thrust of 1 N adds nothing to them; the half that goes down by 2.3 m comes in by 0.27 m.
  const std::string second = R"(, "second_order": {"target": {"forces": {"C.end": 1}}})";
  const Outcome leaning = run_taut(
      scratch, simulation(scratch, "time,C.end,load\n1,1,1.9\n2,1,2.3\n", simple_beam(scratch, second)));
  CHECK(leaning.status == 0);
  CHECK(leaning.err.find(
            "line 3 (row 2, time 2 s): node \"m\" has moved by 2.32 m, and against node \"l\" by "
            "23.2 % of their distance; second-order theory is made for displacements up to a fifth") !=
        std::string::npos);
  CHECK(lines(leaning.err) == 1);
}

TEST_CASE("a temperature that has no effect for want of the cable's alpha is remarked on") {
  const Scratch scratch;
  const auto remarks_with = [&](const std::string& alpha) {
    std::ofstream(scratch.path / "warm.json")
        << R"({"taut": 1, "name": "warm wire", "dimension": 2, "nodes": {"a": [0, 0], "b": [10, 0]},
               "supports": {"a": "xy", "b": "xy"},
               "cables": [{"name": "C", "path": ["a", "b"], "E": 2e11, "A": 1e-3, "start": "anchored", "end": "anchored",
                           "prestrain": 0.001)"
        << alpha << R"(}], "loads": {"sun": {"temperature": {"C": 10}}}})";
    return run_taut(scratch, simulation(scratch, "time,sun\n1,1\n", (scratch.path / "warm.json").string()))
        .err;
  };
  CHECK(remarks_with("") ==
        "remark: the load \"sun\" warms cable \"C\", which has no \"alpha\": its temperature changes "
        "nothing\n");
  CHECK(remarks_with(R"(, "alpha": 1.2e-5)").empty());
}

TEST_CASE("a target at which a beam buckles is refused with that reason, and one below it is not") {
  const Scratch scratch;
  for (const auto& [force, buckles] : {std::pair{"40000", false}, std::pair{"60000", true}}) {
    CAPTURE(force);
    const std::string target =
        std::string(R"(, "second_order": {"target": {"forces": {"C.end": )") + force + "}}}";
    const Outcome outcome =
        run_taut(scratch, simulation(scratch, "time,C.end,load\n1,1000,0\n", simple_beam(scratch, target)));
    CHECK(outcome.status == (buckles ? 1 : 0));
    CHECK((outcome.err.find("members buckle") != std::string::npos) == buckles);
    CHECK((outcome.err.find("name a smaller target") != std::string::npos) == buckles);
    CHECK(outcome.err.find("--scalar double") == std::string::npos);
  }
}
