// HTTP as bytes on a socket, so that a test can also do what no browser does.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

class HttpClient {
 public:
  /// `receive_buffer`: its size, for a client that is slow on purpose.
  explicit HttpClient(int port, int receive_buffer = 0) {
    socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (receive_buffer > 0)
      setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected_ = connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~HttpClient() { close(socket_); }
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  bool is_connected() const { return is_connected_; }
  bool send(const std::string& text) const {
    return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }
  bool get(const std::string& path) const { return send("GET " + path + " HTTP/1.1\r\nHost: taut\r\n\r\n"); }
  /// What has come until the other side closes, or for so long.
  const std::string& receive(double seconds) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!is_over_ && std::chrono::steady_clock::now() < until) take(10);
    return text_;
  }
  /// What has come so far, after waiting for more.
  const std::string& take(int milliseconds) {
    pollfd waiting{socket_, POLLIN, 0};
    if (is_over_ || poll(&waiting, 1, milliseconds) <= 0) return text_;
    char bytes[65536];
    const ssize_t count = recv(socket_, bytes, sizeof bytes, 0);
    if (count <= 0)
      is_over_ = true;
    else
      text_.append(bytes, static_cast<std::size_t>(count));
    return text_;
  }
  /// The first bytes are not needed any more; returns how many they were.
  std::size_t forget(std::size_t count) {
    text_.erase(0, count);
    return count;
  }
  /// Whether the other side has closed.
  bool is_over() const { return is_over_; }
  int status() const { return text_.size() > 12 ? std::atoi(text_.c_str() + 9) : 0; }
  std::string body() const {
    const std::size_t at = text_.find("\r\n\r\n");
    return at == std::string::npos ? "" : text_.substr(at + 4);
  }
  /// Of a stream of events, the data of those that are whole.
  std::vector<std::string> events() const {
    std::vector<std::string> found;
    const std::string text = body();
    std::size_t at = 0;
    for (std::size_t end = text.find("\n\n"); end != std::string::npos;
         at = end + 2, end = text.find("\n\n", at))
      if (text.compare(at, 6, "data: ") == 0) found.push_back(text.substr(at + 6, end - at - 6));
    return found;
  }

 private:
  int socket_ = -1;
  bool is_connected_ = false, is_over_ = false;
  std::string text_;
};

/// The body of a page.
inline std::string page_at(int port, const std::string& path, int* status = nullptr) {
  HttpClient client(port);
  client.get(path);
  client.receive(10);
  if (status != nullptr) *status = client.status();
  return client.body();
}
