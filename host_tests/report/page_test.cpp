// The page that `taut report` writes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "files/run_program.hpp"
#include "report/well_formed.hpp"

namespace fs = std::filesystem;

namespace {

const std::string chain = R"({ "taut": 1, "name": "chain <b>&\"", "dimension": 2,
  "nodes": { "a": [0, 0], "b<i>": [2, 0.4], "c": [4, 0.4], "d": [6, 0] },
  "supports": { "a": "xy", "b<i>": "xy", "c": "xy", "d": "xy" },
  "cables": [ { "name": "C<&>", "path": ["a", "b<i>", "c", "d"], "E": 1.95e11, "A": 8e-4, "start": "anchored",
                "end": "jacked", "friction": { "law": "point", "mu": 0.2, "mu_sd": 0.1, "shared": true } } ],
  "sensors": { "C<&>.start": { "sd": 500, "gain_sd": 0, "zero_sd": 0 }, "C<&>.end": { "sd": 500, "gain_sd": 0, "zero_sd": 0 } } })";

const std::string two_jacks = R"({ "taut": 1, "name": "", "dimension": 3,
  "nodes": { "a": [0, 0, 0], "b": [1, 1, 1], "c": [2, 0, 0] },
  "supports": { "a": "xyz", "b": "xyz", "c": "xyz" },
  "cables": [ { "name": "D", "path": ["a", "b", "c"], "E": 1.95e11, "A": 8e-4, "start": "jacked", "end": "jacked",
                "friction": { "law": "point", "mu": 0.1, "mu_sd": 0.02 } } ],
  "sensors": { "D.start": { "sd": 100, "gain_sd": 0, "zero_sd": 0 }, "D.end": { "sd": 100, "gain_sd": 0, "zero_sd": 0 } } })";

std::string chain_log(int rows) {
  std::ostringstream log;
  log << "time,C<&>.start,C<&>.end\n";
  for (int i = 1; i <= rows; ++i)
    log << i << ',' << 800 * i + i * 37 % 100 << ',' << 1000 * i + i * 53 % 100 << '\n';
  return log.str();
}

std::string two_jacks_log(double start_of_row_30) {
  std::ostringstream log;
  log << "time,D.start,D.end\n";
  for (int i = 1; i <= 60; ++i)
    log << i << ',' << (i == 30 ? start_of_row_30 : 500 * i) << ',' << 500 * i << '\n';
  return log.str();
}

// Runs `taut report` on these texts; the page is page.html in the folder.
Outcome report(const Scratch& scratch, const std::string& scene, const std::string& log,
               const std::string& options = "") {
  std::ofstream(scratch.path / "scene.json") << scene;
  std::ofstream(scratch.path / "log.csv") << log;
  return run_taut(scratch, "report " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv") +
                               " -o " + scratch.quoted("page.html") + options);
}

std::string page_of(const Scratch& scratch) { return text_of(scratch.path / "page.html"); }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The values of all attributes with this name.
std::vector<std::string> attributes(const std::string& page, const std::string& name) {
  const std::string begin = " " + name + "=\"";
  std::vector<std::string> found;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    found.push_back(page.substr(from, page.find('"', from) - from));
  }
  return found;
}

}  // namespace

TEST_CASE("a report is one well-formed page that needs nothing else") {
  const Scratch scratch;
  const Outcome outcome = report(scratch, chain, chain_log(100));
  CHECK(outcome.status == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.empty());
  const std::string page = page_of(scratch);
  CHECK(WellFormed(page)() == "");
  for (const char* outside : {"http:", "https:", "//", " src=", "url(", "@import", "<link", " href="}) {
    CAPTURE(outside);
    CHECK_FALSE(has(page, outside));
  }
  for (const char* part :
       {"<html lang=\"en\">", "name=\"viewport\"", "prefers-color-scheme:dark", "@media print",
        "role=\"img\"", "aria-label=", "<strong>100 rows</strong>", "95 % band"}) {
    CAPTURE(part);
    CHECK(has(page, part));
  }
}

TEST_CASE("names of a scene are text, whatever they hold") {
  const Scratch scratch;
  REQUIRE(report(scratch, chain, chain_log(20)).status == 0);
  const std::string page = page_of(scratch);
  CHECK(has(page, "chain &lt;b&gt;&amp;&quot;"));
  CHECK(has(page, "C&lt;&amp;&gt;"));
  CHECK(has(page, "b&lt;i&gt;"));
  CHECK_FALSE(has(page, "<b>"));
  CHECK_FALSE(has(page, "<i>"));
}

