#include "lib/live/load_history.hpp"

#include "lib/files/text.hpp"

namespace taut::host {

void LoadHistory::add(const LiveAnswer& live) {
  if (live.row == 0) return;
  std::string text = "[" + plain(live.time) + ",[";
  for (const JackNow& jack : live.jacks)
    text += (text.back() == '[' ? "[" : ",[") + plain(jack.force) + "," +
            (jack.stroke ? plain(*jack.stroke) : "null") + "]";
  text += std::string("],") + (live.alarms.empty() ? "0]" : "1]");
  const std::lock_guard<std::mutex> lock(mutex_);
  if (count_++ % every_ == 0) points_.push_back(text);
  last_ = std::move(text);
  if (points_.size() < most) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = std::move(points_[2 * i]);
  points_.resize((points_.size() + 1) / 2);
  every_ *= 2;
}

std::string LoadHistory::json() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string text = "[";
  for (const std::string& point : points_) text += (text.size() == 1 ? "" : ",") + point;
  if (!points_.empty() && points_.back() != last_) text += "," + last_;
  return text + "]";
}

}  // namespace taut::host
