// The line to a device, as seen from a PC.
#pragma once

#include <optional>
#include <string>

namespace monitor::host {

class Link {
 public:
  Link() = default;
  virtual ~Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  virtual void send(const std::string& bytes) = 0;
  /// The next line without its line feed; nothing if none comes in that time.
  virtual std::optional<std::string> receive(int milliseconds) = 0;
};

}  // namespace monitor::host
