// The stack is painted at the start; what is no longer paint has been used.
#pragma once

#include <cstdint>

extern "C" {
extern std::uint32_t stack_bottom[], stack_top[];
}

namespace boards {

constexpr std::uint32_t paint = 0xC0FFEE11;

/// Up to the present depth.
[[gnu::always_inline]] inline void paint_stack() {
  std::uint32_t* present = nullptr;
  asm volatile("mov %0, sp" : "=r"(present));
  for (std::uint32_t* at = stack_bottom; at < present; ++at) *at = paint;
}

inline std::uint32_t stack_size() {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(stack_top) -
                                    reinterpret_cast<std::uintptr_t>(stack_bottom));
}

/// The deepest use since the start [bytes].
inline std::uint32_t stack_used() {
  const volatile std::uint32_t* at = stack_bottom;
  while (at < stack_top && *at == paint) ++at;
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(stack_top) -
                                    reinterpret_cast<std::uintptr_t>(at));
}

}  // namespace boards
