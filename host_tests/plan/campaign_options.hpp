// Arguments of the campaigns: names with numbers.
#pragma once

#include <cstdlib>
#include <string>

namespace plan_test {

/// Calls take(name, number) for every pair of arguments, as in `--seed 2`.
template <class Take>
void for_each_option(int argc, char** argv, Take take) {
  for (int i = 1; i + 1 < argc; i += 2) take(std::string(argv[i]), std::atol(argv[i + 1]));
}

}  // namespace plan_test
