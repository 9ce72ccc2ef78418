// Follows a simulated jacking as a device would, and says how far its forces, and their error bars, are to be
// trusted.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "host/jacking/page.hpp"
#include "host/jacking/site.hpp"
#include "monitor/scene_sources.hpp"

namespace {

using namespace monitor::host;
using Source = monitor::CondensedAtStartUp<tendon>;
using Estimator = taut::Estimator<Source::Model, Source::unknowns, Source::reading_unknowns>;
using Tracker = taut::Tracker<Source::Model>;

constexpr int segments = TendonCapacity::segments, shown = 2;  // the middle of the span
constexpr unsigned drawn_jackings = 100;
constexpr double kilo = 1000, interval = 1.96;

// In the sense of float, as on a device: too large for the stack.
Source source;
Estimator estimator;
Tracker nominal;

Estimator::ReadingsType readings_of(const SiteRow& row) {
  Estimator::ReadingsType readings;
  auto& [anchored, jacked] = readings.ends[0];
  anchored.has_force = jacked.has_force = true;
  anchored.force = static_cast<float>(row.far_end);
  jacked.force = static_cast<float>(row.jack);
  readings.sample.jack[0][1].locked = row.locked;
  return readings;
}

// Friction as the scene has it, and a jack that is believed.
taut::Status follow_nominal(const SiteRow& row) {
  taut::Sample<float, TendonCapacity> sample;
  sample.jack[0][1] = {static_cast<float>(std::max(row.jack, 0.0)), row.locked};
  return nominal.advance(sample).status;
}

RecordedRow record(const Reality& reality, double time, const SiteRow& row) {
  RecordedRow recorded;
  recorded.time = time;
  for (int i = 0; i < segments; ++i) {
    const auto [force, deviation] = estimator.estimate(i);
    recorded.segment.push_back({row.force[i] / kilo, static_cast<double>(force) / kilo,
                                static_cast<double>(deviation) / kilo,
                                static_cast<double>(nominal.tension(i)) / kilo});
  }
  const double true_mean =
      std::accumulate(reality.mu.begin(), reality.mu.end(), 0.0) / TendonCapacity::joints;
  recorded.mu = {true_mean, static_cast<double>(estimator.mu(0)),
                 static_cast<double>(estimator.mu_deviation(0)), tendon.cables[0].mu};
  return recorded;
}

constexpr const char* table_head =
    R"(                |   load cells [kN]   |  mid-span, where nothing is read [kN]           |
                |      jack    anchor |    true  estimate    95 %        off    as told |    mu     sd
----------------+---------------------+-------------------------------------------------+--------------)";

double percent_off(double force, double truth) { return 100 * (force / truth - 1); }

void print_line(const char* words, const SiteRow& row, const RecordedRow& recorded) {
  const Compared& value = recorded.segment[shown];
  std::printf("%-15s | %9.0f %9.0f | %7.0f  %8.0f  +- %3.0f   %+6.2f %%   %+6.2f %% | %.3f  %.3f\n", words,
              row.jack / kilo, row.far_end / kilo, value.truth, value.estimate, interval * value.deviation,
              percent_off(value.estimate, value.truth), percent_off(value.nominal, value.truth),
              recorded.mu.estimate, recorded.mu.deviation);
}

// Of all forces from a tenth of the largest one on.
struct Worth {
  int forces = 0, inside = 0;
  double squares = 0, nominal_squares = 0;

  void add(const RecordedRow& row) {
    for (const Compared& value : row.segment) {
      if (value.truth < full_force / kilo / 10) continue;
      ++forces;
      if (std::fabs(value.estimate - value.truth) <= interval * value.deviation) ++inside;
      squares += std::pow(percent_off(value.estimate, value.truth), 2);
      nominal_squares += std::pow(percent_off(value.nominal, value.truth), 2);
    }
  }
  void add(const Worth& other) {
    forces += other.forces;
    inside += other.inside;
    squares += other.squares;
    nominal_squares += other.nominal_squares;
  }
  std::string words() const {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "%.1f %% of %d forces lie in their 95 %% interval;\n  they are off by %.2f %% (rms), with mu as "
        "told and cells believed by %.2f %%.",
        100.0 * inside / forces, forces, std::sqrt(squares / forces), std::sqrt(nominal_squares / forces));
    return text;
  }
};

struct Jacking {
  std::vector<RecordedRow> rows;
  Worth worth;
};

bool follow(const Reality& reality, const Chance& chance, bool told, Jacking& jacking) {
  Site site(reality, chance);
  if (!estimator.start(source.model(), source.prior()).status || !nominal.start(source.model()).status ||
      !site.start())
    return false;
  double at = 0;
  for (const Deed& deed : deeds) {
    const double from = at;
    SiteRow row;
    for (int i = 1; i <= deed.rows; ++i) {
      at = from + (deed.force - from) * i / deed.rows;
      if (!site.go_to(at, deed.locked, row) || !estimator.advance(readings_of(row)).status ||
          !follow_nominal(row))
        return false;
      jacking.rows.push_back(record(reality, static_cast<double>(jacking.rows.size() + 1), row));
      jacking.worth.add(jacking.rows.back());
    }
    if (told) print_line(deed.words, row, jacking.rows.back());
  }
  return true;
}

int show(const std::string& file) {
  const char* title = "A tendon over four saddles, jacked with load cells that lie (simulated)";
  const std::string told =
      "The device is told mu 0.12 +- 0.03; in reality it is 0.148 to 0.171, a saddle each.";
  const std::string lies =
      "The jack's cell reads 0.6 % high, that at the anchor 0.4 % low, both with a zero and noise.";
  std::printf("%s\n\n%s\n%s\n\n", title, told.c_str(), lies.c_str());
  std::puts(table_head);
  Jacking shown_jacking;
  if (!source.prepare(0) || !follow(shown_reality, Chance(20261124), true, shown_jacking)) return 1;

  // One jacking says little about an interval.
  Worth worth;
  for (unsigned seed = 1; seed <= drawn_jackings; ++seed) {
    Chance chance(seed);
    const Reality reality = draw_reality(chance);
    Jacking drawn;
    if (!follow(reality, chance, false, drawn)) return 1;
    worth.add(drawn.worth);
  }
  const std::string this_one = "In this jacking " + shown_jacking.worth.words();
  const std::string others = "In " + std::to_string(drawn_jackings) +
                             " more, with friction, wedge and cells drawn anew, " + worth.words();
  std::printf("\n%s\n%s\n", this_one.c_str(), others.c_str());

  std::ofstream page(file, std::ios::binary);
  page << jacking_page(title, {told, lies, this_one, others}, shown_jacking.rows, shown);
  page.close();
  if (!page) {
    std::fprintf(stderr, "jacking: cannot write %s: is there such a folder, and room in it?\n", file.c_str());
    return 2;
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 || arguments[1][0] == '-') {
    std::puts(
        "usage: jacking PAGE.html\nFollows a simulated jacking, prints what is estimated beside what is "
        "true, and writes a page.");
    return count == 2 ? 0 : 2;
  }
  return show(arguments[1]);
}
