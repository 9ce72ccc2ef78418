// An array that costs nothing to begin.
#pragma once

#include <cstddef>
#include <type_traits>

namespace taut {

/// An array of N values of T, N > 0, whose owner writes what it reads: the constructor leaves the items as
/// they are, and is a constant expression, so that an object with it can be made at compile time.
template <class T, int N>
class Uncleared {
  static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_copyable_v<T>,
                "nothing constructs the items");

 public:
  constexpr Uncleared() : nothing_() {}
  T& operator[](int i) { return items_[static_cast<std::size_t>(i)]; }
  const T& operator[](int i) const { return items_[static_cast<std::size_t>(i)]; }

 private:
  union {
    char nothing_;
    T items_[static_cast<std::size_t>(N)];
  };
};

}  // namespace taut
