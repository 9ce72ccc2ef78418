// Bytes from an interrupt to the main loop: the interrupt writes, the main loop reads.
#pragma once

#include <atomic>
#include <cstdint>

namespace boards {

template <class Item, unsigned Size>
class Ring {
 public:
  /// For the interrupt. False: it is full, and the item is lost.
  bool put(const Item& item) {
    const unsigned at = in_.load(std::memory_order_relaxed), next = (at + 1) % Size;
    if (next == out_.load(std::memory_order_acquire)) return false;
    items_[at] = item;
    in_.store(next, std::memory_order_release);
    return true;
  }
  /// For the main loop.
  bool take(Item& item) {
    const unsigned at = out_.load(std::memory_order_relaxed);
    if (at == in_.load(std::memory_order_acquire)) return false;
    item = items_[at];
    out_.store((at + 1) % Size, std::memory_order_release);
    return true;
  }
  bool is_empty() const {
    return in_.load(std::memory_order_relaxed) == out_.load(std::memory_order_relaxed);
  }

 private:
  Item items_[Size];
  std::atomic<unsigned> in_{0}, out_{0};
};

}  // namespace boards
