// Objects that the program takes as the zeros of fresh memory are what their constructors make.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include "lib/kinds/condensed_kind.hpp"
#include "lib/kinds/large_objects.hpp"

namespace {

struct Roof : taut::Capacity {
  static constexpr int struts = 6, beams = 5, cables = 2, segments = 7, joints = 5;
  static constexpr int substructures = 1, loads = 2, displacements = 3;
};

// Stores that the compiler may not leave out, though the lifetime of an object begins after them.
[[gnu::noinline]] void fill(std::vector<unsigned char>& memory, unsigned char with) {
  std::memset(memory.data(), with, memory.size());
}
// Of bytes that are no zeros, a constructor leaves only what lies between the members.
template <class T>
std::vector<unsigned char> constructed_over(unsigned char before) {
  std::vector<unsigned char> memory(sizeof(T) + alignof(T));
  fill(memory, before);
  void* at = memory.data();
  std::size_t room = memory.size();
  REQUIRE(std::align(alignof(T), sizeof(T), at, room) != nullptr);
  new (at) T;
  const auto* const bytes = static_cast<const unsigned char*>(at);
  return {bytes, bytes + sizeof(T)};
}
template <class T>
void check_zeros() {
  const auto over_ones = constructed_over<T>(0xff), over_twos = constructed_over<T>(0xfe);
  const auto zeroed = taut::host::make_zeroed<T>();
  const auto* const bytes = reinterpret_cast<const unsigned char*>(zeroed.get());
  std::size_t wrong = 0, written = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    if (over_ones[i] != over_twos[i]) continue;
    ++written;
    wrong += over_ones[i] != bytes[i] ? 1 : 0;
  }
  CHECK(wrong == 0);
  // Without struts there is nothing to write.
  if (sizeof(T) > 64) CHECK(2 * written > sizeof(T));
}

}  // namespace

TEST_CASE_TEMPLATE("condensed scenes and the rows of struts and displacements begin as zeros, bit for bit",
                   Cap, Roof, taut::host::Rigid<Roof>, taut::host::Leaning<Roof>) {
  check_zeros<taut::host::CondensedOf<float, Cap>>();
  check_zeros<taut::host::CondensedOf<double, Cap>>();
  check_zeros<taut::host::StrutsOf<float, Cap>>();
  check_zeros<taut::host::StrutsOf<double, Cap>>();
  check_zeros<taut::host::DisplacementsOf<float, Cap>>();
  check_zeros<taut::host::DisplacementsOf<double, Cap>>();
}
