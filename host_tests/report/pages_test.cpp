// The stressing record on paper: printed by headless Chromium, its pages read by Poppler.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "files/run_program.hpp"
#include "lib/files/sha256.hpp"

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Cables side by side over three saddles each, pulled one after the other in equal stages to 1.9 MN and
/// locked.
struct Site {
  int cables = 1, stages = 4;
  std::string name = "T";

  std::string cable(int c) const { return name + std::to_string(c + 1); }
  std::string scene() const {
    std::string nodes, supports, list, sensors;
    for (int c = 0; c < cables; ++c) {
      const char* const between = c == 0 ? "" : ", ";
      std::string path;
      for (int k = 0; k < 5; ++k) {
        const std::string node = "\"n" + std::to_string(c + 1) + std::to_string(k) + "\"";
        const double sag[] = {0, -0.8, -1.2, -0.8, 0};
        nodes += (k == 0 ? between : ", ") + node + ": [" + std::to_string(10 * k) + ", " +
                 std::to_string(sag[k] - 3 * c) + "]";
        supports += (k == 0 ? between : ", ") + node + ": \"xy\"";
        path += (k == 0 ? "" : ", ") + node;
      }
      list += between + (R"({ "name": ")" + cable(c) + R"(", "path": [)") + path +
              R"(], "E": 1.95e11, "A": 1.4e-3, "start": "anchored", "end": "jacked", "seating": 0.005,
                 "friction": { "law": "point", "mu": 0.15, "mu_sd": 0.03 } })";
      sensors += between + ("\"" + cable(c)) + R"(.end": { "sd": 500 }, ")" + cable(c) +
                 R"(.end.stroke": { "sd": 0.0005, "zero": "free" })";
    }
    return R"({ "taut": 1, "name": "deck \"<A&B>\"", "dimension": 2, "nodes": { )" + nodes +
           R"( }, "supports": { )" + supports + R"( }, "cables": [ )" + list + R"( ], "sensors": { )" +
           sensors + " } }";
  }
  std::string log() const {
    std::string text = "time [min]";
    for (int c = 0; c < cables; ++c)
      text += "," + cable(c) + ".end [kN]," + cable(c) + ".end.stroke [mm]," + cable(c) + ".end.locked";
    text += "\n";
    std::vector<std::string> now(static_cast<std::size_t>(cables), ",0,12,0");
    int minutes = 0;
    const auto row = [&] {
      text += std::to_string(minutes += 10);
      for (const std::string& of : now) text += of;
      text += "\n";
    };
    for (int c = 0; c < cables; ++c) {
      double kN = 0, mm = 0;
      const auto put = [&](bool locked) {
        now[static_cast<std::size_t>(c)] =
            "," + std::to_string(kN) + "," + std::to_string(mm) + (locked ? ",1" : ",0");
        row();
      };
      for (int s = 1; s <= stages; ++s) {
        kN = 1900.0 * s / stages;
        mm = 12 + 1e3 * kN * 1e3 * 40.1 * 0.97 / (1.95e11 * 1.4e-3);
        put(false);
      }
      mm -= 5.5;
      put(true);
    }
    return text;
  }
  std::string goal() const {
    std::string target;
    for (int c = 0; c < cables; ++c) target += (c == 0 ? "\"" : ", \"") + cable(c) + "\": 1.85e6";
    return R"({ "taut": 1, "target": { )" + target + R"( }, "limits": { )" + target + " } }";
  }
};

/// A printed page: its text, and how much of its height above the foot has something on it.
struct Printed {
  std::string text;
  double filled = 0;
};

double filled_part(const std::string& picture) {
  std::istringstream stream(picture);
  std::string magic;
  std::size_t width = 0, height = 0, white = 0;
  stream >> magic >> width >> height >> white;
  const std::size_t begin = static_cast<std::size_t>(stream.tellg()) + 1;
  constexpr double foot = 0.945;  // where the foot of a page begins
  const auto rows = static_cast<std::size_t>(foot * static_cast<double>(height));
  for (std::size_t y = rows; y > 0; --y)
    for (std::size_t x = 0; x < width; ++x)
      if (static_cast<unsigned char>(picture[begin + (y - 1) * width + x]) < 200)
        return static_cast<double>(y) / static_cast<double>(rows);
  return 0;
}

bool is_there(const char* program) {
  return std::system(("command -v " + std::string(program) + " > /dev/null 2>&1").c_str()) == 0;
}

bool has_chinese_letters() { return std::system("fc-list :lang=zh | grep -q .") == 0; }

bool can_print() {
  const std::string chromium = TAUT_CHROMIUM;
  if (!chromium.empty() && !has(chromium, "NOTFOUND") && is_there("pdftotext") && is_there("pdftoppm"))
    return true;
  MESSAGE("there is no Chromium, or no pdftotext and pdftoppm of poppler-utils: not tested");
  return false;
}

