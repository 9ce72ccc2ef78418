// What a command line asks for: files that a run writes, none in the place of another one, and what cannot be
// written or meant is said before anything is.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "files/run_program.hpp"

namespace fs = std::filesystem;

namespace {

const std::string one_jack = TAUT_FILES "/one_jack.json";
const std::string rows = "time,C.end\n1,1000\n2,2000\n";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Runs the program in the folder, with a scene, a log and a goal in it.
Outcome run_in(const Scratch& scratch, const std::string& arguments) {
  fs::copy_file(one_jack, scratch.path / "scene.json", fs::copy_options::overwrite_existing);
  std::ofstream(scratch.path / "log.csv") << rows;
  std::ofstream(scratch.path / "goal.json") << R"({ "taut": 1, "target": { "C": 1e4 } })";
  return run_taut(scratch, arguments, "cd '" + scratch.path.string() + "'");
}

bool is_there(const Scratch& scratch, const std::string& file) { return fs::exists(scratch.path / file); }

}  // namespace

TEST_CASE("two outputs of one run are two files, however they are spelt") {
  const Scratch scratch;
  fs::create_directory(scratch.path / "folder");
  fs::create_directory_symlink("folder", scratch.path / "link");
  const std::string state = "estimate scene.json log.csv -o x --state ",
                    sheet = "plan scene.json goal.json -o x --report ";
  for (const std::string& both :
       {state + "./x", state + "folder/../x", state + scratch.quoted("x"), sheet + "./x",
        std::string("estimate scene.json log.csv -o folder/x --state link/x"),
        std::string("watch scene.json log.csv --speed 1e6 --record x --state ./x")}) {
    CAPTURE(both);
    const Outcome outcome = run_in(scratch, both);
    CHECK(outcome.status == 2);
    CHECK(has(outcome.err, "; name another file\n"));
    CHECK_FALSE(is_there(scratch, "x"));
    CHECK_FALSE(is_there(scratch, "folder/x"));
  }
}

TEST_CASE("the header of a scene and its C interface are three files") {
  const Scratch scratch;
  for (const char* header : {"jack.h", "./jack.h", "jack.cpp"}) {
    CAPTURE(header);
    const Outcome outcome = run_in(scratch, std::string("export scene.json --c jack -o ") + header);
    CHECK(outcome.status == 2);
    CHECK(has(outcome.err, "is the header of the scene and a file of its C interface; name another file\n"));
    CHECK_FALSE(is_there(scratch, "jack.h"));
    CHECK_FALSE(is_there(scratch, "jack.cpp"));
  }
}

TEST_CASE("a file that cannot be written is said before anything is computed or written") {
  const Scratch scratch;
  for (const std::string arguments : {"estimate scene.json log.csv -o out.csv --state nowhere/state",
                                      "plan scene.json goal.json -o out.csv --report nowhere/sheet.html",
                                      "plan scene.json goal.json -o nowhere/log.csv --report out.csv"}) {
    CAPTURE(arguments);
    const Outcome outcome = run_in(scratch, arguments);
    CHECK(outcome.status == 2);
    CHECK(has(outcome.err, "cannot be written: No such file or directory; name a place"));
    CHECK(outcome.out.empty());
    CHECK_FALSE(is_there(scratch, "out.csv"));
  }
}

TEST_CASE("what could be written is as it was where the run then fails") {
  const Scratch scratch;
  std::ofstream(scratch.path / "plan.csv") << "older\n";
  std::ofstream(scratch.path / "bad.json") << "{}";
  CHECK(run_in(scratch, "plan scene.json bad.json -o plan.csv").status == 2);
  CHECK(text_of(scratch.path / "plan.csv") == "older\n");
}

TEST_CASE("an output of - is standard output") {
  const Scratch scratch;
  for (const std::string command :
       {"simulate scene.json log.csv", "export scene.json", "template scene.json"}) {
    CAPTURE(command);
    const Outcome plain = run_in(scratch, command), named = run_in(scratch, command + " -o -");
    CHECK(named.status == 0);
    CHECK_FALSE(named.out.empty());
    CHECK(named.out == plain.out);
    CHECK_FALSE(is_there(scratch, "-"));
  }
}

TEST_CASE("a file that is not there is called by what it should be") {
  const Scratch scratch;
  const auto says = [&](const std::string& arguments) { return run_in(scratch, arguments).err; };
  CHECK(has(says("plan scene.json nowhere"), "name a goal file that can be read"));
  CHECK(has(says("report scene.json log.csv -o x.html --job nowhere"), "name a job file that can be read"));
  CHECK(has(says("simulate nowhere log.csv"), "name a scene file that can be read"));
  CHECK(has(says("simulate scene.json nowhere"), "name a log file that can be read"));
  CHECK(has(says("estimate scene.json log.csv --state ."), ".: is a directory; name a file for the output"));
  CHECK(has(says("watch scene.json log.csv --state ."), ".: is a directory; name a state file"));
}

TEST_CASE("a command that is not known is named, with the one that was meant or all that there are") {
  const Scratch scratch;
  const Outcome near = run_in(scratch, "simulat scene.json log.csv"),
                far = run_in(scratch, "scene.json log.csv");
  CHECK(near.status == 2);
  CHECK(near.err == "taut: there is no command \"simulat\"; did you mean \"simulate\"?\n");
  CHECK(far.status == 2);
  CHECK(has(far.err, "taut: there is no command \"scene.json\"; the commands are \"check\", \"simulate\""));
}

TEST_CASE("limits between which no force lies are refused") {
  for (const std::string command : {"estimate scene.json log.csv", "report scene.json log.csv -o x.html",
                                    "watch scene.json log.csv --speed 1e6"}) {
    CAPTURE(command);
    const Scratch scratch;
    const Outcome outcome = run_in(scratch, command + " --least-force 2e5 --most-force 1.5e5");
    CHECK(outcome.status == 2);
    CHECK(outcome.err ==
          "--least-force: the limit of 2e+05 N is above that of --most-force, 150000 N; write the smaller "
          "one here\n");
    CHECK_FALSE(is_there(scratch, "x.html"));
    for (const char* possible : {" --least-force 1.5e5 --most-force 1.5e5", " --least-force 2e5"})
      CHECK(run_in(scratch, command + possible).status == 0);
  }
}
