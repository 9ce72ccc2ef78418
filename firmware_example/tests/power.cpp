// The power fails at every byte of the record, and every bit of it flips; or, by default, at one in seven.
#include <algorithm>

#include "rig.hpp"

namespace power_test {
using namespace rig;

namespace {

// Of the places in a record, one in so many is tried: each byte of a word and each bit of a byte is among
// them.
#ifdef MONITOR_LONG_TESTS
constexpr int every = 1;
#else
constexpr int every = 7;
#endif

std::vector<float> recorded_row(std::uint32_t number) {
  return {1000.0F * static_cast<float>(number), 40000, number % 3 == 0 ? 500.0F : 100.0F};
}
/// Whether the first sample is under load, so that there are two estimators.
enum class Begin { without_load, under_load };

std::vector<float> row_of(std::uint32_t scene, Begin begin, std::uint32_t number) {
  if (begin == Begin::without_load && number == 1)
    return std::vector<float>(scene == rolling_joint ? std::size_t{3} : std::size_t{2});
  if (scene == rolling_joint) return recorded_row(number);
  if (begin == Begin::without_load) return truss_log().at(number - 1);
  return {0.2F, 100000 + 10 * static_cast<float>(number)};
}

/// What a device answers to which nothing happens, and how long its records are.
struct Undisturbed {
  std::vector<Fields> answers{1};
  std::vector<long> records{0};
};
Undisturbed undisturbed(std::uint32_t scene, Begin begin, std::uint32_t rows) {
  Plain device;
  settle(device, scene);
  Undisturbed found;
  for (std::uint32_t number = 1; number <= rows; ++number) {
    const long before = device.board.written;
    found.answers.push_back(state(device.ask(sample(number, row_of(scene, begin, number)))));
    found.records.push_back(device.board.written - before);
  }
  return found;
}

std::uint32_t last_sample(const Fields& information) { return monitor::host::number_of(information.at(14)); }
std::uint32_t scene_of(const Fields& information) { return monitor::host::number_of(information.at(2)); }

void cut_at_every_byte(std::uint32_t scene, Begin begin, int torn) {
  constexpr std::uint32_t rows = 6, cut_row = 4;
  const auto [expected, records] = undisturbed(scene, begin, rows);
  const long record = records[cut_row];
  Plain device;
  settle(device, scene);
  for (std::uint32_t number = 1; number < cut_row; ++number)
    device.ask(sample(number, row_of(scene, begin, number)));
  const auto memory = device.board.memory;
  for (long next = 0; next < record + every; next += every) {
    const long cut = std::min(next, record);
    device.board.memory = memory;
    device.boot();
    const long before = device.board.written;
    device.board.torn = torn;
    device.board.bytes_until_cut = cut;
    device.ask(sample(cut_row, row_of(scene, begin, cut_row)));
    REQUIRE(device.board.written - before == std::min(cut, record));
    device.boot();
    INFO("cut at byte " << cut << " of " << record);
    const std::uint32_t last = last_sample(device.greeting);
    REQUIRE(scene_of(device.greeting) == scene);
    REQUIRE((last == cut_row || (cut < record && last == cut_row - 1)));
    REQUIRE(state(device.ask("P")) == expected[last]);
    for (std::uint32_t number = last + 1; number <= rows; ++number) {
      const Fields answer = device.ask(sample(number, row_of(scene, begin, number)));
      REQUIRE(quality(answer) == 'g');
      REQUIRE(state(answer) == expected[number]);
    }
  }
}

}  // namespace

TEST_CASE("a power cut at any byte of the record loses at most the last sample") {
  for (const std::uint32_t scene : {rolling_joint, truss_string})
    for (const Begin begin : {Begin::without_load, Begin::under_load}) cut_at_every_byte(scene, begin, -1);
}
TEST_CASE("while nobody knows how cables came under load, the record holds two estimators") {
  for (const std::uint32_t scene : {rolling_joint, truss_string})
    CHECK(undisturbed(scene, Begin::under_load, 4).records[4] >
          1.5 * static_cast<double>(undisturbed(scene, Begin::without_load, 4).records[4]));
}
TEST_CASE("also if the byte of the cut becomes anything") {
  cut_at_every_byte(rolling_joint, Begin::without_load, 0x00);
  cut_at_every_byte(rolling_joint, Begin::under_load, 0xFF);
  cut_at_every_byte(truss_string, Begin::without_load, 0xA5);
}

TEST_CASE("every single flipped bit of the memory is noticed") {
  constexpr std::uint32_t rows = 5;
  const auto expected = undisturbed(truss_string, Begin::without_load, rows).answers;
  Plain device;
  settle(device, truss_string);
  for (std::uint32_t number = 1; number <= rows; ++number)
    device.ask(sample(number, row_of(truss_string, Begin::without_load, number)));
  const auto memory = device.board.memory;
  const auto end = std::find_if(memory.rbegin(), memory.rend(), [](auto byte) { return byte != 0; }).base();
  const auto used = static_cast<std::size_t>(end - memory.begin());
  int fell_back = 0;
  for (std::size_t place = 0; place < 8 * used; place += every) {
    const std::size_t byte = place / 8, bit = place % 8;
    device.board.memory[byte] = static_cast<std::uint8_t>(memory[byte] ^ 1U << bit);
    device.boot();
    const std::uint32_t last = last_sample(device.greeting);
    INFO("byte " << byte << " bit " << bit);
    REQUIRE((last == rows || last == rows - 1));
    fell_back += last == rows ? 0 : 1;
    REQUIRE(state(device.ask("P")) == expected[last]);
    device.board.memory[byte] = memory[byte];
  }
  CHECK(fell_back > 8 * 100 / every);
}

TEST_CASE("with both records gone the device says so and begins anew") {
  Plain device;
  settle(device, rolling_joint);
  device.ask(sample(1, {40000, 0, 0}));
  for (auto& byte : device.board.memory) byte = static_cast<std::uint8_t>(byte ^ 0x10U);
  device.boot();
  const Fields answer = device.ask(sample(9, {40000, 0, 0}));
  CHECK(quality(answer) == 'g');
  CHECK(alarms(answer).has(Alarm::state_lost));
  // Nobody knows any more whether friction keeps force away from the anchor or holds it there.
  CHECK(tension(answer, 0) > 40000);
  CHECK(monitor::alarm_of(monitor::host::number_of(answer.back())).kind == taut::Alarm::Kind::unknown_past);
}

TEST_CASE("a memory that was never written is no loss") {
  Plain device;
  CHECK_FALSE(alarms(device.ask("P")).has(Alarm::state_lost));
  std::fill(device.board.memory.begin(), device.board.memory.end(), std::uint8_t{0xFF});
  device.boot();
  CHECK_FALSE(alarms(device.ask("P")).has(Alarm::state_lost));
}

TEST_CASE("zero, lock, limits and acknowledgements survive the power") {
  Plain device;
  settle(device, rolling_joint);
  device.ask(sample(1, {150, 0, 0}));
  device.ask("Z " + number_field(0) + " " + number_field(1));
  device.ask("G " + real_field(-200) + " " + real_field(50000) + " " + number_field(9));
  device.ask(sample(2, {40150, 10000, 0}));
  device.ask("L " + number_field(1) + " " + number_field(1));
  const Fields locked = device.ask(sample(3, {40150, 10000, 0}));
  device.boot();
  CHECK(alarms(device.ask("P")).has(Alarm::restarted));
  const Fields answer = device.ask(sample(4, {40150, 0, 0}));
  CHECK(state(answer) == state(locked));
  CHECK(alarms(device.ask(sample(5, {60000, 0, 0}))).has(Alarm::sensor_range));
}

TEST_CASE("the number of the record passes zero") {
  using Records = monitor::Records<monitor::host::MemoryBoard>;
  monitor::host::MemoryBoard board;
  const int slot = Records::size_with(4);
  const auto put = [&](int number, std::uint32_t sequence) {
    monitor::RecordHeader header;
    header.length = 4;
    header.sequence = sequence;
    monitor::Crc32 crc;
    crc.add(&header, sizeof header);
    crc.add(&sequence, 4);
    const std::uint32_t checksum = crc.value();
    board.write(number * slot, &header, sizeof header);
    board.write(number * slot + static_cast<int>(sizeof header), &sequence, 4);
    board.write(number * slot + static_cast<int>(sizeof header) + 4, &checksum, 4);
  };
  monitor::RecordHeader found;
  put(0, 0xFFFFFFFF);
  put(1, 0);
  Records records(board, slot);
  REQUIRE(records.find(found) == monitor::Found::record);
  CHECK(found.sequence == 0);
  put(0, 1);
  REQUIRE(records.find(found) == monitor::Found::record);
  CHECK(found.sequence == 1);
}

}  // namespace power_test
