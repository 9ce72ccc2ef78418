// The monitor on a PC: its serial line is standard input and output, its memory a file if one is named, its
// Modbus line a serial line if one is named.
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "host/serial_line.hpp"
#include "monitor/modbus_slave.hpp"
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
  /// Waits for bytes here and on another line, if there is one; the end of the input is the end of the world.
  void idle(int other_line) {
    if (taken_ < held_) return;
    std::array<pollfd, 2> waiting{{{STDIN_FILENO, POLLIN, 0}, {other_line, POLLIN, 0}}};
    if (poll(waiting.data(), 2, 1) <= 0 || waiting[0].revents == 0) return;
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
using Modbus = monitor::ModbusSlave<Application, monitor::host::SerialLine>;

int usage() {
  std::fputs("usage: monitor.elf [MEMORY] [--modbus LINE [BAUD]]\n", stderr);
  return 2;
}

int run(const std::vector<std::string>& words) {
  std::size_t next = 0;
  const char* memory = nullptr;
  if (next < words.size() && words[next] != "--modbus") memory = words[next++].c_str();
  std::optional<monitor::host::SerialLine> line;
  std::uint32_t baud = monitor::Settings::modbus_baud;
  if (next < words.size()) {
    if (words[next] != "--modbus" || next + 1 == words.size() || next + 3 < words.size()) return usage();
    if (next + 2 < words.size()) baud = static_cast<std::uint32_t>(std::atol(words[next + 2].c_str()));
    line.emplace(words[next + 1], baud);
  }
  static StdioBoard board(memory);
  std::optional<Modbus> modbus;
  for (;;) {
    auto* const application = new (room) Application(board);
    if (line) modbus.emplace(*application, *line, monitor::Settings::modbus_address, baud);
    application->begin();
    while (!board.restarts()) {
      application->step();
      if (modbus) modbus->step();
      board.idle(line ? line->descriptor() : -1);
    }
    board.come_back();
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run({arguments + 1, arguments + count});
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "monitor: %s\n", problem.what());
  }
  return 2;
}
