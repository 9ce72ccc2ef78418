// What no browser sends is answered with an error or dropped, names with markup are text, and rows go on
// being answered.
#include <doctest/doctest.h>

#include <memory>

#include "report/well_formed.hpp"
#include "watch/http_client.hpp"
#include "watch/watched_program.hpp"
#include "watch/watched_scene.hpp"

namespace {

int status_of(int port, const std::string& request, double seconds = 3) {
  HttpClient client(port);
  client.send(request);
  client.receive(seconds);
  return client.is_over() ? client.status() : -1;
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("hostile requests are refused or dropped, and nothing else suffers") {
  const Scratch scratch;
  write_scene(scratch);
  WatchedProgram watch(scratch, {"scene.json", "-", "--http", "0"});
  const int port = watch.port();
  const std::vector<std::string> rows = log_rows(5);
  watch.write(log_header + joined(rows));
  REQUIRE(comes_true([&] { return page_at(port, "/answer.json").find("\"time\":4.0") == 1; }));
  const std::string end = " HTTP/1.1\r\nHost: x\r\n\r\n";
  for (const char* path :
       {"/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/answer.json/../../x",
        "/scene.json", "/log.csv", "/\\..\\x", "/answer.json%00", "/events/x"})
    CHECK_MESSAGE(status_of(port, std::string("GET ") + path + end) == 404, path);
  CHECK(status_of(port, "GET /" + std::string(100000, 'a') + end) != 200);
  CHECK(status_of(port, "GET / HTTP/1.1\r\nX: " + std::string(100000, 'a') + "\r\n\r\n") != 200);
  CHECK(status_of(port, "GET / HTTP/1.1\r\n" + repeated("X: y\r\n", 20000) + "\r\n") != 200);
  CHECK(status_of(port, "nonsense\r\n\r\n") == 400);
  CHECK(status_of(port, std::string("\0\1\2\3\r\n\r\n", 8)) == 400);
  for (const char* method : {"POST", "PUT", "DELETE", "TRACE", "PATCH"}) {
    const int status =
        status_of(port, std::string(method) + " / HTTP/1.1\r\nHost: x\r\nContent-Length: 0\r\n\r\n");
    CHECK_MESSAGE((status == 404 || status == 400), method);
  }
  CHECK(status_of(port,
                  "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 99999999\r\n\r\n" + std::string(60000, 'x'),
                  8) != 200);
  CHECK(
      status_of(port, "GET / HTTP/1.1\r\nHost: x\r\nRange: bytes=0-0,1-1,-5,99999999999999999999-\r\n\r\n") !=
      500);
  // A request that never ends is dropped as a whole, however its bytes drip, and meanwhile others are served.
  std::vector<std::unique_ptr<HttpClient>> slow;
  for (int i = 0; i < 40; ++i) {
    slow.push_back(std::make_unique<HttpClient>(port));
    slow.back()->send("GET / HTTP/1.1\r\nX: ");
  }
  const auto begun = std::chrono::steady_clock::now();
  while (!slow.front()->is_over() && std::chrono::steady_clock::now() - begun < std::chrono::seconds(9)) {
    for (const auto& client : slow) client->send("a");
    slow.front()->take(300);
    CHECK(page_at(port, "/answer.json").find("\"time\":4.0") == 1);
  }
  CHECK(slow.front()->is_over());
  slow.clear();
  // More at a time than are listened to.
  std::vector<std::unique_ptr<HttpClient>> many;
  for (int i = 0; i < 300; ++i) {
    many.push_back(std::make_unique<HttpClient>(port));
    many.back()->get("/events");
  }
  watch.write("5,100000,120000,0\n");
  CHECK(comes_true([&] { return watch.out().find("time 5 s") != std::string::npos; }));
  many.clear();
  CHECK(comes_true([&] { return page_at(port, "/answer.json").find("\"time\":5.0") == 1; }));
  CHECK(watch.is_running());
  watch.close_input();
  CHECK(watch.ended() == 0);
}

TEST_CASE("names with markup are text on the page, and control characters none on the terminal") {
  const Scratch scratch;
  const std::string bad = "<script>alert(1)</script>";
  write_scene(scratch, bad + "&amp;\\u001b[2J", "C<b>");
  std::ofstream(scratch.path / "<i>.csv") << "time,C<b>.start,C<b>.end\n0,0,0\n1,80000,100000\n";
  WatchedProgram watch(scratch, {"scene.json", "<i>.csv", "--http", "0"});
  const int port = watch.port();
  REQUIRE(comes_true([&] { return page_at(port, "/answer.json").find("\"time\":1.0") == 1; }));
  const std::string page = page_at(port, "/");
  CHECK(WellFormed(page)() == "");
  CHECK(page.find(bad) == std::string::npos);
  CHECK(page.find("<i>.csv") == std::string::npos);
  CHECK(page.find("&lt;i&gt;.csv") != std::string::npos);
  CHECK(page.find("C<b>") == std::string::npos);
  CHECK(page.find("C&lt;b&gt;") != std::string::npos);
  for (const char* elsewhere : {"http://", "https://", "//cdn", "@import", "url("}) {
    std::string text = page;
    const std::string svg = "http://www.w3.org/2000/svg";  // a name, not an address
    for (std::size_t at = text.find(svg); at != std::string::npos; at = text.find(svg))
      text.erase(at, svg.size());
    CHECK_MESSAGE(text.find(elsewhere) == std::string::npos, elsewhere);
  }
  CHECK(watch.out().find('\x1b') == std::string::npos);
}
