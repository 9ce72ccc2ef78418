// Runs the tests; with --table prints every hard case and its errors as Markdown instead, with --scenes
// FOLDER writes the scenes and logs of hard cases there. --samples N is the length of the long run.
#define DOCTEST_CONFIG_IMPLEMENT
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>

#include "hard_cases/hard_case.hpp"
#include "hard_cases/long_run.hpp"

namespace {

void print_table() {
  std::printf("| case | double error | float error | events |\n| --- | --- | --- | --- |\n");
  for (const hard::HardCase& hard_case : hard::hard_cases()) {
    const hard::Measured m = hard_case.measure();
    const auto print = [](const hard::Deviation& found) {
      if (found.trouble.empty())
        std::printf(" %.0e |", std::max(found.from_reference, found.verified));
      else
        std::printf(" refused: %s |", found.trouble.c_str());
    };
    std::printf("| %s: %s |", hard_case.name, hard_case.reason);
    print(m.in_double);
    print(m.in_float);
    std::printf(" %d |\n", m.in_double.events);
    std::fflush(stdout);
  }
}

int write_scenes(const char* folder) {
  try {
    std::filesystem::create_directories(folder);
    for (const hard::HardCase& hard_case : hard::hard_cases()) {
      hard::scene_files.emplace(folder, hard_case.word);
      hard_case.measure();
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hard_cases: %s; name a folder that can be written\n", error.what());
    return 2;
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--samples") == 0 && i + 1 < argc)
      hard::long_run_samples = std::atol(argv[i + 1]);
    if (std::strcmp(argv[i], "--scenes") == 0 && i + 1 < argc) return write_scenes(argv[i + 1]);
    if (std::strcmp(argv[i], "--table") != 0) continue;
    print_table();
    return 0;
  }
  return doctest::Context(argc, argv).run();
}
