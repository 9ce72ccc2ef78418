// The header that `taut template` writes: what it says, and that it heads a log.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "files/result_table.hpp"
#include "files/run_program.hpp"

namespace {

std::string last_line(const std::string& text) {
  const std::string lines = text.substr(0, text.size() - 1);
  return lines.substr(lines.rfind('\n') + 1);
}

}  // namespace

TEST_CASE(
    "the template has every column of a scene, and says what it is, its unit and whether it is needed") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << R"({ "taut": 1, "name": "two cables", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0.2], "c": [2, 0], "top": [1, 1] },
    "supports": { "a": "xy", "c": "xy", "top": "xy" },
    "struts": [ { "nodes": ["b", "top"], "E": 2e11, "A": 1e-3 }, { "nodes": ["b", "c"], "E": 2e11, "A": 1e-3 } ],
    "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 2e11, "A": 1e-4, "start": "anchored", "end": "jacked" },
                { "name": "H", "path": ["a", "b", "top"], "E": 2e11, "A": 1e-4, "closed": true } ],
    "loads": { "snow": { "forces": { "b": [0, -1] } } },
    "sensors": { "C.end": { "calibration": [[0, 0], [10, 2000]] } } })";
  const Outcome outcome = run_taut(scratch, "template " + scratch.quoted("scene.json"));
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(last_line(outcome.out) ==
        "time,snow,C.start,C.end,C.end.locked,C.end.stroke,C.T1,C.T2,H.T1,H.T2,H.T3,strut1,strut2");
  for (const std::string remark :
       {"# Log for the scene \"two cables\"", "# time [s]: needed;",
        "# snow [1]: factor of this load; needed",
        "# C.start [N]: load cell at the anchored start of cable \"C\"; a measurement",
        "# C.end [as its gauge shows; the calibration in the scene makes N of it]: force of the jack at the "
        "end of cable \"C\"; needed",
        "# C.end.locked [0 or 1]: 1 while a wedge holds the end of cable \"C\"",
        "# C.end.stroke [m]: extension of the jack",
        "# C.T2 [N]: force of the segment from node \"b\" to \"c\"",
        "# H.T3 [N]: force of the segment from node \"top\" to \"a\"",
        "# strut1 [N]: axial force of the strut from node \"b\" to \"top\", tension positive"})
    CHECK_MESSAGE(("\n" + outcome.out).find("\n" + remark) != std::string::npos, remark);
}

TEST_CASE("the template of every scene here heads a log of it as it is") {
  for (const char* const name :
       {"every_key.json", "one_jack.json", "two_jacks.json", "vertical_strut.json"}) {
    CAPTURE(name);
    const Scratch scratch;
    const std::string scene = std::string("'" TAUT_FILES "/") + name + "'", log = scratch.quoted("log.csv");
    REQUIRE(run_taut(scratch, "template " + scene + " -o " + log).status == 0);
    const std::string head = text_of(scratch.path / "log.csv");
    const auto columns = fields(last_line(head)).size();
    std::ofstream(scratch.path / "log.csv", std::ios::app) << "0" << std::string(columns - 1, ',') << "\n";
    const Outcome outcome = run_taut(scratch, "simulate " + scene + " " + log);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.find("has no column") == std::string::npos);
    CHECK(Table(outcome.out).rows.size() == 1);
  }
}

TEST_CASE("there is no template for a scene that cannot be used, and none takes the place of its scene") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << "{}";
  const Outcome outcome = run_taut(scratch, "template " + scratch.quoted("scene.json"));
  CHECK(outcome.status == 2);
  CHECK(outcome.out.empty());
  std::filesystem::copy_file(TAUT_FILES "/one_jack.json", scratch.path / "copy.json");
  CHECK(run_taut(scratch, "template " + scratch.quoted("copy.json") + " -o " + scratch.quoted("copy.json"))
            .status == 2);
}
