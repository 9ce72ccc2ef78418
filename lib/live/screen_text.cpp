#include "lib/live/screen_text.hpp"

#include <algorithm>
#include <cmath>

#include "lib/files/result_file.hpp"
#include "lib/report/number_text.hpp"
#include "lib/report/run_record.hpp"

namespace taut::host {
namespace {

constexpr const char* full = "\u2588";
constexpr const char* edge = "\u2502";
constexpr const char* shade = "\u2591";
constexpr const char* mark = "\u25c6";

bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

// As a terminal may have it: without what would move its cursor, and no longer than there is room.
std::string cut(const std::string& text, std::size_t most) {
  std::string line;
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (begins_character(text[i]) && count++ == most) break;
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool is_control =
        byte < 0x20 || byte == 0x7F ||
        (byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0);
    line += is_control ? '?' : text[i];
    if (is_control && byte == 0xC2) ++i;
  }
  return line;
}

std::string padded(const std::string& text, std::size_t width) {
  const std::size_t used = width_of(text);
  return text + std::string(used < width ? width - used : 0, ' ');
}

std::string right(const std::string& text, std::size_t width) {
  const std::size_t used = width_of(text);
  return std::string(used < width ? width - used : 0, ' ') + text;
}

ForceUnit unit_of(const LiveAnswer& live) {
  double largest = 0;
  for (const double force : live.answer.tension) largest = std::max(largest, force);
  return ForceUnit::for_largest(largest);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string time_text(double time) { return "time " + coordinate(time, 3) + " s"; }

// From zero to the force, with the band about its end.
std::string bar(double force, const std::array<double, 2>& band, double most, std::size_t width) {
  const auto cell = [&](double value) {
    const double part = most > 0 ? value / most : 0;
    return static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * static_cast<double>(width - 1) + 0.5);
  };
  const std::size_t at = cell(force), low = cell(band[0]), high = cell(band[1]);
  std::string text;
  for (std::size_t i = 0; i < width; ++i)
    text += i == at ? edge : i >= low && i <= high ? shade : i < at ? full : " ";
  return text;
}

// From zero to the force of a jack, and where its stage is.
std::string marked_bar(double force, double stage, double most, std::size_t width) {
  const auto cell = [&](double value) {
    return static_cast<std::size_t>(std::clamp(value / most, 0.0, 1.0) * static_cast<double>(width - 1) +
                                    0.5);
  };
  std::string text;
  for (std::size_t i = 0; i < width; ++i)
    text += i == cell(stage) ? mark : i <= cell(force) && force > 0 ? full : " ";
  return text;
}

void add_plan(const LiveAnswer& live, std::size_t columns, std::vector<std::string>& lines) {
  constexpr std::size_t label = 12;
  const PlanNow& plan = *live.plan;
  lines.push_back("PLAN " + plan.say);
  double most = 0;
  for (const PlanStageNow& stage : plan.stages)
    for (const double force : stage.force) most = std::max(most, force);
  for (std::size_t k = 0; k < plan.jacks.size() && k < live.jacks.size() && most > 0; ++k)
    if (const std::optional<double> stage = plan.mark(k))
      lines.push_back(padded("  " + plan.jacks[k], label) + "[" +
                      marked_bar(live.jacks[k].force, *stage, std::max(most, live.jacks[k].force),
                                 columns > label + 12 ? columns - label - 2 : 10) +
                      "]");
  for (std::size_t s = 0; s < plan.stages.size(); ++s)
    lines.push_back(std::string(s == plan.present ? "> " : "  ") + stage_text(plan, s) +
                    (plan.stages[s].skipped  ? "  skipped"
                     : plan.stages[s].passed ? "  passed"
                                             : ""));
  lines.push_back("  " + error_text(plan) + (plan.is_planning ? "; a new plan is being looked for" : ""));
  if (!plan.anew.empty()) lines.push_back("  " + anew_text(plan.anew.back()));
}

}  // namespace

std::vector<std::string> screen_text(const SceneDescription& scene, const LiveAnswer& live, std::size_t rows,
                                     std::size_t columns) {
  constexpr std::size_t label = 8, number = 12, short_number = 9;
  const ForceUnit unit = unit_of(live);
  const Answer& answer = live.answer;
  double most = 0;
  for (std::size_t i = 0; i < answer.tension.size(); ++i)
    most = std::max(most, force_band(answer.tension[i], answer.deviation[i])[1]);
  const std::size_t width =
      columns > label + number + short_number + 12 ? columns - label - number - short_number - 3 : 10;

  std::vector<std::string> lines = {scene.name + "   " + time_text(live.time) + "   row " +
                                    std::to_string(live.row)};
  lines.push_back(live.alarms.empty() ? "no alarm" : "ALARM " + joined(live.alarms));
  if (!live.notices.empty()) lines.push_back("notice " + joined(live.notices));
  for (const JackNow& jack : live.jacks)
    lines.push_back("jack " + scene.cables[jack.cable].name + "." + end_name(jack.end) + "  " +
                    unit.text(jack.force) +
                    (jack.stroke ? "  stroke " + fixed(1000 * *jack.stroke, 1) + " mm" : ""));
  if (live.plan) add_plan(live, columns, lines);
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const CableDescription& cable = scene.cables[c];
    const CableStart first = start_of(scene, c);
    lines.push_back("");
    lines.push_back("cable " + cable.name);
    for (std::size_t i = 0; i < cable.segments(); ++i) {
      const double force = answer.tension[first.segment + i], sd = answer.deviation[first.segment + i];
      lines.push_back(padded("  T" + std::to_string(i + 1), label) + right(unit.text(force), number) + " " +
                      padded("\u00b1" + unit.deviation(band_width * sd), short_number) + " " +
                      bar(force, force_band(force, sd), most, width));
      // A closed cable has its joint 1 between the last segment and the first.
      const std::size_t j = cable.closed ? (i + 1) % cable.segments() : i;
      if (i >= cable.joints() && !cable.closed) continue;
      lines.push_back(padded("", label) + right("joint " + std::to_string(j + 1), number) + " " +
                      padded(state_word(answer.state[first.joint + j]), short_number) + " mu " +
                      fixed(answer.mu[first.joint + j], 3) + " \u00b1" +
                      significant(band_width * answer.mu_deviation[first.joint + j], 2));
    }
  }
  if (lines.size() > rows && rows > 0) {
    const std::size_t hidden = lines.size() - rows + 1;
    lines.resize(rows - 1);
    lines.push_back(std::to_string(hidden) + " more lines: make the window higher, or use --http");
  }
  for (std::string& line : lines) line = cut(line, columns);
  return lines;
}

std::string row_text(const SceneDescription& scene, const LiveAnswer& live) {
  if (live.row == 0) return joined(live.alarms);
  const ForceUnit unit = unit_of(live);
  std::string text = time_text(live.time) + ":";
  for (const JackNow& jack : live.jacks)
    text +=
        " " + scene.cables[jack.cable].name + "." + end_name(jack.end) + " " + unit.text(jack.force) + ";";
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const auto begin = live.answer.tension.begin() + static_cast<std::ptrdiff_t>(start_of(scene, c).segment);
    const auto [low, high] =
        std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(scene.cables[c].segments()));
    text += " " + scene.cables[c].name + " " + unit.number(*low) + " to " + unit.text(*high) + ";";
  }
  constexpr std::size_t longest = 1000;  // of what a pipe takes at once
  text += live.alarms.empty() ? " no alarm" : " " + joined(live.alarms);
  if (live.plan) text += "; plan: " + live.plan->say;
  return cut(text, longest);
}

}  // namespace taut::host