std::vector<Printed> printed(const Scratch& scratch, const Site& site, const std::string& language) {
  std::ofstream(scratch.path / "scene.json") << site.scene();
  std::ofstream(scratch.path / "log.csv") << site.log();
  std::ofstream(scratch.path / "goal.json") << site.goal();
  std::ofstream(scratch.path / "job.json") << R"({ "taut": 1, "project": "Valley \\ bridge" })";
  const Outcome outcome = run_taut(
      scratch, "report " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv") + " --goal " +
                   scratch.quoted("goal.json") + " --job " + scratch.quoted("job.json") + " --language " +
                   language + " -o " + scratch.quoted("page.html"));
  REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
  const std::string print =
      std::string(TAUT_CHROMIUM) +
      " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir=" +
      scratch.quoted("profile") + " --no-pdf-header-footer --print-to-pdf=" + scratch.quoted("page.pdf") +
      " " + scratch.quoted("page.html") + " > " + scratch.quoted("said") + " 2>&1";
  REQUIRE(std::system(print.c_str()) == 0);
  REQUIRE(std::system(
              ("pdftotext -layout " + scratch.quoted("page.pdf") + " " + scratch.quoted("text")).c_str()) ==
          0);
  REQUIRE(std::system(
              ("pdftoppm -gray -r 30 " + scratch.quoted("page.pdf") + " " + scratch.quoted("p")).c_str()) ==
          0);
  std::vector<std::string> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path))
    if (entry.path().extension() == ".pgm") pictures.push_back(entry.path().string());
  std::sort(pictures.begin(), pictures.end());
  std::vector<Printed> pages;
  std::istringstream text(text_of(scratch.path / "text"));
  for (std::string page; std::getline(text, page, '\f');) {
    if (pages.size() == pictures.size()) break;
    pages.push_back({page, filled_part(text_of(pictures[pages.size()]))});
  }
  REQUIRE(pages.size() == pictures.size());
  return pages;
}

// The only page that has this text.
std::size_t page_of(const std::vector<Printed>& pages, const std::string& text) {
  std::size_t found = pages.size();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    if (!has(pages[i].text, text)) continue;
    CHECK(found == pages.size());
    found = i;
  }
  REQUIRE(found < pages.size());
  return found;
}

void check_pages(const std::vector<Printed>& pages, const std::string& hash) {
  for (std::size_t i = 0; i < pages.size(); ++i) {
    CAPTURE(i);
    std::string packed;
    for (const char c : pages[i].text)
      if (std::isspace(static_cast<unsigned char>(c)) == 0) packed += c;
    const std::string number = std::to_string(i + 1) + "/" + std::to_string(pages.size());
    CHECK(packed.substr(packed.size() - std::min(packed.size(), number.size())) == number);
    CHECK(has(pages[i].text, "Valley \\ bridge \u00b7 deck \"<A&B>\""));
    CHECK(has(pages[i].text, hash.substr(0, 12)));
    if (i + 1 < pages.size()) CHECK(pages[i].filled > 0.5);
  }
}

}  // namespace

TEST_CASE("the record of one cable is one page, with its result and room for signatures") {
  if (!can_print()) return;
  const Scratch scratch;
  const Site site;
  const auto pages = printed(scratch, site, "en");
  check_pages(pages, taut::host::sha256(site.log()));
  for (const char* part : {"Stressing record", "Instruments", "Jack T1.end", "Losses",
                           "Forces after lock-off", "Passes", "name, signature, date"}) {
    CAPTURE(std::string(part));
    CHECK(page_of(pages, part) == 0);
  }
  CHECK(count(pages[0].text, "name, signature, date") == 3);
  CHECK(page_of(pages, "Cable forces: deck") == 1);
}

TEST_CASE(
    "the record of many cables goes on page after page: numbered, no row cut, and signed where it ends") {
  if (!can_print()) return;
  struct Case {
    Site site;
    const char *language, *signature, *jack, *result, *force_head, *next;
    std::size_t most_pages;  // of the record
  };
  for (const Case& each :
       {Case{{4, 4, "T"},
             "en",
             "name, signature, date",
             "Jack T4.end",
             "Passes",
             "Segment or strut",
             "Cable forces:",
             2},
        Case{{12, 4, "T"},
             "de",
             "Name, Unterschrift, Datum",
             "Presse T12.end",
             "Bestanden",
             "Abschnitt oder Stab",
             "Seilkr\u00e4fte:",
             5},
        Case{{4, 4, "Transverse tendon at the northern abutment "},
             "de",
             "Name, Unterschrift, Datum",
             "Presse Transverse tendon at the northern abutment 4.end",
             "Bestanden",
             "Abschnitt oder Stab",
             "Seilkr\u00e4fte:",
             3},
        Case{{1, 36, "T"}, "zh", "\u59d3\u540d", "T1.end", "\u5408\u683c", "", "deck \"<A&B>\"", 2}}) {
    if (each.language == std::string("zh") && !has_chinese_letters()) {
      MESSAGE("there are no Chinese letters: not printed in Chinese");
      continue;
    }
    CAPTURE(each.site.cables);
    CAPTURE(each.site.stages);
    const Scratch scratch;
    const auto pages = printed(scratch, each.site, each.language);
    check_pages(pages, taut::host::sha256(each.site.log()));
    const std::size_t end = page_of(pages, each.signature);
    CHECK(end < each.most_pages);
    CHECK(count(pages[end].text, each.signature) == 3);
    CHECK(has(pages[end].text, each.result));
    std::string record;
    for (std::size_t i = 0; i <= end; ++i) record += pages[i].text;
    CHECK(has(record, each.jack));
    // Every stage of every jack, once; kN and a decimal.
    for (int s = 1; s < each.site.stages; ++s) {
      std::ostringstream force;
      force.precision(1);
      force << std::fixed << 1900.0 * s / each.site.stages;
      CAPTURE(force.str());
      if (1900.0 * s / each.site.stages >= 1900.0 / 30)
        CHECK(count(record, " " + force.str() + " ") >= static_cast<std::size_t>(each.site.cables));
    }
    // Where the table of forces goes on it has its head.
    if (std::string(each.force_head).empty()) continue;
    std::size_t rows = 0;
    for (std::size_t i = 0; i <= end; ++i) {
      const std::size_t here =
          count(pages[i].text, std::string(each.language) == "en" ? "segment " : "Abschnitt ");
      if (here == 0) continue;
      rows += here;
      CHECK(has(pages[i].text, std::string(each.force_head).substr(0, 7)));
    }
    CHECK(rows >= static_cast<std::size_t>(4 * each.site.cables));
  }
}
