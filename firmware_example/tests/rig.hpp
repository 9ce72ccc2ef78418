// A device on a bench: the application on a board of memory, with frames put together by hand.
#pragma once

#include <doctest/doctest.h>

#include <cstddef>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "host/device.hpp"
#include "host/memory_monitor.hpp"

namespace rig {

using monitor::Alarm;
using monitor::Alarms;
using monitor::host::framed;
using monitor::host::number_field;
using monitor::host::real_field;

using Fields = std::vector<std::string>;

inline Fields fields_of(const std::string& body) {
  Fields fields;
  std::istringstream stream(body);
  for (std::string field; std::getline(stream, field, ' ');) fields.push_back(field);
  return fields;
}

/// Every application stands at the same address, as on a device.
template <class Application, class Board = monitor::host::MemoryBoard>
class Rig {
 public:
  Board board;

  Rig() { boot(); }
  ~Rig() { application().~Application(); }
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// The power comes (back).
  void boot() {
    if (booted_) application().~Application();
    booted_ = true;
    board.power_on();
    new (room_) Application(board);
    application().begin();
    greeting = one_answer();
  }
  Application& application() { return *reinterpret_cast<Application*>(room_); }

  void run() {
    do application().step();
    while (!board.line_is_empty());
  }
  /// All good frames that the device has sent.
  std::vector<Fields> answers() {
    std::vector<Fields> found;
    std::istringstream stream(board.from_device);
    for (std::string line; std::getline(stream, line);) {
      const auto body = monitor::host::body_of(line);
      REQUIRE_MESSAGE(body.has_value(), "the device sent no frame: " << line);
      found.push_back(fields_of(*body));
    }
    board.from_device.clear();
    return found;
  }
  Fields one_answer() {
    const auto found = answers();
    REQUIRE(found.size() == 1);
    return found[0];
  }
  Fields ask_raw(const std::string& bytes) {
    board.to_device += bytes;
    run();
    return one_answer();
  }
  Fields ask(const std::string& body) { return ask_raw(framed(body)); }

  Fields greeting;

 private:
  alignas(Application) std::byte room_[sizeof(Application)];
  bool booted_ = false;
};

using monitor::host::Reading;
using Readings = std::vector<Reading>;
/// An instrument that is not read.
inline constexpr Reading none;

/// A second after the one before.
inline std::string sample_of(std::uint32_t sequence, const Readings& numbers, float dt = 1) {
  std::string body = "S " + number_field(sequence) + " " + real_field(dt);
  for (const Reading& each : numbers) body += " " + monitor::host::reading_field(each);
  return body;
}
/// The jacks' cells alone: three forces are the recorded experiment, a factor and a force the truss string.
inline std::string sample(std::uint32_t sequence, const std::vector<float>& numbers) {
  Readings all;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers.size() == 2 && i == 0)
      all.emplace_back(numbers[i]);
    else
      all.insert(all.end(), {Reading(), Reading(numbers[i]), Reading()});
  }
  return sample_of(sequence, all);
}

/// What an answer says.
inline char quality(const Fields& answer) { return answer.at(2)[0]; }
inline Alarms alarms(const Fields& answer) { return Alarms(monitor::host::number_of(answer.at(3))); }
inline std::uint32_t sequence(const Fields& answer) { return monitor::host::number_of(answer.at(1)); }
inline float real(const std::string& field) { return monitor::float_of(monitor::host::number_of(field)); }
/// Tension of a segment [N].
inline float tension(const Fields& answer, std::size_t segment) { return real(answer.at(10 + segment)); }
inline Fields tensions(const Fields& answer, int segments) {
  return Fields(answer.begin() + 10, answer.begin() + 10 + segments);
}
/// Forces, slips, states and all: what must not depend on what happened to the line or the power.
inline Fields state(const Fields& answer) { return Fields(answer.begin() + 10, answer.end()); }

using Plain = Rig<monitor::host::MemoryMonitor>;
/// The recorded experiment has three jacks, the truss string a load and a jack.
constexpr std::uint32_t rolling_joint = 0, truss_string = 1;
inline std::string choose(std::uint32_t scene) { return "C " + number_field(scene); }

/// The restart of the first boot is no news in the tests.
inline void settle(Plain& rig, std::uint32_t scene) {
  rig.ask("Q");
  rig.ask(choose(scene));
  rig.ask("P");
}

/// A tensioning of the truss string: load factor, jack force.
inline const std::vector<std::vector<float>>& truss_log() {
  static const std::vector<std::vector<float>> log = {{0, 25000},     {0.2F, 60000},  {0.2F, 110000},
                                                      {0.2F, 95000},  {0.4F, 130000}, {0.4F, 190000},
                                                      {1.0F, 170000}, {1.0F, 240000}, {0.5F, 90000}};
  return log;
}

}  // namespace rig
