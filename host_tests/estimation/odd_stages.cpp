// Logs with a row a load stage: steps that are no longer even, and readings that were misread.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "estimation/each_seed.hpp"
#include "estimation/jacked_chain.hpp"

namespace odd_stages_test {
using namespace estimation;

namespace {

/// Load stages a minute apart, perhaps with a cell at the far end, and their truth.
class Stages {
 public:
  Stages(std::uint64_t seed, bool has_far_end)
      : random_(seed), said_(said(has_far_end)), jacked_(4e-3, said_), chain_(mu) {}

  /// The jack pulls so much of the full load; its cell is read as so many times that.
  void pull(double part, double misread = 1) {
    chain_.pull(part * full);
    read(part * full * misread, false);
  }
  /// The wedge holds, the jack is let out; the log has that, or not.
  void lock(bool is_said = true) {
    if (!is_locked_) chain_.lock(4e-3);
    is_locked_ = true;
    read(0, is_said);
  }
  /// From here on both are read in such steps [N].
  void show_in_steps(double step) { step_ = step; }
  /// From here on the far end keeps what it reads.
  void freeze_far_end() { is_frozen_ = true; }
  int outliers() const { return outliers_; }
  Score here() const { return score_of(jacked_, chain_); }
  double off() const { return largest_error(jacked_, chain_); }
  double force(int segment) const { return jacked_[segment].force; }
  double deviation(int segment) const { return jacked_[segment].deviation; }

 private:
  static Said said(bool has_far_end) {
    Said said;
    said.jack_sd = 1e-3 * full;
    said.far_sd = has_far_end ? 1e-3 * full : 0;
    return said;
  }
  double noise() { return said_.jack_sd * support::gaussian(random_); }
  void read(double jack, bool is_locked) {
    const auto shown = [this](double force) {
      const double reading = force + noise();
      return step_ > 0 ? step_ * std::round(reading / step_) : reading;
    };
    if (said_.far_sd > 0 && !is_frozen_) far_end_ = std::max(0.0, shown(chain_[0]));
    jacked_.row(shown(jack), is_locked, 60, far_end_);
    outliers_ += jacked_.raises(taut::Alarm::Kind::outlier) ? 1 : 0;
  }

