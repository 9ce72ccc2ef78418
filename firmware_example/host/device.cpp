#include "host/device.hpp"

#include <sstream>
#include <stdexcept>

#include "monitor/crc32.hpp"
#include "monitor/frame.hpp"

namespace monitor::host {
namespace {

constexpr int most_attempts = 10;
constexpr int wait_milliseconds = 3000;

std::vector<std::string> fields_of(const std::string& body) {
  std::vector<std::string> fields;
  std::istringstream stream(body);
  for (std::string field; std::getline(stream, field, ' ');) fields.push_back(field);
  return fields;
}

std::uint32_t checksum(const std::string& text) {
  Crc32 crc;
  crc.add(text.data(), text.size());
  return crc.value();
}

[[noreturn]] void misunderstood() {
  throw std::runtime_error(
      "the device speaks another protocol; build firmware and host from the same sources");
}

const std::string& at(const std::vector<std::string>& fields, std::size_t i) {
  if (i >= fields.size()) misunderstood();
  return fields[i];
}

taut::Status status_at(const std::vector<std::string>& fields, std::size_t i) {
  taut::Status status;
  status.code = static_cast<taut::Code>(number_of(at(fields, i)));
  status.place = static_cast<taut::Place>(number_of(at(fields, i + 1)));
  status.index = static_cast<int>(number_of(at(fields, i + 2)));
  status.cable = static_cast<int>(number_of(at(fields, i + 3)));
  return status;
}

std::string remedy(const std::string& refusal) {
  if (refusal == "sequence") return "choose the scene again, that begins a new sequence";
  if (refusal == "fields") return "the device holds another scene: build the firmware for this one";
  if (refusal == "zero") return "take the load off before zeroing the cell";
  if (refusal == "cell") return "only open cables have cells, and only jacked ends are locked";
  return "see the table of refusals in firmware_example/README.md";
}

Information information_of(const std::vector<std::string>& fields) {
  Information found;
  std::size_t i = 1;
  const auto next = [&] { return number_of(at(fields, i++)); };
  found.version = next();
  if (found.version != protocol_version) misunderstood();
  found.scene = next();
  found.scenes = next();
  found.status = status_at(fields, i);
  i += 4;
  for (std::uint32_t* each :
       {&found.cables, &found.segments, &found.joints, &found.loads, &found.fingerprint})
    *each = next();
  found.has_last = next() != 0;
  found.last = next();
  found.latched = Alarms(next());
  for (std::uint32_t* each : {&found.bad_frames, &found.lost_bytes, &found.restarts, &found.start,
                              &found.stack_used, &found.stack_size, &found.milliseconds})
    *each = next();
  return found;
}

}  // namespace

std::string framed(const std::string& body) { return "$" + body + "*" + number_field(checksum(body)) + "\n"; }

std::optional<std::string> body_of(const std::string& line) {
  const std::size_t around = static_cast<std::size_t>(frame_overhead) - 1;
  if (line.size() <= around || line[0] != '$') return std::nullopt;
  const std::string body = line.substr(1, line.size() - around);
  return line + "\n" == framed(body) ? std::optional(body) : std::nullopt;
}

std::string number_field(std::uint32_t value) {
  std::string field;
  for (int shift = 28; shift >= 0; shift -= 4) field += "0123456789abcdef"[value >> shift & 0xFU];
  return field;
}
std::string real_field(float value) { return number_field(bits_of(value)); }
std::string reading_field(const Reading& reading) { return reading ? real_field(*reading) : "-"; }

std::uint32_t number_of(const std::string& field) {
  std::uint32_t value = 0;
  Fields fields(field.data(), static_cast<int>(field.size()));
  if (!fields.number(value) || !fields.done()) misunderstood();
  return value;
}

std::string in_words(Alarms alarms) {
  std::string words;
  for (int i = 0; i < alarm_count; ++i)
    if (alarms.has(static_cast<Alarm>(i))) words += (words.empty() ? "" : " ") + std::string(alarm_words[i]);
  return words;
}

Information Device::information() { return information_of(ask("I", 'I', "")); }

Information Device::choose(std::uint32_t scene) {
  sequence_ = 0;
  // The device greets with the same kind of frame, and while it starts it may not hear: only one about this
  // scene is the answer.
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    ask("C " + number_field(scene), 'I', "");
    const Information found = information();
    if (found.scene == scene && !found.has_last) return found;
  }
  throw std::runtime_error("the device does not take up the scene; restart it");
}

DeviceAnswer Device::sample(float dt, const std::vector<Reading>& numbers) {
  const std::string sequence = number_field(++sequence_);
  std::string body = "S " + sequence + " " + real_field(dt);
  for (const Reading& each : numbers) body += " " + reading_field(each);
  const std::vector<std::string> fields = ask(body, 'A', sequence);
  DeviceAnswer answer;
  answer.sequence = sequence_;
  answer.quality = static_cast<Quality>(at(fields, 2)[0]);
  answer.alarms = Alarms(number_of(at(fields, 3)));
  answer.events = static_cast<int>(number_of(at(fields, 4)));
  answer.fraction = float_of(number_of(at(fields, 5)));
  answer.status = status_at(fields, 6);
  answer.values.assign(fields.begin() + 10, fields.end());
  return answer;
}

void Device::lock(int cable, std::size_t end, bool locked) {
  const std::string letter = locked ? "L" : "J";
  ask(letter + " " + number_field(static_cast<std::uint32_t>(cable)) + " " +
          number_field(static_cast<std::uint32_t>(end)),
      'K', letter);
}

void Device::set_limits(float least, float most, std::uint32_t frozen_after) {
  ask("G " + real_field(least) + " " + real_field(most) + " " + number_field(frozen_after), 'K', "G");
}

Information Device::restart() {
  ask("R", 'K', "R");
  while (const auto line = link_.receive(wait_milliseconds)) {
    const auto said = body_of(*line);
    if (said && said->front() == 'I') break;
  }
  return information();
}

std::vector<std::string> Device::ask(const std::string& body, char kind, const std::string& first_field) {
  std::string refusal;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    link_.send(framed(body));
    while (const auto line = link_.receive(wait_milliseconds)) {
      const auto said = body_of(*line);
      if (!said) break;
      std::vector<std::string> fields = fields_of(*said);
      if (fields[0] == "E") {
        refusal = at(fields, 1);
        // Noise on the line: say it again.
        if (refusal == "frame") break;
        throw std::runtime_error("the device refuses \"" + body.substr(0, 1) + "\": " + refusal + "; " +
                                 remedy(refusal));
      }
      if (fields[0][0] == kind && (first_field.empty() || at(fields, 1) == first_field)) return fields;
    }
  }
  throw std::runtime_error(refusal.empty() ? "the device does not answer; is it running?"
                                           : "the line to the device is too noisy; check its cable");
}

}  // namespace monitor::host
