// Where the lines of a log come from while it is written.
#pragma once

#include <optional>
#include <streambuf>
#include <string>
#include <utility>

namespace taut::host {

/// Gives the text of a log line by line and waits where there is none yet.
class LineSource {
 public:
  LineSource() = default;
  virtual ~LineSource() = default;
  LineSource(const LineSource&) = delete;
  LineSource& operator=(const LineSource&) = delete;

  /// The next line with its line feed, which the last one of a text may lack; nothing at the end, or when the
  /// program is to end. Throws InputError where there can be no more.
  virtual std::optional<std::string> next() = 0;
};

/// What a LineSource gives, for a stream that never reads ahead of the line that is asked for.
class LineBuffer : public std::streambuf {
 public:
  explicit LineBuffer(LineSource& source) : source_(source) {}

  /// The line that was given last, without its end.
  std::string last_line() const {
    std::string text = line_;
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    return text;
  }
  /// What is left of the present line is left out, and the next one will be this one, before those of the
  /// source.
  void insert(const std::string& line) {
    setg(nullptr, nullptr, nullptr);
    inserted_ = line + "\n";
  }
  /// Whether the source has come to its end.
  bool is_over() const { return is_over_; }

 private:
  int_type underflow() override {
    if (is_over_) return traits_type::eof();
    std::optional<std::string> line = inserted_ ? std::exchange(inserted_, std::nullopt) : source_.next();
    is_over_ = !line || line->empty();
    if (is_over_) return traits_type::eof();
    line_ = std::move(*line);
    setg(line_.data(), line_.data(), line_.data() + line_.size());
    return traits_type::to_int_type(line_[0]);
  }

  LineSource& source_;
  std::string line_;
  std::optional<std::string> inserted_;
  bool is_over_ = false;
};

}  // namespace taut::host
