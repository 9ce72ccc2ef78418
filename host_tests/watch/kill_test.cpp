// Killed at any instant and started again, the program has the record of one run without a break.
#include <doctest/doctest.h>

#include <cstdlib>
#include <iostream>
#include <random>

#include "watch/watched_program.hpp"
#include "watch/watched_scene.hpp"

namespace {

/// TAUT_KILLS in the environment, for more than an ordinary test does.
int kills() {
  const char* const given = std::getenv("TAUT_KILLS");
  return given != nullptr ? std::atoi(given) : 12;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

void write(const Scratch& scratch, const std::string& text) {
  std::ofstream(scratch.path / "log.csv", std::ios::app) << text << std::flush;
}

const std::vector<std::string> state_and_record = {"--record", "record.csv", "--state", "state"};

std::vector<std::string> with_state(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), state_and_record.begin(), state_and_record.end());
  return arguments;
}

}  // namespace

TEST_CASE("killed at random instants, a watch of a file goes on as if nothing had been") {
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  const Scratch scratch, whole;
  write_scene(scratch);
  write_scene(whole);
  const std::vector<std::string> rows = log_rows(400 * kills(), seed);
  const std::string log = log_header + joined(rows);
  // A watch takes some time to start, and then thousands of rows a second.
  std::uniform_int_distribution<int> instant(0, 60000);
  write(scratch, log);
  int killed_within = 0;
  for (int i = 0; i < kills(); ++i) {
    const std::size_t before = lines_of(text_of(scratch.path / "record.csv"));
    WatchedProgram watch(scratch, with_state({"scene.json", "log.csv"}));
    std::this_thread::sleep_for(std::chrono::microseconds(instant(random)));
    watch.send(SIGKILL);
    REQUIRE(watch.ended() == 128 + SIGKILL);
    const std::size_t after = lines_of(text_of(scratch.path / "record.csv"));
    CHECK(after >= before);  // nothing that was answered is lost
    if (after > before && after < rows.size() + 1) ++killed_within;
  }
  MESSAGE(killed_within, " of ", kills(), " kills while rows were answered");
  WatchedProgram last(scratch, with_state({"scene.json", "log.csv", "--speed", "1e9"}));
  REQUIRE(last.ended(60) == 0);
  WatchedProgram one(whole, with_state({"scene.json", "-"}));
  one.write(log);
  one.close_input();
  REQUIRE(one.ended(60) == 0);
  CHECK(text_of(scratch.path / "record.csv") == text_of(whole.path / "record.csv"));
  CHECK(text_of(scratch.path / "record.csv") == estimated(whole, log).out);
  CHECK(lines_of(text_of(scratch.path / "record.csv")) == rows.size() + 1);
}

TEST_CASE("killed between rows from standard input, a watch goes on with those that come then") {
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(40 * kills(), seed);
  std::uniform_int_distribution<std::size_t> count(0, 70);
  std::size_t at = 0;
  while (at < rows.size()) {
    WatchedProgram watch(scratch, with_state({"scene.json", "-"}));
    const std::size_t to = std::min(at + count(random), rows.size());
    REQUIRE(watch.write(log_header + joined(rows, at, to)));
    // What is in the record has been answered; what has been answered is in the state.
    REQUIRE(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == to + 1; }));
    watch.send(SIGKILL);
    REQUIRE(watch.ended() == 128 + SIGKILL);
    at = to;
  }
  CHECK(text_of(scratch.path / "record.csv") == estimated(scratch, log_header + joined(rows)).out);
}

TEST_CASE("a log that begins under load goes on after a kill, though its past is not known yet") {
  const Scratch scratch;
  write_scene(scratch);
  std::vector<std::string> rows = log_rows(200);
  rows.erase(rows.begin(),
             rows.begin() + 60);  // half of the load is on, and held back by nothing that is known
  rows.erase(rows.begin() + 5, rows.begin() + 40);
  const Outcome whole = estimated(scratch, log_header + joined(rows));
  REQUIRE(whole.out.find("unknown-past:C") != std::string::npos);
  for (std::size_t at = 0; at < rows.size(); at += 3) {
    WatchedProgram watch(scratch, with_state({"scene.json", "-"}));
    REQUIRE(watch.write(log_header + joined(rows, at, at + 3)));
    REQUIRE(comes_true(
        [&] { return lines_of(text_of(scratch.path / "record.csv")) == std::min(at + 3, rows.size()) + 1; }));
    watch.send(SIGKILL);
    REQUIRE(watch.ended() == 128 + SIGKILL);
  }
  CHECK(text_of(scratch.path / "record.csv") == whole.out);
}

