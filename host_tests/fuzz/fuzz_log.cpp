// Any bytes as a log of a scene that has every kind of column, also as the log of a second visit whose times
// count from a date.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "lib/files/date_time.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/scene_file.hpp"

namespace {

using namespace taut::host;

const SceneDescription& scene() {
  static const SceneDescription read = read_scene(R"({ "taut": 1, "name": "fuzz", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0], "c": [1, 1] },
    "struts": [ { "nodes": ["a", "b"], "E": 1, "A": 1 } ],
    "cables": [ { "name": "C", "path": ["a", "b"], "E": 1, "A": 1, "start": "jacked", "end": "anchored" },
                { "name": "main", "path": ["a", "b", "c"], "E": 1, "A": 1, "start": "jacked", "end": "jacked" },
                { "name": "H", "path": ["a", "b", "c"], "E": 1, "A": 1, "closed": true } ],
    "loads": { "Fy": {}, "snow": {}, "heat": {} },
    "sensors": { "main.end": { "calibration": [[0, 0], [10, 2000]] } } })",
                                                  "fuzz");
  return read;
}

void require(bool kept) {
  if (!kept) std::abort();
}

// What the reader promises of every row.
void check_row(const LogRow& row, double time_before) {
  require(std::isfinite(row.time) && row.time > time_before);
  for (const double factor : row.factor) require(std::isfinite(factor));
  for (std::size_t c = 0; c < row.cables.size(); ++c) {
    for (std::size_t end = 0; end < 2; ++end) {
      const EndRow& given = row.cables[c][end];
      require(std::isfinite(given.force));
      require(scene().cables[c].is_jacked(end) ? given.locked || given.force >= 0
                                               : !given.locked && !given.stroke);
    }
  }
}

// Follows a log to its end or to what cannot be used.
void follow(const std::string& text, const std::optional<Moment>& origin) {
  try {
    std::istringstream stream(text);
    LogReader reader(stream, "fuzz", scene());
    reader.count_from(origin);
    LogRow row = reader.first_row();
    double time = -std::numeric_limits<double>::infinity();
    while (reader.next(row)) {
      check_row(row, time);
      time = row.time;
    }
  } catch (const InputError& error) {
    require(std::string(error.what()).find('\n') == std::string::npos);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  follow(text, std::nullopt);
  follow(text, read_moment("2026-03-01T10:00:00.5Z"));
  return 0;
}
