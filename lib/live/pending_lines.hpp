// Bytes as they come, cut into lines.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace taut::host {

/// Keeps what has no end yet, up to a line that no log can have.
class PendingLines {
 public:
  static constexpr std::size_t longest = (std::size_t{1} << 20) + 2;

  void add(std::string_view bytes) {
    // What is done with goes once it is the larger part, so that no byte is moved often.
    if (at_ > bytes_.size() / 2) {
      bytes_.erase(0, at_);
      searched_ -= at_;
      at_ = 0;
    }
    bytes_ += bytes;
  }
  /// The next line with its line feed; without one where it is too long.
  std::optional<std::string> take() {
    const std::size_t end = bytes_.find('\n', searched_);
    if (end == std::string::npos) {
      searched_ = bytes_.size();
      return searched_ - at_ < longest ? std::nullopt : rest();
    }
    searched_ = end + 1;
    return cut(end + 1);
  }
  /// What has come of a line without an end; nothing if that is nothing.
  std::optional<std::string> rest() {
    if (at_ == bytes_.size()) return std::nullopt;
    searched_ = bytes_.size();
    return cut(bytes_.size());
  }
  void forget() {
    bytes_.clear();
    at_ = searched_ = 0;
  }

 private:
  std::string cut(std::size_t end) {
    std::string line = bytes_.substr(at_, end - at_);
    at_ = end;
    return line;
  }

  std::string bytes_;
  std::size_t at_ = 0, searched_ = 0;
};

}  // namespace taut::host
