#include "lib/live/answer_board.hpp"

#include <utility>

namespace taut::host {

void AnswerBoard::put(LiveAnswerPtr answer) {
  LiveAnswerPtr old;  // freed after the lock
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    answers_.push_back(std::move(answer));
    ++count_;
    if (answers_.size() > kept) {
      old = std::move(answers_.front());
      answers_.pop_front();
    }
  }
  changed_.notify_all();
}

void AnswerBoard::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
}

bool AnswerBoard::is_closed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_closed_;
}

LiveAnswerPtr AnswerBoard::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return answers_.empty() ? nullptr : answers_.back();
}

AnswerBoard::Place AnswerBoard::newest_place() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {count_ > 0 ? count_ - 1 : 0};
}

LiveAnswerPtr AnswerBoard::next(Place& place, std::chrono::milliseconds patience) const {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return is_closed_ || count_ > place.next; });
  if (count_ <= place.next) return nullptr;
  const std::size_t oldest = count_ - answers_.size();
  if (place.next < oldest) place.next = count_ - 1;
  return answers_[place.next++ - oldest];
}

std::size_t AnswerBoard::count() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return count_;
}

}  // namespace taut::host