TEST_CASE("beams are drawn member by member with their hinges, and what supports hold of them is said") {
  const Scratch scratch;
  const std::string girder = R"({ "taut": 1, "name": "girder", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [3, 0], "c<d>": [6, 0], "e": [3, -1] },
    "supports": { "a": "xyr", "c<d>": "y", "e": "x" },
    "struts": [ { "nodes": ["b", "e"], "E": 2e11, "A": 1e-3 } ],
    "beams": [ { "nodes": ["a", "b", "c<d>"], "E": 2e11, "A": 0.02, "I": 4e-4, "hinges": ["c<d>"] } ],
    "cables": [ { "name": "C", "path": ["a", "e", "c<d>"], "E": 1.95e11, "A": 8e-4, "start": "anchored", "end": "jacked",
                  "friction": { "law": "point", "mu": 0.1 } } ] })";
  REQUIRE(report(scratch, girder, "time,C.end\n1,1000\n2,2000\n").status == 0);
  const std::string page = page_of(scratch);
  CHECK(WellFormed(page)() == "");
  const auto looks = attributes(page, "class");
  // Two members and one hinge, and one of each in the legend.
  CHECK(std::count(looks.begin(), looks.end(), "beam") == 3);
  CHECK(std::count(looks.begin(), looks.end(), "hinge") == 2);
  CHECK(has(page, "<title>beam 1 (a\u2013b)</title>"));
  CHECK(has(page, "<title>beam 1 (b\u2013c&lt;d&gt;)</title>"));
  CHECK(has(page, "<title>hinge of beam 1 at node c&lt;d&gt;</title>"));
  CHECK(has(page, "<title>support a: held in x, y, rotation</title>"));
  // No beams, no entry of the legend.
  REQUIRE(report(scratch, chain, chain_log(3)).status == 0);
  CHECK_FALSE(has(page_of(scratch), "class=\"beam\""));
}

TEST_CASE("in second-order theory every strut shows how much friction its lean uses") {
  const Scratch scratch;
  const std::string mast = R"({ "taut": 1, "name": "mast", "dimension": 2,
    "nodes": { "l": [-10, 0.5], "p": [0, 0], "r": [10, 0.5], "t": [0, 2] },
    "supports": { "l": "xy", "r": "xy", "t": "xy" },
    "struts": [ { "nodes": ["p", "t"], "E": 2.0e11, "A": 2.0e-3 } ],
    "cables": [ { "name": "C", "path": ["l", "p", "r"], "E": 2.0e11, "A": 4.0e-3, "start": "anchored", "end": "jacked",
                  "friction": { "law": "point", "mu": 0.1 } } ],
    "second_order": { "target": { "loads": {}, "forces": { "C.end": 2.0e6 } } } })";
  REQUIRE(report(scratch, mast, "time,C.end\n1,797508\n2,1991880\n").status == 0);
  const std::string page = page_of(scratch);
  // It leans by 0.0125, all but a hundredth of that from the bisector of its cable: 12 % of mu.
  CHECK(has(page, "leans: 12 % of friction used"));
  CHECK(has(page, "Friction used"));
  CHECK(has(page, "per cent at a joint"));
  REQUIRE(report(scratch, chain, chain_log(20)).status == 0);
  CHECK_FALSE(has(page_of(scratch), "per cent at a joint"));
}

TEST_CASE("all points lie within their charts, and long logs have no more of them") {
  const Scratch scratch;
  // A strain of 13 % in the end.
  std::string meant = chain;
  meant.insert(meant.find("\"name\""), "\"plausible\": false, ");
  REQUIRE(report(scratch, meant, chain_log(20000)).status == 0);
  const std::string page = page_of(scratch);
  CHECK(page.size() < 600000);
  const auto curves = attributes(page, "points");
  CHECK(curves.size() >= 8);
  for (const std::string& curve : curves) {
    std::istringstream points(curve);
    double x = 0, y = 0;
    char comma = 0;
    std::size_t count = 0;
    bool inside = true;
    while (points >> x >> comma >> y) {
      ++count;
      inside = inside && x >= 0 && x <= 1000 && y >= 0 && y <= 220;
    }
    CHECK(points.eof());
    CHECK(inside);
    CHECK(count >= 2);
    CHECK(count <= 2000);  // a band has two sides
  }
}