  support::Random random_;
  Said said_;
  Jacked jacked_;
  Chain chain_;
  bool is_locked_ = false, is_frozen_ = false;
  double step_ = 0, far_end_ = -1;
  int outliers_ = 0;
};

constexpr bool has_far_end = true, has_none = false;

}  // namespace

TEST_CASE("a last stage that is smaller than the even ones before, and back from there, is no outlier") {
  for (const bool has_cell : {has_none, has_far_end})
    for (const int even : {4, 8, 12})
      for (const double over : {1.03, 1.05}) {
        CAPTURE(has_cell);
        CAPTURE(even);
        CAPTURE(over);
        for_each_seed<Stages>(has_cell, [&](Stages& stages) {
          for (int i = 1; i <= even; ++i) stages.pull(1.0 * i / even);
          stages.pull(over);
          CHECK(stages.here().worst < 3.5);
          stages.pull(1);
          CHECK(stages.here().worst < 3.5);
          stages.lock();
          CHECK(stages.here().worst < 3.5);
          CHECK(stages.outliers() == 0);
        });
      }
}

TEST_CASE(
    "a stage of the jack that the far end has not seen was misread: it is left out, and forces stay true") {
  for (const double misread : {10.0, 1.5, 0.1})
    for (const int at : {3, 5, 7, 8}) {
      CAPTURE(misread);
      CAPTURE(at);
      for_each_seed<Stages>(has_far_end, [&](Stages& stages) {
        for (int i = 1; i <= 8; ++i) {
          stages.pull(i / 8.0, i == at ? misread : 1);
          if (i >= at) CHECK(stages.here().worst < 4);
        }
        CHECK(stages.outliers() >= 1);
        stages.pull(1.05);
        CHECK(stages.off() < 0.02);
        stages.lock();
        CHECK(stages.here().worst < 4);
        CHECK(stages.off() < 0.03);
      });
    }
}

TEST_CASE("a stage that is misread in a hold is left out, though the far end shows the very same again") {
  for (const double step : {0.0, 0.003})
    for (const double misread : {10.0, 1.4, 1.2, 0.1})
      for (const int rests : {1, 3}) {
        CAPTURE(step);
        CAPTURE(misread);
        CAPTURE(rests);
        for_each_seed<Stages>(has_far_end, [&](Stages& stages) {
          stages.show_in_steps(step * full);
          for (int i = 1; i <= 8; ++i) stages.pull(i / 8.0);
          for (int i = 0; i < rests; ++i) stages.pull(1);
          REQUIRE(stages.off() < 0.02);
          stages.pull(1, misread);
          CHECK(stages.outliers() == 1);
          CHECK(stages.off() < 0.02);
          stages.pull(1);
          CHECK(stages.off() < 0.02);
          stages.lock();
          CHECK(stages.off() < 0.03);
        });
      }
}

TEST_CASE("a far end whose cell is dead holds the jack's stages back for a row at most") {
  for_each_seed<Stages>(has_far_end, [](Stages& stages) {
    const auto at_jack = [&] { return stages.force(segments - 1) / full; };
    for (const double load : {0.1, 0.2, 0.3}) stages.pull(load);
    stages.freeze_far_end();
    bool was_behind = false;
    for (const double load : {0.4, 0.5, 0.6, 0.8, 1.0, 1.0, 0.5, 0.1, 0.1}) {
      CAPTURE(load);
      stages.pull(load);
      const bool is_behind = std::fabs(at_jack() - load) > 0.02;
      CHECK_FALSE((is_behind && was_behind));
      was_behind = is_behind;
    }
  });
}

TEST_CASE("stages that the far end follows are believed, however far they go, and releases as well") {
  for (const std::vector<double>& loads :
       {std::vector<double>{0.05, 0.1, 0.6, 1},
        {0.2, 0.4, 0.6, 0.8, 1, 0.6, 0.3, 0.1, 0.02, 0.5, 1},
        {0.25, 0.5, 1, 0.97, 0.02},
        // Down so far that all slides back, and up again: the far end hears of it late.
        {0.25, 0.5, 0.75, 0.4, 0.25, 0.26, 0.5, 0.75, 1}})
    for_each_seed<Stages>(has_far_end, [&](Stages& stages) {
      for (const double load : loads) {
        stages.pull(load);
        CAPTURE(load);
        CHECK(stages.here().worst < 4);
      }
      CHECK(stages.outliers() == 0);
    });
}

TEST_CASE("a wedge that holds two stages before the log says so is seen by the far end: forces stay true") {
  for_each_seed<Stages>(has_far_end, [](Stages& stages) {
    for (const double load : {0.25, 0.5, 0.75, 1.0, 1.0}) stages.pull(load);
    for (int i = 0; i < 2; ++i) stages.lock(false);
    for (int i = 0; i < 3; ++i) stages.lock();
    CHECK(stages.here().held == segments);
    CHECK(stages.off() < 0.02);
  });
}

TEST_CASE("with the jack alone a stage of ten times the load waits for the next one, and bars reach there") {
  for_each_seed<Stages>(has_none, [](Stages& stages) {
    for (const double load : {0.2, 0.4, 0.6}) stages.pull(load);
    stages.pull(0.8, 10);
    CHECK(stages.off() < 0.4);
    CHECK(stages.deviation(segments - 1) > 2 * full);
    stages.pull(1);
    CHECK(stages.outliers() == 1);
    CHECK(stages.here().held == segments);
  });
  // One that was right is believed then.
  for_each_seed<Stages>(has_none, [](Stages& steep) {
    for (const double load : {0.05, 0.1}) steep.pull(load);
    for (int i = 0; i < 2; ++i) steep.pull(0.8);
    CHECK(steep.here().held == segments);
  });
}

}  // namespace odd_stages_test
