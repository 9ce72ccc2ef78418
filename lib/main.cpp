// The program `taut`.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "lib/commands/check.hpp"
#include "lib/commands/export_scene.hpp"
#include "lib/commands/log_template.hpp"
#include "lib/commands/plan.hpp"
#include "lib/commands/report.hpp"
#include "lib/commands/run_log.hpp"
#include "lib/commands/watch.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/number_range.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/own_stack.hpp"

namespace {

using namespace taut::host;

constexpr int unusable_input = 2;
constexpr int most_substeps = 1000000, most_every = 1000000000;

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const auto& [name, method] : methods) names.push_back(name);
  return names;
}

std::vector<std::string> language_names() {
  std::vector<std::string> names;
  for (const auto& [name, language] : languages) names.emplace_back(name);
  return names;
}

Language language_called(const std::string& name) {
  for (const auto& [known, language] : languages)
    if (name == known) return language;
  return Language::english;
}

Method method_called(const std::string& name) {
  return std::find_if(methods.begin(), methods.end(), [&](const auto& each) { return each.first == name; })
      ->second;
}

// A NaN is in no range for CLI11 to refuse.
const CLI::Validator from_zero_up(
    [](const std::string& text) -> std::string {
      double number = 0;
      if (CLI::detail::lexical_cast(text, number) && number >= 0 && number <= largest_input) return "";
      return "write a number from 0 to 1e30";
    },
    "NUMBER");

// As for the rows of a log, - is what the shell hands over.
CLI::Option* add_output(CLI::App& command, std::string& output, const std::string& meaning) {
  return command.add_option("-o", output, meaning + "; standard output if absent or -")
      ->transform([](const std::string& path) { return path == "-" ? std::string() : path; });
}

// The command line, with what it asks for.
class CommandLine {
 public:
  CommandLine() {
    app_.name("taut");
    app_.set_version_flag("--version", "taut " TAUT_VERSION);
    app_.require_subcommand(1);
    app_.footer("Exit status: 0 done; 1 the scene has no answer somewhere; 2 unusable input.");
    add_check();
    add_simulate();
    add_estimate();
    add_watch();
    add_report();
    add_plan();
    add_export();
    add_template();
  }

