// Plays a log to a device and writes what it answers, as `taut estimate --scalar float` would.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "host/device.hpp"
#include "host/process_link.hpp"
#include "lib/files/alarm_words.hpp"
#include "lib/files/answer.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/log_verdict.hpp"
#include "lib/files/number_range.hpp"
#include "lib/files/output_file.hpp"
#include "lib/files/result_file.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/files/status_text.hpp"
#include "lib/files/text.hpp"
#include "monitor/estimator_alarm.hpp"
#include "monitor/frame.hpp"

namespace {

using namespace taut::host;
using monitor::Alarm;
using monitor::Alarms;
using monitor::Quality;
using monitor::host::Device;
using monitor::host::DeviceAnswer;
using monitor::host::in_words;
using monitor::host::Reading;

enum ExitStatus : int { done = 0, no_answer = 1, unusable_input = 2 };

/// How one log is played.
struct Options {
  std::string scene, log, output;
  std::uint32_t number = 0;
  bool hex = false, restart = false, stack = false;
};

/// The numbers of an answer in the places where the writer of results looks for them.
class AnswerReader {
 public:
  AnswerReader(const DeviceAnswer& answer, const SceneDescription& scene) : values_(answer.values) {
    std::size_t segments = 0, joints = 0;
    for (const CableDescription& cable : scene.cables) {
      segments += cable.segments();
      joints += cable.joints();
    }
    reals(found_.tension, segments);
    reals(found_.slip, joints);
    states(joints);
    reals(found_.contact, joints);
    reals(found_.friction, joints);
    found_.extension.resize(scene.cables.size());
    for (std::size_t c = 0; c < scene.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (scene.cables[c].is_jacked(end)) found_.extension[c][end] = real();
    reals(found_.strut, scene.struts.size());
    reals(found_.deviation, segments);
    reals(found_.mu, joints);
    reals(found_.mu_deviation, joints);
    read_alarms(alarms(scene), scene, found_);
  }
  /// Without a verdict.
  const Answer& found() const { return found_; }

 private:
  const std::string& next() {
    static const std::string nothing;
    return at_ < values_.size() ? values_[at_++] : nothing;
  }
  // Adding zero makes a positive zero of a negative one, as in every result of the program.
  double real() { return static_cast<double>(monitor::float_of(monitor::host::number_of(next()))) + 0.0; }
  void reals(std::vector<double>& to, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) to.push_back(real());
  }
  void states(std::size_t joints) {
    if (joints == 0) return;
    for (const char letter : next())
      found_.state.push_back(letter == 'f'   ? taut::JointState::forward
                             : letter == 'b' ? taut::JointState::backward
                             : letter == 'o' ? taut::JointState::open
                                             : taut::JointState::stick);
    found_.state.resize(joints);
  }

  // All that is left.
  std::vector<taut::Alarm> alarms(const SceneDescription& scene) {
    std::vector<taut::Alarm> found;
    while (at_ < values_.size()) {
      found.push_back(monitor::alarm_of(monitor::host::number_of(next())));
      if (found.back().cable >= static_cast<int>(scene.cables.size()))
        throw std::runtime_error("the device names a cable that the scene does not have");
    }
    return found;
  }

  const std::vector<std::string>& values_;
  std::size_t at_ = 0;
  Answer found_;
};

class Player {
 public:
  Player(const Options& options, const SceneDescription& scene, Device& device)
      : options_(options), scene_(scene), device_(device), verdict_(scene) {}

  int play(LogReader& log, OutputFile& output) {
    take_scene();
    remark_on_instruments(log);
    const NumberFormat format{ScalarType::float32, options_.hex};
    output.write(result_header(scene_, ResultColumns::estimate));
    LogRow row = log.first_row(), before = row;
    while (log.next(row)) {
      const DeviceAnswer answer = answer_to(row, before);
      const std::string place = options_.log + ": line " + std::to_string(row.line);
      // Doubtful forces are those that `taut estimate` finds too; the remark below says what the device
      // thinks.
      if (answer.quality != Quality::good && answer.quality != Quality::doubtful) {
        output.finish();
        std::cerr << place << ": " << reason(answer) << "; the result ends before it\n";
        return no_answer;
      }
      // The device has been running for longer than this log.
      Alarms alarms = answer.alarms;
      if (row.row == 1) alarms = Alarms(alarms.bits() & ~greeting.bits());
      if (alarms.bits() != 0)
        std::cerr << "remark: " << place << ": the device says " << in_words(alarms) << '\n';
      Answer found = AnswerReader(answer, scene_).found();
      found.verdict = verdict_.take(row, found.alarms);
      output.write(result_row(scene_, row.time, found, format, ResultColumns::estimate));
      before = row;
    }
    output.finish();
    if (options_.stack) std::cerr << "stack " << device_.information().stack_used << '\n';
    return done;
  }

 private:
  void take_scene() {
    greeting.raise(Alarm::restarted);
    greeting.raise(Alarm::bad_frame);
    const auto found = device_.choose(options_.number);
    if (!found.status)
      throw InputError(options_.scene, "", "the device refuses the scene",
                       failure_text(found.status, scene_).english());
    std::size_t segments = 0, joints = 0;
    for (const CableDescription& cable : scene_.cables) {
      segments += cable.segments();
      joints += cable.joints();
    }
    if (found.cables != scene_.cables.size() || found.segments != segments || found.joints != joints ||
        found.loads != scene_.loads.size())
      throw InputError(
          options_.scene, "", "the device holds another scene",
          "build the firmware for this one with firmware_example/run, or choose another with --scene");
    // The log is not a load cell: any finite force is a good one.
    constexpr float largest = std::numeric_limits<float>::max();
    device_.set_limits(-largest, largest, 0);
  }