TEST_CASE("the same log from standard input again: what is known of it is skipped") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(50);
  for (const std::size_t to : {20U, 20U, 37U, 50U}) {
    WatchedProgram watch(scratch, with_state({"scene.json", "-"}));
    watch.write(log_header + joined(rows, 0, to));
    watch.close_input();
    CHECK(watch.ended() == 0);
    CHECK(lines_of(text_of(scratch.path / "record.csv")) == to + 1);
  }
  CHECK(text_of(scratch.path / "record.csv") == estimated(scratch, log_header + joined(rows)).out);
}

TEST_CASE("rows in state and record that were being written count as not there") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(30);
  {
    WatchedProgram watch(scratch, with_state({"scene.json", "-"}));
    watch.write(log_header + joined(rows, 0, 20));
    REQUIRE(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == 21; }));
    watch.send(SIGKILL);
    watch.ended();
  }
  std::ofstream(scratch.path / "state", std::ios::app) << "R" << rows[20].substr(0, 9);
  std::ofstream(scratch.path / "record.csv", std::ios::app) << "20,123";
  WatchedProgram watch(scratch, with_state({"scene.json", "-"}));
  watch.write(log_header + joined(rows, 20));
  watch.close_input();
  CHECK(watch.ended() == 0);
  CHECK(text_of(scratch.path / "record.csv") == estimated(scratch, log_header + joined(rows)).out);
}

TEST_CASE("a watch goes on where estimate left a site, and estimate is told of a state of watch") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(40);
  std::ofstream(scratch.path / "first.csv") << log_header << joined(rows, 0, 20);
  const Outcome first =
      run_taut(scratch, "estimate " + scratch.quoted("scene.json") + " " + scratch.quoted("first.csv") +
                            " --state " + scratch.quoted("state"));
  REQUIRE(first.status == 0);
  {
    WatchedProgram watch(scratch, with_state({"scene.json", "-"}));
    watch.write(log_header + joined(rows, 20));
    watch.close_input();
    REQUIRE(watch.ended() == 0);
  }
  const std::string head = first.out.substr(0, first.out.find('\n') + 1);
  const std::string both = first.out + text_of(scratch.path / "record.csv").substr(head.size());
  CHECK(both == estimated(scratch, log_header + joined(rows)).out);
  const Outcome refused =
      run_taut(scratch, "estimate " + scratch.quoted("scene.json") + " " + scratch.quoted("first.csv") +
                            " --state " + scratch.quoted("state"));
  CHECK(refused.status == 2);
  CHECK(refused.err.find("is the state of taut watch; go on with taut watch") != std::string::npos);
}

TEST_CASE("state and record that do not belong together, or to the scene, are refused") {
  const Scratch scratch;
  write_scene(scratch);
  {
    WatchedProgram watch(scratch, with_state({"scene.json", "-"}));
    watch.write(log_header + joined(log_rows(20)));
    watch.close_input();
    REQUIRE(watch.ended() == 0);
  }
  std::ofstream(scratch.path / "record.csv") << text_of(scratch.path / "record.csv").substr(0, 3000);
  const auto refused = [&] {
    WatchedProgram watch(scratch, with_state({"scene.json", "-"}));
    CHECK(watch.ended() == 2);
    return watch.err();
  };
  CHECK(refused().find("record.csv: has fewer rows than the state knows; name the record") !=
        std::string::npos);
  write_scene(scratch, "another chain");
  CHECK(refused().find("state: belongs to another scene") != std::string::npos);
  std::ofstream(scratch.path / "state") << "taut-watch-1 what";
  CHECK(refused().find("state: is not a whole state; name a file") != std::string::npos);
}