  int run(int argc, char** argv) {
    if (argc > 1) require_command(argv[1]);
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app_.exit(error) == 0 ? 0 : unusable_input;
    }
    for (const auto* limits : {&options_.limits, &watching_.limits, &reporting_.limits})
      require_possible(*limits);
    if (check_->parsed()) return check(options_.scene, options_.log);
    if (export_->parsed()) return export_scenes({scenes_, options_.output, c_name_});
    if (template_->parsed()) return write_log_template(options_.scene, options_.output);
    if (watch_->parsed()) return watch(watching_);
    if (report_->parsed()) {
      reporting_.language = language_called(language_);
      return report(reporting_);
    }
    if (plan_->parsed()) return plan(plan_options_);
    options_.method = estimate_->parsed() ? Method::estimate : method_called(method_);
    options_.numbers.scalar = scalar_ == "float" ? ScalarType::float32 : ScalarType::float64;
    return run_log(options_);
  }

 private:
  // CLI11 says that a command is missing, and not which one it does not know.
  void require_command(const std::string& word) const {
    if (word.rfind('-', 0) == 0) return;
    std::vector<std::string> known;
    for (const CLI::App* command : app_.get_subcommands([](const CLI::App*) { return true; }))
      known.push_back(command->get_name());
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw InputError("taut", "", "there is no command " + quote(word),
                       suggestion(word, known, "the commands are"));
  }

  static void require_possible(const taut::AlarmLimits<double>& limits) {
    if (limits.most_force >= 0 && limits.least_force > limits.most_force)
      throw InputError("--least-force", "",
                       "the limit of " + plain(limits.least_force) + " N is above that of --most-force, " +
                           plain(limits.most_force) + " N",
                       "write the smaller one here");
  }

  void add_check() {
    check_ = app_.add_subcommand("check", "Show what a scene holds and needs, and whether it stands");
    check_->add_option("SCENE", options_.scene, "Scene file (JSON)")->required();
    check_->add_option("LOG", options_.log, "Log (CSV): how far linear theory is off on the way along it");
  }

  void add_simulate() {
    CLI::App* simulate = app_.add_subcommand("simulate", "Compute the cable forces for every row of a log");
    add_run(*simulate, "Log of loads and jack forces (CSV); - for standard input");
    simulate->add_option("--method", method_, "Method of computation")
        ->check(CLI::IsMember(method_names()))
        ->capture_default_str();
    simulate->add_option("--substeps", options_.substeps, "Load steps a row, for the method stepwise")
        ->check(CLI::Range(1, most_substeps))
        ->capture_default_str();
  }

  void add_estimate() {
    estimate_ = app_.add_subcommand(
        "estimate", "Estimate the cable forces, and friction, from the readings of a log, with error bars");
    add_run(*estimate_, "Log of readings (CSV); - for standard input");
    add_limits(*estimate_, options_.limits);
    estimate_->add_option(
        "--state", options_.state,
        "Go on where this file says, if there is one; afterwards it says where this log ends");
  }

  void add_watch() {
    watch_ = app_.add_subcommand("watch",
                                 "Show the cable forces while rows come: on the terminal and in browsers");
    watch_->add_option("SCENE", watching_.scene, "Scene file (JSON)")->required();
    watch_->add_option("LOG", watching_.log,
                       "Log of readings (CSV) that is followed as it grows; - for standard input");
    watch_->add_option("--serial", watching_.serial,
                       "Take the rows from a serial line: DEVICE[:BAUD], 115200 if absent");
    watch_->add_option("--http", watching_.http,
                       "Serve the page at [ADDRESS:]PORT, 127.0.0.1 if absent; port 0: any");
    watch_->add_option("--record", watching_.record, "Append the answer to every row to this file (CSV)");
    watch_->add_option("--state", watching_.state,
                       "Go on where this file says, if there is one; it is kept at every row");
    watch_->add_option("--speed", watching_.speed, "Play LOG to its end, so many times as fast as its times");
    watch_->add_option("--goal", watching_.goal,
                       "Goal file (JSON) as of plan: say what is to be jacked, and plan anew on the way");
    add_limits(*watch_, watching_.limits);
  }

  void add_report() {
    report_ = app_.add_subcommand(
        "report", "Show what estimate finds: a record to sign, drawings, charts and tables on a page");
    report_->add_option("SCENE", reporting_.scene, "Scene file (JSON)")->required();
    report_->add_option("LOG", reporting_.log, "Log of readings (CSV)")->required();
    report_->add_option("-o", reporting_.output, "The page (HTML)")->required();
    report_->add_option("--job", reporting_.job,
                        "Project, instruments, required stages (JSON) for the record");
    report_->add_option("--goal", reporting_.goal, "Goal file (JSON): targets and limits of the forces");
    report_->add_option("--language", language_, "Language of the page")
        ->check(CLI::IsMember(language_names()))
        ->capture_default_str();
    add_limits(*report_, reporting_.limits);
  }

  void add_plan() {
    plan_ = app_.add_subcommand(
        "plan", "Find how to jack so that every segment comes as near to its target as friction allows");
    plan_->add_option("SCENE", plan_options_.scene, "Scene file (JSON)")->required();
    plan_->add_option("GOAL", plan_options_.goal, "Goal file: targets, limits, moves (JSON)")->required();
    plan_->add_option("-o", plan_options_.log, "Log of the plan (CSV), for simulate");
    plan_->add_option("--report", plan_options_.sheet, "Sheet for the site (HTML)");
    plan_->add_flag("--robust", plan_options_.is_robust,
                    "Against all that is known of mu, not for its mean alone");
  }

  void add_limits(CLI::App& command, taut::AlarmLimits<double>& limits) {
    const auto add = [&](const char* name, double& limit, const char* meaning) {
      return command.add_option(name, limit, meaning)->check(from_zero_up);
    };
    add("--least-force", limits.least_force, "Alarm when the force of a segment is below this [N]");
    add("--most-force", limits.most_force, "Alarm when the force of a segment is above this [N]");
    add("--elongation-tolerance", limits.elongation,
        "Alarm when a stroke grows by this part more or less than expected")
        ->capture_default_str();
    add("--gain-tolerance", limits.gain, "Alarm when the load cells of a cable differ by more than this part")
        ->capture_default_str();
    add("--initial-strain", limits.initial_strain, "Strokes count from this strain of the cable on")
        ->capture_default_str();
  }

  void add_run(CLI::App& command, const std::string& log) {
    command.add_option("SCENE", options_.scene, "Scene file (JSON)")->required();
    command.add_option("LOG", options_.log, log)->required();
    add_output(command, options_.output, "Result file (CSV)");
    command.add_option("--scalar", scalar_, "Floating-point type of the computation")
        ->check(CLI::IsMember({"double", "float"}))
        ->capture_default_str();
    command
        .add_option("--columns", options_.choice.columns,
                    "Columns of the result beside the time, as in C.T1,C.sd1; all if absent")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--every", options_.choice.every, "Write every so many rows one")
        ->check(CLI::Range(1, most_every))
        ->capture_default_str();
    command.add_flag("--hex", options_.numbers.hex, "Write numbers as the bits of their IEEE values");
  }

  void add_export() {
    export_ = app_.add_subcommand("export", "Write a C++ header with the condensed scene, for firmware");
    export_->add_option("SCENE", scenes_, "Scene files (JSON); several share one capacity and so their code")
        ->required();
    add_output(*export_, options_.output, "Header file (C++)");
    export_->add_option("--c", c_name_, "Write also a C interface, NAME.h and NAME.cpp, beside the header");
  }

  void add_template() {
    template_ = app_.add_subcommand("template", "Write the header of a log for a scene, with remarks");
    template_->add_option("SCENE", options_.scene, "Scene file (JSON)")->required();
    add_output(*template_, options_.output, "Log file (CSV)");
  }

  CLI::App app_{"Cable forces with friction in cable-supported structures."};
  CLI::App* check_ = nullptr;
  CLI::App* estimate_ = nullptr;
  CLI::App* export_ = nullptr;
  CLI::App* plan_ = nullptr;
  CLI::App* report_ = nullptr;
  CLI::App* template_ = nullptr;
  CLI::App* watch_ = nullptr;
  RunOptions options_;
  PlanOptions plan_options_;
  WatchOptions watching_;
  ReportOptions reporting_;
  std::vector<std::string> scenes_;
  std::optional<std::string> c_name_;
  std::string method_ = methods.front().first, scalar_ = "double", language_ = languages.front().first;
};

int run(int argc, char** argv) {
  try {
    return CommandLine().run(argc, argv);
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
  } catch (const std::bad_alloc&) {
    std::cerr << "taut: there is not enough memory for this scene\n";
  } catch (const std::exception& error) {
    std::cerr << "taut: " << error.what() << '\n';
  }
  return unusable_input;
}

}  // namespace

int main(int argc, char** argv) {
  return call_with_own_stack([&] { return run(argc, argv); });
}
