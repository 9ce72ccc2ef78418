// The firmware without an operating system: an object, not linked, of which tests/no_system sees what it
// calls and how deep its stack can get.
#include <cstddef>
#include <cstdint>

#include "monitor/scenes.hpp"
#include "monitor/start.hpp"

/// What the application needs of a board, none of which is here.
class BoardElsewhere {
 public:
  bool read(char& byte);
  void write(const char* bytes, int count);
  std::uint32_t lost_bytes() const;
  std::uint32_t milliseconds() const;
  void feed_watchdog();
  monitor::Start start() const;
  void restart();
  void hang();
  void idle();
  static constexpr int memory_size = 1 << 20;
  void read(int at, void* to, std::size_t count);
  void write(int at, const void* from, std::size_t count);
  std::uint32_t stack_used() const;
  std::uint32_t stack_size() const;
};

extern "C" void run() {
  static BoardElsewhere board;
  static monitor::Monitor<BoardElsewhere> application(board);
  application.begin();
  for (;;) {
    application.step();
    board.idle();
  }
}
