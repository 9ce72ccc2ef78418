// Results: their columns, their numbers, and that a file is whole or not there.
#include <doctest/doctest.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

#include "files/run_program.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/output_file.hpp"
#include "lib/files/result_file.hpp"
#include "lib/files/scene_file.hpp"

namespace fs = std::filesystem;
using namespace taut;
using namespace taut::host;

namespace {

const NumberFormat as_double{ScalarType::float64, false}, as_float{ScalarType::float32, false};
const NumberFormat double_bits{ScalarType::float64, true}, float_bits{ScalarType::float32, true};

std::string written(double value, const NumberFormat& format) {
  std::string text;
  append_number(text, value, format);
  return text;
}

template <class Float>
Float read_back(const std::string& text) {
  Float value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

SceneDescription two_cables() {
  return read_scene(R"({ "taut": 1, "name": "n", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0], "c": [2, 1] },
    "struts": [ { "nodes": ["a", "b"], "E": 1, "A": 1 } ],
    "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 1, "A": 1, "start": "jacked", "end": "anchored" },
                { "name": "H", "path": ["a", "b", "c"], "E": 1, "A": 1, "closed": true } ] })",
                    "f");
}

std::size_t files_in(const Scratch& scratch) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(scratch.path), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("the header names every column in the order of the scene, extensions at jacked ends only") {
  CHECK(result_header(two_cables()) ==
        "time,C.T1,C.T2,C.slip1,C.state1,C.N1,C.f1,C.start.payout,"
        "H.T1,H.T2,H.T3,H.slip1,H.slip2,H.slip3,H.state1,H.state2,H.state3,H.N1,H.N2,H.N3,H.f1,H.f2,H.f3,"
        "strut1\n");
}

TEST_CASE("an estimate has after these the deviations and mu of every cable, alarms, notices and verdict") {
  const std::string state = result_header(two_cables()),
                    estimate = result_header(two_cables(), ResultColumns::estimate);
  CHECK(estimate == state.substr(0, state.size() - 1) +
                        ",C.sd1,C.sd2,C.mu1,C.mu_sd1,H.sd1,H.sd2,H.sd3,H.mu1,H.mu2,H.mu3,H.mu_sd1,H.mu_sd2,"
                        "H.mu_sd3,alarms,notices,verdict\n");
}

TEST_CASE("a row holds the values under their columns") {
  Answer answer;
  answer.tension = {1, 2, 3, 4, 5};
  answer.slip = {0.1, 0.2, 0.3, 0.4};
  answer.state = {JointState::stick, JointState::forward, JointState::backward, JointState::open};
  answer.contact = {10, 20, 30, 40};
  answer.friction = {-1, -2, -3, -4};
  answer.extension = {{0.5, 0.6}, {0.7, 0.8}};
  answer.strut = {-99.5};
  CHECK(result_row(two_cables(), 0.25, answer, as_double) ==
        "0.25,1,2,0.1,stick,10,-1,0.5,3,4,5,0.2,0.3,0.4,forward,backward,open,20,30,40,-2,-3,-4,-99.5\n");
  answer.deviation = {11, 12, 13, 14, 15};
  answer.mu = {0.5, 0.25, 0.125, 0.75};
  answer.mu_deviation = {6, 7, 8, 9};
  answer.alarms = "mu:C sensor:C.end";
  answer.notices = "no-information:C.end";
  answer.verdict = std::string("do not trust: a; b");
  const std::string state = result_row(two_cables(), 0.25, answer, as_double);
  const std::string numbers =
      state.substr(0, state.size() - 1) + ",11,12,0.5,6,13,14,15,0.25,0.125,0.75,7,8,9,";
  CHECK(result_row(two_cables(), 0.25, answer, as_double, ResultColumns::estimate) ==
        numbers + "mu:C sensor:C.end,no-information:C.end,do not trust: a; b\n");
  answer.alarms = answer.notices = "";
  answer.verdict = std::string("trust");
  CHECK(result_row(two_cables(), 0.25, answer, as_double, ResultColumns::estimate) == numbers + ",,trust\n");
}

TEST_CASE("decimals read back to the same double and float") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    REQUIRE(read_back<double>(written(value, as_double)) == value);
    const auto single =
        static_cast<float>(std::ldexp(static_cast<double>(static_cast<std::int64_t>(bits)), -40));
    REQUIRE(read_back<float>(written(static_cast<double>(single), as_float)) == single);
  }
}

TEST_CASE("decimals are as short as they can be in the type of the computation") {
  CHECK(written(0.1, as_double) == "0.1");
  CHECK(written(static_cast<double>(0.1F), as_float) == "0.1");
  CHECK(written(1e300, as_double) == "1e+300");
}

TEST_CASE("hexadecimal numbers are the bits of the IEEE value") {
  CHECK(written(1, double_bits) == "3ff0000000000000");
  CHECK(written(1, float_bits) == "3f800000");
  CHECK(written(-0.0, float_bits) == "80000000");
  CHECK(written(0, double_bits) == "0000000000000000");
  CHECK(written(0.1, float_bits) == "3dcccccd");
  CHECK(written(-std::numeric_limits<double>::infinity(), double_bits) == "fff0000000000000");
}

TEST_CASE("an output file appears when it is finished, with nothing beside it") {
  const Scratch scratch;
  const fs::path path = scratch.path / "out.csv";
  OutputFile output(path.string());
  output.write("a\n");
  CHECK_FALSE(fs::exists(path));
  output.finish();
  CHECK(text_of(path) == "a\n");
  CHECK(files_in(scratch) == 1);
}

TEST_CASE("an output file that is not finished leaves the older one and nothing beside it") {
  const Scratch scratch;
  const fs::path path = scratch.path / "out.csv";
  std::ofstream(path) << "older";
  { OutputFile(path.string()).write("half of it"); }
  CHECK(text_of(path) == "older");
  CHECK(files_in(scratch) == 1);
}

TEST_CASE("an output through a link replaces what it points at and keeps its permissions") {
  const Scratch scratch;
  const fs::path path = scratch.path / "out.csv", link = scratch.path / "link.csv";
  std::ofstream(path) << "older";
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(path, link);
  OutputFile output(link.string());
  output.write("newer");
  output.finish();
  CHECK(fs::is_symlink(link));
  CHECK(text_of(path) == "newer");
  CHECK(fs::status(path).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("an output that cannot be written is an error that names it") {
  CHECK_THROWS_WITH(OutputFile("/no/such/folder/out.csv"),
                    "/no/such/folder/out.csv: cannot be written: No such file or directory; "
                    "name a place with room and the right to write");
  CHECK_THROWS_WITH(OutputFile("/"), "/: is a directory; name a file for the output");
  if (fs::exists("/dev/full")) {
    OutputFile full("/dev/full");
    full.write("a\n");
    CHECK_THROWS_WITH(full.finish(),
                      "/dev/full: cannot be written: No space left on device; "
                      "name a place with room and the right to write");
    CHECK(fs::is_character_file("/dev/full"));
  }
}
