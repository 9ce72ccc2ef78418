#include "lib/commands/run_log.hpp"

#include <iostream>

#include "lib/files/output_file.hpp"

namespace taut::host {

int run_log(const RunOptions& options) {
  LogFollower follower(options);
  const SceneDescription& scene = follower.scene();
  const ResultColumns columns =
      options.method == Method::estimate ? ResultColumns::estimate : ResultColumns::state;
  OutputFile output(options.output);
  output.write(result_header(scene, columns));
  const std::string end = follower.follow([&](const LogRow& row, const Answer& answer) {
    output.write(result_row(scene, row.time, answer, options.numbers, columns));
  });
  output.finish();
  if (end.empty()) {
    follower.keep_state();
    return 0;
  }
  std::cerr << end << "; the result ends before it\n";
  return 1;
}

}  // namespace taut::host
