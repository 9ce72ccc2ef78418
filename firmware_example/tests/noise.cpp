// A noisy line: dropped, doubled and flipped bytes in both directions.
#include <cstdlib>
#include <random>

#include "rig.hpp"

namespace noise_test {
using namespace rig;

namespace {

#ifdef MONITOR_LONG_TESTS
constexpr std::uint32_t frames = 1000000;
#else
constexpr std::uint32_t frames = 20000;
#endif

class Noise {
 public:
  /// Does something to about one byte in `rarity`.
  explicit Noise(unsigned rarity) : rarity_(rarity) {}

  std::string over(const std::string& bytes) {
    std::string noisy;
    for (const char byte : bytes) {
      if (random_() % rarity_ != 0) {
        noisy += byte;
        continue;
      }
      switch (random_() % 4) {
        case 0:
          break;
        case 1:
          noisy += std::string(2, byte);
          break;
        case 2:
          noisy += static_cast<char>(static_cast<unsigned char>(byte) ^ 1U << random_() % 8);
          break;
        default:
          noisy += static_cast<char>(random_());
          break;
      }
    }
    return noisy;
  }

 private:
  unsigned rarity_;
  std::mt19937 random_{12345};
};

}  // namespace

// The device need not hear a sample; but one that it answers must be the one that was sent, and the answer
// the one of a device that heard the same samples over a clean line.
TEST_CASE("frames over a noisy line: nothing wrong is shown as right") {
  Plain noisy, clean;
  settle(noisy, rolling_joint);
  settle(clean, rolling_joint);
  for (Plain* each : {&noisy, &clean})
    each->ask("G " + real_field(-1e9F) + " " + real_field(1e9F) + " " + number_field(0));
  Noise there(150), back(2000);
  std::mt19937 random(54321);
  long heard = 0, lost = 0, refused = 0, garbled = 0;
  for (std::uint32_t number = 1; number <= frames; ++number) {
    std::vector<float> row;
    for (int i = 0; i < 3; ++i) row.push_back(static_cast<float>(random() % 1000000) / 16);
    const std::string body = sample(number, row);
    noisy.board.to_device += there.over(framed(body));
    noisy.run();
    bool answered = false;
    std::istringstream said(noisy.board.from_device);
    for (std::string line; std::getline(said, line);) {
      const auto sent = monitor::host::body_of(line);
      REQUIRE(sent.has_value());
      const auto received = monitor::host::body_of(back.over(line));
      garbled += received ? 0 : 1;
      if (received) REQUIRE(*received == *sent);
      const Fields answer = fields_of(*sent);
      refused += answer[0] == "E" ? 1 : 0;
      if (answer[0] != "A") continue;
      REQUIRE(sequence(answer) == number);
      answered = true;
      ++heard;
      REQUIRE(quality(answer) == 'g');
      // Before the first one that was heard there was none to miss.
      REQUIRE(alarms(answer).has(Alarm::sample_lost) == (lost > 0 && heard > 1));
      const Fields expected = clean.ask(body);
      REQUIRE(state(answer) == state(expected));
      lost = 0;
    }
    noisy.board.from_device.clear();
    lost += answered ? 0 : 1;
  }
  MESSAGE(heard << " of " << frames << " samples heard, " << refused << " lines refused, " << garbled
                << " answers garbled");
  CHECK(heard > frames / 4);
  CHECK(refused > frames / 10);
  // And then the line is clean again.
  noisy.board.to_device += "\n";
  noisy.run();
  noisy.answers();
  const Fields answer = noisy.ask(sample(frames + 1, {40000, 40000, 40000}));
  CHECK(quality(answer) == 'g');
  CHECK(alarms(noisy.ask(sample(frames + 2, {40000, 40000, 40000}))).bits() == 0);
}

TEST_CASE("pure noise does not move the device") {
  Plain device;
  settle(device, rolling_joint);
  const Fields before = device.ask(sample(1, {40000, 0, 0}));
  std::mt19937 random(99);
  for (int i = 0; i < 10000; ++i) {
    for (int byte = 0; byte < 100; ++byte) device.board.to_device += static_cast<char>(random());
    device.run();
    device.board.from_device.clear();
  }
  device.board.to_device += "\n";
  device.run();
  device.answers();
  CHECK(state(device.ask("P")) == state(before));
  CHECK(quality(device.ask(sample(2, {41000, 0, 0}))) == 'g');
}

}  // namespace noise_test
