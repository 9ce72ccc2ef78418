// A thread for every connection, and no more than so many.
#pragma once

#include <httplib.h>

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>

namespace taut::host {

/// Starts a thread when a connection comes. Of those beyond `most` the task is called at once and by the
/// caller, with is_refusing(): it has to close the connection.
class ConnectionThreads : public httplib::TaskQueue {
 public:
  static constexpr std::size_t most = 128;

  void enqueue(std::function<void()> task) override;
  /// Waits until all have ended.
  void shutdown() override;
  static bool is_refusing();

 private:
  void end();

  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t running_ = 0;
};

}  // namespace taut::host
