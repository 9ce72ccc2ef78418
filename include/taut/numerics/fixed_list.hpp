// A list with storage for N items inside itself: no heap, usable in constant expressions.
#pragma once

#include <array>

namespace taut {

/// Up to N items of T, in the order they were added.
///
/// Adding to a full list drops the item and counts it, so that validate() can say by how much the
/// capacity falls short; nothing else about a scene that overflowed is meaningful.
template <class T, int N>
class FixedList {
  static_assert(N >= 0, "a capacity cannot be negative");

 public:
  /// Adds an item; returns its index, or -1 if the list is full.
  constexpr int add(const T& item) {
    if (size_ == N) {
      ++excess_;
      return -1;
    }
    items_[static_cast<std::size_t>(size_)] = item;
    return size_++;
  }

  constexpr void clear() { size_ = excess_ = 0; }
  /// Takes the last item away; the list must not be empty.
  constexpr void drop_last() { --size_; }

  /// Zero at compile time where the capacity is, so that loops over what a scene cannot have leave no code.
  constexpr int size() const {
    // So that the compiler knows that a loop over one item is none.
    if (N <= 2 && (size_ < 0 || size_ > N)) __builtin_unreachable();
    return N == 0 ? 0 : size_;
  }
  constexpr bool empty() const { return size() == 0; }
  static constexpr int capacity() { return N; }
  /// How many items were dropped because the list was full.
  constexpr int excess() const { return excess_; }

  constexpr T& operator[](int i) { return items_[static_cast<std::size_t>(i)]; }
  constexpr const T& operator[](int i) const { return items_[static_cast<std::size_t>(i)]; }

  constexpr const T* begin() const { return items_.data(); }
  constexpr const T* end() const { return items_.data() + size(); }
  constexpr T* begin() { return items_.data(); }
  constexpr T* end() { return items_.data() + size(); }

  /// Whether both have the same items in the same order.
  friend constexpr bool operator==(const FixedList& a, const FixedList& b) {
    if (a.size() != b.size()) return false;
    for (int i = 0; i < a.size(); ++i)
      if (!(a[i] == b[i])) return false;
    return true;
  }

 private:
  std::array<T, static_cast<std::size_t>(N)> items_{};
  int size_ = 0;
  int excess_ = 0;
};

/// An array of exactly N values of T, indexed by int; N may be zero.
template <class T, int N>
struct FixedArray {
  std::array<T, static_cast<std::size_t>(N)> items{};

  static constexpr int size() { return N; }
  constexpr T& operator[](int i) { return items[static_cast<std::size_t>(i)]; }
  constexpr const T& operator[](int i) const { return items[static_cast<std::size_t>(i)]; }
  constexpr const T* begin() const { return items.data(); }
  constexpr const T* end() const { return items.data() + N; }
  constexpr void fill(const T& value) {
    for (T& item : items) item = value;
  }
  friend constexpr bool operator==(const FixedArray& a, const FixedArray& b) {
    for (int i = 0; i < N; ++i)
      if (!(a[i] == b[i])) return false;
    return true;
  }
};

}  // namespace taut