TEST_CASE("a force that hovers at its limit is one alarm, with the largest force and its time") {
  // The jack's cell is exact, and so is the force of the segment beside it, until it leaves by 1 %.
  std::string exact = chain;
  const std::string sensors = R"("sensors": {)";
  exact.replace(exact.find(sensors), std::string::npos, sensors + R"( "C<&>.end": { "exact": true } } })");
  const std::string log =
      "time,C<&>.end\n1,3000\n2,6000\n10,90000\n20,100100\n30,99900\n40,101230\n50,99100\n60,98900\n70,"
      "99900\n";
  const Scratch scratch;
  REQUIRE(report(scratch, exact, log, " --most-force 100000").status == 0);
  const std::string page = page_of(scratch);
  CHECK(has(page, "<strong>1 alarm</strong>"));
  CHECK(has(page, ">4\u20137<"));
  CHECK(has(page, " Peak 101.2 kN in segment 3 at 40 s."));
}

namespace {

// A jack, a cell at the far end, or not, and a stroke, or not, of a ramp with this mu; every column is read
// once a row.
std::string measured_ramp(double mu, bool has_cell, bool has_stroke) {
  const double side = std::hypot(2, 0.4), turn = std::atan2(0.4, 2);
  std::ostringstream log;
  log << "time,C<&>.end" << (has_cell ? ",C<&>.start" : "") << (has_stroke ? ",C<&>.end.stroke" : "") << '\n';
  for (int i = 1; i <= 300; ++i) {
    const double c = mu * std::tan(turn / 2), held = (1 - c) / (1 + c), force = 1000.0 * i,
                 stroke = force * (side + 2 * held + side * held * held) / (1.95e11 * 8e-4);
    log << i << ',' << force + (i % 2 == 0 ? 300 : -300);
    if (has_cell) log << ',' << force * held * held + (i % 4 < 2 ? 300 : -300);
    if (has_stroke) log << ',' << stroke + (i % 8 < 4 ? 5e-5 : -5e-5);
    log << '\n';
  }
  return log.str();
}
// E A is known, and the stroke is read from its start.
std::string with_stroke() {
  std::string scene = chain;
  scene.replace(scene.find("\"A\": 8e-4"), 9, "\"A\": 8e-4, \"E_sd\": 0");
  const std::string sensors = "\"sensors\": {";
  scene.replace(scene.find(sensors), sensors.size(),
                sensors + R"( "C<&>.end.stroke": { "sd": 0.0001, "zero": "start" },)");
  return scene;
}
// The sentence about mu, without the marks that names need.
std::string mu_sentence(const std::string& page) {
  const std::string begin = "mu of C&lt;&amp;&gt;: ";
  const std::size_t from = page.find(begin);
  if (from == std::string::npos) return "";
  return page.substr(from + begin.size(), page.find("</p>", from) - from - begin.size());
}
// What is before this text in a sentence, as a number.
double number_before(const std::string& sentence, const std::string& text) {
  const std::size_t end = sentence.find(text);
  if (end == std::string::npos) return -1;
  return std::stod(sentence.substr(sentence.rfind(' ', end - 1)));
}

}  // namespace

TEST_CASE("a report says which columns taught it mu, and how much of it") {
  const Scratch scratch;
  const std::string cell = " from C&lt;&amp;&gt;.start (", stroke = " from C&lt;&amp;&gt;.end.stroke (";
  const auto sentence = [&](bool has_cell, bool has_stroke) {
    REQUIRE(report(scratch, with_stroke(), measured_ramp(0.3, has_cell, has_stroke)).status == 0);
    const std::string page = page_of(scratch);
    CHECK(WellFormed(page)() == "");
    CHECK(has(page, "What friction was learned from"));
    return mu_sentence(page);
  };
  const std::string both = sentence(true, true);
  CHECK(both.rfind("0.200 \u00b1 0.100 beforehand, 0.", 0) == 0);
  CHECK(has(both, cell));
  CHECK(has(both, stroke));
  // Percentages without decimals.
  const double first = number_before(both, " % of that"),
               second = number_before(both.substr(both.find(", 0.") + 1), " % from");
  CAPTURE(both);
  CHECK(first >= second);
  CHECK(std::fabs(first + second - 100) < 1.5);
  CHECK(has(sentence(false, true), "; 100 % of that" + stroke));
  CHECK(has(sentence(true, false), "; 100 % of that" + cell));
  CHECK(sentence(false, false) == "0.200 \u00b1 0.100, as the scene has it: nothing in the log measured it.");
}

