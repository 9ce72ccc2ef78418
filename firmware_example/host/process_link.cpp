#include "host/process_link.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <stdexcept>

namespace monitor::host {

ProcessLink::ProcessLink(const std::string& command) {
  std::array<int, 2> in{}, out{};
  if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("there are no pipes left for the device; end other programs");
  // A device that has gone is noticed by its silence.
  std::signal(SIGPIPE, SIG_IGN);
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("the device cannot be started; end other programs");
  if (process_ == 0) {
    dup2(in[0], STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(in[0]);
  close(out[1]);
  to_ = in[1];
  from_ = out[0];
}

ProcessLink::~ProcessLink() {
  close(to_);
  close(from_);
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

void ProcessLink::send(const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t part = ::write(to_, bytes.data() + sent, bytes.size() - sent);
    if (part <= 0) throw std::runtime_error("the device has ended; see what it said before");
    sent += static_cast<std::size_t>(part);
  }
}

std::optional<std::string> ProcessLink::receive(int milliseconds) {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::milliseconds(milliseconds);
  for (;;) {
    const std::size_t end = received_.find('\n');
    if (end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (rest <= 0) return std::nullopt;
    pollfd waiting{from_, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(rest)) <= 0) continue;
    std::array<char, 4096> chunk{};
    const ssize_t part = ::read(from_, chunk.data(), chunk.size());
    if (part <= 0) throw std::runtime_error("the device has ended; see what it said before");
    received_.append(chunk.data(), static_cast<std::size_t>(part));
  }
}

}  // namespace monitor::host
