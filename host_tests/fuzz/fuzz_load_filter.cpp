// Any bytes as readings of a load cell and the times between them.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "estimation/watched_filter.hpp"

namespace {

struct Given {
  std::uint8_t step;  ///< in eighths of a decade; 255: the one before again
  std::uint8_t what;  ///< of the force: in steps, in octaves, or any number at all
  std::int16_t force;
};

// From 1e-6 to 1e8.
float step_of(std::uint8_t given) { return std::pow(10.0f, static_cast<float>(given % 113) / 8 - 6); }

float force_of(const Given& given, float before) {
  const auto amount = static_cast<float>(given.force);
  switch (given.what % 4) {
    case 0:
      return before + amount / 1024;
    case 1:
      return amount;
    case 2:
      return std::ldexp(amount / 32768, given.what / 8);
    default:
      return given.what < 8 ? std::nanf("") : given.what < 16 ? 9.9e37f : before;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  estimation::WatchedFilter<float> filter(1);
  float force = 0, step = 1;
  for (Given given; size >= sizeof given; data += sizeof given, size -= sizeof given) {
    std::memcpy(&given, data, sizeof given);
    if (given.step != 255) step = step_of(given.step);
    const float read = force_of(given, force);
    if (std::fabs(read) < 4e8f) force = read;
    filter.take(read, step);
    if (!filter.keeps_its_promises()) std::abort();
  }
  return 0;
}
