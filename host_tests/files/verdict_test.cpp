// Verdicts: which alarms make numbers doubtful, for how long, and what is said then.
#include "lib/files/verdict.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "lib/files/alarm_words.hpp"
#include "lib/files/scene_file.hpp"

using namespace taut;
using namespace taut::host;

namespace {

struct Doubtful {
  std::string word;
  int least;  // of so many of the last rows
  std::string reason;
};
const std::vector<Doubtful>& doubtful() {
  static const std::vector<Doubtful> all = {
      {"frozen:C.start", 1, "the load cell at C.start keeps one value although the load moves"},
      {"model-misfit:C.start", 1, "C.start does not fit the model"},
      {"sensor:C.start", 3, "the load cell at C.start contradicts the model"},
      {"elongation:C.end", 3, "the stroke at C.end contradicts the model"},
      {"gauge:C.T3", 3, "the measured force of C.T3 contradicts the model"},
      {"gauge:strut2", 3, "the measured force of strut2 contradicts the model"},
      {"outlier:C.end", 6, "the load cell at C.end gives readings that do not belong together"}};
  return all;
}
const std::string no_past = "nobody knows how C came under load (pull on or use --state)";

// The verdict of the last of so many rows with the same words.
std::string after(Verdict& verdict, int rows, const std::string& words) {
  std::string said;
  for (int i = 0; i < rows; ++i) said = verdict.take(words).english();
  return said;
}

SceneDescription two_cables() {
  return read_scene(R"({ "taut": 1, "name": "n", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0], "c": [2, 1] },
    "struts": [ { "nodes": ["a", "b"], "E": 1, "A": 1 }, { "nodes": ["b", "c"], "E": 1, "A": 1 } ],
    "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 1, "A": 1, "start": "anchored", "end": "jacked" },
                { "name": "left: one", "path": ["a", "b", "c"], "E": 1, "A": 1, "start": "anchored", "end": "jacked" } ] })",
                    "f");
}

// Kinds are no more than these.
constexpr int kinds = static_cast<int>(Alarm::Kind::early_unlock) + 1;

}  // namespace

TEST_CASE("without alarms the numbers are trusted, from the first row on") {
  Verdict verdict;
  CHECK(verdict.take("").english() == "trust");
  CHECK(after(verdict, 100, "") == "trust");
}

TEST_CASE("each kind makes numbers doubtful from its number of rows on, and not before") {
  for (const Doubtful& each : doubtful()) {
    CAPTURE(each.word);
    Verdict verdict;
    for (int i = 1; i < each.least; ++i) CHECK(verdict.take(each.word).english() == "trust");
    CHECK(verdict.take(each.word).english() == "do not trust: " + each.reason);
    CHECK(verdict.take("").english() == "do not trust: " + each.reason);
  }
}

TEST_CASE("doubt ends with the row in which too few of the last thirty had the alarm") {
  for (const Doubtful& each : doubtful()) {
    CAPTURE(each.word);
    Verdict verdict;
    after(verdict, each.least, each.word);
    // The first of them leaves the thirty rows with the next row.
    CHECK(after(verdict, Verdict::rows - each.least, "") == "do not trust: " + each.reason);
    CHECK(verdict.take("").english() == "trust");
    CHECK(after(verdict, 100, "") == "trust");
  }
}

TEST_CASE("alarms that are too rare never make numbers doubtful, however many there are") {
  for (const Doubtful& each : doubtful()) {
    if (each.least == 1) continue;
    CAPTURE(each.word);
    Verdict verdict;
    // One less than it takes in any thirty rows.
    for (int i = 0; i < 600; ++i)
      REQUIRE(verdict.take(i % Verdict::rows < each.least - 1 ? each.word : "").english() == "trust");
    // And now as many.
    CHECK(after(verdict, each.least, each.word) == "do not trust: " + each.reason);
  }
}

TEST_CASE("rows with the alarm count wherever in the last thirty they are") {
  Verdict verdict;
  verdict.take("sensor:C.start");
  after(verdict, 13, "");
  CHECK(verdict.take("sensor:C.start").english() == "trust");
  after(verdict, 14, "");
  CHECK(verdict.take("sensor:C.start").english() ==
        "do not trust: the load cell at C.start contradicts the model");
  CHECK(verdict.take("").english() == "trust");
}

