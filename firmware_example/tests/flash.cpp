// The record in flash: the power fails at every word, sectors wear alike.
#include <algorithm>
#include <random>

#include "boards/stm32f405/flash_controller.hpp"
#include "monitor/kept_records.hpp"
#include "rig.hpp"
#include "simulated_flash.hpp"

namespace flash_test {
using namespace rig;
using monitor::Found;
using monitor::RecordHeader;
using Controller = boards::FlashController<SimulatedFlash, SmallSectors>;

namespace {

SimulatedFlash without_controller() {
  SimulatedFlash part;
  part.has_controller = false;
  return part;
}

/// RAM that the power takes, and flash.
template <std::uint32_t Interval, bool HasController = true>
struct FlashBoard : monitor::host::MemoryBoard {
  using RecordsType = monitor::KeptRecords<FlashBoard>;
  using Flash = Controller;
  static constexpr std::uint32_t flash_interval = Interval;
  static constexpr int memory_size = 2 * SmallSectors::sector_size;

  SimulatedFlash part = HasController ? SimulatedFlash() : without_controller();
  Controller controller{part};
  std::mt19937 random{26};

  Flash& flash() { return controller; }
  /// As after a reset: the RAM stays.
  bool keeps_ram = false;
  void power_on() {
    monitor::host::MemoryBoard::power_on();
    part.power_on();
    if (keeps_ram) return;
    // What the application can reach: all of the memory would take longer than the test.
    std::generate_n(memory.begin(), memory_size, [this] { return static_cast<std::uint8_t>(random()); });
  }
};
template <class Board>
using With =
    Rig<monitor::Application<Board, monitor::Settings, monitor::FromFlash<monitor::FlashScene>>, Board>;

std::vector<float> row(std::uint32_t number) {
  return {4000.0F * static_cast<float>(number), 30000, number % 3 == 0 ? 500.0F : 100.0F};
}
std::uint32_t last_sample(const Fields& information) { return monitor::host::number_of(information.at(14)); }

/// What a device answers to which nothing happens.
std::vector<Fields> undisturbed(std::uint32_t rows) {
  Plain device;
  settle(device, rolling_joint);
  device.ask(sample(1, {0, 0, 0}));
  std::vector<Fields> found(2);
  for (std::uint32_t number = 2; number <= rows; ++number)
    found.push_back(state(device.ask(sample(number, row(number)))));
  return found;
}
template <class Device>
void begin(Device& device) {
  device.ask("Q");
  device.ask(choose(rolling_joint));
  device.ask(sample(1, {0, 0, 0}));
}

/// A memory with one record.
struct OneRecord {
  std::vector<std::uint8_t> bytes;
  OneRecord(std::uint32_t sequence, std::uint32_t words) {
    RecordHeader header;
    header.length = 4 * words;
    header.sequence = sequence;
    put(&header, sizeof header);
    for (std::uint32_t i = 0; i < words; ++i) {
      const std::uint32_t word = sequence * 31 + i;
      put(&word, 4);
    }
    monitor::Crc32 crc;
    crc.add(bytes.data(), bytes.size());
    const std::uint32_t checksum = crc.value();
    put(&checksum, 4);
  }
  void put(const void* from, std::size_t count) {
    const auto* each = static_cast<const std::uint8_t*>(from);
    bytes.insert(bytes.end(), each, each + count);
  }
  void read(int at, void* to, std::size_t count) const {
    std::memcpy(to, &bytes[static_cast<std::size_t>(at)], count);
  }
  int size() const { return static_cast<int>(bytes.size()); }
};
using Log = monitor::FlashLog<Controller>;
constexpr int slot = 5000;  // three a sector

}  // namespace

/// Where a sector begins: RM0090, 3.3. Four of 16 KiB, one of 64, seven of 128.
constexpr std::uint32_t begin_of_sector(std::uint32_t number) {
  std::uint32_t address = 0x08000000;
  for (std::uint32_t i = 0; i < number; ++i) address += (i < 4 ? 16 : i == 4 ? 64 : 128) * 1024;
  return address;
}
using boards::RecordSectors;
static_assert(begin_of_sector(RecordSectors::first) == RecordSectors::address);
static_assert(begin_of_sector(RecordSectors::first + 1) ==
              RecordSectors::address + RecordSectors::sector_size);
static_assert(begin_of_sector(12) == 0x08000000 + 1024 * 1024, "the two last sectors of 1 MiB");
static_assert(begin_of_sector(SmallSectors::first) == SmallSectors::address);

TEST_CASE("the controller is used as its manual says") {
  SimulatedFlash part;
  Controller flash(part);
  CHECK(flash.is_there());
  std::mt19937 random(3);
  for (auto& byte : part.memory) byte = static_cast<std::uint8_t>(random());
  const auto before = part.memory;
  CHECK(flash.erase(1));
  CHECK(std::equal(before.begin(), before.begin() + Controller::sector_size, part.memory.begin()));
  CHECK(std::all_of(part.memory.begin() + Controller::sector_size, part.memory.end(),
                    [](auto byte) { return byte == 0xFF; }));
  CHECK(flash.program(Controller::sector_size + 8, 0x12345678));
  CHECK(part.read(SmallSectors::address + Controller::sector_size + 8) == 0x12345678);
  // Locked again, nothing is written.
  flash.lock();
  part.write(SmallSectors::address + Controller::sector_size + 12, 0);
  CHECK(part.read(SmallSectors::address + Controller::sector_size + 12) == 0xFFFFFFFF);
  CHECK(part.misuses == 1);
  CHECK(flash.program(Controller::sector_size + 12, 7));
  CHECK(part.misuses == 1);
  CHECK_FALSE(flash.program(Controller::sector_size + 12, 8));  // a zero does not become a one
}

TEST_CASE("without a controller there is no flash, and nothing waits for it") {
  SimulatedFlash part = without_controller();
  CHECK_FALSE(Controller(part).is_there());
  With<FlashBoard<0, false>> device;
  begin(device);
  const Fields before = device.ask(sample(2, row(2)));
  device.board.keeps_ram = true;
  device.boot();
  CHECK(state(device.ask("P")) == state(before));
  CHECK(device.board.part.steps == 0);
}

TEST_CASE("the newest record is found, and both sectors wear alike") {
  SimulatedFlash part;
  Controller flash(part);
  for (std::uint32_t number = 0; number < 100; ++number) {
    // Anew, as after a power failure, and passing zero.
    const std::uint32_t sequence = 0xFFFFFFD0 + number;
    Log log(flash, slot);
    RecordHeader header;
    const Found found = log.find(header);
    REQUIRE(found == (number == 0 ? Found::nothing : Found::record));
    if (number > 0) REQUIRE(header.sequence == sequence - 1);
    const OneRecord record(sequence, 100 + number);
    REQUIRE(log.store(record, 0, record.size()));
    std::vector<std::uint8_t> back(record.bytes.size());
    log.read(0, back.data(), back.size());
    REQUIRE(back == record.bytes);
  }
  CHECK(part.misuses == 0);
  // Three records a sector: 34 sectors.
  CHECK(part.erasures[0] == 17);
  CHECK(part.erasures[1] == 17);
}

TEST_CASE("the power fails at every word and at every step of an erasure: the record before is there") {
  constexpr std::uint32_t words = 60;
  for (std::uint32_t before = 1; before <= 7; ++before)
    for (long cut = 0;; ++cut) {
      SimulatedFlash part;
      Controller flash(part);
      Log log(flash, slot);
      for (std::uint32_t number = 1; number <= before; ++number) {
        const OneRecord record(number, words);
        REQUIRE(log.store(record, 0, record.size()));
      }
      const long steps = part.steps;
      const int erasures = part.erasures[0] + part.erasures[1];
      part.until_cut = cut;
      const OneRecord last(before + 1, words);
      log.store(last, 0, last.size());
      const long all = words + 7 + 32 * (part.erasures[0] + part.erasures[1] - erasures);
      const bool is_whole = part.steps - steps == all;
      part.power_on();
      INFO("after " << before << " records cut at step " << cut);
      RecordHeader header;
      Log again(flash, slot);
      REQUIRE(again.find(header) == Found::record);
      // With luck the checksum is right although its word was cut.
      const bool may_be_whole = part.steps - steps >= all - 1;
      REQUIRE((header.sequence == before || (may_be_whole && header.sequence == before + 1)));
      if (is_whole) REQUIRE(header.sequence == before + 1);
      // It goes on from there, four records long.
      for (std::uint32_t number = header.sequence + 1; number <= before + 5; ++number) {
        const OneRecord record(number, words);
        REQUIRE(again.store(record, 0, record.size()));
        RecordHeader newest;
        REQUIRE(Log(flash, slot).find(newest) == Found::record);
        REQUIRE(newest.sequence == number);
      }
      REQUIRE(part.misuses == 0);
      if (is_whole) break;
    }
}

TEST_CASE("a word that is worn out costs a slot, not the record") {
  for (int worn = 0; worn < 2 * SmallSectors::sector_size / 4; worn += 301) {
    SimulatedFlash part;
    part.worn_word = worn;
    Controller flash(part);
    Log log(flash, slot);
    for (std::uint32_t number = 1; number <= 12; ++number) {
      const OneRecord record(number, 1000);
      REQUIRE(log.store(record, 0, record.size()));
      RecordHeader header;
      REQUIRE(Log(flash, slot).find(header) == Found::record);
      REQUIRE(header.sequence == number);
    }
  }
}

TEST_CASE("damage is told from nothing") {
  SimulatedFlash part;
  Controller flash(part);
  RecordHeader header;
  CHECK(Log(flash, slot).find(header) == Found::nothing);
  const OneRecord record(1, 50);
  Log log(flash, slot);
  log.store(record, 0, record.size());
  part.memory[40] = static_cast<std::uint8_t>(part.memory[40] ^ 1U);
  CHECK(Log(flash, slot).find(header) == Found::damage);
}

TEST_CASE("a device whose power fails at any word of the record loses at most the last sample") {
  constexpr std::uint32_t rows = 8;
  const auto expected = undisturbed(rows);
  With<FlashBoard<0>> device;
  begin(device);
  for (std::uint32_t cut_row = 2; cut_row <= 7; ++cut_row) {
    // Back to this after every cut.
    const auto memory = device.board.part.memory;
    long cut = 0, fallen_back = 0;
    // Every word of the first record, of the others one in seven: those with an erasure are among them.
    for (bool is_whole = false; !is_whole; cut += cut_row == 2 ? 1 : 7) {
      device.board.part.memory = memory;
      device.boot();
      REQUIRE(last_sample(device.greeting) == cut_row - 1);
      device.board.part.until_cut = cut;
      device.ask(sample(cut_row, row(cut_row)));
      is_whole = device.board.part.until_cut > 0;
      device.boot();
      INFO("row " << cut_row << ", cut at step " << cut);
      const std::uint32_t last = last_sample(device.greeting);
      REQUIRE((last == cut_row || (!is_whole && last == cut_row - 1)));
      fallen_back += last == cut_row ? 0 : 1;
      if (last > 1) REQUIRE(state(device.ask("P")) == expected[last]);
      if (cut % 49 != 0) continue;
      for (std::uint32_t number = last + 1; number <= rows; ++number) {
        const Fields answer = device.ask(sample(number, row(number)));
        REQUIRE(quality(answer) == 'g');
        REQUIRE(state(answer) == expected[number]);
      }
    }
    CHECK(fallen_back > 10);
    device.board.part.memory = memory;
    device.boot();
    device.ask(sample(cut_row, row(cut_row)));
  }
  CHECK(device.board.part.misuses == 0);
  CHECK(device.board.part.erasures[0] > 0);
  CHECK(device.board.part.erasures[1] > 0);
}

TEST_CASE("between writes to the flash a reset loses nothing and a power failure what is not a minute old") {
  const auto expected = undisturbed(12);
  With<FlashBoard<60000>> device;
  begin(device);
  const long steps = device.board.part.steps;
  for (std::uint32_t number = 2; number <= 6; ++number) device.ask(sample(number, row(number)));
  CHECK(device.board.part.steps == steps);
  device.board.keeps_ram = true;
  device.boot();
  CHECK(last_sample(device.greeting) == 6);
  CHECK(state(device.ask("P")) == expected[6]);

  device.ask(sample(7, row(7)));
  device.board.clock += 60000;
  device.run();  // without a sample, too
  device.answers();
  device.ask(sample(8, row(8)));
  device.board.keeps_ram = false;
  device.boot();
  CHECK(last_sample(device.greeting) == 7);
  CHECK(state(device.ask("P")) == expected[7]);
  // What a command has changed is kept at once.
  device.ask(sample(8, row(8)));
  device.ask("L " + number_field(0) + " " + number_field(1));
  device.boot();
  CHECK(last_sample(device.greeting) == 8);
  // The sample that was forgotten is said to be missing.
  device.board.clock = 0;
  device.boot();
  device.ask(sample(9, row(9)));
  device.boot();
  CHECK(alarms(device.ask(sample(10, row(10)))).has(Alarm::sample_lost));
}

TEST_CASE("flash that takes nothing any more is said, and the device goes on with what it has") {
  With<FlashBoard<0>> device;
  begin(device);
  CHECK_FALSE(alarms(device.ask(sample(2, row(2)))).has(Alarm::not_kept));
  device.board.part.is_worn_out = true;
  const Fields answer = device.ask(sample(3, row(3)));
  CHECK(quality(answer) == 'g');
  CHECK(alarms(answer).has(Alarm::not_kept));
  device.board.keeps_ram = true;
  device.boot();
  CHECK(last_sample(device.greeting) == 3);
}

}  // namespace flash_test
