#include "lib/report/axis.hpp"

#include <algorithm>
#include <cmath>

#include "lib/report/number_text.hpp"

namespace taut::host {
namespace {

// 1, 2 or 5 times a power of ten, so that a span has no more than so many steps.
double round_step(double span, int most_steps) {
  const double least = span / most_steps;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

// A span that has a length, and not one that rounding errors are made of.
Range widened(const Range& range) {
  Range wide = range;
  const double size = std::max(std::fabs(range.low()), std::fabs(range.high()));
  if (range.high() - range.low() > 1e-6 * size && size > 0) return wide;
  const double margin = size > 0 ? 0.05 * size : 0.5;
  wide.include(range.low() - margin);
  wide.include(range.high() + margin);
  return wide;
}

std::vector<Tick> ticks_between(double low, double high, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::vector<Tick> ticks;
  const double first = std::ceil(low / step - 1e-6), last = std::floor(high / step + 1e-6);
  for (double k = first; k <= last && ticks.size() < 50; ++k)
    ticks.push_back({k * step, decimals > 6 ? significant(k * step, 4) : fixed(k * step, decimals)});
  return ticks;
}

}  // namespace

void Range::include(double value) {
  if (!std::isfinite(value)) return;
  if (empty()) low_ = high_ = value;
  low_ = std::min(low_, value);
  high_ = std::max(high_, value);
}

double Axis::part(double value) const { return std::clamp((value - low) / (high - low), 0.0, 1.0); }

Axis Axis::round(const Range& range, int most_ticks) {
  const Range wide = widened(range);
  const double step = round_step(wide.high() - wide.low(), most_ticks);
  Axis axis;
  axis.low = std::floor(wide.low() / step + 1e-6) * step;
  axis.high = std::ceil(wide.high() / step - 1e-6) * step;
  axis.ticks = ticks_between(axis.low, axis.high, step);
  return axis;
}

Axis Axis::exact(const Range& range, int most_ticks, double origin) {
  const Range wide = range.high() > range.low() ? range : widened(range);
  Axis axis;
  axis.low = wide.low();
  axis.high = wide.high();
  const double step = round_step(axis.high - axis.low, most_ticks);
  axis.ticks = ticks_between(axis.low - origin, axis.high - origin, step);
  for (Tick& tick : axis.ticks) tick.value += origin;
  return axis;
}

Axis Axis::counted(std::size_t n, std::size_t most_ticks) {
  Axis axis;
  axis.low = 0.5;
  axis.high = static_cast<double>(n) + 0.5;
  const auto step = n <= most_ticks
                        ? 1
                        : static_cast<std::size_t>(std::max(
                              1.0, round_step(static_cast<double>(n), static_cast<int>(most_ticks))));
  for (std::size_t i = 1; i <= n; ++i)
    if (i == 1 || step == 1 || i % step == 0)
      axis.ticks.push_back({static_cast<double>(i), std::to_string(i)});
  return axis;
}

}  // namespace taut::host