TEST_CASE("a report of a mu that is known says nothing of how it was learned") {
  const Scratch scratch;
  std::string scene = with_stroke();
  scene.replace(scene.find("\"mu_sd\": 0.1"), 12, "\"mu_sd\": 0");
  REQUIRE(report(scratch, scene, measured_ramp(0.2, true, true)).status == 0);
  CHECK_FALSE(has(page_of(scratch), "What friction was learned from"));
}

TEST_CASE("the same input gives the same page") {
  const Scratch scratch;
  REQUIRE(report(scratch, chain, chain_log(300)).status == 0);
  const std::string first = page_of(scratch);
  REQUIRE(report(scratch, chain, chain_log(300)).status == 0);
  CHECK(page_of(scratch) == first);
}

TEST_CASE("a row without an answer gives status 1 and a page of the rows before it") {
  const Scratch scratch;
  const Outcome outcome = report(
      scratch, two_jacks, "time,D.start,D.end\n1,20000,20000\n2,20000,20000\n3,20000,90000\n4,20000,90000\n");
  CHECK(outcome.status == 1);
  CHECK(has(outcome.err, "(row 3, time 3 s)"));
  CHECK(has(outcome.err, "; the report ends before it\n"));
  const std::string page = page_of(scratch);
  CHECK(WellFormed(page)() == "");
  CHECK(has(page, "<strong>2 rows</strong>"));
  CHECK(has(page, "The answer ends before the log does."));
  CHECK(has(page, "(row 3, time 3 s)"));
}

TEST_CASE("without any answer the page shows the structure and says why") {
  const Scratch scratch;
  const Outcome outcome = report(scratch, two_jacks, "time,D.start,D.end\n1,20000,90000\n");
  CHECK(outcome.status == 1);
  const std::string page = page_of(scratch);
  CHECK(WellFormed(page)() == "");
  CHECK(has(page, "No row has an answer."));
  CHECK(has(page, "class=\"structure\""));
}

TEST_CASE("so it does of a scene of which a support was forgotten") {
  const Scratch scratch;
  const std::string scene = R"({ "taut": 1, "name": "x", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [10, 2], "c": [20, 0] }, "supports": { "a": "xy", "b": "xy" },
    "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 1.95e11, "A": 1.4e-3, "start": "anchored",
                  "end": "jacked", "friction": { "law": "capstan", "mu": 0.2, "mu_sd": 0.06 } } ] })";
  const Outcome outcome = report(scratch, scene, "time,C.end\n0,0\n1,100000\n2,200000\n");
  CHECK(outcome.status == 1);
  CHECK(has(outcome.err, "before the first row: node \"c\": mechanism"));
  const std::string page = page_of(scratch);
  CHECK(WellFormed(page)() == "");
  CHECK(has(page, "No row has an answer."));
}

TEST_CASE("a prediction without an answer is left out, and the page says so") {
  const Scratch scratch;
  REQUIRE(report(scratch, two_jacks, two_jacks_log(15000)).status == 0);
  CHECK(has(page_of(scratch), "predicted with the friction of the scene"));
  const Outcome outcome = report(scratch, two_jacks, two_jacks_log(60000));
  CHECK(outcome.status == 0);
  const std::string page = page_of(scratch);
  CHECK(WellFormed(page)() == "");
  CHECK(has(page, "is left out: it has no answer in row 30: "));
  CHECK(has(page, "A reading of the load cell at this jack does not belong to the others."));
}

