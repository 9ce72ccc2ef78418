#include "lib/commands/run_log.hpp"

#include <iostream>

#include "lib/commands/result_writer.hpp"

namespace taut::host {

int run_log(const RunOptions& options) {
  LogFollower follower(options);
  const SceneDescription& scene = follower.scene();
  const ResultColumns columns =
      options.method == Method::estimate ? ResultColumns::estimate : ResultColumns::state;
  ResultWriter writer(options.output, scene, columns, options.numbers, options.choice);
  const std::string end =
      follower.follow([&](const LogRow& row, const Answer& answer) { writer.take(row.time, answer); });
  writer.finish();
  if (end.empty()) {
    follower.keep_state();
    return 0;
  }
  std::cerr << end << "; the result ends before it\n";
  return 1;
}

}  // namespace taut::host
