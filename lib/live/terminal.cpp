#include "lib/live/terminal.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <string>

#include "lib/live/screen_text.hpp"
#include "lib/live/stop_signal.hpp"

namespace taut::host {
namespace {

// Another page of the terminal without a cursor, and back.
constexpr const char* take_screen = "\x1b[?1049h\x1b[?25l\x1b[2J";
constexpr const char* give_back = "\x1b[?25h\x1b[?1049l";
constexpr const char* top = "\x1b[H";
constexpr const char* clear_line = "\x1b[K\r\n";
constexpr const char* clear_rest = "\x1b[J";

}  // namespace

Terminal::Terminal(const SceneDescription& scene, const AnswerBoard& board)
    : scene_(scene), board_(board), is_terminal_(isatty(STDOUT_FILENO) == 1) {
  if (is_terminal_) put(take_screen);
  const SignalsHeldBack held;
  thread_ = std::thread([this] { is_terminal_ ? draw_screen() : write_lines(); });
}

Terminal::~Terminal() {
  thread_.join();
  if (is_terminal_) put(give_back);
}

void Terminal::draw_screen() {
  LiveAnswerPtr drawn;
  while (!board_.is_closed()) {
    const LiveAnswerPtr newest = board_.newest();
    if (newest && newest != drawn) {
      drawn = newest;
      winsize size{};
      const bool is_known =
          ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 && size.ws_col > 0;
      const std::size_t rows = is_known ? size.ws_row : 24, columns = is_known ? size.ws_col : 80;
      std::string text = top;
      std::vector<std::string> lines = {scene_.name, "no row yet: " + row_text(scene_, *newest)};
      if (newest->row > 0) lines = screen_text(scene_, *newest, rows, columns);
      for (std::size_t i = 0; i < lines.size(); ++i)
        text += lines[i] + (i + 1 < lines.size() ? clear_line : "\x1b[K");
      if (!put(text + clear_rest)) return;
    }
    std::this_thread::sleep_for(pause);
  }
}

void Terminal::write_lines() {
  AnswerBoard::Place place;
  while (true) {
    const LiveAnswerPtr answer = board_.next(place, std::chrono::milliseconds(250));
    if (!answer && board_.is_closed()) return;
    if (answer && !put(row_text(scene_, *answer) + "\n")) return;
  }
}

// False if nobody takes it any more.
bool Terminal::put(const std::string& text) {
  std::size_t done = 0;
  std::optional<std::chrono::steady_clock::time_point> closed;
  while (done < text.size()) {
    pollfd waiting{STDOUT_FILENO, POLLOUT, 0};
    const int found = poll(&waiting, 1, 100);
    if (found < 0 && errno != EINTR) return false;
    if (found > 0) {
      // No more at a time than a pipe that is writable takes without waiting.
      const std::size_t count = std::min<std::size_t>(text.size() - done, 512);
      const ssize_t written = write(STDOUT_FILENO, text.data() + done, count);
      if (written < 0 && errno != EINTR && errno != EAGAIN) return false;
      if (written > 0) done += static_cast<std::size_t>(written);
      continue;
    }
    if (!board_.is_closed()) continue;
    if (!closed) closed = std::chrono::steady_clock::now();
    if (std::chrono::steady_clock::now() - *closed > patience) return false;
  }
  return true;
}

}  // namespace taut::host
