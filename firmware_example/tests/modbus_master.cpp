// libmodbus as the master of the firmware, over a serial line of this computer.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "host/device.hpp"
#include "host/process_link.hpp"
#include "monitor/frame.hpp"
#include "monitor/settings.hpp"

namespace {

using monitor::host::Device;
using monitor::host::Reading;

/// Slow, so that a busy machine does not cut a frame by a silence.
constexpr int baud = 1200;

/// A wire between two pseudo-terminals.
class Wire {
 public:
  Wire() {
    for (End& end : ends_) {
      std::array<char, 256> path{};
      int device = -1;
      termios raw{};
      cfmakeraw(&raw);
      REQUIRE(openpty(&end.side, &device, path.data(), &raw, nullptr) == 0);
      end.path = path.data();
      end.device = device;  // held, so that the terminal outlives whoever opens it
    }
    thread_ = std::thread([this] { carry(); });
  }
  ~Wire() {
    ends_over_ = true;
    thread_.join();
    for (const End& end : ends_) {
      close(end.side);
      close(end.device);
    }
  }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  const std::string& path(std::size_t end) const { return ends_[end].path; }
  std::atomic<int> torn{0};  ///< so many of the next bytes to the device become others

 private:
  struct End {
    int side = -1, device = -1;
    std::string path;
  };
  void carry() {
    while (!ends_over_) {
      std::array<pollfd, 2> waiting{{{ends_[0].side, POLLIN, 0}, {ends_[1].side, POLLIN, 0}}};
      if (poll(waiting.data(), 2, 20) <= 0) continue;
      for (std::size_t from = 0; from < 2; ++from) {
        if ((waiting[from].revents & POLLIN) == 0) continue;
        std::array<unsigned char, 512> bytes{};
        const ssize_t count = ::read(ends_[from].side, bytes.data(), bytes.size());
        for (ssize_t i = 0; i < count && from == 0 && torn > 0; ++i, --torn)
          bytes[static_cast<std::size_t>(i)] ^= 0x10U;
        if (count > 0)
          REQUIRE(::write(ends_[1 - from].side, bytes.data(), static_cast<std::size_t>(count)) == count);
      }
    }
  }

  std::array<End, 2> ends_;
  std::atomic<bool> ends_over_{false};
  std::thread thread_;
};

/// The command that starts the firmware with `line` as its Modbus line. MONITOR_DEVICE may name another, with
/// an @ for the line: that of an emulator.
std::string device(const std::string& line) {
  const char* const other = std::getenv("MONITOR_DEVICE");
  std::string command =
      other != nullptr ? other : "'" MONITOR_FIRMWARE "' --modbus @ " + std::to_string(baud);
  const std::size_t at = command.find('@');
  REQUIRE(at != std::string::npos);
  return command.replace(at, 1, line);
}

/// The firmware as a process, with both of its lines.
class Site {
 public:
  Site()
      : link_(device(wire.path(1))),
        frames(link_),
        master_(modbus_new_rtu(wire.path(0).c_str(), baud, 'E', 8, 1)) {
    REQUIRE(master_ != nullptr);
    REQUIRE(modbus_set_slave(master_, monitor::Settings::modbus_address) == 0);
    REQUIRE(modbus_connect(master_) == 0);
    modbus_set_response_timeout(master_, 2, 0);
    frames.choose(0);
  }
  ~Site() {
    modbus_close(master_);
    modbus_free(master_);
  }
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  Wire wire;

 private:
  monitor::host::ProcessLink link_;

 public:
  Device frames;
  modbus_t* master() const { return master_; }
  /// What `request` returns of the master. Repeated where no answer came, as masters do: a busy machine can
  /// cut a frame by a silence.
  template <class Request>
  int ask(const Request& request) const {
    constexpr int attempts = 5;
    int answer = -1;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      errno = 0;
      answer = request(master_);
      if (answer >= 0 || errno != ETIMEDOUT) break;
    }
    return answer;
  }

  std::vector<float> reals(int at, int count) const {
    std::vector<std::uint16_t> words(static_cast<std::size_t>(2 * count));
    REQUIRE(ask([&](modbus_t* master) {
              return modbus_read_input_registers(master, at, 2 * count, words.data());
            }) == 2 * count);
    std::vector<float> found;
    for (std::size_t i = 0; i < words.size(); i += 2) found.push_back(modbus_get_float_abcd(&words[i]));
    return found;
  }
  void write(int at, const std::vector<float>& values) const {
    // By hand: modbus_set_float_abcd() of libmodbus 3.1.6 swaps the bytes of each register.
    std::vector<std::uint16_t> words;
    for (const float value : values) {
      words.push_back(static_cast<std::uint16_t>(monitor::bits_of(value) >> 16U));
      words.push_back(static_cast<std::uint16_t>(monitor::bits_of(value) & 0xFFFFU));
    }
    const int count = static_cast<int>(words.size());
    REQUIRE(ask([&](modbus_t* master) { return modbus_write_registers(master, at, count, words.data()); }) ==
            count);
  }

 private:
  modbus_t* master_;
};

float real(const std::string& field) { return monitor::float_of(monitor::host::number_of(field)); }
constexpr int segments = 6, joints = 3;

}  // namespace

TEST_CASE("libmodbus reads the forces that the frames have") {
  const Site site;
  Device frames = site.frames;
  const auto answer = frames.sample(1, {Reading(), 40000.0F, {}, {}, 30000.0F, {}, {}, 20000.0F, {}});
  const auto forces = site.reals(1000, segments), deviations = site.reals(2000, segments);
  for (std::size_t i = 0; i < segments; ++i) {
    CHECK(forces[i] == real(answer.values.at(i)));
    CHECK(deviations[i] == real(answer.values.at(segments + 4 * joints + 1 + i)));
  }
  CHECK(forces[1] == 40000);
  CHECK(site.reals(3000, joints)[0] > 0);
}

