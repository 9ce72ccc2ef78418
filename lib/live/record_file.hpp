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

  /// Size of the file up to the row that was appended last [bytes].
  std::int64_t size() const { return at_; }
  /// The rows after this size come again: until cut() a line that is there stays, so that at no instant one
  /// is missing. Throws InputError if the file is shorter.
  void go_back_to(std::int64_t size);
  /// What has not come again is cut off.
  void cut();
  /// A line with its end. Throws InputError if it cannot be written.
  void append(const std::string& line);

 private:
  [[noreturn]] void fail(const std::string& doing) const;

  std::string path_;
  int descriptor_ = -1;
  std::int64_t at_ = 0, size_ = 0;  // of the row appended last, and of the file
};

}  // namespace taut::host
