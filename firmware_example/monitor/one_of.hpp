// Room for one of several objects at a time, chosen by number: the scenes share their memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>

namespace monitor {

/// std::variant without exceptions, and without pointers to functions, which would hide the depth of the
/// stack.
template <class... Types>
class OneOf {
 public:
  static_assert((std::is_trivially_destructible_v<Types> && ...), "objects are replaced without a farewell");

  /// Puts a new object of type `which` in place of the one that is there.
  void make(int which) {
    which_ = which;
    int i = 0;
    static_cast<void>(((i++ == which ? (new (bytes_) Types, true) : false) || ...));
  }

  /// Calls `call` with the object. Something must have been made.
  template <class Call>
  void visit(Call&& call) {
    int i = 0;
    static_cast<void>(((i++ == which_ ? (call(*reinterpret_cast<Types*>(bytes_)), true) : false) || ...));
  }

 private:
  alignas(Types...) std::byte bytes_[std::max({sizeof(Types)...})];
  int which_ = 0;
};

}  // namespace monitor
