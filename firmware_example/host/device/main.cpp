// The monitor on a PC: its serial line is standard input and output, its memory a file if one is named.
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "monitor/scenes.hpp"

namespace {

class StdioBoard {
 public:
  explicit StdioBoard(const char* file) : memory_(memory_size) {
    if (file == nullptr) return;
    file_ = open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0 || pread(file_, memory_.data(), memory_.size(), 0) < 0) {
      std::fprintf(stderr, "monitor: %s cannot be used as memory; name a file that can be written\n", file);
      std::exit(2);
    }
  }

  bool read(char& byte) {
    if (taken_ == held_) return false;
    byte = bytes_[taken_++];
    return true;
  }
  void write(const char* bytes, int count) {
    if (::write(STDOUT_FILENO, bytes, static_cast<std::size_t>(count)) != count) std::exit(0);
  }
  std::uint32_t lost_bytes() const { return 0; }
  /// Waits for bytes; the end of the input is the end of the world.
  void idle() {
    if (taken_ < held_) return;
    pollfd waiting{STDIN_FILENO, POLLIN, 0};
    if (poll(&waiting, 1, 1) <= 0) return;
    const ssize_t count = ::read(STDIN_FILENO, bytes_.data(), bytes_.size());
    if (count <= 0) std::exit(0);
    taken_ = 0;
    held_ = static_cast<std::size_t>(count);
  }

  std::uint32_t milliseconds() const {
    using namespace std::chrono;
    return static_cast<std::uint32_t>(
        duration_cast<std::chrono::milliseconds>(steady_clock::now() - begun_).count());
  }
  void feed_watchdog() {}
  monitor::Start start() const { return start_; }
  void restart() { restarts_ = true; }
  /// There is no watchdog here.
  void hang() {}
  bool restarts() const { return restarts_; }
  void come_back() {
    restarts_ = false;
    start_ = monitor::Start::commanded;
  }

  static constexpr int memory_size = 1 << 20;
  void read(int at, void* to, std::size_t count) { std::memcpy(to, memory_.data() + at, count); }
  void write(int at, const void* from, std::size_t count) {
    std::memcpy(memory_.data() + at, from, count);
    if (file_ >= 0 && pwrite(file_, memory_.data() + at, count, at) < 0) std::exit(2);
  }
  std::uint32_t stack_used() const { return 0; }
  std::uint32_t stack_size() const { return 0; }

 private:
  std::array<char, 4096> bytes_{};
  std::size_t taken_ = 0, held_ = 0;
  std::vector<unsigned char> memory_;
  int file_ = -1;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  monitor::Start start_ = monitor::Start::power_on;
  bool restarts_ = false;
};

using Application = monitor::Monitor<StdioBoard>;
alignas(Application) std::byte room[sizeof(Application)];

}  // namespace

int main(int count, char** arguments) {
  static StdioBoard board(count > 1 ? arguments[1] : nullptr);
  for (;;) {
    auto* const application = new (room) Application(board);
    application->begin();
    while (!board.restarts()) {
      application->step();
      board.idle();
    }
    board.come_back();
  }
}
