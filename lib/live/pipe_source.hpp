// A log from standard input.
#pragma once

#include "lib/live/line_source.hpp"
#include "lib/live/pending_lines.hpp"
#include "lib/live/stop_signal.hpp"

namespace taut::host {

/// Lines from a descriptor until its end.
class PipeSource : public LineSource {
 public:
  PipeSource(int descriptor, const StopSignal& stop) : descriptor_(descriptor), stop_(stop) {}

  std::optional<std::string> next() override;

 private:
  int descriptor_;
  const StopSignal& stop_;
  PendingLines lines_;
  bool is_over_ = false;
};

}  // namespace taut::host
