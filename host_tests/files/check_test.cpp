// What `taut check` says of a theory that does not do for its scene, and what `taut simulate` says then.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "files/run_program.hpp"
#include "lib/files/hanging_joints.hpp"
#include "lib/files/scene_file.hpp"

namespace {

using namespace taut::host;

const std::string root = TAUT_FILES "/../..";

void write(const Scratch& scratch, const std::string& name, const std::string& text) {
  std::ofstream(scratch.path / name) << text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The number behind the words; NaN without them.
double number_after(const std::string& text, const std::string& words) {
  const auto at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + words.size(), nullptr);
}

// A strut that is pinned at its top, under a cable that is jacked at its right end. The lean of the strut at
// large displacements follows from moments about its top; so do the load at which it runs away and
// T1 = 1 994 345 N, extension 0.0497816 m, strut -199 017 N at a jack of 1 991 880 N.
std::string one_strut(const std::string& mu) {
  return R"({ "taut": 1, "name": "one strut", "dimension": 2,
    "nodes": { "l": [-10, 0.5], "p": [0, 0], "r": [10, 0.5], "t": [0, 2] },
    "supports": { "l": "xy", "r": "xy", "t": "xy" },
    "struts": [ { "nodes": ["p", "t"], "E": 2e11, "A": 100 } ],
    "cables": [ { "name": "C", "path": ["l", "p", "r"], "E": 1.6e11, "A": 5e-3, "start": "anchored", "end": "jacked",
                  "friction": { "law": "point", "mu": )" +
         mu + " } } ] }";
}
const std::string strut_log = "time,C.end\n1,500000\n2,1000000\n3,1991880\n4,1000000\n";

// Eight struts under a ring, each with one rod outwards: sideways only the hoop's tension holds their feet.
std::string hoop(const std::string& theory) {
  std::string nodes, supports, struts, path, bearings;
  const double pi = std::acos(-1.0);
  for (int i = 0; i < 8; ++i) {
    const std::string n = std::to_string(i), comma = i == 0 ? "" : ", ";
    const double x = std::cos(i * pi / 4), y = std::sin(i * pi / 4);
    const auto at = [&](double radius, double z) {
      return "[" + std::to_string(radius * x) + ", " + std::to_string(radius * y) + ", " + std::to_string(z) +
             "]";
    };
    nodes += comma + "\"h" + n + "\": " + at(20, -3) + ", \"t" + n + "\": " + at(20, 0) + ", \"s" + n +
             "\": " + at(26, 0);
    supports += comma + "\"t" + n + "\": \"xyz\", \"s" + n + "\": \"xyz\"";
    struts += comma + R"({ "nodes": ["h)" + n + "\", \"t" + n +
              R"("], "E": 2.1e11, "A": 4e-3 }, { "nodes": ["h)" + n + "\", \"s" + n +
              R"("], "E": 2.1e11, "A": 2e-3 })";
    path += comma + "\"h" + n + "\"";
  }
  return R"({ "taut": 1, "name": "hoop", "dimension": 3, "nodes": { )" + nodes + " }, \"supports\": { " +
         supports + " }, \"struts\": [ " + struts + R"( ], "cables": [ { "name": "C", "path": [ )" + path +
         R"( ], "E": 1.6e11, "A": 2e-3, "closed": true, "prestrain": 0.003, "friction": { "law": "point", "mu": 0.1 } } ])" +
         theory + " }";
}

int directions(const std::string& members) {
  const SceneDescription scene = read_scene(R"({ "taut": 1, "name": "", "dimension": 2,
    "nodes": { "l": [-8, 1], "p": [0, 0], "r": [8, 1], "a": [-3, 4], "b": [3, 4], "t": [0, 5] },
    "supports": { "l": "xy", "r": "xy", "a": "xy", "b": "xy", "t": "xy" },
    )" + members + R"(
    "cables": [ { "name": "C", "path": ["l", "p", "r"], "E": 1.6e11, "A": 2e-3, "start": "anchored", "end": "jacked",
                  "friction": { "law": "point", "mu": 0.1 } } ] })",
                                            "scene.json");
  const auto joints = hanging_joints(scene);
  return joints.empty() ? 0 : joints[0].directions;
}

