// Replays the recorded jack loads of the rolling joint experiment through the monitor and prints the force of
// every segment beside the measured one.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include "host/log_reader.hpp"
#include "monitor/monitor.hpp"
#include "monitor/scenes/rolling_joint.hpp"

namespace {

using monitor::host::BadLog;
using monitor::host::LogReader;
using monitor::host::LogRow;
using monitor::scenes::rolling_joint;
using JointMonitor = monitor::Monitor<monitor::scenes::RollingJoint>;

enum ExitStatus : int { done = 0, no_answer = 1, unusable_input = 2 };
constexpr std::size_t start = 0, end = 1;

std::vector<std::string> cable_names() {
  return {std::begin(monitor::scenes::rolling_joint_cables), std::end(monitor::scenes::rolling_joint_cables)};
}

/// The jack is at the end of every cable: forward is towards it.
const char* in_words(taut::JointState state) {
  switch (state) {
    case taut::JointState::stick:
      return "holds";
    case taut::JointState::forward:
      return "slides to jack";
    case taut::JointState::backward:
      return "slides to anchor";
    case taut::JointState::open:
      return "slack";
  }
  return "";
}

/// An empty field keeps the jack force of the row before.
void take_jack_forces(const LogRow& row, JointMonitor::Sample& sample) {
  for (std::size_t cable = 0; cable < row.cables.size(); ++cable)
    if (const auto& force = row.cables[cable][end])
      sample.jack[static_cast<int>(cable)][end].force = static_cast<float>(*force);
}

void print_heading() {
  std::puts("Rolling cable-strut joint (Yan et al. 2015, Table 4): force of every cable segment");
  std::puts("");
  std::puts("    |          |  anchored segment [kN]         |  jacked segment [kN]   |");
  std::puts("row | cable    | computed  measured  difference |  computed  load cell   | joint");
  std::puts("----+----------+--------------------------------+------------------------+------------------");
}

/// In percent of the measured force, without a sign if that rounds to zero.
std::string difference(double computed, double measured) {
  if (!(measured > 0)) return "-";
  const double percent = 100 * (computed - measured) / measured;
  char text[32];
  std::snprintf(text, sizeof text, std::fabs(percent) < 0.005 ? "%.2f %%" : "%+.2f %%", percent);
  return text[0] == '-' && std::fabs(percent) < 0.005 ? text + 1 : text;
}

/// One line, for a row in which the anchored end of a cable was measured.
void print_line(int row, int cable, double measured, const JointMonitor::Sample& sample,
                const JointMonitor::Reading& reading) {
  const auto& given = rolling_joint.cables[cable];
  const int last = given.first_segment + given.segments() - 1;
  const double anchored = static_cast<double>(reading.forces.tension[given.first_segment]);
  const double jacked = static_cast<double>(reading.forces.tension[last]);
  const double load_cell = static_cast<double>(sample.jack[cable][end].force);
  std::printf("%3d | %-8s | %8.2f  %8.2f  %10s | %9.2f  %9.2f   | %s\n", row,
              monitor::scenes::rolling_joint_cables[cable], anchored / 1000, measured / 1000,
              difference(anchored, measured).c_str(), jacked / 1000, load_cell / 1000,
              in_words(reading.forces.state[given.first_joint]));
}

/// One line; it must not claim more than was done.
void print_summary(int measurements) {
  std::printf(
      "\nComputed: %d anchored force%s, from the jack's load cell and a mu that was identified from the "
      "same readings.\n",
      measurements, measurements == 1 ? "" : "s");
}

/// Without its jack a cable would be computed as never pulled.
void require_jacks(const LogReader& log, const std::string& file) {
  const std::vector<std::string> names = cable_names();
  for (std::size_t cable = 0; cable < names.size(); ++cable)
    if (!log.has(cable, end))
      throw BadLog(file + ", line 1: there is no column \"" + names[cable] +
                   ".end\"; add the load cell at this jack, it drives the model");
}

int replay(const std::string& file) {
  LogReader log(file, cable_names());
  require_jacks(log, file);
  static JointMonitor joint_monitor;
  const taut::Status started = joint_monitor.start(rolling_joint);
  if (!started) {
    std::fprintf(stderr, "monitor: the scene: %s\n", taut::describe(started.code));
    return no_answer;
  }
  print_heading();
  JointMonitor::Sample sample;
  int rows = 0, measurements = 0;
  while (const auto row = log.next()) {
    ++rows;
    take_jack_forces(*row, sample);
    const JointMonitor::Reading reading = joint_monitor.take(sample);
    if (!reading.status) {
      std::fprintf(stderr, "monitor: row %d: %s\n", rows, taut::describe(reading.status.code));
      return no_answer;
    }
    for (std::size_t cable = 0; cable < row->cables.size(); ++cable) {
      if (!row->cables[cable][start]) continue;
      print_line(rows, static_cast<int>(cable), *row->cables[cable][start], sample, reading);
      ++measurements;
    }
  }
  print_summary(measurements);
  return done;
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 2 ||
      (count == 2 && (std::string(arguments[1]) == "-h" || std::string(arguments[1]) == "--help"))) {
    std::puts("usage: monitor [LOG]    replays a log, without one the recorded experiment");
    return count > 2 ? unusable_input : done;
  }
  try {
    return replay(count == 2 ? arguments[1] : MONITOR_RECORDED_LOG);
  } catch (const BadLog& problem) {
    std::fprintf(stderr, "monitor: %s\n", problem.what());
    return unusable_input;
  }
}
