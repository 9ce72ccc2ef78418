// From reset to run(): vectors, memory, floating point.
#include <cstdint>

#include "board.hpp"
#include "boards/cortex_m/run.hpp"
#include "boards/cortex_m/stack.hpp"

extern "C" {
// From the linker script.
extern std::uint32_t stack_bottom[], stack_top[], data_begin[], data_end[], bss_begin[], bss_end[];
extern const std::uint32_t data_load[];
using Initializer = void (*)();
extern const Initializer init_array_begin[], init_array_end[];

[[noreturn]] void start_up();

/// Whatever went wrong, the state is in its record: begin again.
[[noreturn]] void fault() { boards::restart_after_fault(); }

// What the compiler and the C library may call; none of it needs a heap here.
[[noreturn]] void abort() { fault(); }
[[noreturn]] void __cxa_pure_virtual() { fault(); }
int __aeabi_atexit(void*, void (*)(void*), void*) { return 0; }
}

namespace {

constexpr std::uintptr_t coprocessor_access = 0xE000ED88;

void ignore() {}

using Handler = void (*)();
struct Vectors {
  std::uint32_t* stack;
  Handler handlers[15 + boards::interrupts];
};

constexpr Vectors make_vectors() {
  Vectors vectors{stack_top, {}};
  for (Handler& handler : vectors.handlers) handler = fault;
  vectors.handlers[0] = start_up;
  vectors.handlers[1] = ignore;  // the watchdog's warning; its reset follows
  vectors.handlers[14] = boards::on_tick;
  for (const int receive : boards::receive_interrupts) vectors.handlers[15 + receive] = boards::on_receive;
  return vectors;
}

}  // namespace

extern "C" {
[[gnu::section(".vectors"), gnu::used]] extern constexpr Vectors vectors = make_vectors();

[[noreturn]] void start_up() {
  // Before anything uses a register of it: full access to the floating-point unit.
  *reinterpret_cast<volatile std::uint32_t*>(coprocessor_access) |= 0xFU << 20U;
  asm volatile("dsb\n isb" ::: "memory");
  boards::paint_stack();
  const std::uint32_t* from = data_load;
  for (std::uint32_t* to = data_begin; to != data_end; ++to) *to = *from++;
  for (std::uint32_t* to = bss_begin; to != bss_end; ++to) *to = 0;
  for (const Initializer* each = init_array_begin; each != init_array_end; ++each) (*each)();
  run();
  fault();
}
}
