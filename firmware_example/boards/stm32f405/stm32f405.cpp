#include "boards/stm32f405/stm32f405.hpp"

#include <cstring>

#include "boards/stm32f405/ring.hpp"

extern "C" {
// From the linker script.
extern std::uint32_t kept_marker[];
extern std::uint8_t kept_memory[];
}

namespace boards {
namespace {

// RM0090, 2.3: where the peripherals are; ARMv7-M architecture reference manual: those of the core.

struct ResetAndClock {  // 7.3
  std::uint32_t control, pll, configuration, interrupt;
  std::uint32_t reset[8];
  std::uint32_t enable_ahb1, enable_ahb2, enable_ahb3, unused, enable_apb1, enable_apb2;
};
struct Port {  // 8.4
  std::uint32_t mode, type, speed, pull, in, out, set_reset, lock, function[2];
};
struct Usart {  // 30.6
  std::uint32_t status, data, rate, control, control2, control3;
};
struct Watchdog {  // 21.4
  std::uint32_t key, prescaler, reload, status;
};
struct SysTick {
  std::uint32_t control, reload, value;
};

template <class Registers, std::uintptr_t address>
volatile Registers& at() {
  return *reinterpret_cast<volatile Registers*>(address);
}
volatile ResetAndClock& clocks() { return at<ResetAndClock, 0x40023800>(); }
volatile std::uint32_t& flash_access() { return at<std::uint32_t, 0x40023C00>(); }
volatile Port& port_a() { return at<Port, 0x40020000>(); }
volatile Usart& frames() { return at<Usart, 0x40011000>(); }
volatile Usart& bus() { return at<Usart, 0x40004400>(); }
volatile Watchdog& watchdog() { return at<Watchdog, 0x40003000>(); }
volatile SysTick& systick() { return at<SysTick, 0xE000E010>(); }
volatile std::uint32_t& interrupt_enable() { return at<std::uint32_t, 0xE000E104>(); }
volatile std::uint32_t& reset_control() { return at<std::uint32_t, 0xE000ED0C>(); }
volatile std::uint32_t& interrupt_state() { return at<std::uint32_t, 0xE000ED04>(); }

// Of a USART's status and control.
constexpr std::uint32_t overrun = 1U << 3U, received = 1U << 5U, transmitted = 1U << 6U, has_room = 1U << 7U;
constexpr std::uint32_t receive_on = 1U << 2U, transmit_on = 1U << 3U, receive_interrupt_on = 1U << 5U,
                        even_parity = 1U << 10U, nine_bits = 1U << 12U, usart_on = 1U << 13U;

constexpr std::uint32_t running = 0x52554E21, on_command = 0x434D4421;

/// Of the core, of USART1 and of USART2 [Hz].
struct Rates {
  std::uint32_t core, usart1, usart2;
};
std::uint32_t core_hz = 16000000;

volatile std::uint32_t ticks = 0;
volatile std::uint32_t lost = 0;

struct TimedByte {
  std::uint8_t value;
  std::uint32_t at;
};
Ring<char, 1024> received_frames;
Ring<TimedByte, 512> received_bus;

/// USART1 is on APB2, which halves the clock of the core, USART2 on APB1, which has a fourth of it.
constexpr Rates divided(std::uint32_t core) { return {core, core / 2, core / 4}; }
/// 16 MHz / m * n / p for the core, / q for what is not used here. What each may be: 7.2 and 7.3.2.
constexpr std::uint32_t inner_hz = 16000000, pll_m = 16, pll_n = 336, pll_p = 2, pll_q = 7;
constexpr std::uint32_t pll_in = inner_hz / pll_m, pll_out = pll_in * pll_n;
constexpr Rates pll_rates = divided(pll_out / pll_p);
static_assert(pll_in >= 1000000 && pll_in <= 2000000 && pll_out >= 100000000 && pll_out <= 432000000);
static_assert(pll_rates.core <= 168000000 && pll_rates.usart1 <= 84000000 && pll_rates.usart2 <= 42000000);
static_assert(pll_out / pll_q <= 48000000);

constexpr std::uint32_t most_looks = 100000;
/// Whether the bits come, in bounded time.
bool comes(volatile std::uint32_t& where, std::uint32_t mask, std::uint32_t bits) {
  for (std::uint32_t look = 0; look < most_looks; ++look)
    if ((where & mask) == bits) return true;
  return false;
}

/// From the 16 MHz inside to 168 MHz, which needs no crystal. Stays at 16 MHz if the PLL does not lock.
Rates start_clocks() {
  // A core that runs has an oscillator: without one this is an emulator, at 168 MHz and without these
  // registers.
  if (clocks().control == 0) return pll_rates;
  clocks().enable_apb1 = clocks().enable_apb1 | 1U << 28U;  // power, in its highest range after reset
  // The source is the oscillator inside; bits that have no meaning stay as they are after reset.
  constexpr std::uint32_t fields = 0x3FU | 0x1FFU << 6U | 3U << 16U | 1U << 22U | 0xFU << 24U;
  clocks().pll = (clocks().pll & ~fields) | pll_m | pll_n << 6U | (pll_p / 2 - 1) << 16U | pll_q << 24U;
  clocks().control = clocks().control | 1U << 24U;
  if (!comes(clocks().control, 1U << 25U, 1U << 25U)) return {inner_hz, inner_hz, inner_hz};
  // Five wait states, prefetch and instructions cached; not data, for the record changes.
  flash_access() = 5U | 1U << 8U | 1U << 9U;
  if (!comes(flash_access(), 7U, 5U)) return {inner_hz, inner_hz, inner_hz};
  // AHB / 1, APB1 / 4, APB2 / 2, then the PLL.
  clocks().configuration = 5U << 10U | 4U << 13U;
  clocks().configuration = 5U << 10U | 4U << 13U | 2U;
  if (!comes(clocks().configuration, 3U << 2U, 2U << 2U)) return divided(inner_hz);
  return pll_rates;
}

void start_lines(const Rates& rates, std::uint32_t modbus_baud) {
  clocks().enable_ahb1 = clocks().enable_ahb1 | 1U;         // port A
  clocks().enable_apb1 = clocks().enable_apb1 | 1U << 17U;  // USART2
  clocks().enable_apb2 = clocks().enable_apb2 | 1U << 4U;   // USART1
  // A peripheral answers two cycles after its clock is on.
  static_cast<void>(clocks().enable_apb2);
  // The driver listens before its pin is an output.
  port_a().set_reset = 1U << (1 + 16);
  // PA2, PA3, PA9, PA10 have function 7, PA1 is an output; receivers rest high.
  port_a().function[0] = (port_a().function[0] & ~(0xFFU << 8U)) | 0x77U << 8U;
  port_a().function[1] = (port_a().function[1] & ~(0xFFU << 4U)) | 0x77U << 4U;
  port_a().pull = (port_a().pull & ~(3U << 6U | 3U << 20U)) | 1U << 6U | 1U << 20U;
  port_a().mode =
      (port_a().mode & ~(3U << 2U | 0xFU << 4U | 0xFU << 18U)) | 1U << 2U | 0xAU << 4U | 0xAU << 18U;

  frames().rate = (rates.usart1 + 115200 / 2) / 115200;
  frames().control = usart_on | transmit_on | receive_on | receive_interrupt_on;
  bus().rate = (rates.usart2 + modbus_baud / 2) / modbus_baud;
  // Eight bits and the parity are nine.
  bus().control = usart_on | transmit_on | receive_on | receive_interrupt_on | even_parity | nine_bits;
  for (const int each : receive_interrupts) interrupt_enable() = 1U << static_cast<unsigned>(each - 32);
}

/// After about eight seconds, five to fifteen with what its oscillator may have: an erasure takes two.
void start_watchdog() {
  watchdog().key = 0xCCCC;
  watchdog().key = 0x5555;
  watchdog().prescaler = 6;  // 32 kHz / 256
  watchdog().reload = 1000;
  static_cast<void>(comes(watchdog().status, 3, 0));
  watchdog().key = 0xAAAA;
}

[[noreturn]] void reset() {
  asm volatile("dsb" ::: "memory");
  reset_control() = 0x05FA0004;
  for (;;) {
  }
}

}  // namespace

void on_tick() { ticks = ticks + 1; }

/// Of both lines: reading status and then data also clears an overrun.
void on_receive() {
  for (std::uint32_t state = frames().status; (state & (received | overrun)) != 0; state = frames().status) {
    const auto byte = static_cast<char>(frames().data & 0xFFU);
    if ((state & overrun) != 0) lost = lost + 1;
    if ((state & received) != 0 && !received_frames.put(byte)) lost = lost + 1;
  }
  for (std::uint32_t state = bus().status; (state & (received | overrun)) != 0; state = bus().status) {
    const auto byte = static_cast<std::uint8_t>(bus().data & 0xFFU);
    // What is lost here the checksum tells.
    if ((state & received) != 0) static_cast<void>(received_bus.put({byte, ModbusLine::microseconds()}));
  }
}

void restart_after_fault() { reset(); }

void MemoryBus::copy(std::uint32_t address, void* to, std::size_t count) {
  std::memcpy(to, reinterpret_cast<const void*>(static_cast<std::uintptr_t>(address)), count);
}

bool ModbusLine::read(std::uint8_t& byte, std::uint32_t& at) {
  TimedByte next{};
  if (!received_bus.take(next)) return false;
  byte = next.value;
  at = next.at;
  return true;
}

std::uint32_t ModbusLine::microseconds() {
  // The counter falls within a millisecond; between two looks at the milliseconds it has not begun anew.
  // Where interrupts are held the tick may wait.
  for (int look = 0; look < 3; ++look) {
    const std::uint32_t before = ticks, left = systick().value;
    const bool waits = (interrupt_state() & 1U << 26U) != 0;
    if (before != ticks) continue;
    const std::uint32_t per_millisecond = core_hz / 1000;
    const bool has_begun_anew = waits && left > per_millisecond / 2;
    return (before + (has_begun_anew ? 1 : 0)) * 1000 + (per_millisecond - 1 - left) / (core_hz / 1000000);
  }
  return ticks * 1000;
}

void ModbusLine::write(const std::uint8_t* bytes, int count) {
  port_a().set_reset = 1U << 1U;
  for (int i = 0; i < count; ++i) {
    while ((bus().status & has_room) == 0) {
    }
    bus().data = bytes[i];
  }
  // The last stop bit has left before the driver listens again.
  while ((bus().status & transmitted) == 0) {
  }
  port_a().set_reset = 1U << (1 + 16);
}

Stm32f405::Stm32f405(std::uint32_t modbus_baud) {
  start_ = kept_marker[0] == on_command ? monitor::Start::commanded
           : kept_marker[0] == running  ? monitor::Start::watchdog
                                        : monitor::Start::power_on;
  kept_marker[0] = running;
  start_watchdog();
  const Rates rates = start_clocks();
  core_hz = rates.core;
  systick().reload = core_hz / 1000 - 1;
  systick().value = 0;
  systick().control = 7;
  start_lines(rates, modbus_baud);
}

bool Stm32f405::read(char& byte) { return received_frames.take(byte); }

void Stm32f405::write(const char* bytes, int count) {
  for (int i = 0; i < count; ++i) {
    while ((frames().status & has_room) == 0) {
    }
    frames().data = static_cast<std::uint8_t>(bytes[i]);
  }
}

std::uint32_t Stm32f405::lost_bytes() const { return lost; }

void Stm32f405::idle() {
  // With interrupts held back, so that a byte between the question and the sleep still wakes it.
  asm volatile("cpsid i" ::: "memory");
  if (received_frames.is_empty() && received_bus.is_empty()) asm volatile("dsb\n wfi");
  asm volatile("cpsie i" ::: "memory");
}

std::uint32_t Stm32f405::milliseconds() const { return ticks; }

void Stm32f405::feed_watchdog() { watchdog().key = 0xAAAA; }

void Stm32f405::restart() {
  kept_marker[0] = on_command;
  reset();
}

void Stm32f405::hang() {
  for (;;) asm volatile("wfi");
}

void Stm32f405::read(int at, void* to, std::size_t count) { std::memcpy(to, kept_memory + at, count); }
void Stm32f405::write(int at, const void* from, std::size_t count) {
  std::memcpy(kept_memory + at, from, count);
}

}  // namespace boards
