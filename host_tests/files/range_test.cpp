// Numbers out of all range, one at a time in a scene and its log: a result has finite numbers or is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "files/run_program.hpp"

namespace {

const std::string scene = text_of(TAUT_FILES "/every_key.json");
const std::string log_file = text_of(TAUT_FILES "/every_column.csv");
const std::vector<std::string> out_of_range = {"1e-300", "1e-30", "1e30", "-1e30", "1e308"};

bool is_of_a_number(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
}
bool is_of_a_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// First byte and length of every number that is in no string, comment or name.
std::vector<std::pair<std::size_t, std::size_t>> numbers_in(const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      while (text[++i] != '"') i += text[i] == '\\' ? 1 : 0;
    } else if (text.compare(i, 2, "//") == 0) {
      i = text.find('\n', i);
    } else if (text.compare(i, 2, "/*") == 0) {
      i = text.find("*/", i) + 1;
    } else if (is_of_a_number(text[i])) {
      const std::size_t first = i;
      while (i < text.size() && (is_of_a_number(text[i]) || text[i] == 'e')) ++i;
      found.emplace_back(first, i - first);
    }
  }
  return found;
}

/// Whether a text has `nan` or `inf` that is not part of a longer word.
bool has_no_number(const std::string& text) {
  for (const char* const word : {"nan", "inf"})
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      if ((at == 0 || !is_of_a_word(text[at - 1])) && (at + 3 == text.size() || !is_of_a_word(text[at + 3])))
        return true;
  return false;
}

/// Runs a command on the files scene.json and log.csv; `result` is where its result goes, if not to standard
/// output.
void check_finite(const Scratch& scratch, const std::string& arguments, const std::string& what,
                  const std::string& result = "") {
  const Outcome outcome = run_taut(scratch, arguments);
  INFO(arguments, ": ", what);
  CHECK(outcome.status >= 0);
  CHECK_FALSE(has_no_number(outcome.out));
  if (outcome.status != 0) CHECK_FALSE(outcome.err.empty());
  if (outcome.status == 2) CHECK(outcome.out.empty());
  if (!result.empty() && outcome.status != 2) CHECK_FALSE(has_no_number(text_of(scratch.path / result)));
}

void check_run(const Scratch& scratch, const std::string& what) {
  const std::string files = scratch.quoted("scene.json") + " " + scratch.quoted("log.csv");
  for (const char* const scalar : {"double", "float"}) {
    check_finite(scratch, "simulate " + files + " --scalar " + scalar, what);
    check_finite(scratch, "estimate " + files + " --scalar " + scalar, what);
  }
  check_finite(scratch, "simulate " + files + " --method stepwise", what);
  check_finite(scratch, "report " + files + " -o " + scratch.quoted("report.html"), what, "report.html");
}

}  // namespace

TEST_CASE("a number of the scene out of all range gives a finite result or a refusal") {
  const Scratch scratch;
  std::ofstream(scratch.path / "log.csv") << log_file;
  const auto numbers = numbers_in(scene);
  REQUIRE(numbers.size() > 60);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    // Every number gets one of them, and all kinds of numbers get each.
    const std::string& extreme = out_of_range[i % out_of_range.size()];
    std::string changed = scene;
    changed.replace(numbers[i].first, numbers[i].second, extreme);
    std::ofstream(scratch.path / "scene.json") << changed;
    const std::string what = extreme + " at byte " + std::to_string(numbers[i].first);
    check_run(scratch, what);
    check_finite(scratch, "check " + scratch.quoted("scene.json"), what);
    check_finite(scratch, "export " + scratch.quoted("scene.json"), what);
  }
}

TEST_CASE("a number of the log out of all range gives a finite result or a refusal") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene;
  const auto numbers = numbers_in(log_file.substr(log_file.find('\n')));
  REQUIRE(numbers.size() > 20);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string& extreme = out_of_range[i % out_of_range.size()];
    std::string changed = log_file;
    changed.replace(log_file.find('\n') + numbers[i].first, numbers[i].second, extreme);
    std::ofstream(scratch.path / "log.csv") << changed;
    check_run(scratch, extreme + " as number " + std::to_string(i));
  }
}

TEST_CASE("a stiffness that no material has is refused with its place") {
  const Scratch scratch;
  std::string changed = text_of(TAUT_FILES "/one_jack.json");
  changed.replace(changed.find("2.0e11"), 6, "1e-300");
  std::ofstream(scratch.path / "scene.json") << changed;
  const Outcome outcome = run_taut(scratch, "check " + scratch.quoted("scene.json"));
  CHECK(outcome.status == 2);
  CHECK(outcome.err == (scratch.path / "scene.json").string() +
                           ": /cables/0/E: the number 1e-300 is too small; write one of at least 1e-30\n");
}

TEST_CASE(
    "a row whose answer is beyond single precision ends the result with its place and the rows before it") {
  const Scratch scratch;
  // The cable does not feel the load on the strut, which is 1e30 N times a factor of 1e14.
  std::ofstream(scratch.path / "scene.json")
      << R"({ "taut": 1, "name": "a strut apart", "plausible": false, "dimension": 2,
    "nodes": { "left": [-1, 1], "saddle": [0, 0], "right": [3, 3], "foot": [0, -2], "head": [0, -1] },
    "supports": { "left": "xy", "saddle": "xy", "right": "xy", "foot": "xy", "head": "x" },
    "struts": [ { "nodes": ["foot", "head"], "E": 2.0e11, "A": 1.0e-4 } ],
    "cables": [ { "name": "C", "path": ["left", "saddle", "right"], "E": 2.0e11, "A": 1.0e-4,
                  "start": "anchored", "end": "jacked", "friction": { "law": "point", "mu": 0.1 } } ],
    "loads": { "P": { "forces": { "head": [0, -1e30] } } } })";
  std::ofstream(scratch.path / "log.csv") << "time,P,C.end\n1,1,1000\n2,1e14,1000\n";
  const std::string arguments = scratch.quoted("scene.json") + " " + scratch.quoted("log.csv");
  const Outcome in_float = run_taut(scratch, "simulate --scalar float " + arguments);
  CHECK(in_float.status == 1);
  CHECK(std::count(in_float.out.begin(), in_float.out.end(), '\n') == 2);
  const std::string place = (scratch.path / "log.csv").string() + ": line ";
  const std::size_t end = in_float.err.find(place + "3");
  REQUIRE(end != std::string::npos);
  CHECK(
      in_float.err.substr(end) ==
      place +
          "3 (row 2, time 2 s): strut1 = -inf; look for stiffnesses, lengths and forces that differ by very "
          "many powers of ten; the result ends before it\n");
  // The row before has an answer, and the head is far away in it.
  CHECK(in_float.err.find("remark: " + place + "2 (row 1, time 1 s): node \"head\" has moved by 5e+22 m") ==
        0);
  CHECK(run_taut(scratch, "simulate " + arguments).status == 0);
}

TEST_CASE("a limit that is no number is refused") {
  const Scratch scratch;
  const std::string arguments = "estimate '" TAUT_FILES "/one_jack.json' no.csv ";
  for (const char* const limit : {"nan", "inf", "1e31", "-1"}) {
    const Outcome outcome = run_taut(scratch, arguments + "--most-force " + limit);
    CHECK(outcome.status == 2);
    CHECK_MESSAGE(outcome.err.find("--most-force") != std::string::npos, outcome.err);
  }
}
