// Replays the recorded jack loads of the rolling joint experiment through the monitor and prints the force of
// every segment beside the measured one.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "host/device.hpp"
#include "host/log_reader.hpp"
#include "host/memory_link.hpp"
#include "host/memory_monitor.hpp"
#include "host/process_link.hpp"
#include "monitor/frame.hpp"

namespace {

using monitor::FlashScene;
using monitor::host::BadLog;
using monitor::host::Device;
using monitor::host::DeviceAnswer;
using monitor::host::LogReader;
using monitor::host::LogRow;
using monitor::host::Reading;

enum ExitStatus : int { done = 0, no_answer = 1, unusable_input = 2 };
constexpr std::size_t start = 0, end = 1;

std::vector<std::string> cable_names() {
  return {FlashScene::cable_names().items.begin(), FlashScene::cable_names().items.end()};
}
const auto& layout(std::size_t cable) { return FlashScene::model().cables[static_cast<int>(cable)]; }

/// The jack is at the end of every cable: forward is towards it.
const char* in_words(char state) {
  switch (state) {
    case 's':
      return "holds";
    case 'f':
      return "slides to jack";
    case 'b':
      return "slides to anchor";
    default:
      return "slack";
  }
}

/// An empty field keeps the jack force of the row before.
void take_jack_forces(const LogRow& row, std::vector<float>& forces) {
  for (std::size_t cable = 0; cable < row.cables.size(); ++cable)
    if (const auto& force = row.cables[cable][end]) forces[cable] = static_cast<float>(*force);
}

/// The measured anchored force is what the computed one is compared with: the device does not get it.
std::vector<Reading> readings(const std::vector<float>& forces) {
  std::vector<Reading> numbers;
  for (const float force : forces) numbers.insert(numbers.end(), {Reading(), Reading(force), Reading()});
  return numbers;
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

double tension(const DeviceAnswer& answer, int segment) {
  const std::string& field = answer.values.at(static_cast<std::size_t>(segment));
  return static_cast<double>(monitor::float_of(monitor::host::number_of(field)));
}

/// One line, for a row in which the anchored end of a cable was measured.
void print_line(int row, std::size_t cable, double measured, double load_cell, const DeviceAnswer& answer) {
  const auto& given = layout(cable);
  const auto& model = FlashScene::model();
  const double anchored = tension(answer, given.first_segment);
  const double jacked = tension(answer, given.first_segment + given.segments() - 1);
  const std::string& states =
      answer.values.at(static_cast<std::size_t>(model.segments) + static_cast<std::size_t>(model.joints));
  std::printf("%3d | %-8s | %8.2f  %8.2f  %10s | %9.2f  %9.2f   | %s\n", row, cable_names()[cable].c_str(),
              anchored / 1000, measured / 1000, difference(anchored, measured).c_str(), jacked / 1000,
              load_cell / 1000, in_words(states.at(static_cast<std::size_t>(given.first_joint))));
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

int replay(const std::string& file, monitor::host::Link& link) {
  LogReader log(file, cable_names());
  require_jacks(log, file);
  Device device(link);
  const auto found = device.choose(0);
  if (!found.status || found.fingerprint != monitor::fingerprint(FlashScene::model(), FlashScene::prior())) {
    std::fprintf(stderr,
                 "monitor: the device does not hold the recorded experiment; build it without a scene\n");
    return no_answer;
  }
  print_heading();
  std::vector<float> forces(cable_names().size());
  int rows = 0, measurements = 0;
  double time = 0;
  while (const auto row = log.next()) {
    ++rows;
    take_jack_forces(*row, forces);
    const double dt = rows == 1 ? 1 : row->time - time;
    time = row->time;
    const DeviceAnswer answer = device.sample(static_cast<float>(dt), readings(forces));
    if (answer.quality != monitor::Quality::good) {
      std::fprintf(stderr, "monitor: row %d: %s\n", rows, monitor::host::in_words(answer.alarms).c_str());
      return no_answer;
    }
    for (std::size_t cable = 0; cable < row->cables.size(); ++cable) {
      if (!row->cables[cable][start]) continue;
      print_line(rows, cable, *row->cables[cable][start], static_cast<double>(forces[cable]), answer);
      ++measurements;
    }
  }
  print_summary(measurements);
  return done;
}

int replay_here(const std::string& file) {
  using Application = monitor::host::MemoryMonitor;
  static monitor::host::MemoryBoard board;
  static Application application(board);
  application.begin();
  monitor::host::MemoryLink<Application> link(board, application);
  return replay(file, link);
}

int usage(int status) {
  std::puts("usage: monitor [--device COMMAND] [LOG]");
  std::puts(
      "Replays a log, without one the recorded experiment, through a device whose serial line is the "
      "standard");
  std::puts("input and output of the command, without one through the same application in this program.");
  return status;
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<std::string> rest(arguments + 1, arguments + count);
  if (!rest.empty() && (rest[0] == "-h" || rest[0] == "--help")) return usage(done);
  std::string device;
  if (rest.size() >= 2 && rest[0] == "--device") {
    device = rest[1];
    rest.erase(rest.begin(), rest.begin() + 2);
  }
  if (rest.size() > 1 || (rest.size() == 1 && rest[0][0] == '-')) return usage(unusable_input);
  const std::string file = rest.empty() ? MONITOR_RECORDED_LOG : rest[0];
  try {
    if (device.empty()) return replay_here(file);
    monitor::host::ProcessLink link(device);
    return replay(file, link);
  } catch (const BadLog& problem) {
    std::fprintf(stderr, "monitor: %s\n", problem.what());
    return unusable_input;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "monitor: %s\n", problem.what());
    return no_answer;
  }
}
