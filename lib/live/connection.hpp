// A connection to a browser that cannot keep the server waiting.
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <string>

namespace taut::host {

/// A whole request has to come in one time, every piece of the answer has to be taken in another; then the
/// connection is over. Of a request only so many bytes are read.
class Connection : public httplib::Stream {
 public:
  static constexpr std::chrono::seconds to_ask{5}, to_take{5};
  static constexpr std::size_t longest_request = std::size_t{1} << 16;

  explicit Connection(socket_t socket);

  bool is_readable() const override;
  /// Whether the other side takes more within its time.
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool wait_for(short event, Clock::time_point until) const;

  socket_t socket_;
  Clock::time_point asked_until_;
  std::array<char, 4096> bytes_{};
  std::size_t at_ = 0, size_ = 0, read_ = 0;
};

}  // namespace taut::host
