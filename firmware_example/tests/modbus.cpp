// The monitor as a Modbus slave: frames put together by hand, and by random.
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <random>
#include <vector>

#include "monitor/modbus_crc.hpp"
#include "monitor/modbus_frame.hpp"
#include "monitor/modbus_map.hpp"
#include "rig.hpp"

namespace modbus_test {
using namespace rig;

namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::uint32_t character = 11 * 1000000 / monitor::Settings::modbus_baud;  // [us]
constexpr std::uint32_t silence = monitor::modbus_silence(monitor::Settings::modbus_baud);

/// Bit by bit, as Modbus over serial line V1.02, 6.2.2 draws it: another way than the table of the device.
std::uint16_t slow_crc(const Bytes& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xA001U : crc >> 1U;
  }
  return static_cast<std::uint16_t>(crc);
}
Bytes with_crc(Bytes bytes) {
  const std::uint16_t crc = slow_crc(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return bytes;
}
void put_word(Bytes& bytes, unsigned word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8U & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
}
void put_number(Bytes& bytes, std::uint32_t number) {
  put_word(bytes, number >> 16U);
  put_word(bytes, number & 0xFFFFU);
}

/// A device with a bus.
class Bus : public Plain {
 public:
  std::uint8_t address = monitor::Settings::modbus_address;

  /// One character after the other, each with its time.
  void put(const Bytes& bytes, std::uint32_t pause = 0) {
    for (const std::uint8_t byte : bytes) {
      board.modbus.clock += character + pause;
      board.modbus.to_device.push_back({byte, board.modbus.clock});
    }
  }
  void wait(std::uint32_t microseconds) {
    for (int pass = 0; pass < 4; ++pass) application().step_modbus();
    board.modbus.clock += microseconds;
    for (int pass = 0; pass < 4; ++pass) application().step_modbus();
  }
  Bytes said() {
    Bytes found;
    found.swap(board.modbus.from_device);
    return found;
  }
  /// What it says to a whole frame.
  Bytes hear(const Bytes& frame) {
    put(frame);
    wait(silence);
    return said();
  }
  /// The answer without address and checksum, both of which must be right.
  Bytes request(const Bytes& pdu) {
    Bytes frame{address};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    const Bytes found = hear(with_crc(frame));
    REQUIRE(found.size() >= 5);
    REQUIRE(found[0] == address);
    REQUIRE(with_crc(Bytes(found.begin(), found.end() - 2)) == found);
    return {found.begin() + 1, found.end() - 2};
  }
  Bytes read(std::uint8_t function, unsigned from, unsigned count) {
    Bytes pdu{function};
    put_word(pdu, from);
    put_word(pdu, count);
    return request(pdu);
  }
  unsigned word(std::uint8_t function, unsigned at) {
    const Bytes found = read(function, at, 1);
    REQUIRE(found.size() == 4);
    return unsigned{found[2]} << 8U | found[3];
  }
  std::uint32_t number(std::uint8_t function, unsigned at) {
    const Bytes found = read(function, at, 2);
    REQUIRE(found.size() == 6);
    return std::uint32_t{found[2]} << 24U | std::uint32_t{found[3]} << 16U | std::uint32_t{found[4]} << 8U |
           found[5];
  }
  std::string input(unsigned at) { return number_field(number(4, at)); }
  bool bit(std::uint8_t function, unsigned at) { return (read(function, at, 1).at(2) & 1U) != 0; }

  Bytes write_numbers(unsigned at, const std::vector<std::uint32_t>& numbers) {
    Bytes pdu{16};
    put_word(pdu, at);
    put_word(pdu, static_cast<unsigned>(2 * numbers.size()));
    pdu.push_back(static_cast<std::uint8_t>(4 * numbers.size()));
    for (const std::uint32_t each : numbers) put_number(pdu, each);
    return request(pdu);
  }
  Bytes write_coil(unsigned at, bool on) {
    Bytes pdu{5};
    put_word(pdu, at);
    put_word(pdu, on ? 0xFF00 : 0);
    return request(pdu);
  }
  Bytes write_register(unsigned at, unsigned value) {
    Bytes pdu{6};
    put_word(pdu, at);
    put_word(pdu, value);
    return request(pdu);
  }
  /// Writes number, time and readings, and has the sample taken.
  Bytes take(std::uint32_t sequence, const Readings& readings) {
    write_numbers(0, {sequence, monitor::bits_of(1)});
    std::vector<std::uint32_t> numbers;
    for (const Reading& each : readings) numbers.push_back(each ? monitor::bits_of(*each) : 0x7FC00000);
    write_numbers(100, numbers);
    return write_coil(0, true);
  }
};

Bytes refusal(std::uint8_t function, std::uint8_t exception) {
  return {static_cast<std::uint8_t>(function | 0x80U), exception};
}
/// Of the recorded experiment: anchor's cell, jack's cell, stroke of every cable.
Readings jacks(float first, float second, float third) {
  return {none, first, none, none, second, none, none, third, none};
}

}  // namespace

