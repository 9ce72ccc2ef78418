// A device in the same program: its main loop runs while somebody waits for it.
#pragma once

#include <optional>
#include <string>

#include "host/link.hpp"
#include "host/memory_board.hpp"

namespace monitor::host {

template <class Application>
class MemoryLink : public Link {
 public:
  MemoryLink(MemoryBoard& board, Application& application) : board_(board), application_(application) {}

  void send(const std::string& bytes) override { board_.to_device += bytes; }
  std::optional<std::string> receive(int) override {
    std::string& said = board_.from_device;
    while (said.find('\n') == std::string::npos && !board_.line_is_empty()) application_.step();
    const std::size_t end = said.find('\n');
    if (end == std::string::npos) return std::nullopt;
    std::string line = said.substr(0, end);
    said.erase(0, end + 1);
    return line;
  }

 private:
  MemoryBoard& board_;
  Application& application_;
};

}  // namespace monitor::host
