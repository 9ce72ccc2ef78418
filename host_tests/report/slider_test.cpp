// The slider of a report in headless Chromium: every chart, drawing and table goes with it.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "files/run_program.hpp"

namespace {

constexpr const char* scene = R"({ "taut": 1, "name": "band", "dimension": 2,
  "nodes": { "a": [0, 0], "b": [2, -1], "c": [4, 0] }, "supports": { "a": "xy", "b": "xy", "c": "xy" },
  "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 1.95e11, "A": 1e-3, "start": "anchored", "end": "jacked",
                "friction": { "law": "point", "mu": 0.15, "mu_sd": 0 } } ],
  "sensors": { "C.end": { "exact": true, "sd": 0.001 } } })";

// The page after the slider has been moved to this row, as the browser has it then.
std::string moved_page(const Scratch& scratch, int row) {
  std::string page = text_of(scratch.path / "page.html");
  const std::string move =
      "<script>var slider=document.querySelector('#moment');slider.value=" + std::to_string(row) +
      ";slider.dispatchEvent(new Event('input'));</script></body>";
  page.replace(page.rfind("</body>"), 7, move);
  std::ofstream(scratch.path / "moved.html") << page;
  const std::string command =
      std::string(TAUT_CHROMIUM) +
      " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir=" +
      scratch.quoted("profile") + " --dump-dom " + scratch.quoted("moved.html") + " > " +
      scratch.quoted("dom.html") + " 2> " + scratch.quoted("err");
  if (std::system(command.c_str()) != 0) return "";
  return text_of(scratch.path / "dom.html");
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("moved to a row, drawing, charts and table show the forces that estimate has there") {
  if (std::string(TAUT_CHROMIUM).find("NOTFOUND") != std::string::npos ||
      std::string(TAUT_CHROMIUM).empty()) {
    MESSAGE("there is no Chromium: not tested");
    return;
  }
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << scene;
  std::string log = "time,C.end\n";
  for (int i = 1; i <= 50; ++i)
    log += std::to_string(i) + "," + std::to_string(i <= 40 ? 1000 * i : 40000) + "\n";
  std::ofstream(scratch.path / "log.csv") << log;
  const std::string files = scratch.quoted("scene.json") + " " + scratch.quoted("log.csv");
  REQUIRE(run_taut(scratch, "report " + files + " -o " + scratch.quoted("page.html")).status == 0);
  const std::string still = text_of(scratch.path / "page.html");

  const std::string page = moved_page(scratch, 19);  // counted from 0
  REQUIRE_FALSE(page.empty());
  // At 20 s the jack has 20 kN, and the far segment exp(-mu * 2 atan(1/2)) of it, by Eq. (1) for a point
  // contact.
  const double bend = 2 * std::atan(0.5),
               far = 20 * (1 - 0.15 * std::tan(bend / 2)) / (1 + 0.15 * std::tan(bend / 2));
  CAPTURE(far);
  const auto text = [](double kN) { return std::to_string(kN).substr(0, 4); };
  CHECK(has(page, "<td class=\"number force\">20.00</td>"));
  CHECK(has(page, "<td class=\"number force\">" + text(far)));
  CHECK(count(page, "at 20 s") >= 3);  // headings
  CHECK_FALSE(has(page, "at the end of the log</span>"));
  // Cursors in force, mu, and states over time, two fifths along: (20 - 1) / (50 - 1).
  CHECK(count(page, "class=\"cursor\"") == count(still, "chart over-time"));
  CHECK(has(page, "x1=\"38.7"));
  CHECK(has(page, "<body class=\"moved\">"));
  // The states that the joint has there, in the drawing and in the table.
  CHECK(has(page, "forward</td>"));

  const std::string back = moved_page(scratch, 49);
  CHECK(has(back, "<td class=\"number force\">40.00</td>"));
  CHECK(has(back, "at the end of the log</span>"));
  CHECK_FALSE(has(back, "<body class=\"moved\">"));
}
