// The answers over HTTP, for any number of browsers.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "lib/live/answer_board.hpp"
#include "lib/live/load_history.hpp"

namespace taut::host {

/// `[ADDRESS:]PORT`
struct HttpAddress {
  std::string address = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
};

/// Throws InputError, with `option` as the file, for what is none.
HttpAddress http_address(const std::string& option, const std::string& text);

/// Serves `/`, `/answer.json`, `/events` and `/history.json` from threads of its own, until it is destroyed.
/// What it is given must outlive it; `page` is called from these threads.
class HttpServer {
 public:
  using Page = std::function<std::string(const LiveAnswerPtr&)>;
  /// So many may listen to events at a time; others are told to come back later.
  static constexpr int most_listeners = 96;

  /// Throws InputError if nobody can listen there.
  HttpServer(const HttpAddress& address, const AnswerBoard& board, const LoadHistory& history, Page page);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// `http://127.0.0.1:8080/`
  const std::string& url() const { return url_; }

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
  std::string url_;
};

}  // namespace taut::host
