#include "lib/commands/report.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include "lib/commands/log_follower.hpp"
#include "lib/files/file_text.hpp"
#include "lib/files/output_file.hpp"
#include "lib/files/sha256.hpp"
#include "lib/plan/goal_file.hpp"
#include "lib/report/report_page.hpp"
#include "lib/report/run_record.hpp"

namespace taut::host {
namespace {

// Follows the same rows with the friction of the scene, as long as there is an answer.
class Prediction {
 public:
  explicit Prediction(const SceneDescription& scene)
      : scene_(scene), model_(make_model(scene, Method::tracker, ScalarType::float64)) {
    go_on(Sentence("before the first row"), model_->start(1));
  }

  /// The answer to the row; null where there is none.
  const Answer* advance(LogRow row) {
    if (!run_.reason.empty()) return nullptr;
    // Noise: a jack cannot push.
    for (auto& cable : row.cables)
      for (EndRow& end : cable) end.force = std::max(end.force, 0.0);
    go_on(Sentence("in row {1}", {std::to_string(row.row)}), model_->advance(row, 1));
    if (!run_.reason.empty()) return nullptr;
    model_->read(answer_);
    return &answer_;
  }

  NominalRun finished() {
    if (!run_.reason.empty()) return run_;
    model_->read(answer_);
    const std::string number = impossible_number(scene_, answer_);
    if (number.empty())
      run_.tension = answer_.tension;
    else
      run_.reason = Sentence("it has no answer at the end: {1}", {number});
    return run_;
  }

 private:
  void go_on(const Sentence& where, const Followed& path) {
    if (!path.whole())
      run_.reason = Sentence("it has no answer {1}: {2}", {where, reason_to_stop(path, scene_)});
  }

  const SceneDescription& scene_;
  std::unique_ptr<Model> model_;
  Answer answer_;
  NominalRun run_;
};

constexpr std::size_t largest_file = std::size_t{1} << 30;

// What is signed beside the run.
StressingSheet sheet_of(const ReportOptions& options, const LogFollower& follower) {
  StressingSheet sheet;
  if (!options.job.empty()) sheet.job = read_job_file(options.job, follower.scene());
  if (!options.goal.empty()) {
    const PlanGoal goal = read_goal_file(options.goal, follower.scene());
    sheet.target = goal.target;
    sheet.most_segment = goal.most_segment;
  }
  sheet.version = TAUT_VERSION;
  sheet.scene_hash = sha256(read_text(options.scene, largest_file, "scene file"));
  sheet.log_hash = sha256(read_text(options.log, largest_file, "log file"));
  sheet.least_force = std::max(options.limits.least_force, 0.0);
  if (options.limits.most_force >= 0) sheet.most_force = options.limits.most_force;
  if (!sheet.job.elongation_tolerance) sheet.job.elongation_tolerance = options.limits.elongation;
  return sheet;
}

}  // namespace

int report(const ReportOptions& options) {
  RunOptions run;
  run.scene = options.scene;
  run.log = options.log;
  run.output = options.output;
  run.method = Method::estimate;
  run.limits = options.limits;
  LogFollower follower(run);
  keep_inputs(options.output, {options.job, options.goal});
  StressingSheet sheet = sheet_of(options, follower);
  OutputFile output(options.output);
  RunRecord record(follower.scene());
  Prediction prediction(follower.scene());
  const Sentence end = follower.follow(
      [&](const LogRow& row, const Answer& answer) { record.add(row, answer, prediction.advance(row)); });
  if (follower.began()) sheet.began = moment_text(*follower.began());
  output.write(report_page({follower.scene(), options.scene, options.log, record, prediction.finished(), end,
                            follower.remarks(), follower.learned(), std::move(sheet), follower.struts(),
                            Words(options.language)}));
  output.finish();
  if (end.empty()) return 0;
  std::cerr << end.english() << "; the report ends before it\n";
  return 1;
}

}  // namespace taut::host
