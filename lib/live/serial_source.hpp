// A log from a serial line that may be pulled out and put back.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "lib/live/frame_rows.hpp"
#include "lib/live/line_source.hpp"
#include "lib/live/pending_lines.hpp"
#include "lib/live/stop_signal.hpp"

namespace taut::host {

/// `DEVICE[:BAUD]`
struct SerialLine {
  std::string device;
  int baud = 115200;
};

/// Throws InputError for a speed that no line has.
SerialLine serial_line(const std::string& text);

/// Lines of the log's format, or frames of the firmware's monitor, at 8 data bits, no parity, one stop bit. A
/// log ends where the line is lost or the header comes again; the next one begins with that header, or where
/// there is none with that of the log before. The first line after the device was opened may be the rest of
/// one: it counts only if it is a header.
class SerialSource : public LineSource {
 public:
  static constexpr std::chrono::milliseconds silence{10000}, retry{200};

  /// Told when nothing has come for so long or the device is gone, and when lines come again.
  using Tell = std::function<void(bool is_silent)>;
  /// Throws InputError if the device cannot be opened. `header` is what the log before had; empty: not known.
  SerialSource(const SerialLine& line, std::string header, const StopSignal& stop, Tell tell,
               FrameRows frames);
  ~SerialSource() override;

  std::optional<std::string> next() override;
  /// Of the present log, or the one before.
  const std::string& header() const { return header_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool open_device();
  void lose();
  std::optional<std::string> line();
  bool wait_for_bytes();
  void say(bool is_silent);

  SerialLine serial_;
  std::string header_;
  const StopSignal& stop_;
  Tell tell_;
  FrameRows frames_;
  PendingLines lines_;
  int descriptor_ = -1;
  bool is_fresh_ = true;  // since it was opened no line has ended
  bool is_silent_ = false;
  bool has_begun_ = false;           // the present log has a header
  bool header_waits_ = false;        // it has come, and is to be given
  bool is_asked_ = false;            // for a header
  std::optional<std::string> kept_;  // a line that comes after the header
  Clock::time_point heard_;
};

}  // namespace taut::host