TEST_CASE("the checksum is that of Modbus") {
  // Of the check value of CRC-16/MODBUS in the catalogue of parametrised CRC algorithms, and of the usual
  // example of a request: 11 03 006B 0003 7687.
  monitor::ModbusCrc crc;
  for (const char digit : std::string("123456789")) crc.add(static_cast<std::uint8_t>(digit));
  CHECK(crc.value() == 0x4B37);
  const Bytes example{0x11, 0x03, 0x00, 0x6B, 0x00, 0x03};
  CHECK(with_crc(example) == Bytes{0x11, 0x03, 0x00, 0x6B, 0x00, 0x03, 0x76, 0x87});
  std::mt19937 random(11);
  for (int length = 1; length < 300; ++length) {
    Bytes bytes(static_cast<std::size_t>(length));
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    monitor::ModbusCrc found;
    found.add(bytes.data(), length);
    REQUIRE(found.value() == slow_crc(bytes));
  }
}

TEST_CASE("the silence is three and a half characters, at most 19200 bits a second") {
  CHECK(monitor::modbus_silence(9600) == 4010);
  CHECK(monitor::modbus_silence(19200) == 2005);
  CHECK(monitor::modbus_silence(115200) == 1750);
}

TEST_CASE("a master that samples by Modbus reads the bits that the frames have") {
  Bus bus;
  Plain other;
  settle(bus, rolling_joint);
  settle(other, rolling_joint);
  for (std::uint32_t number = 1; number <= 5; ++number) {
    const float force = 9000 * static_cast<float>(number);
    CHECK(bus.take(number, jacks(force, 40000, 0)) == Bytes{5, 0, 0, 0xFF, 0});
    const Fields answer = other.ask(sample(number, {force, 40000, 0}));
    constexpr std::size_t segments = 6, joints = 3;
    std::size_t at = 10;
    for (unsigned i = 0; i < segments; ++i) CHECK(bus.input(1000 + 2 * i) == answer.at(at++));
    for (unsigned j = 0; j < joints; ++j) CHECK(bus.input(5000 + 2 * j) == answer.at(at++));
    for (unsigned j = 0; j < joints; ++j) CHECK("sfbo"[bus.word(4, 10000 + j)] == answer.at(at)[j]);
    ++at;
    for (unsigned j = 0; j < joints; ++j) CHECK(bus.input(6000 + 2 * j) == answer.at(at++));
    for (unsigned j = 0; j < joints; ++j) CHECK(bus.input(7000 + 2 * j) == answer.at(at++));
    for (unsigned k = 0; k < 3; ++k) CHECK(bus.input(8000 + 2 * k) == answer.at(at++));
    for (unsigned i = 0; i < segments; ++i) CHECK(bus.input(2000 + 2 * i) == answer.at(at++));
    for (unsigned j = 0; j < joints; ++j) CHECK(bus.input(3000 + 2 * j) == answer.at(at++));
    for (unsigned j = 0; j < joints; ++j) CHECK(bus.input(4000 + 2 * j) == answer.at(at++));
    const std::size_t findings = bus.word(4, 9);
    REQUIRE(answer.size() == at + findings);
    for (unsigned k = 0; k < findings; ++k) CHECK(bus.input(100 + 2 * k) == answer.at(at++));
    CHECK(bus.number(4, 20) == number);
    CHECK(bus.word(4, 1) == 4);
    CHECK(bus.bit(2, 16));
  }
  // Also with struts and load factors, and asked for by frames on the other line.
  bus.write_register(10, truss_string);
  CHECK(bus.write_coil(2, true) == Bytes{5, 0, 2, 0xFF, 0});
  other.ask(choose(truss_string));
  CHECK(bus.word(4, 2) == truss_string);
  const unsigned struts = bus.word(4, 8);
  CHECK(struts > 0);
  for (std::uint32_t number = 1; number <= truss_log().size(); ++number) {
    const auto& row = truss_log()[number - 1];
    bus.take(number, {row[0], none, row[1], none});
    other.ask(sample(number, row));
    const Fields answer = other.ask("P");
    CHECK(state(bus.ask("P")) == state(answer));
    CHECK(bus.input(1002) == answer.at(11));
    CHECK(bus.input(9000) == answer.at(10 + 4 + 3 + 1 + 3 + 3 + 1));
  }
}

