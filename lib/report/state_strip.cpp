#include "lib/report/state_strip.hpp"

#include <algorithm>
#include <array>

#include "lib/files/result_file.hpp"
#include "lib/report/chart.hpp"
#include "lib/report/html.hpp"
#include "lib/report/names.hpp"
#include "lib/report/number_text.hpp"

namespace taut::host {
namespace {

constexpr std::size_t states = 4;
constexpr double least_share = 0.15;  // of the height, for a state that occurs at all
constexpr double longest_strip = 640;

// Heights of the states in a row, of 1 in all.
std::array<double, states> shares(const StateCounts& counts) {
  double total = 0, sum = 0;
  for (const std::size_t count : counts) total += static_cast<double>(count);
  std::array<double, states> found{};
  for (std::size_t s = 0; s < states; ++s) {
    if (counts[s] > 0) found[s] = std::max(static_cast<double>(counts[s]) / total, least_share);
    sum += found[s];
  }
  for (double& share : found) share /= sum;
  return found;
}

// The bars of one joint, one path a state.
class Bars {
 public:
  Bars(double top, double height) : top_(top), height_(height) {}

  void add(double from, double to, const std::array<double, states>& share) {
    if (share == share_ && from <= to_ + 1e-9) {
      to_ = to;
      return;
    }
    draw();
    from_ = from;
    to_ = to;
    share_ = share;
  }
  std::string finished() {
    draw();
    std::string drawn;
    for (std::size_t s = 0; s < states; ++s)
      if (!paths_[s].empty())
        drawn += void_element("path", {{"class", state_word(static_cast<JointState>(s))}, {"d", paths_[s]}});
    return drawn;
  }

 private:
  void draw() {
    double y = top_;
    for (std::size_t s = 0; s < states; ++s) {
      const double part = height_ * share_[s];
      if (part > 0) {
        const std::string across = coordinate(to_ - from_, 2);
        paths_[s].append("M").append(coordinate(from_, 2)).append(",").append(coordinate(y, 2));
        paths_[s].append("h").append(across).append("v").append(coordinate(part, 2));
        paths_[s].append("h-").append(across).append("z");
      }
      y += part;
    }
  }

  double top_, height_, from_ = 0, to_ = 0;
  std::array<double, states> share_{};
  std::array<std::string, states> paths_;
};

// A row of the log stands for the time to half way to its neighbours.
std::string bars_of(std::size_t joint, double top, double height, const RunRecord& record, const Axis& time) {
  const auto& spans = record.states.cells();
  const auto between = [](double a, double b) { return a + (b - a) / 2; };
  Bars bars(top, height);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double from = i == 0 ? time.low : between(spans[i - 1].last_time, spans[i].first_time);
    const double to =
        i + 1 == spans.size() ? time.high : between(spans[i].last_time, spans[i + 1].first_time);
    bars.add(chart_width * time.part(from), chart_width * time.part(to), shares(spans[i].joints[joint]));
  }
  return bars.finished();
}

}  // namespace

std::string state_strip(const SceneDescription& scene, std::size_t c, const RunRecord& record,
                        const Axis& time, const std::string& x_title, const Words& say) {
  const CableDescription& cable = scene.cables[c];
  const std::size_t first = start_of(scene, c).joint, joints = cable.joints();
  const double pitch = std::clamp(longest_strip / static_cast<double>(joints), 6.0, 20.0);
  const double height = pitch * static_cast<double>(joints);
  const std::size_t labelled = pitch >= 13 ? 1 : pitch >= 7 ? 2 : 3;  // every so many rows
  std::string bars, labels;
  for (std::size_t j = 0; j < joints; ++j) {
    const std::string& node = node_name(scene, joint_node(cable, j));
    const double top = pitch * static_cast<double>(j);
    bars += bars_of(first + j, top + 1, pitch - 2, record, time);
    if (j % labelled != 0) continue;
    labels += element(
        "text", {{"x", "-7"}, {"y", coordinate(top + pitch / 2 + 4)}, {"text-anchor", "end"}},
        escaped(std::to_string(j + 1) + " " + shortened(node, 4)) +
            element("title", {}, escaped(say("joint {1} at node {2}", {std::to_string(j + 1), node}))));
  }
  const std::string stretched =
      element("svg",
              {{"class", "states"},
               {"viewBox", "0 0 " + coordinate(chart_width) + " " + coordinate(height)},
               {"preserveAspectRatio", "none"},
               {"width", "100%"},
               {"height", coordinate(height)}},
              bars);
  const std::string says = say("States of the joints of cable {1} over time", {cable.name});
  const std::string svg = element(
      "svg", {{"role", "img"}, {"aria-label", says}, {"width", "100%"}, {"height", coordinate(height)}},
      axis_below(time, height) + element("g", {{"class", "grid"}}, labels) + stretched);
  return element("figure", {{"class", "chart over-time"}},
                 element("div", {{"class", "y-title"}}, escaped(say("joint, node"))) +
                     element("div", {{"class", "plot"}}, svg) +
                     element("div", {{"class", "x-title"}}, escaped(x_title)));
}

std::string state_legend(const Words& say) {
  const std::array<const char*, states> meaning = {
      "stick: nothing moves over the joint", "forward: the cable moves towards its end",
      "backward: the cable moves towards its start", "open: slack on both sides"};
  std::string entries;
  for (std::size_t s = 0; s < states; ++s)
    entries +=
        element("li", {},
                element("span", {{"class", std::string("patch ") + state_word(static_cast<JointState>(s))}}) +
                    escaped(say(meaning[s])));
  return element("ul", {{"class", "legend"}}, entries);
}

}  // namespace taut::host