TEST_CASE("libmodbus samples with registers and a coil, and locks off with another") {
  const Site site;
  const float none = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::vector<float>> rows = {{0, 0, 0}, {20000, 40000, 100}, {40000, 30000, 200}};
  std::uint16_t sequence = 0;
  for (const auto& row : rows) {
    REQUIRE(site.ask([&](modbus_t* master) { return modbus_write_register(master, 0, 0); }) == 1);
    ++sequence;
    REQUIRE(site.ask([&](modbus_t* master) { return modbus_write_register(master, 1, sequence); }) == 1);
    site.write(100, {none, row[0], none, none, row[1], none, none, row[2], none});
    REQUIRE(site.ask([&](modbus_t* master) { return modbus_write_bit(master, 0, 1); }) == 1);
  }
  const auto forces = site.reals(1000, segments);
  // Yan et al. (2015), Table 4: of the first cable 33.35 kN of 40 kN arrive.
  CHECK(forces[0] == doctest::Approx(33350).epsilon(1e-4));
  CHECK(forces[1] == 40000);
  std::array<std::uint16_t, 4> words{};
  REQUIRE(site.ask([&](modbus_t* master) { return modbus_read_registers(master, 0, 2, words.data()); }) == 2);
  CHECK(words[1] == 3);

  const std::array<std::uint8_t, 5> locked{1, 0, 1, 0, 1};
  CHECK(site.ask([&](modbus_t* master) { return modbus_write_bits(master, 101, 5, locked.data()); }) == -1);
  CHECK(errno == EMBXILADD);  // between the jacks there are anchors
  REQUIRE(site.ask([&](modbus_t* master) { return modbus_write_bit(master, 101, 1); }) == 1);
  std::array<std::uint8_t, 12> bits{};
  REQUIRE(site.ask([&](modbus_t* master) { return modbus_read_bits(master, 101, 1, bits.data()); }) == 1);
  CHECK(bits[0] == 1);
  REQUIRE(site.ask([&](modbus_t* master) { return modbus_read_input_bits(master, 0, 12, bits.data()); }) ==
          12);
  CHECK(bits[11] == 1);  // it was switched on
  REQUIRE(site.ask([&](modbus_t* master) { return modbus_write_bit(master, 1, 1); }) == 1);
  REQUIRE(site.ask([&](modbus_t* master) { return modbus_read_input_bits(master, 0, 12, bits.data()); }) ==
          12);
  CHECK(bits[11] == 0);
}

TEST_CASE("libmodbus is told what is wrong, and nothing by a device that is not addressed") {
  const Site site;
  std::array<std::uint16_t, 4> words{};
  CHECK(site.ask([&](modbus_t* master) {
    return modbus_read_input_registers(master, 1000 + 2 * segments, 1, words.data());
  }) == -1);
  CHECK(errno == EMBXILADD);
  REQUIRE(site.ask([&](modbus_t* master) { return modbus_write_register(master, 10, 77); }) == 1);
  CHECK(site.ask([&](modbus_t* master) { return modbus_write_bit(master, 2, 1); }) == -1);
  CHECK(errno == EMBXILVAL);
  modbus_set_response_timeout(site.master(), 0, 300000);
  REQUIRE(modbus_set_slave(site.master(), 2) == 0);
  CHECK(modbus_read_input_registers(site.master(), 0, 1, words.data()) == -1);
  CHECK(errno == ETIMEDOUT);
  modbus_set_response_timeout(site.master(), 2, 0);
  REQUIRE(modbus_set_slave(site.master(), monitor::Settings::modbus_address) == 0);
  REQUIRE(site.ask([&](modbus_t* master) {
    return modbus_read_input_registers(master, 0, 1, words.data());
  }) == 1);
}

TEST_CASE("a request that noise has torn is not answered, and the next one is") {
  Site site;
  std::array<std::uint16_t, 4> words{};
  for (int round = 0; round < 5; ++round) {
    site.wire.torn = 1 + round;
    modbus_set_response_timeout(site.master(), 0, 300000);
    CHECK(modbus_read_input_registers(site.master(), 0, 1, words.data()) == -1);
    CHECK(errno == ETIMEDOUT);
    modbus_set_response_timeout(site.master(), 2, 0);
    REQUIRE(site.ask([&](modbus_t* master) {
      return modbus_read_input_registers(master, 28, 2, words.data());
    }) == 2);
    CHECK(words[1] == round + 1);
  }
}

TEST_CASE("after a restart on command the device answers with what it knew") {
  const Site site;
  Device frames = site.frames;
  frames.sample(1, {Reading(), 40000.0F, {}, {}, 30000.0F, {}, {}, 20000.0F, {}});
  const auto before = site.reals(1000, segments);
  REQUIRE(site.ask([&](modbus_t* master) { return modbus_write_bit(master, 4, 1); }) == 1);
  // While it starts it does not hear.
  std::array<std::uint16_t, 2> words{};
  bool answers = false;
  for (int attempt = 0; attempt < 10 && !answers; ++attempt)
    answers = modbus_read_input_registers(site.master(), 0, 1, words.data()) == 1;
  CHECK(site.reals(1000, segments) == before);
  REQUIRE(site.ask([&](modbus_t* master) {
    return modbus_read_input_registers(master, 32, 2, words.data());
  }) == 2);
  CHECK(words[1] == 1);
}
