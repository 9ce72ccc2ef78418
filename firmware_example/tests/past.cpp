// A session that begins under load: nobody knows how the cables came there.
#include "rig.hpp"

namespace past_test {
using namespace rig;

namespace {

constexpr int segments = 4;

// The fields of an answer of the truss string, where its values begin at 10: 4 tensions, 3 slips, a word of
// states, 3 contact and 3 friction forces, an extension, 13 struts, 4 deviations, 3 mu and their deviations,
// alarms.
float deviation(const Fields& answer, std::size_t segment) { return real(answer.at(38 + segment)); }
bool doubts_past(const Fields& answer) {
  for (std::size_t i = 48; i < answer.size(); ++i)
    if (monitor::alarm_of(monitor::host::number_of(answer[i])).kind == taut::Alarm::Kind::unknown_past)
      return true;
  return false;
}

/// The application with the truss string alone, and what a site sets.
template <class Settings>
using Truss = Rig<monitor::Application<monitor::host::MemoryBoard, Settings,
                                       monitor::CondensedAtStartUp<monitor::scenes::truss_string>>>;
struct Trusting : monitor::Settings {
  static constexpr bool doubts_past = false;
};
using Doubting = Truss<monitor::Settings>;

/// A jacking that begins at 100 kN: held, let out, pulled on.
std::vector<float> loaded_row(std::uint32_t number) {
  const float row = static_cast<float>(number);
  return {0.2F, number <= 4 ? 100000 + 10 * row : 100000 - 5000 * (row - 4)};
}
constexpr std::uint32_t loaded_rows = 12;

}  // namespace

TEST_CASE(
    "the forces of a cable that is under load at once lie between those of all pasts, until it has slid") {
  Doubting doubting;
  Truss<Trusting> trusting;
  bool was_known = false;
  for (std::uint32_t number = 1; number <= loaded_rows; ++number) {
    const std::string body = sample(number, loaded_row(number));
    const Fields answer = doubting.ask(body), from_zero = trusting.ask(body);
    CHECK(quality(answer) == 'g');
    CHECK_FALSE(doubts_past(from_zero));
    INFO("sample " << number);
    was_known = was_known || !doubts_past(answer);
    CHECK(doubts_past(answer) == !was_known);
    for (std::size_t i = 0; i < segments; ++i) {
      const float off = std::fabs(tension(from_zero, i) - tension(answer, i));
      CHECK(off <= 1.001F * 1.96F * deviation(answer, i));
    }
    // Friction holds the force at the anchor below that of the jack, or as far above it.
    if (number == 1) CHECK(deviation(answer, 0) > 3 * deviation(from_zero, 0));
    if (was_known) CHECK(state(answer) == state(from_zero));
  }
  CHECK(was_known);
}

TEST_CASE("a first sample without load says that there was none") {
  for (const float first : {0.0F, -2000.0F}) {
    Doubting device;
    CAPTURE(first);
    CHECK_FALSE(doubts_past(device.ask(sample_of(1, {0.0F, none, first, none}))));
    CHECK_FALSE(doubts_past(device.ask(sample(2, {0.0F, 100000}))));
  }
}

TEST_CASE("samples in which no cell is read say nothing of a load: the first reading does") {
  // At commit e560b22 they told of none, and so did one that was lost.
  for (const float first : {0.0F, 100000.0F}) {
    CAPTURE(first);
    Doubting device;
    for (std::uint32_t number = 1; number <= 2; ++number) {
      const Fields silent = device.ask(sample_of(number, {0.0F, none, none, none}));
      CHECK(doubts_past(silent));
      CHECK(tension(silent, 0) + 1.96F * deviation(silent, 0) > 100000);
      device.boot();
    }
    CHECK(doubts_past(device.ask(sample(3, {0.0F, first}))) == (first > 0));
  }
}

TEST_CASE("a sample that was not used is not the first one") {
  Doubting device;
  CHECK(quality(device.ask(sample(1, {0.0F, 2e7F}))) == 'h');
  CHECK(doubts_past(device.ask(sample(2, {0.0F, 100000}))));
}

TEST_CASE("a scene that is chosen again begins anew, whatever was doubted before") {
  Doubting device;
  CHECK(doubts_past(device.ask(sample(1, {0.0F, 100000}))));
  device.ask(choose(0));
  CHECK_FALSE(doubts_past(device.ask("P")));
  CHECK_FALSE(doubts_past(device.ask(sample(1, {0.0F, 0.0F}))));
  device.ask(choose(0));
  CHECK(doubts_past(device.ask(sample(1, {0.0F, 100000}))));
}

TEST_CASE("a cell that was off and is zeroed leaves no doubt once it pulls") {
  Doubting device;
  CHECK(doubts_past(device.ask(sample(1, {0.0F, 9000}))));
  CHECK(device.ask("Z " + number_field(0) + " " + number_field(1)) == Fields{"K", "Z"});
  device.ask(sample(2, {0.0F, 9000}));
  CHECK_FALSE(doubts_past(device.ask(sample(3, {0.0F, 10000}))));
}

TEST_CASE(
    "an end that is locked and not read tells nothing, through a power failure too: the first reading does") {
  // At commit 1763c67 it told of no load.
  for (const float first : {0.0F, 100000.0F}) {
    CAPTURE(first);
    Doubting device;
    device.ask("L " + number_field(0) + " " + number_field(1));
    const Fields silent = device.ask(sample_of(1, {0.0F, none, none, none}));
    CHECK(quality(silent) == 'g');
    CHECK(doubts_past(silent));
    CHECK(tension(silent, 0) + 1.96F * deviation(silent, 0) > 100000);
    device.boot();
    CHECK(state(device.ask("P")) == state(silent));
    device.ask("J " + number_field(0) + " " + number_field(1));
    CHECK(doubts_past(device.ask(sample(2, {0.0F, first}))) == (first > 0));
  }
}

TEST_CASE("while the past is not known, a power failure after any sample changes no bit") {
  Doubting steady, failing;
  for (std::uint32_t number = 1; number <= loaded_rows; ++number) {
    const std::string body = sample(number, loaded_row(number));
    const Fields expected = steady.ask(body);
    CHECK(state(failing.ask(body)) == state(expected));
    failing.boot();
    CHECK(state(failing.ask("P")) == state(expected));
  }
}

TEST_CASE("the record is longer while there are two estimators, and only then") {
  Doubting device;
  std::vector<long> of_two, of_one;
  for (std::uint32_t number = 1; number <= loaded_rows; ++number) {
    const long before = device.board.written;
    const bool doubts = doubts_past(device.ask(sample(number, loaded_row(number))));
    (doubts ? of_two : of_one).push_back(device.board.written - before);
  }
  REQUIRE(!of_two.empty());
  REQUIRE(!of_one.empty());
  for (const long length : of_two) CHECK(length == of_two.front());
  for (const long length : of_one)
    CHECK(static_cast<double>(length) < 0.7 * static_cast<double>(of_two.front()));
}

}  // namespace past_test
