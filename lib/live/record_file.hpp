// A result that grows row by row, and goes on after an interruption.
#pragma once

#include <cstdint>
#include <string>

namespace taut::host {

/// Rows are in the file when append() returns: the program may be killed, though not the computer lose its
/// power.
class RecordFile {
 public:
  /// Opens the file, or makes it with this header. Throws InputError for a file that holds something else.
  RecordFile(const std::string& path, const std::string& header);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

  /// Size of the file [bytes].
  std::int64_t size() const { return size_; }
  /// Cuts off what was written after it had this size. Throws InputError if it is shorter.
  void go_back_to(std::int64_t size);
  /// A line with its end. Throws InputError if it cannot be written.
  void append(const std::string& line);

 private:
  [[noreturn]] void fail(const std::string& doing) const;

  std::string path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace taut::host
