// What the device does when it is told to.
#include <cmath>
#include <limits>
#include <utility>

#include "rig.hpp"

namespace commands_test {
using namespace rig;

TEST_CASE("the recorded experiment: 40 kN at the jack leave 33.35 kN at the anchor") {
  Plain device;
  CHECK(device.greeting.at(0) == "I");
  settle(device, rolling_joint);
  device.ask(sample(1, {0, 0, 0}));
  const Fields answer = device.ask(sample(2, {40000, 0, 0}));
  CHECK(quality(answer) == 'g');
  CHECK(alarms(answer).bits() == 0);
  CHECK(tension(answer, 0) == doctest::Approx(33350).epsilon(1e-4));
  CHECK(tension(answer, 1) == 40000);
}

TEST_CASE("a sample that comes again is answered again, and the model stays where it is") {
  Plain device;
  settle(device, truss_string);
  device.ask(sample(7, {0, 100000}));
  const Fields first = device.ask(sample(8, {0, 90000}));
  const Fields again = device.ask(sample(8, {0, 90000}));
  CHECK(again == first);
  // Even with other numbers: the number of the sample counts.
  CHECK(state(device.ask(sample(8, {0, 1}))) == state(first));
  CHECK(state(device.ask("P")) == state(first));
}

TEST_CASE("a missing sample is said, an old one refused") {
  Plain device;
  settle(device, rolling_joint);
  device.ask(sample(1, {0, 0, 0}));
  CHECK(alarms(device.ask(sample(2, {1, 0, 0}))).bits() == 0);
  CHECK(alarms(device.ask(sample(4, {2, 0, 0}))).has(Alarm::sample_lost));
  CHECK(alarms(device.ask(sample(5, {3, 0, 0}))).bits() == 0);
  CHECK(device.ask(sample(4, {9, 0, 0})) == Fields{"E", "sequence"});
  CHECK(alarms(device.ask(sample(6, {4, 0, 0}))).bits() == 0);
}

TEST_CASE("locked off, the force at the jack is of no account; jacked again it starts from what is there") {
  Plain device;
  settle(device, truss_string);
  const float pulled = tension(device.ask(sample(1, {0, 100000})), 3);
  CHECK(pulled == 100000);
  const std::string end = number_field(0) + " " + number_field(1);
  CHECK(device.ask("L " + end) == Fields{"K", "L"});
  const Fields locked = device.ask(sample(2, {0, 100000}));
  CHECK(tension(locked, 3) < 99000);  // the wedge draws in
  CHECK(tensions(device.ask(sample(3, {0, 5})), 4) == tensions(locked, 4));
  CHECK(device.ask("J " + end) == Fields{"K", "J"});
  CHECK(tension(device.ask(sample(4, {0, 120000})), 3) == 120000);
}

TEST_CASE("a cell is zeroed with what it says, but not under load") {
  Plain device;
  settle(device, rolling_joint);
  device.ask(sample(1, {150, 0, 0}));
  const std::string cell = number_field(0) + " " + number_field(1);
  CHECK(device.ask("Z " + cell) == Fields{"K", "Z"});
  CHECK(tension(device.ask(sample(2, {40150, 0, 0})), 1) == 40000);
  CHECK(device.ask("Z " + cell) == Fields{"E", "zero"});
  CHECK(tension(device.ask(sample(3, {40150, 0, 0})), 1) == 40000);
}

TEST_CASE("what is not understood is refused by name and changes nothing") {
  Plain device;
  settle(device, rolling_joint);
  const Fields before = device.ask(sample(1, {40000, 0, 0}));
  const std::string anchored = number_field(0) + " " + number_field(0);
  const std::string nowhere = number_field(3) + " " + number_field(1);
  const std::string nothing = number_field(0) + " " + number_field(2);
  CHECK(device.ask("X") == Fields{"E", "command"});
  CHECK(device.ask("S") == Fields{"E", "fields"});
  CHECK(device.ask(sample(2, {40000, 0})) == Fields{"E", "fields"});
  CHECK(device.ask(sample(2, {40000, 0, 0, 0})) == Fields{"E", "fields"});
  CHECK(device.ask("L " + anchored) == Fields{"E", "cell"});
  CHECK(device.ask("L " + nowhere) == Fields{"E", "cell"});
  CHECK(device.ask("Z " + nothing) == Fields{"E", "cell"});
  CHECK(device.ask("L 00000000") == Fields{"E", "fields"});
  CHECK(device.ask("I 00000000") == Fields{"E", "fields"});
  CHECK(device.ask(choose(2)) == Fields{"E", "scene"});
  CHECK(device.ask("G " + real_field(1) + " " + real_field(2) + " " + number_field(0)) ==
        Fields{"E", "limits"});
  // Without limits an infinite reading were one like any other.
  const float infinity = std::numeric_limits<float>::infinity();
  for (const auto& [least, most] : {std::pair(-infinity, infinity), std::pair(-100.0F, infinity),
                                    std::pair(-infinity, 1e6F), std::pair(-100.0F, std::nanf(""))})
    CHECK(device.ask("G " + real_field(least) + " " + real_field(most) + " " + number_field(0)) ==
          Fields{"E", "limits"});
  CHECK(device.ask_raw("$I*00000000\n") == Fields{"E", "frame"});
  CHECK(state(device.ask("P")) == state(before));
}

TEST_CASE("another scene begins without load, and the first one again when it comes back") {
  Plain device;
  settle(device, rolling_joint);
  const Fields first = device.ask(sample(1, {40000, 0, 0}));
  CHECK(device.ask(choose(truss_string)).at(2) == number_field(1));
  device.ask(sample(1, {0, 1000}));
  device.ask(choose(rolling_joint));
  CHECK(tension(device.ask("P"), 0) == 0);
  CHECK(state(device.ask(sample(1, {40000, 0, 0}))) == state(first));
}

TEST_CASE("alarms stay in the information until they are acknowledged") {
  Plain device;
  const auto latched = [](const Fields& information) {
    return Alarms(monitor::host::number_of(information.at(15)));
  };
  settle(device, rolling_joint);
  device.ask_raw("noise\n");
  CHECK(alarms(device.ask(sample(1, {0, 0, 0}))).has(Alarm::bad_frame));
  CHECK(alarms(device.ask(sample(2, {0, 0, 0}))).bits() == 0);
  CHECK(latched(device.ask("I")).has(Alarm::bad_frame));
  CHECK(device.ask("Q") == Fields{"K", "Q"});
  CHECK(latched(device.ask("I")).bits() == 0);
}

}  // namespace commands_test
