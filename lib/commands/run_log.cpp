#include "lib/commands/run_log.hpp"

#include <iostream>

#include "lib/commands/result_writer.hpp"
#include "lib/files/input_error.hpp"

namespace taut::host {

namespace {

// Of a stream, every row is written before the next one comes, and what was written stays.
Sentence follow(LogFollower& follower, ResultWriter& writer) {
  const bool is_stream = follower.is_stream();
  if (is_stream) writer.flush();
  try {
    const Sentence end = follower.follow([&](const LogRow& row, const Answer& answer) {
      writer.take(row.time, answer);
      if (is_stream) writer.flush();
    });
    writer.finish();
    return end;
  } catch (const InputError&) {
    if (is_stream) writer.finish();
    throw;
  }
}

}  // namespace

int run_log(const RunOptions& options) {
  LogFollower follower(options);
  const SceneDescription& scene = follower.scene();
  const ResultColumns columns =
      options.method == Method::estimate ? ResultColumns::estimate : ResultColumns::state;
  ResultWriter writer(options.output, scene, columns, options.numbers, options.choice);
  const Sentence end = follow(follower, writer);
  if (end.empty()) {
    follower.keep_state();
    return 0;
  }
  std::cerr << end.english() << "; the result ends before it\n";
  return 1;
}

}  // namespace taut::host
