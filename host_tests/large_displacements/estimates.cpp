// Random structures jacked with friction that is known to 30 %, as `taut estimate` in second-order theory
// finds their forces:
//
//     large_displacements_estimates [--count N] [--first I] [--program PATH]
//
// True forces are those at large displacements. README.md here has the table.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "large_displacements/estimated.hpp"

using namespace large_displacements;

int main(int count, char** words) {
  int first = 1, seeds = 1000;
  std::string taut = TAUT_PROGRAM;
  for (int i = 1; i + 1 < count; i += 2) {
    const std::string word = words[i];
    if (word == "--count") seeds = std::atoi(words[i + 1]);
    if (word == "--first") first = std::atoi(words[i + 1]);
    if (word == "--program") taut = words[i + 1];
  }
  std::map<std::pair<std::string, bool>, Summary> tables;
  for (int seed = first; seed < first + seeds; ++seed) {
    const Jacking jacking = random_jacking(static_cast<std::uint64_t>(seed));
    if (jacking.model.cables[0].closed) continue;
    // The name is random-7-radial.
    const std::string& name = jacking.model.name;
    const std::string kind = name.substr(name.find('-', 7) + 1);
    for (const bool has_far_end : {false, true}) {
      std::mt19937_64 generator(static_cast<unsigned>(2 * seed + (has_far_end ? 1 : 0)));
      std::normal_distribution<double> normal;
      Known known;
      known.mu = std::max(0.4, 1 + 0.3 * normal(generator));
      known.scatter = 0.12;
      known.has_far_end = has_far_end;
      known.seed = static_cast<unsigned>(generator());
      const auto found = estimate(jacking, known, taut);
      if (!found) continue;
      tables[{kind, has_far_end}].add(*found);
      tables[{"~all", has_far_end}].add(*found);
      if (found->force.size() < found->rows)
        std::fprintf(stderr, "%s, mu %.2f times what it is: %s", name.c_str(), known.mu, found->said.c_str());
    }
  }
  std::printf(
      "| | far end | jackings | not to the end | coverage [%%] | error, rms [%%] | rms of error / sd |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const auto& [of, sum] : tables) {
    const auto n = static_cast<double>(sum.count);
    std::printf("| %s | %s | %d | %d | %.1f | %.2f | %.2f |\n", of.first[0] == '~' ? "all" : of.first.c_str(),
                of.second ? "read" : "-", sum.jackings, sum.unanswered,
                100 * static_cast<double>(sum.held) / n, 100 * std::sqrt(sum.off_squared / n),
                std::sqrt(sum.share_squared / n));
  }
}