TEST_CASE("an alarm that a row has more than once counts once") {
  Verdict verdict;
  CHECK(verdict.take("sensor:C.start sensor:C.start sensor:C.start").english() == "trust");
  CHECK(verdict.take("sensor:C.start").english() == "trust");
}

TEST_CASE("places are counted each by itself") {
  Verdict verdict;
  CHECK(verdict.take("sensor:C.start gauge:strut1").english() == "trust");
  CHECK(verdict.take("sensor:D.start gauge:strut2").english() == "trust");
  CHECK(verdict.take("sensor:E.start gauge:C.T1").english() == "trust");
}

TEST_CASE("an unknown past makes the numbers of its own rows doubtful, and of no other") {
  Verdict verdict;
  CHECK(verdict.take("unknown-past:C").english() == "do not trust: " + no_past);
  CHECK(after(verdict, 40, "unknown-past:C") == "do not trust: " + no_past);
  CHECK(verdict.take("").english() == "trust");
  CHECK(verdict.take("unknown-past:C").english() == "do not trust: " + no_past);
}

TEST_CASE("what tells of forces and friction, and words of no kind, leave numbers as good as they are") {
  Verdict verdict;
  CHECK(after(verdict, 100,
              "force-high:C.T1 force-low:C.T2 mu:C mu:C.3 stuck:C.2 lift-off:C.end no-information:C.start "
              "something-else:C sensors:C.start") == "trust");
  CHECK(verdict.memory().empty());
}

TEST_CASE("of several reasons the worst two are named, the worst first, in whatever order they came") {
  const std::vector<std::pair<std::string, std::string>> worst_first = {
      {"unknown-past:C", no_past},
      {"frozen:C.start", doubtful()[0].reason},
      {"model-misfit:C.start", doubtful()[1].reason},
      {"sensor:C.start", doubtful()[2].reason},
      {"elongation:C.end", doubtful()[3].reason},
      {"gauge:C.T3", doubtful()[4].reason},
      {"outlier:C.end", doubtful()[6].reason}};
  for (std::size_t i = 0; i + 1 < worst_first.size(); ++i) {
    CAPTURE(worst_first[i].first);
    // These two and all that is less bad, the least bad first.
    std::string words;
    for (std::size_t k = worst_first.size(); k-- > i;) words += worst_first[k].first + ' ';
    Verdict verdict;
    CHECK(after(verdict, 6, words) ==
          "do not trust: " + worst_first[i].second + "; " + worst_first[i + 1].second);
  }
}

TEST_CASE("two places of one kind are two reasons") {
  Verdict verdict;
  CHECK(verdict.take("model-misfit:D.start model-misfit:C.start model-misfit:E.start").english() ==
        "do not trust: C.start does not fit the model; D.start does not fit the model");
}

TEST_CASE("a place is what follows the first colon") {
  Verdict verdict;
  CHECK(verdict.take("model-misfit:left:_one.start").english() ==
        "do not trust: left:_one.start does not fit the model");
}

TEST_CASE("a verdict is one field of a line: it has no comma, quote or line end") {
  Verdict verdict;
  for (int kind = 0; kind < kinds; ++kind) {
    const Alarm alarm = Alarm::of(static_cast<Alarm::Kind>(kind), 1, 0);
    Verdict alone;
    const std::string said = after(alone, 6, alarm_word(alarm, two_cables()));
    CAPTURE(said);
    CHECK(said.find_first_of(",\"\r\n") == std::string::npos);
    CHECK((is_trust(said) || said.substr(0, 14) == "do not trust: "));
  }
}

TEST_CASE("the kinds of alarms that make numbers doubtful do so as they are written") {
  using Kind = Alarm::Kind;
  for (int i = 0; i < kinds; ++i) {
    const auto kind = static_cast<Kind>(i);
    const bool is_doubtful = kind == Kind::unknown_past || kind == Kind::misfit || kind == Kind::sensor ||
                             kind == Kind::strut || kind == Kind::segment || kind == Kind::elongation ||
                             kind == Kind::frozen || kind == Kind::outlier || kind == Kind::unread ||
                             kind == Kind::late_lock;
    Verdict verdict;
    const std::string word = alarm_word(Alarm::of(kind, 0, 0), two_cables());
    CAPTURE(word);
    CHECK_FALSE(word.empty());
    CHECK(is_trust(after(verdict, 30, word)) == !is_doubtful);
  }
}

