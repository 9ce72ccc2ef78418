// Large objects of which a scene uses little.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace taut::host {

struct FreeZeroed {
  void operator()(void* object) const { std::free(object); }
};

/// An object as its default constructor leaves it, for types that begin as zeros, bit for bit: that they do
/// is tested. Memory comes from the system as zeros already, and what is not written takes none: the rows of
/// 2048 struts are 150 MB, those of nine a few pages. Throws std::bad_alloc.
template <class T>
using Zeroed = std::unique_ptr<T, FreeZeroed>;

template <class T>
Zeroed<T> make_zeroed() {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(std::max_align_t));
  void* const memory = std::calloc(1, sizeof(T));
  if (memory == nullptr) throw std::bad_alloc();
  return Zeroed<T>(static_cast<T*>(memory));
}

/// An object as its default constructor leaves it: std::make_unique() would write zeros to all of it before.
template <class T>
std::unique_ptr<T> make_default() {
  return std::unique_ptr<T>(new T);
}

}  // namespace taut::host
