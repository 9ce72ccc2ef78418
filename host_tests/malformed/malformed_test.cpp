// What cannot be used is refused with exactly the message in the table, by the readers themselves.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "expected_messages.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/kinds/valid_scene.hpp"

namespace fs = std::filesystem;
using namespace taut::host;

namespace {

const fs::path malformed = TAUT_MALFORMED;

template <class Read>
std::string message_of(Read read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void check_names_a_place(const std::string& message) {
  CHECK_MESSAGE(message.find("; ") != std::string::npos, "a remedy follows the semicolon: ", message);
  CHECK_MESSAGE(message.find('\n') == std::string::npos, "a message is one line: ", message);
}

}  // namespace

TEST_CASE("every malformed scene is refused with its message") {
  const fs::path folder = malformed / "scenes";
  const auto expected = expected_messages(folder);
  fs::current_path(folder);
  for (const auto& [file, message] : expected) {
    CHECK(message_of([&, name = file] { require_valid(read_scene_file(name)); }) == message);
    check_names_a_place(message);
  }
  CHECK(expected.size() == files_in(folder, ".json").size());
}

TEST_CASE("every malformed log is refused with its message") {
  const fs::path folder = malformed / "logs";
  const auto expected = expected_messages(folder);
  fs::current_path(folder);
  const SceneDescription scene = read_scene_file("scene.json");
  require_valid(scene);
  for (const auto& [file, message] : expected) {
    CHECK(message_of([&, name = file] { check_log(name, scene, {}); }) == message);
    check_names_a_place(message);
  }
  CHECK(expected.size() == files_in(folder, ".csv").size());
}

TEST_CASE("a file that is not there is refused by name") {
  CHECK(
      message_of([] { read_scene_file("no such scene.json"); }) ==
      "no such scene.json: cannot be opened: No such file or directory; name a scene file that can be read");
  CHECK(message_of([] { check_log("no such log.csv", {}, {}); }) ==
        "no such log.csv: cannot be opened: No such file or directory; name a log file that can be read");
}

TEST_CASE("a folder in place of a file is refused") {
  CHECK(message_of([] { read_scene_file("/"); }) == "/: is a directory; name a scene file");
  CHECK(message_of([] { check_log("/", {}, {}); }) == "/: is a directory; name a log file");
}

TEST_CASE("a million opening brackets are refused without exhausting the stack") {
  const std::string brackets(1000000, '[');
  CHECK(message_of([&] { read_scene(brackets, "deep.json"); }) ==
        "deep.json: brackets are nested more than 16 deep; check that it is a scene");
}

TEST_CASE("a long list of numbers is refused before it takes all memory") {
  std::string list = "[0";
  for (int i = 0; i < 1100000; ++i) list += ",0";
  CHECK(message_of([&] { read_scene(list + "]", "long.json"); }) ==
        "long.json: the file holds more than 1000000 values; check that it is a scene");
}
