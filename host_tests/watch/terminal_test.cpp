// The screen on a terminal: drawn in place, seldom enough, and given back as it was.
#include <doctest/doctest.h>

#include <pty.h>
#include <sys/ioctl.h>

#include <atomic>
#include <mutex>

#include "files/result_table.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/live/screen_text.hpp"
#include "watch/watched_program.hpp"
#include "watch/watched_scene.hpp"

namespace {

/// A terminal of 80 columns and 24 rows that remembers all that was written to it.
class Screen {
 public:
  Screen() {
    winsize size{24, 80, 0, 0};
    REQUIRE(openpty(&user_, &program_, nullptr, nullptr, &size) == 0);
    for (const int end : {user_, program_}) fcntl(end, F_SETFD, FD_CLOEXEC);
    reader_ = std::thread([this] {
      char bytes[4096];
      while (!is_over_) {
        pollfd waiting{user_, POLLIN, 0};
        if (poll(&waiting, 1, 20) <= 0) continue;
        const ssize_t count = read(user_, bytes, sizeof bytes);
        const std::lock_guard<std::mutex> lock(mutex_);
        if (count > 0) text_.append(bytes, static_cast<std::size_t>(count));
      }
    });
  }
  ~Screen() {
    is_over_ = true;
    reader_.join();
    close(user_);
    close(program_);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  int program_end() const { return program_; }
  std::string text() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return text_;
  }

 private:
  int user_ = -1, program_ = -1;
  std::atomic<bool> is_over_ = false;
  mutable std::mutex mutex_;
  std::string text_;
  std::thread reader_;
};

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE(
    "a terminal shows one screen that is drawn in place at most ten times a second, and is given back") {
  const Scratch scratch;
  write_scene(scratch);
  const Screen screen;
  const std::vector<std::string> rows = log_rows(100);
  const auto begun = std::chrono::steady_clock::now();
  WatchedProgram watch(scratch, {"scene.json", "-"}, screen.program_end());
  watch.write(log_header);
  for (const std::string& row : rows) {
    watch.write(row);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  CHECK(comes_true([&] { return screen.text().find("row 100") != std::string::npos; }));
  watch.send(SIGINT);
  CHECK(watch.ended() == 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  CHECK(comes_true([&] { return screen.text().find("\x1b[?1049l") != std::string::npos; }));
  const std::string text = screen.text();
  CHECK(text.find("\x1b[?1049h\x1b[?25l") == 0);
  CHECK(text.substr(text.size() - 14) == "\x1b[?25h\x1b[?1049l");
  CHECK(static_cast<double>(count_of(text, "\x1b[H")) <= 10 * seconds + 2);
  CHECK(count_of(text, "\x1b[2J") == 1);  // cleared once: nothing flickers
  const Table table(estimated(scratch, log_header + joined(rows)).out);
  std::string force =
      std::to_string(table.number(99, "C.T1") / 1000).substr(0, 5);  // of 100 to 999 kN four digits
  CHECK_MESSAGE(text.find(force.substr(0, 4)) != std::string::npos, force);
  CHECK(text.find("jack C.end") != std::string::npos);
}

TEST_CASE(
    "a screen has no more lines and columns than the terminal, and the bars are as long as the forces") {
  const Scratch scratch;
  write_scene(scratch);
  const taut::host::SceneDescription scene =
      taut::host::read_scene_file((scratch.path / "scene.json").string());
  taut::host::LiveAnswer live;
  live.row = 7;
  live.time = 12.5;
  live.answer.tension = {25000, 50000, 75000, 100000};
  live.answer.deviation = {0, 0, 0, 0};
  live.answer.state.assign(3, taut::JointState::forward);
  live.answer.mu.assign(3, 0.2);
  live.answer.mu_deviation.assign(3, 0.1);
  live.alarms = {"mu:C"};
  const auto lines = taut::host::screen_text(scene, live, 40, 80);
  std::vector<std::size_t> bars;
  for (const std::string& line : lines) {
    const auto width = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    CHECK(width <= 80);
    if (line.find("  T") == 0) bars.push_back(count_of(line, "\u2588"));
  }
  REQUIRE(bars.size() == 4);
  for (std::size_t i = 0; i < 4; ++i)  // a quarter each, to a character
    CHECK(std::abs(static_cast<double>(bars[i]) -
                   static_cast<double>(bars[3]) * static_cast<double>(i + 1) / 4) <= 1);
  CHECK(lines[0] == "chain   time 12.5 s   row 7");
  CHECK(lines[1] == "ALARM mu:C");
  CHECK(taut::host::screen_text(scene, live, 5, 20).size() == 5);
}

TEST_CASE("with a plan the screen says what to do, and a mark on the bar of the jack is at its stage") {
  const Scratch scratch;
  write_scene(scratch);
  const taut::host::SceneDescription scene =
      taut::host::read_scene_file((scratch.path / "scene.json").string());
  taut::host::PlanNow plan;
  plan.jacks = {"C.end"};
  plan.unit = taut::host::ForceUnit::for_largest(2e5);
  plan.stages = {{"1", false, {0}, {2e5}, {0.01}, true, false},
                 {"2", false, {0}, {1.5e5}, {0.008}, false, false}};
  plan.present = 1;
  plan.orders = {{0, taut::host::JackOrder::let_out, 1.5e5, 5e4, {}, {}}};
  plan.say = "let out C.end to 150.0 kN: 50.0 kN to go";
  plan.error = 0.0127;
  plan.anew = {{12.5, "mu of C is 0.260 and not 0.200"}};
  taut::host::LiveAnswer live;
  live.row = 7;
  live.answer.tension = {1e5, 1e5, 1e5, 1e5};
  live.answer.deviation = {0, 0, 0, 0};
  live.answer.state.assign(3, taut::JointState::forward);
  live.answer.mu.assign(3, 0.2);
  live.answer.mu_deviation.assign(3, 0.1);
  live.jacks = {{0, 1, 1e5, {}, {}}};
  live.plan = std::make_shared<const taut::host::PlanNow>(plan);
  const auto lines = taut::host::screen_text(scene, live, 40, 80);
  const auto line_with = [&](const std::string& word) {
    for (const std::string& line : lines)
      if (line.find(word) != std::string::npos) return line;
    return std::string();
  };
  CHECK(line_with("PLAN ") == "PLAN " + plan.say);
  CHECK(line_with("1 pull C.end to 200.0 kN, 10.0 mm").find("passed") != std::string::npos);
  CHECK(line_with("> 2 let out C.end to 150.0 kN, 8.0 mm").find("passed") == std::string::npos);
  CHECK(line_with("planned anew at 12.5 s: because mu of C is 0.260 and not 0.200") != "");
  CHECK(line_with("1.27 %") != "");
  const std::string bar = line_with("[");
  const auto width = [](const std::string& text) {
    return static_cast<double>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
  };
  const std::size_t begin = bar.find('[') + 1, mark = bar.find("\u25c6");
  REQUIRE(mark != std::string::npos);
  // Of 200 kN, which are the whole bar: the mark at three quarters, the force up to a half.
  const double whole = width(bar.substr(begin, bar.find(']') - begin));
  CHECK(width(bar) <= 80);
  CHECK(std::fabs(width(bar.substr(begin, mark - begin)) - 0.75 * whole) <= 1);
  CHECK(std::fabs(static_cast<double>(count_of(bar, "\u2588")) - 0.5 * whole) <= 1);
  CHECK(taut::host::row_text(scene, live).find("; plan: let out C.end") != std::string::npos);
}