/// Nothing holds node "n" of this scene when the jack of cable "B" pulls.
void check_that_n_is_named(const std::string& scene) {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene;
  std::ofstream(scratch.path / "log.csv") << "time,B.end\n1,1000\n";
  const Outcome refused =
      run_taut(scratch, "simulate " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv"));
  CHECK(refused.status == 1);
  CHECK_MESSAGE(refused.err.find("node \"n\": mechanism: nothing holds this node; ") != std::string::npos,
                refused.err);
}

}  // namespace

TEST_CASE("a node that nothing uses is to be removed or connected") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << R"({ "taut": 1, "name": "spare", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [5, 0], "spare": [3, 3] }, "supports": { "a": "xy", "b": "xy" },
    "cables": [ { "name": "C", "path": ["a", "b"], "E": 2e11, "A": 1e-4, "start": "anchored", "end": "jacked" } ] })";
  const Outcome refused = run_taut(scratch, "check " + scratch.quoted("scene.json"));
  CHECK(refused.status == 1);
  CHECK_MESSAGE(
      refused.err.find("node \"spare\": mechanism: nothing holds this node; no strut, beam, cable or "
                       "substructure ends at it or passes it: remove it from \"nodes\", or connect it") !=
          std::string::npos,
      refused.err);
}

TEST_CASE("check says which jacks hold one another alone, and not of those that something else holds") {
  const auto mast = [](const std::string& struts) {
    return R"({ "taut": 1, "name": "mast", "dimension": 2,
      "nodes": { "base": [0, 0], "top": [0, 20], "l": [-15, 0], "r": [15, 0] },
      "supports": { "base": "xy", "l": "xy", "r": "xy" },
      "struts": [ )" +
           struts + R"({ "nodes": ["base", "top"], "E": 2.06e11, "A": 5e-3 } ],
      "cables": [ { "name": "L", "path": ["top", "l"], "E": 1.6e11, "A": 1e-3, "start": "anchored", "end": "jacked" },
                  { "name": "R", "path": ["top", "r"], "E": 1.6e11, "A": 1e-3, "start": "anchored", "end": "jacked" } ] })";
  };
  const Scratch scratch;
  const auto check = [&](const std::string& scene) {
    std::ofstream(scratch.path / "scene.json") << scene;
    const Outcome outcome = run_taut(scratch, "check " + scratch.quoted("scene.json"));
    CHECK(outcome.status == 0);
    return outcome.err;
  };
  CHECK(
      check(mast("")) ==
      "warning: while the forces of L.end and R.end are given, nothing holds what they pull at, and there is "
      "an "
      "answer "
      "only where they balance; lock or anchor all but one of them, or hold it: add a strut, a support or a "
      "substructure\n");
  CHECK(check(mast(R"({ "nodes": ["l", "top"], "E": 2.06e11, "A": 5e-3 }, )")).empty());
}

TEST_CASE("a node that two cables alone hold is named where they are slack, though they have no joint") {
  check_that_n_is_named(R"({ "taut": 1, "name": "free", "dimension": 2,
    "nodes": { "a": [0, 0], "n": [5, -1], "c": [10, 0], "d": [5, 4] },
    "supports": { "a": "xy", "c": "xy", "d": "xy" },
    "struts": [ { "nodes": ["a", "d"], "E": 2e11, "A": 1e-3 } ],
    "cables": [ { "name": "A", "path": ["a", "n"], "E": 2e11, "A": 1e-4, "start": "anchored", "end": "anchored" },
      { "name": "B", "path": ["n", "c"], "E": 2e11, "A": 1e-4, "start": "anchored", "end": "jacked" } ] })");
}

TEST_CASE("a node with a strut that one cable pulls aside is named, though the cable has no joint") {
  check_that_n_is_named(R"({ "taut": 1, "name": "aside", "dimension": 2,
    "nodes": { "n": [5, -1], "c": [10, -1], "d": [5, 4] },
    "supports": { "c": "xy", "d": "xy" },
    "struts": [ { "nodes": ["n", "d"], "E": 2e11, "A": 1e-3 } ],
    "cables": [
      { "name": "B", "path": ["n", "c"], "E": 2e11, "A": 1e-4, "start": "anchored", "end": "jacked" } ] })");
}

