// A device that is another process, such as an emulator: its serial line is standard input and output.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "host/link.hpp"

namespace monitor::host {

class ProcessLink : public Link {
 public:
  /// Starts the command by a shell. Throws std::runtime_error.
  explicit ProcessLink(const std::string& command);
  /// Ends the process.
  ~ProcessLink() override;
  ProcessLink(const ProcessLink&) = delete;
  ProcessLink& operator=(const ProcessLink&) = delete;

  void send(const std::string& bytes) override;
  std::optional<std::string> receive(int milliseconds) override;

 private:
  pid_t process_ = -1;
  int to_ = -1, from_ = -1;
  std::string received_;
};

}  // namespace monitor::host
