// An STM32F405 after its reference manual RM0090: two serial lines, clock, watchdog, and a record in flash.
#pragma once

#include <cstddef>
#include <cstdint>

#include "boards/cortex_m/stack.hpp"
#include "boards/stm32f405/flash_controller.hpp"
#include "monitor/kept_records.hpp"
#include "monitor/start.hpp"

namespace boards {

constexpr int interrupts = 82;
/// USART1 and USART2. RM0090, 12.2.
constexpr int receive_interrupts[] = {37, 38};

void on_receive();
void on_tick();
[[noreturn]] void restart_after_fault();

/// Registers and flash as they are.
struct MemoryBus {
  static std::uint32_t read(std::uint32_t address) {
    return *reinterpret_cast<const volatile std::uint32_t*>(static_cast<std::uintptr_t>(address));
  }
  static void write(std::uint32_t address, std::uint32_t word) {
    *reinterpret_cast<volatile std::uint32_t*>(static_cast<std::uintptr_t>(address)) = word;
  }
  static void copy(std::uint32_t address, void* to, std::size_t count);
};

/// USART2 with the direction of an RS-485 driver at PA1, for monitor::ModbusSlave.
class ModbusLine {
 public:
  static bool read(std::uint8_t& byte, std::uint32_t& at);
  static std::uint32_t microseconds();
  static void write(const std::uint8_t* bytes, int count);
};

/// What the application needs of a board.
class Stm32f405 {
 public:
  /// `modbus_baud`: bits a second of the Modbus line; that of the frames has 115200.
  explicit Stm32f405(std::uint32_t modbus_baud);

  // The serial line: USART1, PA9 and PA10.
  bool read(char& byte);
  void write(const char* bytes, int count);
  std::uint32_t lost_bytes() const;
  /// Sleeps until something happens, at most a millisecond.
  void idle();
  ModbusLine& modbus() { return modbus_; }

  std::uint32_t milliseconds() const;
  void feed_watchdog();
  monitor::Start start() const { return start_; }
  void restart();
  /// Forever, to see the watchdog at work.
  [[noreturn]] void hang();

  // RAM that a reset leaves alone, and flash.
  static constexpr int memory_size = 48 * 1024;
  void read(int at, void* to, std::size_t count);
  void write(int at, const void* from, std::size_t count);
  using Flash = FlashController<MemoryBus>;
  Flash& flash() { return flash_; }
  using RecordsType = monitor::KeptRecords<Stm32f405>;
  /// A sector bears 10000 erasures and holds at least five records: two months of samples without a pause.
  static constexpr std::uint32_t flash_interval = 60000;

  std::uint32_t stack_used() const { return boards::stack_used(); }
  std::uint32_t stack_size() const { return boards::stack_size(); }

 private:
  monitor::Start start_;
  MemoryBus bus_;
  Flash flash_{bus_};
  ModbusLine modbus_;
};

}  // namespace boards
