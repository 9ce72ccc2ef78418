#include "lib/live/connection.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>

namespace taut::host {

Connection::Connection(socket_t socket) : socket_(socket), asked_until_(Clock::now() + to_ask) {
  fcntl(socket_, F_SETFL, fcntl(socket_, F_GETFL) | O_NONBLOCK);
  const int yes = 1, kept = 1 << 17;
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  // What a slow client has before it is soon behind the present; the system would keep megabytes of it.
  setsockopt(socket_, SOL_SOCKET, SO_SNDBUF, &kept, sizeof kept);
}

bool Connection::wait_for(short event, Clock::time_point until) const {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd waiting{socket_, event, 0};
    const int found = poll(&waiting, 1, static_cast<int>(std::max<long long>(left, 0)));
    if (found > 0) return (waiting.revents & event) != 0;
    if (found == 0 || errno != EINTR) return false;
  }
}

bool Connection::is_readable() const { return at_ < size_ || wait_for(POLLIN, asked_until_); }

bool Connection::is_writable() const { return wait_for(POLLOUT, Clock::now() + to_take); }

ssize_t Connection::read(char* to, std::size_t size) {
  if (at_ == size_) {
    if (read_ >= longest_request || !wait_for(POLLIN, asked_until_)) return -1;
    const ssize_t count = recv(socket_, bytes_.data(), bytes_.size(), 0);
    if (count <= 0) return count;
    at_ = 0;
    size_ = static_cast<std::size_t>(count);
    read_ += size_;
  }
  const std::size_t count = std::min(size, size_ - at_);
  std::copy_n(bytes_.data() + at_, count, to);
  at_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t Connection::write(const char* from, std::size_t size) {
  const auto until = Clock::now() + to_take;
  std::size_t done = 0;
  while (done < size) {
    // A connection that is closed raises no signal: the server ignores SIGPIPE.
    const ssize_t count = send(socket_, from + done, size - done, 0);
    if (count > 0)
      done += static_cast<std::size_t>(count);
    else if (errno != EINTR && !((errno == EAGAIN || errno == EWOULDBLOCK) && wait_for(POLLOUT, until)))
      return -1;
  }
  return static_cast<ssize_t>(done);
}

// Nobody is told apart.
void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}
void Connection::get_local_ip_and_port(std::string& ip, int& port) const { get_remote_ip_and_port(ip, port); }

}  // namespace taut::host
