// Talks to a device: sends what it is asked, again if need be, and reads the answers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/link.hpp"
#include "monitor/alarms.hpp"
#include "taut/status.hpp"

namespace monitor::host {

/// What an instrument says, or nothing.
using Reading = std::optional<float>;

/// What a device says of itself.
struct Information {
  std::uint32_t version = 0, scene = 0, scenes = 0;
  taut::Status status;
  std::uint32_t cables = 0, segments = 0, joints = 0, loads = 0, fingerprint = 0;
  bool has_last = false;
  std::uint32_t last = 0;
  Alarms latched;
  std::uint32_t bad_frames = 0, lost_bytes = 0, restarts = 0, start = 0, stack_used = 0, stack_size = 0,
                milliseconds = 0;
};

/// The answer to a sample.
struct DeviceAnswer {
  std::uint32_t sequence = 0;
  Quality quality = Quality::none;
  Alarms alarms;
  int events = 0;
  float fraction = 0;
  taut::Status status;
  std::vector<std::string> values;  ///< the fields that follow
};

/// A body as a frame, and the body of a line that is a good frame.
std::string framed(const std::string& body);
std::optional<std::string> body_of(const std::string& line);

std::string number_field(std::uint32_t value);
std::string real_field(float value);
std::string reading_field(const Reading& reading);
std::uint32_t number_of(const std::string& field);

/// The alarms as words with blanks between them.
std::string in_words(Alarms alarms);

/// Every function throws std::runtime_error if the device stays silent or refuses.
class Device {
 public:
  explicit Device(Link& link) : link_(link) {}

  Information information();
  Information choose(std::uint32_t scene);
  /// Numbers the sample and sends it until its answer comes. `dt` is the time since the last one; `numbers`
  /// are load factors, then for both ends of every open cable the force and, if it is jacked, the stroke.
  DeviceAnswer sample(float dt, const std::vector<Reading>& numbers);
  void lock(int cable, std::size_t end, bool locked);
  void set_limits(float least, float most, std::uint32_t frozen_after);
  /// As after a power failure; the device goes on where its record says.
  Information restart();

 private:
  std::vector<std::string> ask(const std::string& body, char kind, const std::string& first_field);

  Link& link_;
  std::uint32_t sequence_ = 0;
};

}  // namespace monitor::host
