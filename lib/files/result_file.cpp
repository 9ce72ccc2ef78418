#include "lib/files/result_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "lib/files/deserved_digits.hpp"
#include "lib/files/input_error.hpp"
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

// Grows one line of a result, field by field; those that are not selected are not written.
class Line {
 public:
  Line(const NumberFormat& format, const ResultSelection& selection)
      : format_(format), selection_(selection), chosen_(selection.count()) {}

  void number(double value) {
    if (std::string* const text = next()) append_number(*text, value, format_);
  }
  void number(const std::vector<double>& values, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) number(values[first + i]);
  }
  void skip() { ++column_; }
  void field(const std::string& field) {
    if (std::string* const text = next()) *text += field;
  }
  std::string finished() {
    for (std::size_t i = 0; i < chosen_.size(); ++i) text_ += (i == 0 ? "" : ",") + chosen_[i];
    return text_ + "\n";
  }

 private:
  // Where the next field goes; null if it is not written.
  std::string* next() {
    const std::size_t column = column_++;
    if (!selection_.is_all()) {
      const std::size_t place = selection_.place(column);
      return place == ResultSelection::nowhere ? nullptr : &chosen_[place];
    }
    if (column > 0) text_ += ',';
    return &text_;
  }

  NumberFormat format_;
  const ResultSelection& selection_;
  std::vector<std::string> chosen_;
  std::string text_;
  std::size_t column_ = 0;
};

std::string displacement_name(const NodeDescription& node, int axis) { return node.name + '.' + "xyz"[axis]; }

// Of all nodes; those that were not asked for are not written.
void add_displacements(const SceneDescription& scene, const Answer& answer, Line& line) {
  std::size_t given = 0;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node)
    for (int axis = 0; axis < scene.dimension; ++axis) {
      const bool is_next = given < scene.displaced.size() &&
                           scene.displaced[given].node == static_cast<int>(node) &&
                           scene.displaced[given].axis == axis;
      if (is_next)
        line.number(answer.displacement[given++]);
      else
        line.skip();
    }
}

using host::is_possible;

bool is_possible(const Answer& answer) {
  const auto all = [](const auto& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double number) { return is_possible(number); });
  };
  return all(answer.tension) && all(answer.slip) && all(answer.contact) && all(answer.friction) &&
         all(answer.strut) && all(answer.displacement) && all(answer.deviation) && all(answer.mu) &&
         all(answer.mu_deviation) && std::all_of(answer.extension.begin(), answer.extension.end(), all);
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
        found = name + std::to_string(i + 1) + " = " + plain(number);
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
      if (const double extension = answer.extension[c][end]; found.empty() && !is_possible(extension))
        found = cable.name + "." + end_name(end) + ".payout = " + plain(extension);
    segment += segments;
    joint += joints;
  }
  check("strut", answer.strut, 0, answer.strut.size());
  return found;
}

std::vector<std::string> result_columns(const SceneDescription& scene, ResultColumns columns) {
  std::vector<std::string> names = {"time"};
  const auto numbered = [&](const std::string& stem, std::size_t count) {
    for (std::size_t i = 1; i <= count; ++i) names.push_back(stem + std::to_string(i));
  };
  for (const CableDescription& cable : scene.cables) {
    numbered(cable.name + ".T", cable.segments());
    numbered(cable.name + ".slip", cable.joints());
    numbered(cable.name + ".state", cable.joints());
    numbered(cable.name + ".N", cable.joints());
    numbered(cable.name + ".f", cable.joints());
    for (std::size_t end = 0; end < 2; ++end) {
      if (cable.is_jacked(end)) names.push_back(cable.name + "." + end_name(end) + ".payout");
    }
  }
  numbered("strut", scene.struts.size());
  if (columns == ResultColumns::estimate) {
    for (const CableDescription& cable : scene.cables) {
      numbered(cable.name + ".sd", cable.segments());
      numbered(cable.name + ".mu", cable.joints());
      numbered(cable.name + ".mu_sd", cable.joints());
    }
    for (const char* name : {"alarms", "notices", "verdict"}) names.push_back(name);
  }
  return names;
}

std::vector<std::string> further_columns(const SceneDescription& scene, ResultColumns columns) {
  std::vector<std::string> names;
  for (const CableDescription& cable : scene.cables)
    for (std::size_t j = 1; j <= cable.joints(); ++j)
      names.push_back(cable.name + ".used" + std::to_string(j));
  if (columns == ResultColumns::state)
    for (const NodeDescription& node : scene.nodes)
      for (int axis = 0; axis < scene.dimension; ++axis) names.push_back(displacement_name(node, axis));
  return names;
}

std::vector<DisplacementDescription> displacements_among(const std::vector<std::string>& names,
                                                         const SceneDescription& scene) {
  std::vector<DisplacementDescription> among;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node)
    for (int axis = 0; axis < scene.dimension; ++axis)
      if (std::find(names.begin(), names.end(), displacement_name(scene.nodes[node], axis)) != names.end())
        among.push_back({static_cast<int>(node), axis});
  return among;
}

ResultSelection select_columns(const std::vector<std::string>& names, const SceneDescription& scene,
                               ResultColumns columns) {
  const std::vector<std::string> usual = result_columns(scene, columns),
                                 further = further_columns(scene, columns);
  std::vector<std::string> known = usual;
  known.insert(known.end(), further.begin(), further.end());
  std::vector<std::size_t> chosen = {0};
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      const std::string all = "the columns are", list = suggestion("", usual, all),
                        meant = suggestion(name, known, all);
      const std::string asked =
          further.empty() ? ""
                          : ", and on request " + quote(further.front()) + " to " + quote(further.back());
      throw InputError("--columns", "", "the result has no column " + quote(name),
                       (meant == suggestion("", known, all) ? list : meant + " " + list) + asked);
    }
    const auto column = static_cast<std::size_t>(found - known.begin());
    if (std::find(chosen.begin(), chosen.end(), column) == chosen.end()) chosen.push_back(column);
  }
  return {chosen, known.size()};
}

std::string result_header(const SceneDescription& scene, ResultColumns columns,
                          const ResultSelection& selection) {
  Line line(NumberFormat{}, selection);
  for (const std::string& name : result_columns(scene, columns)) line.field(name);
  if (!selection.is_all())
    for (const std::string& name : further_columns(scene, columns)) line.field(name);
  return line.finished();
}

std::string result_row(const SceneDescription& scene, double time, const Answer& found,
                       const NumberFormat& format, ResultColumns columns, const ResultSelection& selection) {
  const Answer answer = format.hex ? found : with_deserved_digits(found);
  Line line(format, selection);
  line.number(format.hex ? time : rounded(time, time_digits));
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
      if (cable.is_jacked(end)) line.number(answer.extension[c][end]);
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
    for (const std::string& words : {answer.alarms, answer.notices, answer.verdict.english()})
      line.field(words);
  }
  if (selection.is_all()) return line.finished();
  line.number(answer.friction_used, 0, answer.friction_used.size());
  if (columns == ResultColumns::state) add_displacements(scene, answer, line);
  return line.finished();
}

}  // namespace taut::host
