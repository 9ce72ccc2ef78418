#include "boards/cortex_m/mps2.hpp"

#include <atomic>
#include <cstring>

extern "C" {
// From the linker script.
extern std::uint32_t kept_marker[];
extern std::uint8_t kept_memory[];
}

namespace boards {
namespace {

constexpr std::uint32_t clock_hz = 25000000;

struct Uart {
  std::uint32_t data, state, control, interrupt, divider;
};
constexpr std::uint32_t transmit_full = 1, receive_full = 2, receive_overrun = 8;
constexpr std::uint32_t transmit_on = 1, receive_on = 2, receive_interrupt_on = 8;

struct Watchdog {
  std::uint32_t load, value, control, clear;
  std::uint32_t unused[(0xC00 - 0x10) / 4];
  std::uint32_t lock;
};
constexpr std::uint32_t watchdog_key = 0x1ACCE551;
/// The first time-out warns, the second one resets.
constexpr std::uint32_t watchdog_seconds = 5;

struct SysTick {
  std::uint32_t control, reload, value;
};

template <class Registers, std::uintptr_t address>
volatile Registers& at() {
  return *reinterpret_cast<volatile Registers*>(address);
}
volatile Uart& uart() { return at<Uart, 0x40004000>(); }
volatile Watchdog& watchdog() { return at<Watchdog, 0x40008000>(); }
volatile SysTick& systick() { return at<SysTick, 0xE000E010>(); }
volatile std::uint32_t& interrupt_enable() { return at<std::uint32_t, 0xE000E100>(); }
volatile std::uint32_t& reset_control() { return at<std::uint32_t, 0xE000ED0C>(); }

constexpr std::uint32_t running = 0x52554E21, on_command = 0x434D4421;

volatile std::uint32_t ticks = 0;

/// What has been received and not yet read: the interrupt writes `in`, the main loop `out`.
constexpr unsigned ring_size = 1024;
volatile char ring[ring_size];
std::atomic<unsigned> in{0}, out{0};
volatile std::uint32_t lost = 0;

[[noreturn]] void reset() {
  asm volatile("dsb" ::: "memory");
  reset_control() = 0x05FA0004;
  for (;;) {
  }
}

}  // namespace

void on_tick() { ticks = ticks + 1; }

void on_receive() {
  volatile Uart& line = uart();
  line.interrupt = 2;
  if ((line.state & receive_overrun) != 0) {
    line.state = receive_overrun;
    lost = lost + 1;
  }
  while ((line.state & receive_full) != 0) {
    const char byte = static_cast<char>(line.data);
    const unsigned next = (in.load(std::memory_order_relaxed) + 1) % ring_size;
    if (next == out.load(std::memory_order_acquire)) {
      lost = lost + 1;
      continue;
    }
    ring[in.load(std::memory_order_relaxed)] = byte;
    in.store(next, std::memory_order_release);
  }
}

void restart_after_fault() { reset(); }

Mps2::Mps2() {
  start_ = kept_marker[0] == on_command ? monitor::Start::commanded
           : kept_marker[0] == running  ? monitor::Start::watchdog
                                        : monitor::Start::power_on;
  kept_marker[0] = running;
  watchdog().lock = watchdog_key;
  watchdog().load = watchdog_seconds * clock_hz;
  watchdog().control = 3;
  systick().reload = clock_hz / 1000 - 1;
  systick().value = 0;
  systick().control = 7;
  uart().divider = 217;  // 115200 baud
  uart().control = transmit_on | receive_on | receive_interrupt_on;
  interrupt_enable() = 1U << receive_interrupts[0];
}

bool Mps2::read(char& byte) {
  const unsigned from = out.load(std::memory_order_relaxed);
  if (from == in.load(std::memory_order_acquire)) return false;
  byte = ring[from];
  out.store((from + 1) % ring_size, std::memory_order_release);
  return true;
}

void Mps2::write(const char* bytes, int count) {
  for (int i = 0; i < count; ++i) {
    while ((uart().state & transmit_full) != 0) {
    }
    uart().data = static_cast<std::uint8_t>(bytes[i]);
  }
}

std::uint32_t Mps2::lost_bytes() const { return lost; }

void Mps2::idle() {
  // With interrupts held back, so that a byte between the question and the sleep still wakes it.
  asm volatile("cpsid i" ::: "memory");
  if (in.load(std::memory_order_relaxed) == out.load(std::memory_order_relaxed)) asm volatile("dsb\n wfi");
  asm volatile("cpsie i" ::: "memory");
}

std::uint32_t Mps2::milliseconds() const { return ticks; }

void Mps2::feed_watchdog() { watchdog().clear = 1; }

void Mps2::restart() {
  kept_marker[0] = on_command;
  reset();
}

void Mps2::hang() {
  for (;;) asm volatile("wfi");
}

void Mps2::read(int at, void* to, std::size_t count) { std::memcpy(to, kept_memory + at, count); }
void Mps2::write(int at, const void* from, std::size_t count) { std::memcpy(kept_memory + at, from, count); }

}  // namespace boards
