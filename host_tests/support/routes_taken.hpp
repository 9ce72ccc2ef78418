// How often the trackers of a thread took each route to decide an event.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>

#include "taut/tracking/route.hpp"

namespace support {

/// The Watch of the capacities that tests share. Counts for each thread by itself.
class RoutesTaken {
 public:
  using Counts = std::array<long, static_cast<std::size_t>(taut::routes)>;

  static void took(taut::Route route) { ++counts()[static_cast<std::size_t>(route)]; }
  static Counts& counts() {
    thread_local Counts all{};
    return all;
  }
};

inline void add(RoutesTaken::Counts& to, const RoutesTaken::Counts& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
}

inline long total(const RoutesTaken::Counts& counts) {
  long all = 0;
  for (const long count : counts) all += count;
  return all;
}

inline void print(const RoutesTaken::Counts& counts, const char* indent = "") {
  constexpr std::array<const char*, static_cast<std::size_t>(taut::routes)> names{
      "all modes stay",     "from the modes before",          "pulled straight toward the jack",
      "rates from nothing", "all forces a little further on", "refused"};
  const long all = total(counts);
  std::printf("%s%ld decisions in double, by route:\n", indent, all);
  for (std::size_t i = 0; i < counts.size(); ++i)
    std::printf("%s  %12ld  %9.5f %%  %s\n", indent, counts[i],
                all > 0 ? 100.0 * static_cast<double>(counts[i]) / static_cast<double>(all) : 0.0, names[i]);
}

}  // namespace support