TEST_CASE("memory does not grow with the log, and is empty when all has passed") {
  Verdict verdict;
  for (int i = 0; i < 10000; ++i) {
    verdict.take("sensor:C.start mu:C.1 outlier:C" + std::to_string(i) + ".end");
    REQUIRE(verdict.memory().size() <= 1 + Verdict::rows);
  }
  after(verdict, Verdict::rows, "");
  CHECK(verdict.memory().empty());
}

TEST_CASE("a verdict goes on from what another one remembers") {
  // Words at various times; the cut after every row.
  const auto words = [](int i) {
    return std::string(i % 11 == 3 ? "sensor:C.start " : "") + (i % 7 < 2 ? "outlier:C.end " : "") +
           (i == 20 ? "frozen:C.start " : "") + (i < 5 ? "unknown-past:C" : "");
  };
  int doubtful_rows = 0;
  for (int cut = 0; cut < 80; ++cut) {
    Verdict whole, first;
    for (int i = 0; i < cut; ++i) {
      whole.take(words(i));
      first.take(words(i));
    }
    Verdict second(first.memory());
    for (int i = cut; i < 80; ++i) {
      const std::string expected = whole.take(words(i)).english();
      REQUIRE(second.take(words(i)).english() == expected);
      doubtful_rows += is_trust(expected) ? 0 : 1;
    }
  }
  CHECK(doubtful_rows > 80);
}

TEST_CASE("what needs no action is a notice, and every other kind an alarm") {
  const SceneDescription scene = two_cables();
  for (int kind = 0; kind < kinds; ++kind) {
    const Alarm alarm = Alarm::of(static_cast<Alarm::Kind>(kind), 0, 0);
    Answer answer;
    add_alarm(alarm, scene, answer);
    const std::string word = alarm_word(alarm, scene);
    CAPTURE(word);
    const bool is_notice =
        alarm.kind == Alarm::Kind::no_information || alarm.kind == Alarm::Kind::early_unlock;
    CHECK(answer.notices == (is_notice ? word : ""));
    CHECK(answer.alarms == (is_notice ? "" : word));
  }
}

TEST_CASE("alarms and notices of a row take the place of those before, each in their order") {
  using Kind = Alarm::Kind;
  const SceneDescription scene = two_cables();
  const std::vector<Alarm> alarms = {Alarm::of(Kind::misfit, 0, 0), Alarm::of(Kind::no_information, 0, 0),
                                     Alarm::of(Kind::frozen, 1, 0), Alarm::of(Kind::no_information, 1, 1),
                                     Alarm::of(Kind::strut, -1, 1)};
  Answer answer;
  answer.alarms = answer.notices = "of the row before";
  read_alarms(alarms, scene, answer);
  CHECK(answer.alarms == "model-misfit:C.start frozen:left:_one.start gauge:strut2");
  CHECK(answer.notices == "no-information:C.start no-information:left:_one.end");
  read_alarms(std::vector<Alarm>{}, scene, answer);
  CHECK(answer.alarms.empty());
  CHECK(answer.notices.empty());
}

TEST_CASE("in a load stage what contradicts the model once makes numbers doubtful, for three rows") {
  for (const char* kind : {"sensor:C.start", "elongation:C.end", "gauge:C.T3"}) {
    CAPTURE(kind);
    CHECK(is_trust(Verdict().take(kind)));
    Verdict stages;
    CHECK_FALSE(is_trust(stages.take(kind, true)));
    CHECK_FALSE(is_trust(stages.take("", true)));
    CHECK_FALSE(is_trust(stages.take("", true)));
    CHECK(is_trust(stages.take("", true)));
  }
  // A reading that was left out, and was refused for that, says nothing against the numbers.
  CHECK(is_trust(Verdict().take("outlier:C.end", true)));
}
