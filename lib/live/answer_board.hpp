// Where the newest answers hang for all who look on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>

#include "lib/live/live_answer.hpp"

namespace taut::host {

using LiveAnswerPtr = std::shared_ptr<const LiveAnswer>;

/// One writes, any number of threads read, each at its pace. Writing takes a lock for as long as a pointer
/// takes to copy and waits for no reader: who is more than `kept` answers behind goes on with the newest.
class AnswerBoard {
 public:
  static constexpr std::size_t kept = 512;

  /// Of a reader: the answer that it wants next, at first the first one.
  struct Place {
    std::size_t next = 0;
  };

  void put(LiveAnswerPtr answer);
  /// No more will come.
  void close();
  bool is_closed() const;

  /// The last one; null if there is none.
  LiveAnswerPtr newest() const;
  /// Of a reader that begins with the newest answer, and gets all that are put from now on.
  Place newest_place() const;
  /// The answer at the place, which moves on; null if none comes in that time or ever.
  LiveAnswerPtr next(Place& place, std::chrono::milliseconds patience) const;
  /// How many were put.
  std::size_t count() const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<LiveAnswerPtr> answers_;
  std::size_t count_ = 0;
  bool is_closed_ = false;
};

}  // namespace taut::host
