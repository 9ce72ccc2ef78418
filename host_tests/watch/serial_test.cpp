// A serial line: a pseudo-terminal in its place, which is pulled out and put back.
#include <doctest/doctest.h>

#include <pty.h>
#include <termios.h>

#include <nlohmann/json.hpp>

#include "files/result_table.hpp"
#include "watch/http_client.hpp"
#include "watch/watched_program.hpp"
#include "watch/watched_scene.hpp"

namespace {

namespace fs = std::filesystem;

/// A line whose end at the program has a name that stays the same.
class Line {
 public:
  explicit Line(fs::path name) : name_(std::move(name)) { plug_in(); }
  ~Line() { pull_out(); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  void plug_in() {
    char path[256];
    REQUIRE(openpty(&logger_, &program_, path, nullptr, nullptr) == 0);
    // Else the program would hold the logger's end open itself.
    for (const int end : {logger_, program_}) fcntl(end, F_SETFD, FD_CLOEXEC);
    fs::remove(name_);
    fs::create_symlink(path, name_);
  }
  void pull_out() {
    fs::remove(name_);
    close(program_);
    close(logger_);
  }
  void write(const std::string& text) const {
    CHECK(::write(logger_, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  termios settings() const {
    termios found{};
    tcgetattr(program_, &found);
    return found;
  }

 private:
  fs::path name_;
  int logger_ = -1, program_ = -1;
};

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("a serial line that is pulled out and put back goes on, and is said to be silent in between") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(40);
  Line line(scratch.path / "line");
  WatchedProgram watch(scratch,
                       {"scene.json", "--serial", "line:9600", "--http", "0", "--record", "record.csv"});
  const int port = watch.port();
  const auto recorded = [&](std::size_t count) {
    return comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == count + 1; });
  };
  const auto answer = [&] { return nlohmann::json::parse(page_at(port, "/answer.json")); };
  const auto is_silent = [&] {
    return answer().at("alarms").dump().find("\"silent:line\"") != std::string::npos;
  };
  line.write(log_header + joined(rows, 0, 10));
  REQUIRE(recorded(10));
  // 8 data bits, no parity, one stop bit.
  const termios settings = line.settings();
  CHECK(cfgetispeed(&settings) == B9600);
  CHECK((settings.c_cflag & CSIZE) == CS8);
  CHECK((settings.c_cflag & (PARENB | CSTOPB)) == 0);
  CHECK((settings.c_lflag & (ICANON | ECHO)) == 0);
  CHECK_FALSE(is_silent());

  line.pull_out();
  CHECK(comes_true(is_silent));
  CHECK(answer().at("time").get<double>() == 9);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(watch.is_running());
  line.plug_in();
  // The first line may be the rest of one; the header does not come again.
  line.write(rows[11].substr(rows[11].find(',') - 1) + joined(rows, 12, 20));
  REQUIRE_MESSAGE(recorded(18), watch.err());
  CHECK_FALSE(is_silent());

  // The logger starts anew while the line is up.
  line.write(log_header + joined(rows, 20, 25));
  REQUIRE(recorded(23));
  // Noise.
  line.write("26,\x01\xff,1\n" + joined(rows, 25, 26) + "3,1,2,3\n27,1,2\n" + joined(rows, 26, 40));
  REQUIRE(recorded(38));
  CHECK(answer().at("notices").dump().find("unreadable:line") != std::string::npos);
  watch.send(SIGTERM);
  CHECK(watch.ended() == 0);
  CHECK(text_of(scratch.path / "record.csv") ==
        estimated(scratch, log_header + joined(rows, 0, 10) + joined(rows, 12)).out);
  CHECK(watch.err().find("the line is silent") != std::string::npos);
  CHECK(watch.err().find("rows come again") != std::string::npos);
  CHECK(watch.err().find("the line is left out") != std::string::npos);
}

TEST_CASE("after a kill a serial line needs no second header") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(20);
  const Line line(scratch.path / "line");
  const auto recorded = [&](std::size_t count) {
    return comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == count + 1; });
  };
  const std::vector<std::string> arguments = {"scene.json", "--serial", "line",   "--record", "record.csv",
                                              "--state",    "state",    "--http", "0"};
  {
    WatchedProgram watch(scratch, arguments);
    watch.port();
    line.write(log_header + joined(rows, 0, 10));
    REQUIRE(recorded(10));
    watch.send(SIGKILL);
    watch.ended();
  }
  WatchedProgram watch(scratch, arguments);
  watch.port();  // the line is open before
  line.write("rest of a line\n" + joined(rows, 10));
  REQUIRE(recorded(20));
  CHECK(text_of(scratch.path / "record.csv") == estimated(scratch, log_header + joined(rows)).out);
}
