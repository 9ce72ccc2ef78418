// A serial line: a pseudo-terminal in its place, which is pulled out and put back.
#include <doctest/doctest.h>

#include <pty.h>
#include <termios.h>

#include <nlohmann/json.hpp>

#include "files/result_table.hpp"
#include "lib/live/frame_rows.hpp"
#include "monitor/frame.hpp"
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

// As the monitor of the firmware writes them.
std::string framed(const std::string& kind, const std::vector<std::string>& fields) {
  monitor::FrameWriter<400> writer;
  writer.begin(kind[0]);
  for (const std::string& field : fields) writer.word(field.c_str());
  writer.finish();
  return {writer.text(), static_cast<std::size_t>(writer.size())};
}
std::string hexadecimal(std::uint32_t value) {
  char digits[9];
  std::snprintf(digits, sizeof digits, "%08x", value);
  return digits;
}
std::string bits(double value) { return hexadecimal(monitor::bits_of(static_cast<float>(value))); }

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

TEST_CASE("a frame is one with its checksum") {
  using taut::host::frame_body;
  CHECK(frame_body("$I*dd0216b9\n") == "I");  // computed with zlib
  CHECK(frame_body("rest$I*dd0216b9\r\n") == "I");
  for (const char* bad :
       {"$I*dd0216b8\n", "I*dd0216b9\n", "$J*dd0216b9\n", "$I*DD0216B9\n", "$Idd0216b9\n", "$\n", ""})
    CHECK_MESSAGE(!frame_body(bad), bad);
}

TEST_CASE("frames of the monitor on a serial line are rows, each once, with lock-off and jacking again") {
  const Scratch scratch;
  write_scene(scratch);
  const Line line(scratch.path / "line");
  WatchedProgram watch(scratch, {"scene.json", "--serial", "line", "--record", "record.csv", "--http", "0"});
  watch.port();
  // What a float holds exactly, so that the log below has the same numbers.
  std::string log = "time,C.start,C.end,C.end.stroke,C.end.locked\n", sent;
  for (int i = 0; i < 30; ++i) {
    const double force = i < 20 ? 8000.0 * i : 160000, far = 6500.0 * i;
    const bool has_far = i % 3 == 0 && i < 20, is_locked = i >= 22 && i < 26;
    if (i == 22) sent += framed("L", {hexadecimal(0), hexadecimal(1)});
    if (i == 26) sent += framed("J", {hexadecimal(0), hexadecimal(1)});
    const std::string frame = framed("S", {hexadecimal(static_cast<std::uint32_t>(i + 1)), bits(0.5),
                                           has_far ? bits(far) : "-", bits(force), bits(force / 16777216)});
    sent += frame;
    if (i % 7 == 0) sent += frame;                                        // its answer was lost
    if (i % 5 == 0) sent += framed("A", {hexadecimal(1), "g"});           // what the device says
    if (i == 10) sent += frame.substr(0, 20) + "\n";                      // cut short
    if (i == 11) sent += framed("S", {hexadecimal(99), bits(0.5), "-"});  // of another scene
    std::ostringstream row;
    row.precision(17);
    row << 0.5 * i << ',';
    if (has_far) row << far;
    row << ',' << force << ',' << static_cast<double>(static_cast<float>(force / 16777216)) << ','
        << is_locked << '\n';
    log += row.str();
  }
  line.write(sent);
  REQUIRE(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == 31; }));
  CHECK(text_of(scratch.path / "record.csv") == estimated(scratch, log).out);
}