TEST_CASE("a block is read at once, and half of a number too") {
  Bus bus;
  settle(bus, rolling_joint);
  bus.take(1, jacks(40000, 0, 0));
  const Bytes block = bus.read(4, 1000, 12);
  REQUIRE(block.size() == 2 + 24);
  CHECK(block[1] == 24);
  // 40 kN at the jack of the first cable is its second segment: 0x471C4000.
  CHECK(Bytes(block.begin() + 6, block.begin() + 10) == Bytes{0x47, 0x1C, 0x40, 0x00});
  CHECK(bus.word(4, 1003) == 0x4000);
}

TEST_CASE("a sample that comes again is not taken again, and an old one refused") {
  Bus bus;
  settle(bus, rolling_joint);
  bus.take(7, jacks(40000, 0, 0));
  bus.take(8, jacks(30000, 0, 0));
  const Fields before = state(bus.ask("P"));
  CHECK(bus.take(8, jacks(5, 5, 5)) == Bytes{5, 0, 0, 0xFF, 0});
  CHECK(state(bus.ask("P")) == before);
  CHECK(bus.take(7, jacks(5, 5, 5)) == refusal(5, 3));
  bus.write_numbers(0, {9, monitor::bits_of(0)});
  CHECK(bus.write_coil(0, true) == refusal(5, 3));  // time stands still
  CHECK(state(bus.ask("P")) == before);
}

TEST_CASE("a reading that was not written for this sample is none") {
  Bus bus;
  settle(bus, rolling_joint);
  bus.take(1, jacks(20000, 0, 0));
  CHECK(bus.number(3, 102) == 0x7FC00000);
  bus.write_numbers(0, {2, monitor::bits_of(1)});
  bus.write_coil(0, true);
  Plain other;
  settle(other, rolling_joint);
  other.ask(sample(1, {20000, 0, 0}));
  CHECK(state(bus.ask("P")) == state(other.ask(sample_of(2, Readings(9)))));
}

TEST_CASE("coils lock off, zero, choose, acknowledge and set limits, as the frames do") {
  Bus bus;
  settle(bus, rolling_joint);
  bus.take(1, jacks(150, 0, 0));
  CHECK(bus.write_coil(1101, true) == Bytes{5, 0x04, 0x4D, 0xFF, 0});
  bus.take(2, jacks(40150, 10000, 0));
  CHECK(bus.input(1002) == real_field(40000));
  CHECK(bus.write_coil(1101, true) == refusal(5, 4));  // under load
  CHECK_FALSE(bus.bit(1, 103));
  CHECK(bus.write_coil(103, true) == Bytes{5, 0, 103, 0xFF, 0});
  CHECK(bus.bit(1, 103));
  bus.take(3, jacks(40150, 5, 0));
  CHECK(monitor::float_of(bus.number(4, 1006)) > 5000);
  CHECK(bus.write_coil(103, false) == Bytes{5, 0, 103, 0, 0});
  CHECK_FALSE(bus.bit(1, 103));
  CHECK(bus.write_coil(102, true) == refusal(5, 2));  // an anchor has no wedge
  CHECK(bus.write_coil(106, true) == refusal(5, 2));  // there is no such cable
  // Several in one request, but not with one that there is not.
  CHECK(bus.request({15, 0, 103, 0, 1, 1, 1}) == Bytes{15, 0, 103, 0, 1});
  CHECK(bus.bit(1, 103));
  CHECK(bus.request({15, 0, 101, 0, 3, 1, 5}) == refusal(15, 2));
  CHECK_FALSE(bus.bit(1, 101));

  bus.write_numbers(4, {monitor::bits_of(-200), monitor::bits_of(50000), 9});
  CHECK(bus.write_coil(3, true) == Bytes{5, 0, 3, 0xFF, 0});
  bus.take(4, jacks(60000, 0, 0));
  CHECK(bus.bit(2, static_cast<unsigned>(Alarm::sensor_range)));
  CHECK((bus.number(4, 22) >> static_cast<unsigned>(Alarm::sensor_range) & 1U) == 1);
  CHECK(bus.word(4, 1) == 1);
  CHECK_FALSE(bus.bit(2, 16));
  bus.write_coil(1, true);
  CHECK(bus.number(4, 22) == 0);
  bus.write_numbers(4, {monitor::bits_of(200), monitor::bits_of(50000), 9});
  CHECK(bus.write_coil(3, true) == refusal(5, 3));
  bus.write_register(10, 2);
  CHECK(bus.write_coil(2, true) == refusal(5, 3));
  CHECK_FALSE(bus.board.asked_to_restart);
  CHECK(bus.write_coil(4, true) == Bytes{5, 0, 4, 0xFF, 0});
  CHECK(bus.board.asked_to_restart);
}

