#include "lib/live/connection_threads.hpp"

#include <system_error>
#include <thread>
#include <utility>

namespace taut::host {
namespace {

thread_local bool refusing = false;

void refuse(const std::function<void()>& task) {
  refusing = true;
  task();
  refusing = false;
}

}  // namespace

bool ConnectionThreads::is_refusing() { return refusing; }

void ConnectionThreads::enqueue(std::function<void()> task) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (running_ < most) {
      ++running_;
    } else {
      refuse(task);
      return;
    }
  }
  try {
    std::thread([this, task] {
      task();
      end();
    }).detach();
  } catch (const std::system_error&) {
    end();
    refuse(task);
  }
}

void ConnectionThreads::end() {
  const std::lock_guard<std::mutex> lock(mutex_);
  --running_;
  ended_.notify_all();
}

void ConnectionThreads::shutdown() {
  std::unique_lock<std::mutex> lock(mutex_);
  ended_.wait(lock, [&] { return running_ == 0; });
}

}  // namespace taut::host
