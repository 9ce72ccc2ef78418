// A log that is a file, as far as it is written and further.
#pragma once

#include <cstdint>
#include <string>

#include "lib/live/line_source.hpp"
#include "lib/live/pending_lines.hpp"
#include "lib/live/stop_signal.hpp"

namespace taut::host {

/// Lines of a file. At its end it waits for more, as `tail -f` does, or is over.
class FileSource : public LineSource {
 public:
  /// How long a new row may lie in the file before it is seen.
  static constexpr int interval = 10;  // ms

  /// Throws InputError if there is no such file.
  FileSource(const std::string& path, bool grows, const StopSignal& stop);
  ~FileSource() override;

  /// Throws InputError if the file has become shorter.
  std::optional<std::string> next() override;

 private:
  std::string path_;
  bool grows_;
  const StopSignal& stop_;
  int descriptor_ = -1;
  std::int64_t read_ = 0;
  PendingLines lines_;
};

}  // namespace taut::host
