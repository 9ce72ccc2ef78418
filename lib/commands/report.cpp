#include "lib/commands/report.hpp"

#include <algorithm>
#include <iostream>
#include <memory>

#include "lib/commands/log_follower.hpp"
#include "lib/files/output_file.hpp"
#include "lib/report/report_page.hpp"
#include "lib/report/run_record.hpp"

namespace taut::host {
namespace {

// Follows the same rows with the friction of the scene, as long as there is an answer.
class Prediction {
 public:
  explicit Prediction(const SceneDescription& scene)
      : scene_(scene), model_(make_model(scene, Method::tracker, ScalarType::float64)) {
    go_on("before the first row", model_->start(1));
  }

  void advance(LogRow row) {
    if (!run_.reason.empty()) return;
    // Noise: a jack cannot push.
    for (auto& cable : row.cables)
      for (EndRow& end : cable) end.force = std::max(end.force, 0.0);
    go_on("in row " + std::to_string(row.row), model_->advance(row, 1));
  }

  NominalRun finished() {
    if (!run_.reason.empty()) return run_;
    Answer answer;
    model_->read(answer);
    const std::string number = impossible_number(scene_, answer);
    if (number.empty())
      run_.tension = answer.tension;
    else
      run_.reason = "it has no answer at the end: " + number;
    return run_;
  }

 private:
  void go_on(const std::string& where, const Followed& path) {
    if (!path.whole()) run_.reason = "it has no answer " + where + ": " + reason_to_stop(path, scene_);
  }

  const SceneDescription& scene_;
  std::unique_ptr<Model> model_;
  NominalRun run_;
};

}  // namespace

int report(const ReportOptions& options) {
  RunOptions run;
  run.scene = options.scene;
  run.log = options.log;
  run.output = options.output;
  run.method = Method::estimate;
  run.limits = options.limits;
  LogFollower follower(run);
  OutputFile output(options.output);
  RunRecord record(follower.scene());
  Prediction prediction(follower.scene());
  const std::string end = follower.follow([&](const LogRow& row, const Answer& answer) {
    record.add(row, answer);
    prediction.advance(row);
  });
  output.write(report_page({follower.scene(), options.scene, options.log, record, prediction.finished(), end,
                            follower.remarks(), follower.learned()}));
  output.finish();
  if (end.empty()) return 0;
  std::cerr << end << "; the report ends before it\n";
  return 1;
}

}  // namespace taut::host
