// Every so many of things that come one by one.
#pragma once

#include <cstddef>
#include <vector>

namespace taut::host {

/// Keeps things in their order, at most `Most` of them: every second one of those it has when there is no
/// more room, and of what follows. Memory: `Most` things.
template <class Thing, std::size_t Most>
class EverySoMany {
 public:
  void add(const Thing& thing) {
    if (added_++ % every_ != 0) return;
    if (kept_.size() == Most) {
      for (std::size_t i = 0; 2 * i < Most; ++i) kept_[i] = kept_[2 * i];
      kept_.resize(Most / 2);
      every_ *= 2;
    }
    kept_.push_back(thing);
  }
  const std::vector<Thing>& kept() const { return kept_; }
  /// One of so many is kept.
  std::size_t every() const { return every_; }

 private:
  std::vector<Thing> kept_;
  std::size_t added_ = 0, every_ = 1;
};

}  // namespace taut::host