TEST_CASE("what cannot be done is refused with the exception of the standard, and changes nothing") {
  Bus bus;
  settle(bus, rolling_joint);
  bus.take(1, jacks(40000, 0, 0));
  const Fields before = state(bus.ask("P"));
  for (unsigned function = 0; function < 128; ++function) {
    const bool is_known = (function >= 1 && function <= 6) || function == 15 || function == 16;
    if (is_known) continue;
    CHECK(bus.request({static_cast<std::uint8_t>(function), 0, 0, 0, 1}) ==
          refusal(static_cast<std::uint8_t>(function), 1));
  }
  CHECK(bus.read(4, 1012, 1) == refusal(4, 2));  // six segments
  CHECK(bus.read(4, 1010, 3) == refusal(4, 2));
  CHECK(bus.read(4, 16, 1) == refusal(4, 2));
  CHECK(bus.read(4, 38, 1) == refusal(4, 2));
  CHECK(bus.read(4, 9000, 1) == refusal(4, 2));  // no struts
  CHECK(bus.read(4, 10003, 1) == refusal(4, 2));
  CHECK(bus.read(4, 0xFFFF, 2) == refusal(4, 2));
  CHECK(bus.read(3, 11, 1) == refusal(3, 2));
  CHECK(bus.read(3, 118, 1) == refusal(3, 2));  // nine numbers
  CHECK(bus.read(1, 5, 1) == refusal(1, 2));
  CHECK(bus.read(2, 13, 1) == refusal(2, 2));
  for (std::uint8_t function = 1; function <= 4; ++function) {
    CHECK(bus.read(function, 0, 0) == refusal(function, 3));
    CHECK(bus.read(function, 0, function < 3 ? 2001 : 126) == refusal(function, 3));
    CHECK(bus.request({function, 0, 0, 0, 1, 0}) == refusal(function, 3));
    CHECK(bus.request({function, 0, 0, 0}) == refusal(function, 3));
  }
  CHECK(bus.request({5, 0, 1, 0x12, 0x34}) == refusal(5, 3));
  CHECK(bus.request({6, 0, 12, 0, 1}) == refusal(6, 2));
  CHECK(bus.request({15, 0, 0, 0, 1, 2, 0, 0}) == refusal(15, 3));
  CHECK(bus.request({15, 0, 0, 0, 9, 1, 0}) == refusal(15, 3));
  CHECK(bus.request({15}) == refusal(15, 3));
  CHECK(bus.request({16, 0, 0, 0, 1, 2, 0}) == refusal(16, 3));
  CHECK(bus.request({16, 0, 0, 0, 2, 2, 0, 0, 0, 0}) == refusal(16, 3));
  CHECK(bus.request({16, 0, 0, 0, 0, 0}) == refusal(16, 3));
  // Nothing is written where one of the registers is not there.
  CHECK(bus.request({16, 0, 9, 0, 3, 6, 0, 1, 0, 1, 0, 1}) == refusal(16, 2));
  CHECK(bus.word(3, 10) == 0);
  CHECK(bus.write_register(10, 1) == Bytes{6, 0, 10, 0, 1});
  CHECK(bus.word(3, 10) == 1);
  CHECK(state(bus.ask("P")) == before);
}