  /// What `taut estimate` takes for instruments that the scene does not describe, the device does not.
  void remark_on_instruments(const LogReader& log) const {
    for (const CableDescription& cable : scene_.cables)
      for (std::size_t end = 0; end < 2 && !cable.closed; ++end) {
        const std::string name = cable.name + "." + end_name(end);
        if (!cable.is_jacked(end) && log.has(name) && !cable.cell[end].sd)
          std::cerr << "remark: the load cell " << quote(name)
                    << " has no \"sd\" in \"sensors\": the device does not use it\n";
        if (cable.is_jacked(end) && log.has(name + ".stroke") && !cable.stroke[end].is_given)
          std::cerr << "remark: the stroke " << quote(name + ".stroke")
                    << " is not in \"sensors\": the device does not learn from it\n";
      }
  }

  static Reading reading(const std::optional<double>& given) {
    return given ? Reading(static_cast<float>(*given)) : Reading();
  }
  DeviceAnswer answer_to(const LogRow& row, const LogRow& before) {
    std::vector<Reading> numbers;
    for (const double factor : row.factor) numbers.emplace_back(static_cast<float>(factor));
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t end = 0; end < 2 && !scene_.cables[c].closed; ++end) {
        const EndRow& given = row.cables[c][end];
        numbers.push_back(reading(given.reading));
        if (!scene_.cables[c].is_jacked(end)) continue;
        numbers.push_back(reading(given.stroke));
        if (given.locked != before.cables[c][end].locked)
          device_.lock(static_cast<int>(c), end, given.locked);
      }
    const double dt = row.row == 1 ? 1 : row.time - before.time;
    DeviceAnswer answer = device_.sample(static_cast<float>(dt), numbers);
    if (options_.restart) device_.restart();
    return answer;
  }

  std::string reason(const DeviceAnswer& answer) const {
    if (!answer.status) return failure_text(answer.status, scene_).english();
    return "the device says " + in_words(answer.alarms);
  }

  const Options& options_;
  const SceneDescription& scene_;
  Device& device_;
  Alarms greeting;      // what is no news in the first answer
  LogVerdict verdict_;  // the device has none
};

int play(const Options& options, Device& device) {
  const SceneDescription scene = read_scene_file(options.scene);
  LogRules rules;
  rules.are_readings = true;
  rules.shortest_step = shortest_step;
  check_log(options.log, scene, rules);
  keep_inputs(options.output, {options.scene, options.log});
  std::ifstream stream = open_log(options.log);
  LogReader log(stream, options.log, scene, rules);
  OutputFile output(options.output);
  return Player(options, scene, device).play(log, output);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("SCENE", options.scene, "Scene file (JSON) that the device holds");
  app.add_option("LOG", options.log, "Log of readings (CSV)");
  app.add_option("-o", options.output, "Result file (CSV); standard output if absent");
  app.add_option("--scene", options.number,
                 "Number of the scene on the device: those in flash from 0 on, then the one condensed there");
  app.add_flag("--hex", options.hex, "Write numbers as the bits of their IEEE values");
  app.add_flag("--restart", options.restart, "Restart the device after every row");
  app.add_flag("--stack", options.stack, "Say at the end how much stack the device has used [bytes]");
}

/// One after the other on the same device; the exit status of each is a line of standard output.
int play_list(const std::string& list, Device& device) {
  std::ifstream lines(list);
  if (!lines) throw InputError(list, "", "this list cannot be read", "give the name of a text file");
  int worst = done;
  for (std::string line; std::getline(lines, line);) {
    int status = unusable_input;
    try {
      Options options;
      CLI::App app;
      add_options(app, options);
      app.parse(line);
      status = play(options, device);
    } catch (const CLI::ParseError& error) {
      std::cerr << list << ": " << line << ": " << error.what() << '\n';
    } catch (const InputError& error) {
      std::cerr << error.what() << '\n';
    }
    std::cout << status << std::endl;
    worst = std::max(worst, status);
  }
  return worst;
}

int run(int argc, char** argv) {
  CLI::App app{"Plays a log to a device and writes its answers."};
  Options options;
  std::string command, list;
  add_options(app, options);
  app.add_option("--device", command, "Command whose standard input and output are the serial line")
      ->required();
  app.add_option("--list", list,
                 "File with what else is on this command line for one log a line: all are played to the same "
                 "device, and their exit statuses written to standard output");
  app.footer("Exit status: 0 done; 1 no answer somewhere, or no device; 2 unusable input.");
  try {
    app.parse(argc, argv);
    if (list.empty() == options.log.empty()) throw CLI::RequiredError("SCENE and LOG, or --list,");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : unusable_input;
  }
  monitor::host::ProcessLink link(command);
  Device device(link);
  return list.empty() ? play(options, device) : play_list(list, device);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return unusable_input;
  } catch (const std::exception& error) {
    std::cerr << "monitor: " << error.what() << '\n';
  }
  return no_answer;
}
