#include "lib/files/result_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "lib/files/number_range.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

template <class Unsigned, class Float>
void append_bits(std::string& text, Float value) {
  static_assert(sizeof(Unsigned) == sizeof(Float), "one bit pattern for every value");
  Unsigned bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (int shift = static_cast<int>(sizeof bits) * 8 - 4; shift >= 0; shift -= 4) {
    text += "0123456789abcdef"[bits >> shift & 0xFU];
  }
}

template <class Float>
void append_shortest(std::string& text, Float value) {
  std::array<char, 32> digits{};
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

// Grows one line of a result, field by field.
class Line {
 public:
  explicit Line(const NumberFormat& format) : format_(format) {}

  void number(double value) {
    comma();
    append_number(text_, value, format_);
  }
  void number(const std::vector<double>& values, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) number(values[first + i]);
  }
  void field(const std::string& text) {
    comma();
    text_ += text;
  }
  void numbered(const std::string& stem, std::size_t count) {
    for (std::size_t i = 1; i <= count; ++i) field(stem + std::to_string(i));
  }
  std::string finished() { return text_ + "\n"; }

 private:
  void comma() {
    if (!text_.empty()) text_ += ',';
  }

  NumberFormat format_;
  std::string text_;
};

using host::is_possible;

bool is_possible(const Answer& answer) {
  const auto all = [](const auto& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double number) { return is_possible(number); });
  };
  return all(answer.tension) && all(answer.slip) && all(answer.contact) && all(answer.friction) &&
         all(answer.strut) && all(answer.deviation) && all(answer.mu) && all(answer.mu_deviation) &&
         std::all_of(answer.payout.begin(), answer.payout.end(), all);
}

}  // namespace

const char* state_word(JointState state) {
  switch (state) {
    case JointState::stick:
      return "stick";
    case JointState::forward:
      return "forward";
    case JointState::backward:
      return "backward";
    case JointState::open:
      return "open";
  }
  return "unknown";
}

void append_number(std::string& text, double value, const NumberFormat& format) {
  const bool single = format.scalar == ScalarType::float32;
  const auto rounded = static_cast<float>(value);
  if (format.hex && single) {
    append_bits<std::uint32_t>(text, rounded);
  } else if (format.hex) {
    append_bits<std::uint64_t>(text, value);
  } else if (single) {
    append_shortest(text, rounded);
  } else {
    append_shortest(text, value);
  }
}

std::string impossible_number(const SceneDescription& scene, const Answer& answer) {
  if (is_possible(answer)) return "";
  std::string found;
  const auto check = [&](const std::string& name, const std::vector<double>& numbers, std::size_t first,
                         std::size_t count) {
    for (std::size_t i = 0; i < count && found.empty() && first + i < numbers.size(); ++i)
      if (const double number = numbers[first + i]; !is_possible(number))
        found = name + std::to_string(i + 1) + " is " + plain(number);
  };
  std::size_t segment = 0, joint = 0;
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const CableDescription& cable = scene.cables[c];
    const std::size_t segments = cable.segments(), joints = cable.joints();
    check(cable.name + ".T", answer.tension, segment, segments);
    check(cable.name + ".slip", answer.slip, joint, joints);
    check(cable.name + ".N", answer.contact, joint, joints);
    check(cable.name + ".f", answer.friction, joint, joints);
    check(cable.name + ".sd", answer.deviation, segment, segments);
    check(cable.name + ".mu", answer.mu, joint, joints);
    check(cable.name + ".mu_sd", answer.mu_deviation, joint, joints);
    for (std::size_t end = 0; end < 2; ++end)
      if (const double payout = answer.payout[c][end]; found.empty() && !is_possible(payout))
        found = cable.name + "." + end_name(end) + ".payout is " + plain(payout);
    segment += segments;
    joint += joints;
  }
  check("strut", answer.strut, 0, answer.strut.size());
  return found;
}

std::string result_header(const SceneDescription& scene, ResultColumns columns) {
  Line line(NumberFormat{});
  line.field("time");
  for (const CableDescription& cable : scene.cables) {
    line.numbered(cable.name + ".T", cable.segments());
    line.numbered(cable.name + ".slip", cable.joints());
    line.numbered(cable.name + ".state", cable.joints());
    line.numbered(cable.name + ".N", cable.joints());
    line.numbered(cable.name + ".f", cable.joints());
    for (std::size_t end = 0; end < 2; ++end) {
      if (cable.is_jacked(end)) line.field(cable.name + "." + end_name(end) + ".payout");
    }
  }
  line.numbered("strut", scene.struts.size());
  if (columns == ResultColumns::estimate) {
    for (const CableDescription& cable : scene.cables) {
      line.numbered(cable.name + ".sd", cable.segments());
      line.numbered(cable.name + ".mu", cable.joints());
      line.numbered(cable.name + ".mu_sd", cable.joints());
    }
    for (const char* name : {"alarms", "notices", "verdict"}) line.field(name);
  }
  return line.finished();
}

std::string result_row(const SceneDescription& scene, double time, const Answer& answer,
                       const NumberFormat& format, ResultColumns columns) {
  Line line(format);
  line.number(time);
  std::size_t segment = 0, joint = 0;
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const CableDescription& cable = scene.cables[c];
    const std::size_t joints = cable.joints();
    line.number(answer.tension, segment, cable.segments());
    line.number(answer.slip, joint, joints);
    for (std::size_t j = 0; j < joints; ++j) line.field(state_word(answer.state[joint + j]));
    line.number(answer.contact, joint, joints);
    line.number(answer.friction, joint, joints);
    for (std::size_t end = 0; end < 2; ++end) {
      if (cable.is_jacked(end)) line.number(answer.payout[c][end]);
    }
    segment += cable.segments();
    joint += joints;
  }
  line.number(answer.strut, 0, answer.strut.size());
  if (columns == ResultColumns::estimate) {
    segment = joint = 0;
    for (const CableDescription& cable : scene.cables) {
      line.number(answer.deviation, segment, cable.segments());
      line.number(answer.mu, joint, cable.joints());
      line.number(answer.mu_deviation, joint, cable.joints());
      segment += cable.segments();
      joint += cable.joints();
    }
    for (const std::string* words : {&answer.alarms, &answer.notices, &answer.verdict}) line.field(*words);
  }
  return line.finished();
}

}  // namespace taut::host
