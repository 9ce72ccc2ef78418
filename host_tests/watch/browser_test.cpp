// The page in headless Chromium, which is steered through pipes: what it shows is what `taut estimate` finds.
#include <doctest/doctest.h>
#include <sys/prctl.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/result_table.hpp"
#include "watch/watched_program.hpp"
#include "watch/watched_scene.hpp"

namespace {

using Json = nlohmann::json;

/// A browser with one page, as wide as a phone.
class Browser {
 public:
  Browser() {
    std::array<int, 2> to{}, from{};
    REQUIRE(pipe(to.data()) == 0);
    REQUIRE(pipe(from.data()) == 0);
    const std::string profile = "--user-data-dir=" + (scratch_.path / "profile").string();
    // What Chromium starts becomes a child of this process when Chromium is gone, and can be waited for.
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    process_ = fork();
    if (process_ == 0) {
      setsid();
      // Chromium reads commands from 3 and writes answers to 4.
      const int in = fcntl(to[0], F_DUPFD, 20), out = fcntl(from[1], F_DUPFD, 20);
      dup2(in, 3);
      dup2(out, 4);
      const int nothing = open("/dev/null", O_RDWR);
      for (const int standard : {0, 1, 2}) dup2(nothing, standard);
      execl(TAUT_CHROMIUM, "chromium", "--headless", "--no-sandbox", "--disable-gpu",
            "--disable-dev-shm-usage", "--window-size=390,844", profile.c_str(), "--remote-debugging-pipe",
            "about:blank", static_cast<char*>(nullptr));
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    to_ = to[1];
    from_ = from[0];
    const Json target = call("Target.createTarget", {{"url", "about:blank"}});
    if (target.is_object())
      session_ = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
                     .at("sessionId");
  }
  ~Browser() {
    close(to_);
    close(from_);
    kill(-process_, SIGKILL);
    while (waitpid(-process_, nullptr, 0) > 0) {
    }
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  bool is_there() const { return !session_.empty(); }
  /// Ends when the page is there as a whole: one that is still coming in shows its time before its tables.
  void visit(const std::string& url) {
    call("Emulation.setDeviceMetricsOverride",
         {{"width", 390}, {"height", 844}, {"deviceScaleFactor", 1}, {"mobile", true}});
    call("Page.navigate", {{"url", url}});
    REQUIRE(
        comes_true([&] { return value("document.readyState === 'complete' ? location.href : ''") == url; }));
  }
  void use_dark(bool is_dark) {
    call("Emulation.setEmulatedMedia",
         {{"features", {{{"name", "prefers-color-scheme"}, {"value", is_dark ? "dark" : "light"}}}}});
  }
  /// The value of an expression on the page.
  Json value(const std::string& expression) {
    const Json found = call("Runtime.evaluate", {{"expression", expression}});
    return found.is_object() && found.at("result").contains("value") ? found.at("result").at("value")
                                                                     : Json();
  }

 private:
  // The result of a command; null if the browser says nothing for long.
  Json call(const std::string& method, const Json& parameters) {
    Json command = {{"id", ++last_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) command["sessionId"] = session_;
    const std::string text = command.dump() + '\0';
    if (::write(to_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) return nullptr;
    std::string answer;
    pollfd waiting{from_, POLLIN, 0};
    while (poll(&waiting, 1, 20000) > 0) {
      char byte = 0;
      if (read(from_, &byte, 1) != 1) return nullptr;
      if (byte != '\0') {
        answer += byte;
        continue;
      }
      const Json found = Json::parse(answer);
      answer.clear();
      if (found.value("id", 0) == last_) return found.value("result", Json());
    }
    return nullptr;
  }

  Scratch scratch_;
  pid_t process_ = 0;
  int to_ = -1, from_ = -1, last_ = 0;
  std::string session_;
};

/// The forces of all segments [kN] off the page.
std::vector<double> forces_on(Browser& browser) {
  std::vector<double> forces;
  const Json text = browser.value(
      "Array.from(document.querySelectorAll('[data-segment]')).map(function (r) { return "
      "r.cells[1].textContent; }).join(';')");
  std::istringstream stream(text.is_string() ? text.get<std::string>() : "");
  for (std::string force; std::getline(stream, force, ';');) {
    CHECK(force.find(" kN") != std::string::npos);
    forces.push_back(std::atof(force.c_str()));
  }
  return forces;
}

}  // namespace

TEST_CASE("the page in a browser has the forces of estimate, and goes on with every row") {
  if (std::string(TAUT_CHROMIUM).find("NOTFOUND") != std::string::npos) {
    MESSAGE("skipped: no Chromium is installed");
    return;
  }
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(60);
  const Table table(estimated(scratch, log_header + joined(rows)).out);
  WatchedProgram watch(scratch, {"scene.json", "-", "--http", "0"});
  const std::string url = "http://127.0.0.1:" + std::to_string(watch.port()) + "/";
  watch.write(log_header + joined(rows, 0, 20));
  REQUIRE(comes_true([&] { return watch.out().find("time 19 s") != std::string::npos; }));
  Browser browser;
  REQUIRE(browser.is_there());
  browser.visit(url);
  const auto shows = [&](std::size_t row) {
    const std::string time = table.at(row, "time") + " s";
    CHECK(comes_true([&] { return browser.value("document.getElementById('time').textContent") == time; }));
    const std::vector<double> forces = forces_on(browser);
    REQUIRE(forces.size() == 4);
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(std::fabs(forces[i] - table.number(row, "C.T" + std::to_string(i + 1)) / 1000) <= 0.0501);
    CHECK(browser.value("document.querySelector('[data-joint]').cells[1].textContent") ==
          table.at(row, "C.state1"));
    const Json digits = browser.value("document.querySelector('[data-jack] strong').textContent");
    CHECK(std::fabs(std::atof(digits.get<std::string>().c_str()) - table.number(row, "C.T4") / 1000) <=
          0.0501);
  };
  shows(19);
  CHECK(comes_true([&] { return browser.value("document.getElementById('link').textContent") == "live"; }));
  watch.write(joined(rows, 20, 40));
  shows(39);
  watch.write(joined(rows, 40));
  shows(59);
  // Three curves with points: along the cable, load, stroke.
  CHECK(comes_true(
      [&] { return browser.value("document.querySelectorAll('.live-chart polyline').length") == 3; }));
  // On a phone nothing is wider than the page, and digits are high.
  CHECK(browser.value("document.documentElement.scrollWidth - document.documentElement.clientWidth") == 0);
  CHECK(browser.value("parseFloat(getComputedStyle(document.querySelector('.big strong')).fontSize) > 60") ==
        true);
  CHECK(browser.value("document.querySelectorAll('.segment .cable[class*=\" c\"]').length") == 4);
  browser.use_dark(false);
  const Json light = browser.value("getComputedStyle(document.body).backgroundColor");
  browser.use_dark(true);
  const Json dark = browser.value("getComputedStyle(document.body).backgroundColor");
  CHECK(light != dark);
  // Whatever it loads comes from there.
  CHECK(browser.value("performance.getEntriesByType('resource').every(function (e) { return "
                      "e.name.indexOf(location.origin) "
                      ">= 0; })") == true);
  watch.close_input();
  CHECK(watch.ended() == 0);
  CHECK(comes_true([&] {
    return browser.value("document.getElementById('link').textContent") == "no connection to taut";
  }));
}

TEST_CASE(
    "the page shows what the jack is to do, the stages, and the stage's force in the chart of its load") {
  if (std::string(TAUT_CHROMIUM).find("NOTFOUND") != std::string::npos) {
    MESSAGE("skipped: no Chromium is installed");
    return;
  }
  const Scratch scratch;
  write_scene(scratch);
  std::ofstream(scratch.path / "goal.json") << R"({ "taut": 1, "target": { "C": 2e5 }, "stages": 2,
    "limits": { "C.end": 2.3e5 } })";
  WatchedProgram watch(scratch, {"scene.json", "-", "--http", "0", "--goal", "goal.json"});
  const std::string url = "http://127.0.0.1:" + std::to_string(watch.port()) + "/";
  // The jack alone: nothing is learned of mu, and the plan stays.
  watch.write("time,C.end\n0,0\n1,2000\n");
  REQUIRE(comes_true([&] { return watch.out().find("time 1 s") != std::string::npos; }));
  Browser browser;
  REQUIRE(browser.is_there());
  browser.visit(url);
  const auto text = [&](const std::string& id) {
    const Json found = browser.value("document.getElementById('" + id + "').textContent");
    return found.is_string() ? found.get<std::string>() : "";
  };
  const std::string order = "document.getElementById('order').dataset.order";
  CHECK(comes_true([&] { return text("order").find("pull C.end to 210.2 kN") == 0; }));
  CHECK(browser.value(order) == "pull");
  CHECK(browser.value("document.querySelectorAll('#stages tr').length") == 2);
  CHECK(browser.value("document.querySelector('#stages tr').className") == "present");
  CHECK(text("plan-error").find("off target, expected ") != std::string::npos);
  // The line of the stage goes from side to side, at one height.
  CHECK(comes_true([&] { return browser.value("document.querySelectorAll('#load0 .stage').length") == 1; }));
  CHECK(browser.value("(function () { var p = document.querySelector('#load0 .stage').getAttribute('points')"
                      ".split(' ').map(function (q) { return q.split(','); }); return p.length === 2 "
                      "? p[0][1] === p[1][1] : false; })()") == true);
  // Every segment has its target in the chart of the forces along the cable, and its force on the drawing.
  CHECK(
      comes_true([&] { return browser.value("document.querySelectorAll('#along0 .target').length") == 4; }));
  CHECK(browser.value("document.querySelectorAll('#along0 .limit').length") == 0);
  CHECK(browser.value("Array.prototype.filter.call(document.querySelectorAll('.structure text.force'), "
                      "function (label) { return label.textContent !== ''; }).length > 0") == true);
  const Json calm = browser.value("getComputedStyle(document.getElementById('order')).backgroundColor");
  int row = 2;
  for (double force = 4000; force <= 210000; force += 2000, ++row)
    watch.write(std::to_string(row) + "," + std::to_string(force) + "\n");
  CHECK(comes_true([&] { return browser.value(order) == "stop"; }));
  CHECK(text("order").find("STOP C.end: 210.2 kN is reached") == 0);
  CHECK(browser.value("getComputedStyle(document.getElementById('order')).backgroundColor") != calm);
  for (int i = 0; i < 5; ++i, ++row) watch.write(std::to_string(row) + ",210000\n");
  CHECK(comes_true([&] { return browser.value(order) == "let out"; }));
  CHECK(browser.value("document.querySelector('#stages tr').cells[1].textContent") == "passed");
  for (double force = 212000; force <= 236000; force += 2000, ++row)
    watch.write(std::to_string(row) + "," + std::to_string(force) + "\n");
  for (int i = 0; i < 5; ++i, ++row) watch.write(std::to_string(row) + ",236000\n");
  CHECK(comes_true([&] { return text("alarms").find("plan-limit:C.end") != std::string::npos; }));
  CHECK(text("alarms").find("limit of the goal") != std::string::npos);
  CHECK(browser.value("document.documentElement.scrollWidth - document.documentElement.clientWidth") == 0);
  watch.close_input();
  CHECK(watch.ended() == 0);
}

TEST_CASE("a browser that prints the page as soon as nothing is loading any more comes to an end") {
  if (std::string(TAUT_CHROMIUM).find("NOTFOUND") != std::string::npos) {
    MESSAGE("skipped: no Chromium is installed");
    return;
  }
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(20);
  WatchedProgram watch(scratch, {"scene.json", "-", "--http", "0"});
  const std::string url = "http://127.0.0.1:" + std::to_string(watch.port()) + "/";
  watch.write(log_header + joined(rows));
  REQUIRE(comes_true([&] { return watch.out().find("time 19 s") != std::string::npos; }));
  const std::string command = "timeout 30 '" TAUT_CHROMIUM
                              "' --headless --no-sandbox --disable-gpu --disable-dev-shm-usage "
                              "--user-data-dir=" +
                              scratch.quoted("profile") + " --dump-dom --virtual-time-budget=3000 " + url +
                              " > " + scratch.quoted("dom") + " 2> /dev/null";
  CHECK(std::system(command.c_str()) == 0);
  const Table table(estimated(scratch, log_header + joined(rows)).out);
  const std::string dom = text_of(scratch.path / "dom"), row = "data-segment=\"0\"",
                    cell = "<td class=\"number\">";
  const std::size_t at = dom.find(cell, dom.find(row));
  REQUIRE(at != std::string::npos);
  CHECK(std::fabs(std::atof(dom.c_str() + at + cell.size()) - table.number(19, "C.T1") / 1000) <= 0.0501);
}
