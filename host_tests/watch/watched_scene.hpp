// A structure that tests watch, and rows of its instruments.
#pragma once

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "files/run_program.hpp"

/// One cable over three saddles, anchored at its start and jacked at its end; the scene says all of its
/// instruments.
inline void write_scene(const Scratch& scratch, const std::string& name = "chain",
                        const std::string& cable = "C") {
  std::ofstream(scratch.path / "scene.json")
      << R"({ "taut": 1, "name": ")" + name + R"(", "dimension": 2,
  "nodes": { "a": [0, 0], "b": [2, 0.3], "c": [4, 0.4], "d": [6, 0.3], "e": [8, 0] },
  "supports": { "a": "xy", "b": "xy", "c": "xy", "d": "xy", "e": "xy" },
  "cables": [ { "name": ")" +
             cable + R"(", "path": ["a", "b", "c", "d", "e"], "E": 1.95e11, "A": 8e-4, "start": "anchored",
                "end": "jacked", "friction": { "law": "point", "mu": 0.2, "mu_sd": 0.1, "shared": true } } ],
  "sensors": { ")" +
             cable + R"(.start": { "sd": 300, "gain_sd": 0.01, "zero_sd": 200 },
               ")" +
             cable + R"(.end": { "sd": 300, "gain_sd": 0.01, "zero_sd": 200 },
               ")" +
             cable + R"(.end.stroke": { "sd": 0.001 } } })";
}

inline const std::string log_header = "time,C.start,C.end,C.end.stroke\n";

/// Rows from `first` on of pulling to 200 kN, letting out to 120 kN and pulling again, with noise.
inline std::vector<std::string> log_rows(int rows, unsigned seed = 7, double step = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 300);
  std::vector<std::string> lines;
  for (int i = 0; i < rows; ++i) {
    const double part = static_cast<double>(i) / rows;
    const double force = part < 0.5   ? 4e5 * part
                         : part < 0.8 ? 2e5 - 2.6e5 * (part - 0.5)
                                      : 1.22e5 + 3e5 * (part - 0.8);
    std::ostringstream line;
    line.precision(10);
    line << step * i << ',' << 0.82 * force + normal(random) << ',' << force + normal(random) << ','
         << force * 8 / (1.95e11 * 8e-4) << '\n';
    lines.push_back(line.str());
  }
  return lines;
}

inline std::string joined(const std::vector<std::string>& lines, std::size_t from = 0,
                          std::size_t to = std::string::npos) {
  std::string text;
  for (std::size_t i = from; i < lines.size() && i < to; ++i) text += lines[i];
  return text;
}

/// What `taut estimate -` makes of the log.
inline Outcome estimated(const Scratch& scratch, const std::string& log) {
  const Scratch own;
  std::ofstream(own.path / "log.csv") << log;
  return run_taut(own, "estimate " + scratch.quoted("scene.json") + " - < " + own.quoted("log.csv"));
}
