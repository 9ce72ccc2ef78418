#include "lib/live/frame_rows.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr std::size_t digits_of_a_number = 8;

// As in Ethernet and zip, bit by bit: a line has few bytes.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

// Lower-case digits alone.
std::optional<std::uint32_t> number(std::string_view text) {
  std::uint32_t value = 0;
  if (text.size() != digits_of_a_number ||
      text.find_first_not_of("0123456789abcdef") != std::string_view::npos)
    return std::nullopt;
  std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return value;
}

// By its IEEE bits; one that is no number is nothing.
std::optional<double> real(std::string_view text) {
  const std::optional<std::uint32_t> bits = number(text);
  if (!bits) return std::nullopt;
  float value = 0;
  std::memcpy(&value, &*bits, sizeof value);
  if (!std::isfinite(value)) return std::nullopt;
  return static_cast<double>(value);
}

std::vector<std::string_view> split(std::string_view body) {
  std::vector<std::string_view> fields;
  for (std::size_t end = body.find(' '); end != std::string_view::npos; end = body.find(' ')) {
    fields.push_back(body.substr(0, end));
    body.remove_prefix(end + 1);
  }
  fields.push_back(body);
  return fields;
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

}  // namespace

std::optional<std::string_view> frame_body(std::string_view line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
  // Of a frame that was cut short only the rest of the line counts.
  const std::size_t begin = line.rfind('$');
  if (begin == std::string_view::npos || line.size() - begin < digits_of_a_number + 3) return std::nullopt;
  const std::string_view body = line.substr(begin + 1, line.size() - begin - 2 - digits_of_a_number);
  if (line[line.size() - 1 - digits_of_a_number] != '*') return std::nullopt;
  const std::optional<std::uint32_t> given = number(line.substr(line.size() - digits_of_a_number));
  if (!given || *given != crc32(body)) return std::nullopt;
  return body;
}

FrameRows::FrameRows(const SceneDescription& scene) : scene_(scene), locked_(scene.cables.size()) {
  header_ = "time";
  for (const LoadDescription& load : scene.loads) header_ += "," + quoted(load.name);
  for (const CableDescription& cable : scene.cables)
    for (std::size_t end = 0; end < 2 && !cable.closed; ++end) {
      const std::string name = cable.name + "." + end_name(end);
      header_ += "," + quoted(name);
      if (cable.is_jacked(end)) header_ += "," + quoted(name + ".stroke") + "," + quoted(name + ".locked");
    }
}

std::optional<std::string> FrameRows::row(const std::string& line) {
  const std::optional<std::string_view> body = frame_body(line);
  if (!body) return line;
  const std::vector<std::string_view> fields = split(*body);
  if (fields[0] == "S") {
    const std::optional<std::uint32_t> sequence = fields.size() > 1 ? number(fields[1]) : std::nullopt;
    if (sequence && sequence == sequence_) return std::nullopt;
    std::optional<std::string> found = sample(fields);
    if (!found) return line;
    sequence_ = sequence;
    return found;
  }
  if (fields[0] == "C") {
    sequence_.reset();
    locked_.assign(locked_.size(), {});
  }
  if ((fields[0] == "L" || fields[0] == "J") && !lock(fields, fields[0] == "L")) return line;
  return std::nullopt;
}

std::optional<std::string> FrameRows::sample(const std::vector<std::string_view>& fields) {
  std::size_t at = 2;
  const auto next = [&] { return at < fields.size() ? fields[at++] : std::string_view(); };
  const std::optional<double> dt = real(next());
  if (!dt || !(*dt > 0)) return std::nullopt;
  const double time = has_row_ ? time_ + *dt : 0;
  std::string text = plain(time);
  for (std::size_t i = 0; i < scene_.loads.size(); ++i) {
    const std::optional<double> factor = real(next());
    if (!factor) return std::nullopt;
    text += "," + plain(*factor);
  }
  bool fits = true;
  const auto reading = [&] {
    const std::string_view field = next();
    const std::optional<double> value = real(field);
    fits = fits && (value || field == "-");
    return "," + (value ? plain(*value) : std::string());
  };
  for (std::size_t c = 0; c < scene_.cables.size(); ++c)
    for (std::size_t end = 0; end < 2 && !scene_.cables[c].closed; ++end) {
      text += reading();
      if (scene_.cables[c].is_jacked(end)) text += reading() + (locked_[c][end] ? ",1" : ",0");
    }
  if (!fits || at != fields.size()) return std::nullopt;
  time_ = time;
  has_row_ = true;
  return text + "\n";
}

bool FrameRows::lock(const std::vector<std::string_view>& fields, bool is_locked) {
  if (fields.size() != 3) return false;
  const std::optional<std::uint32_t> cable = number(fields[1]), end = number(fields[2]);
  if (!cable || !end || *cable >= locked_.size() || *end > 1 || !scene_.cables[*cable].is_jacked(*end))
    return false;
  locked_[*cable][*end] = is_locked;
  return true;
}

}  // namespace taut::host
