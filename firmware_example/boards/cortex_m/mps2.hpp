// ARM's MPS2 boards: serial line, clock, watchdog, and a part of the memory that a restart leaves alone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "boards/cortex_m/stack.hpp"
#include "monitor/start.hpp"

namespace boards {

constexpr int interrupts = 32;
constexpr int receive_interrupts[] = {0};

void on_receive();
void on_tick();
[[noreturn]] void restart_after_fault();

/// What the application needs of a board.
class Mps2 {
 public:
  Mps2();

  // The serial line.
  bool read(char& byte);
  void write(const char* bytes, int count);
  std::uint32_t lost_bytes() const;
  /// Sleeps until something happens.
  void idle();

  std::uint32_t milliseconds() const;
  void feed_watchdog();
  monitor::Start start() const { return start_; }
  void restart();
  /// Forever, to see the watchdog at work.
  [[noreturn]] void hang();

  // The non-volatile memory, emulated: what a battery would keep.
  static constexpr int memory_size = 128 * 1024;
  void read(int at, void* to, std::size_t count);
  void write(int at, const void* from, std::size_t count);

  std::uint32_t stack_used() const { return boards::stack_used(); }
  std::uint32_t stack_size() const { return boards::stack_size(); }

 private:
  monitor::Start start_;
};

}  // namespace boards
