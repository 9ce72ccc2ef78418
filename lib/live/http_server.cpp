#include "lib/live/http_server.hpp"

#include <httplib.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <thread>
#include <utility>

#include "lib/files/input_error.hpp"
#include "lib/files/text.hpp"
#include "lib/live/connection.hpp"
#include "lib/live/connection_threads.hpp"
#include "lib/live/stop_signal.hpp"

namespace taut::host {
namespace {

constexpr std::chrono::milliseconds look_up{250}, heartbeat{5000};

// One request a connection, each with its deadlines.
class Server : public httplib::Server {
 public:
  // Five at a time, as the library has it, would make a browser among others wait for seconds.
  void let_wait(int connections) { ::listen(svr_sock_, connections); }

 private:
  bool process_and_close_socket(socket_t socket) override {
    bool is_served = false;
    if (!ConnectionThreads::is_refusing()) {
      Connection connection(socket);
      bool is_closed = false;
      is_served = process_request(connection, true, is_closed, nullptr);
    }
    shutdown(socket, SHUT_RDWR);
    close(socket);
    return is_served;
  }
};

void say(httplib::Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(text + "\n", "text/plain; charset=utf-8");
}

}  // namespace

class HttpServer::Impl {
 public:
  Impl(const AnswerBoard& board, const LoadHistory& history, Page page)
      : board_(board), history_(history), page_(std::move(page)) {
    server_.new_task_queue = [] { return new ConnectionThreads; };
    // Two programs must not share a port.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.set_payload_max_length(1024);
    server_.set_default_headers(
        {{"Cache-Control", "no-store"},
         {"X-Content-Type-Options", "nosniff"},
         {"Referrer-Policy", "no-referrer"},
         {"Content-Security-Policy",
          "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline' blob:; worker-src "
          "blob:; connect-src 'self'; img-src data:; base-uri 'none'; form-action 'none'"}});
    server_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (response.body.empty()) say(response, response.status, "error " + std::to_string(response.status));
    });
    server_.set_exception_handler([](const httplib::Request&, httplib::Response& response,
                                     std::exception_ptr) { say(response, 500, "error 500"); });
    server_.Get("/", [this](const httplib::Request&, httplib::Response& response) {
      response.set_content(page_(board_.newest()), "text/html; charset=utf-8");
    });
    server_.Get("/answer\\.json", [this](const httplib::Request&, httplib::Response& response) {
      const LiveAnswerPtr newest = board_.newest();
      if (newest)
        response.set_content(newest->json + "\n", "application/json");
      else
        say(response, 503, "no row has come yet");
    });
    server_.Get("/history\\.json", [this](const httplib::Request&, httplib::Response& response) {
      response.set_content(history_.json(), "application/json");
    });
    server_.Get("/events", [this](const httplib::Request& request, httplib::Response& response) {
      listen(request, response);
    });
  }

  int bind(const HttpAddress& at) {
    if (at.port == 0) return server_.bind_to_any_port(at.address);
    return server_.bind_to_port(at.address, at.port) ? at.port : -1;
  }
  void start() {
    server_.let_wait(static_cast<int>(ConnectionThreads::most));
    const SignalsHeldBack held;
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ~Impl() {
    // Who listens gets what the board still has.
    for (int i = 0; i < 100 && board_.is_closed() && listeners_ > 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    is_over_ = true;
    if (thread_.joinable()) {
      server_.stop();
      thread_.join();
    }
  }

 private:
  void listen(const httplib::Request& request, httplib::Response& response) {
    if (request.method == "HEAD") return;
    if (++listeners_ > most_listeners) {
      --listeners_;
      response.set_header("Retry-After", "5");
      say(response, 503, "too many listen already");
      return;
    }
    // Before the header goes out: whoever has that misses no row.
    auto place = std::make_shared<AnswerBoard::Place>(board_.newest_place());
    auto last = std::make_shared<std::chrono::steady_clock::time_point>();
    response.set_content_provider(
        "text/event-stream",
        [this, place, last](std::size_t, httplib::DataSink& sink) { return send(*place, *last, sink); },
        [this](bool) { --listeners_; });
  }

  // The next answer, or a sign of life.
  bool send(AnswerBoard::Place& place, std::chrono::steady_clock::time_point& last,
            httplib::DataSink& sink) const {
    if (is_over_) return false;
    const LiveAnswerPtr answer = board_.next(place, look_up);
    const auto now = std::chrono::steady_clock::now();
    if (!answer && board_.is_closed()) {
      sink.done();
      return true;
    }
    if (!answer && now - last < heartbeat) return true;
    last = now;
    const std::string text = answer ? "data: " + answer->json + "\n\n" : ":\n\n";
    return sink.write(text.data(), text.size());
  }

  const AnswerBoard& board_;
  const LoadHistory& history_;
  Page page_;
  std::atomic<int> listeners_ = 0;
  std::atomic<bool> is_over_ = false;
  Server server_;
  std::thread thread_;
};

HttpAddress http_address(const std::string& option, const std::string& text) {
  HttpAddress found;
  const std::size_t colon = text.rfind(':');
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  if (colon != std::string::npos) {
    found.address = text.substr(0, colon);
    const bool has_brackets =
        found.address.size() > 2 && found.address.front() == '[' && found.address.back() == ']';
    if (has_brackets) found.address = found.address.substr(1, found.address.size() - 2);
  }
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), found.port);
  if (error != std::errc() || end != port.data() + port.size() || found.port < 0 || found.port > 65535 ||
      found.address.empty())
    throw InputError(option, "", quote(text) + " is no address and port",
                     "write a port such as 8080, or an address before it as in 0.0.0.0:8080");
  return found;
}

HttpServer::HttpServer(const HttpAddress& address, const AnswerBoard& board, const LoadHistory& history,
                       Page page)
    : impl_(new Impl(board, history, std::move(page))) {
  errno = 0;
  const int port = impl_->bind(address);
  const bool is_long = address.address.find(':') != std::string::npos;
  const std::string host = is_long ? "[" + address.address + "]" : address.address;
  if (port <= 0)
    throw InputError("--http", "",
                     "nobody can listen at " + host + ":" + std::to_string(address.port) +
                         (errno != 0 ? ": " + std::generic_category().message(errno) : ""),
                     "name a port that is free, or 0 for any, and an address of this computer");
  url_ = "http://" + host + ":" + std::to_string(port) + "/";
  impl_->start();
}

HttpServer::~HttpServer() = default;

}  // namespace taut::host
