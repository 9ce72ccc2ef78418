// A pump that leaks a little while it holds: joints stick that are taken to slide.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "estimation/saddle_site.hpp"

namespace leaking_pump_test {
using namespace estimation;

namespace {

struct Said {
  Score mu, held, released;
  int alarms = 0;
};
/// Five stages with holds of so many rows, in which the load comes back by `leak` [N]; then it is let out to
/// 60 %, and pulled again.
Said jack_in_stages(double leak, int hold) {
  Said said;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto jacking = std::make_unique<ReadSite>(SaddleSite(), seed);
    double load = 0;
    for (int stage = 1; stage <= 5; ++stage) {
      const double from = load, to = 0.2 * full * stage;
      for (int i = 1; i <= 10; ++i) jacking->row(from + (to - from) * i / 10);
      for (int i = 1; i <= hold; ++i) {
        jacking->row(load = to - leak * (1 - std::exp(-i / 10.0)));
        // Before, a row or two are off for want of readings.
        if (i > 12) jacking->site.add_to(said.held, jacking->estimator());
      }
    }
    said.mu.add(jacking->mu_off());
    const double highest = load;
    for (const double to : {0.6, 1.0})
      for (int i = 1; i <= 30; ++i) {
        const double from = to < 1 ? highest : 0.6 * full;
        jacking->row(from + (to * full - from) * std::fmin(1.0, i / 20.0));
        jacking->site.add_to(said.released, jacking->estimator());
      }
    said.alarms += jacking->alarms;
  }
  return said;
}

}  // namespace

TEST_CASE("a load that comes back too little to be seen teaches no friction") {
  // Nothing of it counted at commit ba830d5: mu off by 9 deviations of its own where a pump leaks three
  // deviations of the noise, by 37 where holds are long; of the forces let out 51 to 96 % held.
  for (const double leak : {0.0, 0.5, 1.0, 2.0, 3.0, 6.0})
    for (const int hold : {60, 300}) {
      CAPTURE(leak);
      CAPTURE(hold);
      const Said said = jack_in_stages(leak * SaddleSite().noise, hold);
      MESSAGE("leak of ", leak, " of the noise, ", hold, " rows: mu ", said.mu.held, " of ", said.mu.count,
              " held, rms ", said.mu.rms(), "; let out ", 100 * said.released.share(), " %");
      CHECK(said.mu.share() > 0.85);
      CHECK(said.mu.rms() < 1.4);
      CHECK(said.released.share() > 0.9);
      CHECK(said.alarms <= 3);
    }
}

TEST_CASE("friction holds forces where the load was farthest, and bars have it however little it came back") {
  // At commit 74723ed, where the load of the moment counted, 83 to 85 % held of those of holds of 60 rows
  // that lose one deviation of the noise or two.
  for (const double leak : {0.0, 0.5, 1.0, 2.0, 3.0, 6.0}) {
    CAPTURE(leak);
    const Said said = jack_in_stages(leak * SaddleSite().noise, 60);
    MESSAGE("leak of ", leak, " of the noise: held ", 100 * said.held.share(), " %, rms ", said.held.rms(),
            ", worst ", said.held.worst);
    CHECK(said.held.share() > 0.9);
    CHECK(said.held.rms() < 1.3);
  }
}

TEST_CASE("holds tell little of friction, ramps as much as before") {
  const auto known_after = [](int ramp, int hold) {
    const auto jacking = std::make_unique<ReadSite>(SaddleSite(), 3);
    for (int i = 1; i <= ramp; ++i) jacking->row(full * i / ramp);
    for (int i = 0; i < hold; ++i) jacking->row(full);
    return jacking->estimator().mu_deviation(0);
  };
  CHECK(known_after(400, 0) < 0.6 * known_after(100, 0));
  CHECK(known_after(100, 1000) > 0.5 * known_after(100, 0));
}

TEST_CASE("a pump that is worked again for a row, and leaks on, has turned twice") {
  // At commit 6b34cad the jack was taken to go the other way from then on, and bars at the end were up to a
  // hundred times as wide.
  for (const int strokes : {1, 2, 5}) {
    Score held;
    double widest = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const auto pumped = std::make_unique<ReadSite>(SaddleSite(), seed);
      const double top = 0.8 * full, lost = 4 * pumped->site.noise;
      const auto row = [&](double load) {
        pumped->row(load);
        pumped->site.add_to(held, pumped->estimator());
      };
      for (int i = 1; i <= 30; ++i) row(top * i / 30);
      for (int i = 0; i < 8 * strokes; ++i) row(top - lost * (i % 8 + 1));
      for (int i = 0; i <= 4; ++i) row(top - lost * i);
      const double from = top - 4 * lost;
      for (int i = 1; i <= 30; ++i) row(from + (full - from) * i / 30);
      for (int i = 0; i < 12; ++i) row(full);
      widest = std::fmax(widest, pumped->estimator().deviation(0) / pumped->site.noise);
    }
    MESSAGE("", strokes, " strokes, seeds 1 to 40: ", 100 * held.share(), " % held, rms ", held.rms(),
            "; at the end bars are up to ", widest, " of the noise");
    CHECK(widest < 6);
    CHECK(held.share() > 0.93);
    CHECK(held.rms() < 1.1);
  }
}

}  // namespace leaking_pump_test