TEST_CASE("other devices, broadcasts, cut and torn frames are not answered") {
  Bus bus;
  settle(bus, rolling_joint);
  const Bytes good = with_crc({bus.address, 6, 0, 10, 0, 1});
  for (unsigned address = 0; address < 256; ++address)
    if (address != bus.address)
      CHECK(bus.hear(with_crc({static_cast<std::uint8_t>(address), 4, 0, 0, 0, 1})).empty());
  CHECK(bus.hear(with_crc({0, 6, 0, 10, 0, 3})).empty());
  CHECK(bus.word(3, 10) == 3);  // a broadcast is obeyed
  CHECK(bus.hear(with_crc({0, 99})).empty());
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      Bytes torn = good;
      torn[i] = static_cast<std::uint8_t>(torn[i] ^ 1U << bit);
      CHECK(bus.hear(torn).empty());
    }
    CHECK(bus.hear(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(i))).empty());
  }
  CHECK(bus.word(3, 10) == 3);
  CHECK(bus.number(4, 28) == 8 * good.size() + good.size() - 1);
  CHECK(bus.hear(good) == good);
  CHECK(bus.word(3, 10) == 1);
}

TEST_CASE("a frame ends by silence, not by its bytes, whatever the clock says") {
  Bus bus;
  settle(bus, rolling_joint);
  const Bytes good = with_crc({bus.address, 6, 0, 10, 0, 1});
  for (const std::uint32_t clock : {0U, 1000000U, 0xFFFFFFF0U, 0xFFFFF000U}) {
    bus.board.modbus.clock = clock;
    bus.put(good);
    bus.wait(silence - 1);
    CHECK(bus.said().empty());
    bus.wait(1);
    CHECK(bus.said() == good);
    // A pause of one and a half characters is none.
    bus.put(good, character * 3 / 2);
    bus.wait(silence);
    CHECK(bus.said() == good);
    // One of three and a half cuts it: neither part is a frame.
    const auto middle = good.begin() + 4;
    bus.put(Bytes(good.begin(), middle));
    bus.wait(silence);
    bus.put(Bytes(middle, good.end()));
    bus.wait(silence);
    CHECK(bus.said().empty());
    // Two frames without a pause are none.
    bus.put(good);
    bus.put(good);
    bus.wait(silence);
    CHECK(bus.said().empty());
  }
}

TEST_CASE("frames that came while the device was busy are told apart by their times") {
  Bus bus;
  settle(bus, rolling_joint);
  const Bytes good = with_crc({bus.address, 6, 0, 10, 0, 1});
  bus.put(with_crc({9, 4, 0, 0, 0, 1}));  // to another device, and its answer
  bus.board.modbus.clock += silence;
  bus.put(with_crc({9, 4, 2, 0, 7}));
  bus.board.modbus.clock += silence;
  bus.put(good);
  bus.wait(silence);
  CHECK(bus.said() == good);
  CHECK(bus.number(4, 28) == 0);
}

TEST_CASE("garbage of any length is survived, and the next frame is answered") {
  Bus bus;
  settle(bus, rolling_joint);
  const Fields before = state(bus.ask("P"));
  constexpr unsigned seed = 20261;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 2000; ++round) {
    Bytes garbage(random() % 600);
    for (auto& byte : garbage) byte = static_cast<std::uint8_t>(random());
    if (!garbage.empty() && random() % 2 == 0) garbage[0] = bus.address;
    bus.hear(garbage);
    REQUIRE(bus.word(4, 0) == monitor::modbus_map_version);
  }
  // With good checksums: whatever is asked, the answer is a frame. Writing is left out.
  for (int round = 0; round < 5000; ++round) {
    Bytes pdu(1 + random() % 12);
    for (auto& byte : pdu) byte = static_cast<std::uint8_t>(random() % (random() % 3 == 0 ? 256 : 4));
    pdu[0] = static_cast<std::uint8_t>(random() % 5);
    const Bytes answer = bus.request(pdu);
    REQUIRE((answer[0] & 0x7FU) == pdu[0]);
  }
  CHECK(state(bus.ask("P")) == before);
}

}  // namespace modbus_test