TEST_CASE("a joint hangs on its cable in every direction that no member resists") {
  CHECK(directions("") == 2);
  CHECK(directions(R"("struts": [ { "nodes": ["p", "t"], "E": 2e11, "A": 4e-3 } ],)") == 1);
  // Off the bisector, too.
  CHECK(directions(R"("struts": [ { "nodes": ["p", "a"], "E": 2e11, "A": 4e-3 } ],)") == 1);
  CHECK(directions(R"("struts": [ { "nodes": ["p", "a"], "E": 2e11, "A": 4e-3 },
                                  { "nodes": ["p", "b"], "E": 2e11, "A": 4e-3 } ],)") == 0);
  // A strut that is rigid in the beam above it; with a hinge there, or pinned to the ground, it leans.
  const std::string strut = R"({ "nodes": ["p", "t"], "E": 2.1e11, "A": 6e-3, "I": 3e-5)",
                    roof = R"({ "nodes": ["a", "t", "b"], "E": 2.1e11, "A": 2e-2, "I": 4e-4 })";
  CHECK(directions("\"beams\": [ " + strut + " }, " + roof + " ],") == 0);
  CHECK(directions("\"beams\": [ " + strut + R"(, "hinges": ["t"] }, )" + roof + " ],") == 1);
  CHECK(directions("\"beams\": [ " + strut + R"(, "hinges": ["p"] }, )" + roof + " ],") == 0);
  CHECK(directions("\"beams\": [ " + strut + " } ],") == 1);
  CHECK(
      directions(
          R"("substructures": [ { "name": "saddle", "nodes": ["p"], "stiffness": [[1e8, 0], [0, 0]] } ],)") ==
      1);
  CHECK(
      directions(
          R"("substructures": [ { "name": "saddle", "nodes": ["p"], "stiffness": [[1e8, 0], [0, 1e8]] } ],)") ==
      0);
}

TEST_CASE("in space two rods and a strut hold a joint, one rod leaves it to the cable along the hoop") {
  const std::string stem = root + "/firmware_example/data/suspen_dome_";
  CHECK(hanging_joints(read_scene_file(stem + "two_rods.json")).empty());
  const auto joints = hanging_joints(read_scene_file(stem + "one_rod.json"));
  CHECK(joints.size() == 11);
  for (const HangingJoint& joint : joints) CHECK(joint.directions == 1);
}

