// Arguments of the campaigns: names with numbers.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>

namespace plan_test {

struct Option {
  const char* name;
  int* number;
};

/// Reads pairs of arguments, as in `--seed 2`. Anything else ends the program with exit status 2, before a
/// campaign of many minutes begins.
inline void read_options(int argc, char** argv, std::initializer_list<Option> options) {
  for (int i = 1; i < argc; i += 2) {
    int* number = nullptr;
    for (const Option& option : options)
      if (argv[i] == std::string(option.name)) number = option.number;
    if (number == nullptr || i + 1 == argc) {
      std::fprintf(stderr, "%s: %s: give an option and a number. Options:", argv[0], argv[i]);
      for (const Option& option : options) std::fprintf(stderr, " %s %d", option.name, *option.number);
      std::fprintf(stderr, "\n");
      std::exit(2);
    }
    *number = std::atoi(argv[i + 1]);
  }
}

}  // namespace plan_test
