#include "lib/simulate.hpp"

#include <array>
#include <cstdio>
#include <iostream>
#include <limits>

#include "lib/output_file.hpp"
#include "lib/scene_file.hpp"
#include "lib/status_text.hpp"
#include "lib/text.hpp"

namespace taut::host {
namespace {

void remark(const std::string& text) { std::cerr << "remark: " << text << '\n'; }

// What a reader of the result may not expect: columns that are not there, and columns without effect.
void remark_on_columns(const LogReader& log, const SceneDescription& scene) {
  for (const LoadDescription& load : scene.loads) {
    if (!log.has(load.name))
      remark("the log has no column " + quote(load.name) + ": the factor of this load stays 0");
  }
  for (const CableDescription& cable : scene.cables) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::string column = cable.name + "." + end_name(end);
      if (cable.is_jacked(end) && !log.has(column)) {
        remark("the log has no column " + quote(column) + ": this jack force stays 0");
      }
      if (!cable.is_jacked(end) && log.has(column)) {
        remark("column " + quote(column) + " is a measurement at an anchored end: simulate does not use it");
      }
      if (log.has(column + ".stroke")) {
        remark("column " + quote(column + ".stroke") + " is a measurement: simulate does not use it");
      }
    }
  }
}

void remark_on_substeps(const SimulateOptions& options) {
  if (options.method == Method::tracker && options.substeps > 1)
    remark("--substeps has no effect: the method tracker follows a row from event to event, not in steps");
}

// One run from the header to the last row or to the first that has no answer.
class Run {
 public:
  Run(const SimulateOptions& options, const SceneDescription& scene, Model& model, LogReader& log)
      : options_(options), scene_(scene), model_(model), log_(log), output_(options.output) {}

  int operator()() {
    output_.write(result_header(scene_));
    if (const Followed start = model_.start(options_.substeps); !start.whole())
      return stop(options_.scene + ": before the first row", start);
    LogRow row = log_.first_row();
    Answer answer;
    while (log_.next(row)) {
      if (const Followed path = model_.advance(row, options_.substeps); !path.whole())
        return stop(place(row), path);
      model_.read(answer);
      output_.write(result_row(scene_, row.time, answer, options_.numbers));
    }
    output_.finish();
    return 0;
  }

 private:
  std::string place(const LogRow& row) const {
    return options_.log + ": line " + std::to_string(row.line) + " (row " + std::to_string(row.row) +
           ", time " + plain(row.time) + " s)";
  }

  int stop(const std::string& where, const Followed& path) {
    output_.finish();
    std::cerr << where << part(path.fraction) << ": " << reason(path) << "; the result ends before it\n";
    return 1;
  }

  // Where on the path the answer ends, if that is known.
  static std::string part(double fraction) {
    if (fraction <= 0 || fraction > 1) return "";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), ", after %.4g %% of the path to it", 100 * fraction);
    return text.data();
  }

  std::string reason(const Followed& path) const {
    if (!path.status) return failure_text(path.status, scene_);
    return "the event budget is spent: too many changes between sticking and sliding; add rows in between";
  }

  const SimulateOptions& options_;
  const SceneDescription& scene_;
  Model& model_;
  LogReader& log_;
  OutputFile output_;
};

}  // namespace

int simulate(const SimulateOptions& options) {
  const SceneDescription scene = read_scene_file(options.scene);
  const auto model = make_model(scene, options.method, options.numbers.scalar);
  LogRules rules;
  if (options.numbers.scalar == ScalarType::float32) {
    rules.largest = static_cast<double>(std::numeric_limits<float>::max());
  }
  check_log(options.log, scene, rules);
  keep_inputs(options.output, {options.scene, options.log});
  std::ifstream stream = open_log(options.log);
  LogReader log(stream, options.log, scene, rules);
  remark_on_columns(log, scene);
  remark_on_substeps(options);
  return Run(options, scene, *model, log)();
}

}  // namespace taut::host
