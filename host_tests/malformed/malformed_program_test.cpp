// What cannot be used makes the program say so on standard error, leave nothing behind and exit with
// status 2.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "expected_messages.hpp"
#include "files/run_program.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path malformed = TAUT_MALFORMED;

void check_refused(const Outcome& outcome, const std::string& message) {
  CHECK(outcome.status == 2);
  CHECK(outcome.out.empty());
  CHECK(outcome.err == message + "\n");
}

}  // namespace

TEST_CASE("the program refuses every malformed scene with status 2 and writes nothing else") {
  const Scratch scratch;
  fs::current_path(malformed / "scenes");
  for (const auto& [file, message] : expected_messages("."))
    check_refused(run_taut(scratch, "check " + file), message);
}

TEST_CASE("the program refuses every malformed log with status 2 and writes no result") {
  const Scratch scratch;
  fs::current_path(malformed / "logs");
  const fs::path result = scratch.path / "result.csv";
  for (const auto& [file, message] : expected_messages(".")) {
    check_refused(run_taut(scratch, "simulate scene.json " + file), message);
    check_refused(run_taut(scratch, "simulate scene.json " + file + " -o '" + result.string() + "'"),
                  message);
    CHECK_FALSE(fs::exists(result));
  }
}

TEST_CASE("a malformed log leaves an older result as it was") {
  const Scratch scratch;
  fs::current_path(malformed / "logs");
  const fs::path result = scratch.path / "result.csv";
  std::ofstream(result) << "older";
  CHECK(run_taut(scratch, "simulate scene.json row_cut_off.csv -o '" + result.string() + "'").status == 2);
  CHECK(text_of(result) == "older");
}

TEST_CASE("a wrong command line ends with status 2 and nothing on standard output") {
  const Scratch scratch;
  for (const char* arguments :
       {"", "chek scene.json", "check", "simulate scene.json", "simulate a b --method quick",
        "simulate a b --scalar half", "simulate a b --substeps 0", "simulate a b --substeps many",
        "simulate a b --tabs", "check a b"}) {
    const Outcome outcome = run_taut(scratch, arguments);
    CHECK_MESSAGE(outcome.status == 2, arguments);
    CHECK_MESSAGE(outcome.out.empty(), arguments);
    CHECK_MESSAGE(!outcome.err.empty(), arguments);
  }
}

TEST_CASE("help and version are answers, with status 0") {
  const Scratch scratch;
  CHECK(run_taut(scratch, "--version").status == 0);
  CHECK(run_taut(scratch, "--version").out.rfind("taut ", 0) == 0);
  CHECK(run_taut(scratch, "--help").status == 0);
  CHECK(run_taut(scratch, "simulate --help").status == 0);
}