TEST_CASE("the verdict of the last row stands at the top, with the time since when it has held") {
  const Scratch scratch;
  REQUIRE(report(scratch, chain, chain_log(50)).status == 0);
  const std::string good = page_of(scratch);
  const std::string trusted =
      "</h1><p class=\"summary\">Verdict at the end of the log: <strong>trust</strong>, since 1 s</p>";
  CHECK(has(good, trusted));
  // After row 10 the stroke grows by 100 mm at once, and is read in rows 11 to 13.
  const auto log = [](int rows) {
    std::string text = "time,C<&>.end,C<&>.end.stroke\n";
    for (int i = 1; i <= rows; ++i)
      text += std::to_string(i) + ',' + std::to_string(10000 * i) +
              (i == 10             ? ",0\n"
               : i > 10 && i <= 13 ? ",0.1\n"
                                   : ",\n");
    return text;
  };
  REQUIRE(report(scratch, chain, log(20)).status == 0);
  const std::string doubtful = page_of(scratch);
  CHECK(WellFormed(doubtful)() == "");
  CHECK(has(doubtful,
            "</h1><p class=\"warning\">Verdict at the end of the log: <strong>do not trust: the stroke at "
            "C&lt;&amp;&gt;.end contradicts the model</strong> (in doubt since 13 s)</p>"));
  // The first of the three leaves the last thirty rows with row 41.
  REQUIRE(report(scratch, chain, log(45)).status == 0);
  CHECK(has(page_of(scratch), "<strong>trust</strong>, since 41 s</p>"));
}

TEST_CASE(
    "a page that ends before the log says to which row its verdict belongs, and one without rows none") {
  const Scratch scratch;
  REQUIRE(report(scratch, two_jacks, "time,D.start,D.end\n1,20000,20000\n2,20000,20000\n3,20000,90000\n")
              .status == 1);
  CHECK(has(page_of(scratch), "Verdict after row 2: "));
  REQUIRE(report(scratch, two_jacks, "time,D.start,D.end\n1,20000,90000\n").status == 1);
  CHECK_FALSE(has(page_of(scratch), "Verdict"));
}

TEST_CASE("notices are listed apart from alarms, and are not there if there is none") {
  const Scratch scratch;
  REQUIRE(report(scratch, chain, chain_log(50)).status == 0);
  const std::string without = page_of(scratch);
  CHECK_FALSE(has(without, "<h2>Notices</h2>"));
  CHECK_FALSE(has(without, "no-information"));
  // Up, and a little back: joints stick.
  std::ostringstream log;
  log << "time,C<&>.start,C<&>.end\n";
  for (int i = 1; i <= 80; ++i) {
    const int noise = i % 2 == 0 ? 300 : -300;
    log << i << ',' << (i <= 50 ? 1840 * i : 92000) + noise << ','
        << (i <= 50 ? 2000 * i : 100000 - 200 * (i - 50)) - noise << '\n';
  }
  REQUIRE(report(scratch, chain, log.str()).status == 0);
  const std::string page = page_of(scratch);
  CHECK(WellFormed(page)() == "");
  const std::size_t alarms = page.find("<h2>Alarms</h2>"), notices = page.find("<h2>Notices</h2>"),
                    word = page.find("no-information");
  REQUIRE(alarms != std::string::npos);
  REQUIRE(notices != std::string::npos);
  CHECK(alarms < notices);
  CHECK(notices < word);
  CHECK(has(page, "<strong>no alarm</strong>"));
  CHECK(has(page, "There is none."));
  // To do: nothing.
  CHECK_FALSE(has(page, "What to do"));
}

TEST_CASE("unusable input gives status 2 and no page") {
  const Scratch scratch;
  CHECK(report(scratch, chain, "time,X\n1,2\n").status == 2);
  CHECK_FALSE(fs::exists(scratch.path / "page.html"));
  CHECK(report(scratch, "{}", chain_log(3)).status == 2);
  CHECK_FALSE(fs::exists(scratch.path / "page.html"));
}

TEST_CASE("a report needs a file to go to, and does not overwrite its input") {
  const Scratch scratch;
  REQUIRE(report(scratch, chain, chain_log(3)).status == 0);
  const std::string inputs = "report " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv");
  CHECK(run_taut(scratch, inputs).status == 2);
  CHECK(run_taut(scratch, inputs + " -o " + scratch.quoted("log.csv")).status == 2);
  CHECK(text_of(scratch.path / "log.csv") == chain_log(3));
}

TEST_CASE("a log of one row is a report too") {
  const Scratch scratch;
  CHECK(report(scratch, chain, chain_log(1)).status == 0);
  CHECK(WellFormed(page_of(scratch))() == "");
}