TEST_CASE("check says how far linear theory is off, as the closed form of a strut that leans has it") {
  const Scratch scratch;
  write(scratch, "scene.json", one_strut("0.1"));
  write(scratch, "log.csv", strut_log);
  const Outcome outcome =
      run_taut(scratch, "check " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv"));
  CHECK(outcome.status == 0);
  CHECK(has(outcome.out, "theory                  linear\n"));
  CHECK(has(outcome.out, "on the cable alone      joint 1 of cable \"C\" at node \"p\", in 1 direction\n"));
  // Linear theory has T1 = F.
  const double segments = 100 * (1994345 - 1991880) / 1994345.;
  CHECK(std::fabs(number_after(outcome.out, "linear theory           is off by ") - segments) <
        0.05 * segments);
  // Both theories are within what load cells are, but nothing holds the joint when it slides.
  CHECK(has(outcome.err,
            "joint 1 of cable \"C\" at node \"p\": when the cable slides there, nothing holds the node"));
  CHECK_FALSE(has(outcome.err, "is off by"));
}

TEST_CASE("check says at which load a strut runs away that linear theory does not see leaning") {
  const Scratch scratch;
  // At large displacements it runs away at 805 531 N, with mu 0.01 at 1 609 993 N.
  for (const auto& known : {std::pair{"0.005", 805531.}, {"0.01", 1609993.}}) {
    const auto [mu, load] = known;
    INFO("mu " << known.first);
    write(scratch, "scene.json", one_strut(mu));
    write(scratch, "log.csv", strut_log);
    const Outcome outcome =
        run_taut(scratch, "check " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv"));
    CHECK(outcome.status == 0);
    const double found = number_after(outcome.err, "second-order theory has no answer from C.end ");
    CHECK(std::fabs(found - load) < 0.005 * load);
    CHECK(has(outcome.err, "joint 1 of cable \"C\" at node \"p\": friction gives way"));
    CHECK(has(outcome.err, "; linear theory does not see it and goes on\n"));
  }
}

TEST_CASE(
    "a pinned strut that nothing can keep from running away is refused with the strut, the reason and the "
    "remedy") {
  const auto in_second_order = [](std::string scene) {
    const std::string target =
        R"(, "second_order": { "target": { "loads": {}, "forces": { "C.end": 1e6 } } } })";
    return scene.replace(scene.rfind('}'), 1, target);
  };
  const Scratch scratch;
  write(scratch, "log.csv", "time,C.end\n1,500000\n2,1000000\n");
  write(scratch, "scene.json", in_second_order(one_strut("0")));
  const std::string simulate = "simulate " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv");
  const Outcome smooth = run_taut(scratch, simulate);
  CHECK(smooth.status == 1);
  CHECK(has(smooth.err, "joint 1 of cable \"C\" at node \"p\""));
  CHECK(has(smooth.err, "without friction strut 1 from node \"t\" runs away; give the joint friction"));
  std::string two = one_strut("0.1");
  two.replace(two.find("anchored"), 8, "jacked");
  write(scratch, "scene.json", in_second_order(two));
  write(scratch, "log.csv", "time,C.start,C.end\n1,500000,500000\n");
  const Outcome both = run_taut(scratch, simulate);
  CHECK(both.status == 1);
  CHECK(
      has(both.err,
          "between two jacks at work the cable can follow this node, and strut 1 from node \"t\" runs away"));
  CHECK(has(both.err, "prescribe the stroke of one jack"));
  // With the wedge of one of them in, it stands.
  write(scratch, "log.csv", "time,C.start,C.end,C.start.locked\n1,0,500000,1\n");
  CHECK(run_taut(scratch, simulate).status == 0);
}

TEST_CASE(
    "a second-order target that has nothing to begin with is refused by its place, with nothing written") {
  const Scratch scratch;
  write(scratch, "log.csv", "time,C.end\n1,500000\n");
  const std::string expected =
      "/second_order/target: no cable has tension at the target; write the jack forces (\"forces\") and "
      "loads (\"loads\") under which the cables are taut\n";
  for (const char* target : {"{}", R"({ "loads": {}, "forces": {} })", R"({ "forces": { "C.end": 0 } })"}) {
    std::string scene = one_strut("0.1");
    scene.replace(scene.rfind('}'), 1, std::string(R"(, "second_order": { "target": )") + target + " } }");
    write(scratch, "scene.json", scene);
    for (const std::string command : {"simulate", "estimate", "check", "export"}) {
      const std::string log = command == "export" ? "" : " " + scratch.quoted("log.csv");
      const std::string output = command == "check" ? "" : " -o " + scratch.quoted("result");
      const Outcome outcome = run_taut(scratch, command + " " + scratch.quoted("scene.json") + log + output);
      CHECK(outcome.status == 2);
      CHECK(has(outcome.err, expected));
      CHECK_FALSE(std::filesystem::exists(scratch.path / "result"));
    }
  }
}

TEST_CASE("noise of readings is no load that struts run away from") {
  const Scratch scratch;
  std::string scene = text_of(root + "/firmware_example/data/beam_string_radial.json");
  const auto key = scene.rfind(",\n  \"second_order\"");
  REQUIRE(key != std::string::npos);
  write(scratch, "scene.json", scene.substr(0, key) + " }");
  // Up and down by 0.4 % of the largest force: at first the jack stands still while the load comes on.
  std::string log = "time,dead,C.end\n";
  for (int i = 0; i <= 500; ++i)
    log += std::to_string(i) + "," + std::to_string(i / 500.) + "," +
           std::to_string(720000 * i / 500. + (i % 3 == 0 ? 3000 : -3000)) + "\n";
  write(scratch, "log.csv", log);
  const Outcome outcome =
      run_taut(scratch, "check " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv"));
  CHECK(outcome.status == 0);
  CHECK_FALSE(has(outcome.err, "no answer"));
  // The largest force is that of row 498.
  CHECK(has(
      outcome.err,
      "\"second_order\": { \"target\": { \"loads\": { \"dead\": 0.996 }, \"forces\": { \"C.end\": 720120 }"));
}

TEST_CASE("a sound truss string gets a number and no warning") {
  const Scratch scratch;
  const std::string stem = root + "/firmware_example/data/truss_string";
  const Outcome outcome = run_taut(scratch, "check '" + stem + ".json' '" + stem + ".csv'");
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(has(outcome.out, "on the cable alone      no joint\n"));
  const double segments = number_after(outcome.out, "linear theory           is off by ");
  CHECK(segments > 0);
  CHECK(segments < 0.1);
}

TEST_CASE("without a log check says how to learn how far linear theory is off") {
  const Scratch scratch;
  write(scratch, "scene.json", one_strut("0.1"));
  const Outcome outcome = run_taut(scratch, "check " + scratch.quoted("scene.json"));
  CHECK(outcome.status == 0);
  CHECK(has(outcome.out, "linear theory           how far it is off says: taut check SCENE LOG\n"));
}

TEST_CASE(
    "where linear theory refuses and second-order theory does not, the key that check shows makes the scene "
    "stand") {
  const Scratch scratch;
  write(scratch, "scene.json", hoop(""));
  const Outcome refused = run_taut(scratch, "check " + scratch.quoted("scene.json"));
  CHECK(refused.status == 1);
  CHECK(has(refused.err, "mechanism: nothing holds this node; second-order theory has an answer; write "));
  const auto from = refused.err.find("\"second_order\": "), to = refused.err.find(" into the scene");
  REQUIRE(from < to);
  REQUIRE(to != std::string::npos);
  write(scratch, "leaning.json", hoop(", " + refused.err.substr(from, to - from)));
  const Outcome stands = run_taut(scratch, "check " + scratch.quoted("leaning.json"));
  CHECK(stands.status == 0);
  CHECK(stands.err.empty());
  CHECK(has(stands.out, "on the cable alone      joints 1 to 8 of cable \"C\", in 1 direction\n"));
}

TEST_CASE(
    "a cable that loads alone tension has a target of second-order theory, and one that hangs slack has "
    "none") {
  const Scratch scratch;
  // Two nodes hang on a cable between anchors, 1 m below them over 10 m: 1e5 N on each makes H = 1e6 N
  // between them, which E A = 1.6e12 N turn into 1e-4 of that metre.
  const std::string hung = R"({ "taut": 1, "name": "hung", "dimension": 2,
    "nodes": { "a": [0, 0], "p": [10, -1], "q": [20, -1], "b": [30, 0] }, "supports": { "a": "xy", "b": "xy" },
    "cables": [ { "name": "C", "path": ["a", "p", "q", "b"], "E": 1.6e11, "A": 10, "start": "anchored", "end": "anchored",
                  "friction": { "law": "point", "mu": 0.3 } } ],
    "loads": { "w": { "forces": { "p": [0, -1e5], "q": [0, -1e5] } } })";
  write(scratch, "scene.json", hung + R"(, "second_order": { "target": { "loads": { "w": 1 } } } })");
  write(scratch, "log.csv", "time,w\n1,0.5\n2,1\n");
  const std::string files = scratch.quoted("scene.json") + " " + scratch.quoted("log.csv");
  const Outcome stands = run_taut(scratch, "simulate " + files + " --columns C.T2");
  CHECK(stands.status == 0);
  CHECK(std::fabs(number_after(stands.out, "\n1,") / 5e5 - 1) < 3e-4);
  CHECK(std::fabs(number_after(stands.out, "\n2,") / 1e6 - 1) < 3e-4);
  // A push upwards leaves it slack.
  write(scratch, "scene.json", hung + R"(, "second_order": { "target": { "loads": { "w": -1 } } } })");
  const Outcome slack = run_taut(scratch, "simulate " + files);
  CHECK(slack.status == 2);
  CHECK(has(slack.err, "/second_order/target: no cable has tension at the target; "));
  // Without the key, and a log in which nothing has tension.
  write(scratch, "scene.json", hung + " }");
  write(scratch, "log.csv", "time\n1\n");
  const Outcome loose = run_taut(scratch, "check " + files);
  CHECK(loose.status == 1);
  CHECK_FALSE(has(loose.err, "second-order theory has an answer"));
}

TEST_CASE("between rigid saddles nothing leans, and a log is read all the same") {
  const Scratch scratch;
  const std::string stem = root + "/firmware_example/data/rolling_joint";
  const Outcome outcome = run_taut(scratch, "check '" + stem + ".json' '" + stem + ".csv'");
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(has(outcome.out, "theory                  linear: nothing leans between rigid saddles\n"));
  write(scratch, "log.csv", "time,D.end\n1,5\n");
  CHECK(run_taut(scratch, "check '" + stem + ".json' " + scratch.quoted("log.csv")).status == 2);
}

TEST_CASE("load steps that jam are tried smaller before that is recommended") {
  const Scratch scratch;
  const std::string stem = root + "/host_tests/hard_cases/data/lacing_soft";
  const std::string files =
      "simulate '" + stem + ".json' '" + stem + ".csv' -o " + scratch.quoted("result.csv");
  const Outcome outcome = run_taut(scratch, files + " --method stepwise");
  CHECK(outcome.status == 1);
  CHECK(has(outcome.err,
            "jammed: the joint states do not settle; smaller load steps do not help: try --method tracker"));
  // Which helps.
  CHECK(run_taut(scratch, files).status == 0);
}
