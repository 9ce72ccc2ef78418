#include "lib/files/state_file.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <tuple>

#include "lib/files/input_error.hpp"

namespace taut::host {
namespace {

// The number grows with every change of what is in it.
constexpr const char *magic = "taut-state-4", *family = "taut-state-";

// What lies in memory as this program has it.
std::string build() { return fingerprint(TAUT_VERSION " " __VERSION__); }

std::string exact(double number) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%a", number);
  return digits.data();
}

template <class Visit>
void for_each_instrument(SceneDescription& scene, const Visit& visit) {
  for (CableDescription& cable : scene.cables) {
    for (InstrumentDescription& cell : cable.cell) visit(cell);
    for (InstrumentDescription& stroke : cable.stroke) visit(stroke);
    for (InstrumentDescription& force : cable.force) visit(force);
  }
  for (StrutDescription& strut : scene.struts) visit(strut.gauge);
}

/// The words and numbers of the head of a state.
class Head {
 public:
  Head(const std::string& path, const std::string& text) : path_(path), text_(text), stream_(text) {}

  std::string word() {
    std::string found;
    if (!(stream_ >> found)) fail();
    return found;
  }
  double number() {
    const std::string found = word();
    char* end = nullptr;
    const double value = std::strtod(found.c_str(), &end);
    if (*end != '\0') fail();
    return value;
  }
  std::size_t count() {
    const double found = number();
    if (!(found >= 0 && found <= static_cast<double>(text_.size()))) fail();
    return static_cast<std::size_t>(found);
  }
  /// So many bits as a number; not all of them are zero.
  std::uint32_t bits(int most) {
    const double found = number();
    if (!(found >= 1 && found < std::ldexp(1, most))) fail();
    return static_cast<std::uint32_t>(found);
  }
  std::vector<double> numbers() {
    std::vector<double> all(count());
    for (double& value : all) value = number();
    return all;
  }
  /// All that follows the present line.
  std::string rest() {
    if (stream_.get() != '\n') fail();
    return text_.substr(static_cast<std::size_t>(stream_.tellg()));
  }
  [[noreturn]] void fail() const {
    throw InputError(path_, "", "is not a whole state", "name a file that --state has written, or a new one");
  }

 private:
  const std::string& path_;
  const std::string& text_;
  std::istringstream stream_;
};

void write(std::string& text, const std::vector<double>& numbers) {
  text += std::to_string(numbers.size());
  for (const double number : numbers) text += ' ' + exact(number);
  text += '\n';
}

// As numbers, which hold them exactly.
std::vector<double> numbers_of(const std::optional<Moment>& origin) {
  if (!origin) return {};
  return {static_cast<double>(origin->seconds), static_cast<double>(origin->nanoseconds),
          origin->has_zone ? 1.0 : 0.0};
}
std::optional<Moment> origin_of(const std::vector<double>& numbers) {
  if (numbers.size() != 3) return std::nullopt;
  return Moment{static_cast<std::int64_t>(numbers[0]), static_cast<std::int32_t>(numbers[1]),
                numbers[2] == 1};
}

}  // namespace

// FNV-1a, 64 bits.
std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

std::vector<double> assumptions(const SceneDescription& scene) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> all;
  SceneDescription copy = scene;
  for_each_instrument(copy, [&](const InstrumentDescription& instrument) {
    all.push_back(instrument.is_assumed ? 2 : instrument.is_given ? 1 : 0);
    all.push_back(instrument.has_free_zero ? 1 : 0);
    all.push_back(instrument.part_sd);
    for (const auto& value : {instrument.sd, instrument.gain_sd, instrument.zero_sd})
      all.push_back(value.value_or(nothing));
  });
  return all;
}

void assume(const std::vector<double>& assumed, SceneDescription& scene) {
  std::size_t i = 0;
  for_each_instrument(scene, [&](InstrumentDescription& instrument) {
    instrument.is_assumed = assumed[i] == 2;
    instrument.is_given = assumed[i++] > 0;
    instrument.has_free_zero = assumed[i++] == 1;
    instrument.part_sd = assumed[i++];
    for (auto* value : {&instrument.sd, &instrument.gain_sd, &instrument.zero_sd}) {
      const double number = assumed[i++];
      *value = number == number ? std::optional<double>(number) : std::nullopt;
    }
  });
}

std::string state_text(const SavedState& state, const std::string& scene_text) {
  std::string body = exact(state.time) + '\n';
  write(body, numbers_of(state.origin));
  write(body, state.assumed);
  write(body, state.factor);
  std::vector<double> ends;
  for (const auto& cable : state.cables)
    for (const EndRow& end : cable) {
      ends.push_back(end.force);
      ends.push_back(end.locked ? 1 : 0);
    }
  write(body, ends);
  body += std::to_string(state.verdict.raised.size());
  for (const auto& [word, rows] : state.verdict.raised) body += ' ' + word + ' ' + std::to_string(rows);
  body += '\n';
  std::vector<double> locks;
  for (const auto& cable : state.verdict.locks)
    for (const UnsaidLock::Memory& end : cable) locks.insert(locks.end(), end.begin(), end.end());
  write(body, locks);
  body += std::to_string(state.bytes.size()) + '\n' + state.bytes;
  return std::string(magic) + ' ' + build() + ' ' + state.scalar + ' ' + fingerprint(scene_text) + ' ' +
         fingerprint(body) + '\n' + body;
}

SavedState read_state(const std::string& path, const std::string& text, const std::string& scene_text,
                      const std::string& scalar) {
  const std::string new_one = "name a new file: it begins anew";
  Head head(path, text);
  const std::string found_magic = head.word();
  if (found_magic == "taut-watch-1")
    throw InputError(path, "", "is the state of taut watch",
                     "go on with taut watch, or name a new file: it begins anew");
  const bool is_other = found_magic != magic;
  if (is_other && found_magic.rfind(family, 0) != 0) head.fail();
  if (is_other || head.word() != build())
    throw InputError(path, "", "was written by another version or build of taut", new_one);
  if (const std::string found = head.word(); found != scalar)
    throw InputError(path, "", "was written with --scalar " + found, "write --scalar " + found);
  if (head.word() != fingerprint(scene_text))
    throw InputError(path, "", "belongs to another scene, or the scene file has changed", new_one);
  const std::string body_fingerprint = head.word(), body = head.rest();
  if (fingerprint(body) != body_fingerprint) head.fail();
  Head rest(path, body);
  SavedState state;
  state.scalar = scalar;
  state.time = rest.number();
  state.origin = origin_of(rest.numbers());
  state.assumed = rest.numbers();
  state.factor = rest.numbers();
  const std::vector<double> ends = rest.numbers();
  state.cables.resize(ends.size() / 4);
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    EndRow& end = state.cables[i / 4][i % 4 / 2];
    end.force = ends[i];
    end.locked = ends[i + 1] == 1;
  }
  for (std::size_t words = rest.count(); words > 0; --words) {
    const std::string word = rest.word();
    state.verdict.raised[word] = rest.bits(Verdict::rows);
  }
  const std::vector<double> locks = rest.numbers();
  constexpr std::size_t each = std::tuple_size_v<UnsaidLock::Memory>;
  if (locks.size() != 2 * each * state.cables.size()) rest.fail();
  state.verdict.locks.resize(state.cables.size());
  for (std::size_t i = 0; i < locks.size(); ++i)
    state.verdict.locks[i / (2 * each)][i / each % 2][i % each] = locks[i];
  const std::size_t size = rest.count();
  state.bytes = rest.rest();
  if (state.bytes.size() != size) head.fail();
  return state;
}

}  // namespace taut::host
