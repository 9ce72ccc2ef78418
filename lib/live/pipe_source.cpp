#include "lib/live/pipe_source.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace taut::host {

std::optional<std::string> PipeSource::next() {
  while (!stop_.is_requested()) {
    if (std::optional<std::string> line = lines_.take()) return line;
    if (is_over_) return lines_.rest();
    std::array<pollfd, 2> waiting = {pollfd{descriptor_, POLLIN, 0}, pollfd{stop_.descriptor(), POLLIN, 0}};
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) is_over_ = true;
    if (waiting[0].revents == 0) continue;
    std::array<char, 65536> bytes;
    const ssize_t count = read(descriptor_, bytes.data(), bytes.size());
    if (count > 0)
      lines_.add({bytes.data(), static_cast<std::size_t>(count)});
    else if (count == 0 || (errno != EINTR && errno != EAGAIN))
      is_over_ = true;
  }
  return std::nullopt;
}

}  // namespace taut::host
