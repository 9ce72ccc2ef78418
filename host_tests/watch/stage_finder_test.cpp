// Where jacks stand in a plan, what friction remembers of their way, and what is worth a new plan.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "files/run_program.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/live/jack_path.hpp"
#include "lib/live/mu_news.hpp"
#include "lib/live/stage_finder.hpp"
#include "watch/watched_scene.hpp"

using namespace taut::host;

namespace {

PlanStage at(std::vector<double> force, std::vector<char> locked = {}) {
  if (locked.empty()) locked.assign(force.size(), 0);
  return {std::move(force), std::move(locked)};
}

/// One jack: pull to 200 kN, let out to 180 kN, pull to 190 kN.
StageFinder three_moves() {
  return {{{{0}, false}, {{0}, false}, {{0}, false}}, {at({2e5}), at({1.8e5}), at({1.9e5})}, at({0}), {200}};
}

/// Rows of one jack, a second apart.
struct Site {
  StageFinder& finder;
  double time = 0;
  void row(double force, char locked = 0) { finder.take(time++, at({force}, {locked})); }
  void ramp(double from, double to, double step = 2000) {
    const double way = to > from ? step : -step;
    for (double force = from; way * (to - force) > 0; force += way) row(force);
    row(to);
  }
};

}  // namespace

TEST_CASE(
    "a jack is to stop when it has come to its force, and goes on to the next stage when it has stood") {
  StageFinder finder = three_moves();
  Site site{finder};
  site.ramp(0, 199000);
  CHECK(finder.present() == 0);
  CHECK(finder.direction(0) == 1);
  CHECK_FALSE(finder.is_reached());
  site.row(199900);  // within 200 N
  CHECK(finder.is_reached());
  CHECK(finder.present() == 0);
  site.row(199950);
  CHECK(finder.present() == 0);
  site.row(199900);  // two seconds
  CHECK(finder.present() == 1);
  CHECK(finder.direction(0) == -1);
  site.ramp(199900, 180000);
  CHECK(finder.is_reached());
  site.row(180000);
  site.row(180000);
  CHECK(finder.present() == 2);
  CHECK(finder.direction(0) == 1);
  site.ramp(180000, 190000);
  for (int i = 0; i < 3; ++i) site.row(190000);
  CHECK(finder.is_over());
  for (std::size_t s = 0; s < 3; ++s) CHECK_FALSE(finder.is_skipped(s));
}

TEST_CASE("a hold on the way is no end of a stage, and neither is a leak or a little let out") {
  StageFinder finder = three_moves();
  Site site{finder};
  site.ramp(0, 150000);
  for (int i = 0; i < 600; ++i) site.row(150000);
  for (int i = 0; i < 60; ++i) site.row(150000 - 50 * i);
  CHECK(finder.present() == 0);
  // The jack takes a new grip: down to less than the next stage, from less than it.
  site.ramp(147000, 20000);
  CHECK(finder.present() == 0);
  CHECK(finder.direction(0) == 1);
  // From above the next stage, but hardly.
  site.ramp(20000, 184000);
  site.ramp(184000, 179000, 500);
  CHECK(finder.present() == 0);
}

TEST_CASE("beyond its force a jack is still to stop, and the next stage begins where it turned") {
  StageFinder finder = three_moves();
  Site site{finder};
  site.ramp(0, 215000, 5000);
  CHECK(finder.present() == 0);
  CHECK(finder.is_reached());
  site.row(214000);
  CHECK(finder.present() == 1);
  CHECK(finder.memory().begin.force[0] == 215000);
  // Let out too far as well: it is to stop, not to be pulled.
  site.ramp(214000, 170000, 4000);
  CHECK(finder.present() == 1);
  CHECK(finder.is_reached());
}

TEST_CASE("a log with a row a stage goes through all stages") {
  StageFinder finder = three_moves();
  const double rows[] = {2e5, 1.8e5, 1.9e5, 1.9e5};
  std::vector<std::size_t> present;
  for (int i = 0; i < 4; ++i) {
    finder.take(600.0 * i, at({rows[i]}));
    present.push_back(finder.present());
  }
  CHECK(present == std::vector<std::size_t>{0, 1, 2, 3});
}

TEST_CASE("noise neither passes a stage nor comes back to one: the stage only goes up, a step at a time") {
  const unsigned seed = 20260;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 200; ++round) {
    StageFinder finder = three_moves();
    std::normal_distribution<double> noise(0, 60);  // of what the estimator says
    double time = 0;
    std::size_t before = 0;
    const auto go = [&](double from, double to) {
      const int rows = 100;
      for (int i = 0; i <= rows; ++i) {
        finder.take(time, at({from + (to - from) * i / rows + noise(random)}));
        time += 0.1;
        CHECK(finder.present() >= before);
        CHECK(finder.present() <= before + 1);
        before = finder.present();
      }
    };
    go(0, 1e5);
    go(1e5, 1e5);
    go(1e5, 1.99e5);
    CHECK(finder.present() == 0);
    go(1.99e5, 2e5);
    go(2e5, 2e5);
    CHECK(finder.present() == 1);
    go(2e5, 1.805e5);
    go(1.805e5, 1.805e5);
    CHECK(finder.present() == 1);
    go(1.805e5, 1.8e5);
    go(1.8e5, 1.8e5);
    CHECK(finder.present() == 2);
    go(1.8e5, 1.9e5);
    go(1.9e5, 1.9e5);
    CHECK(finder.is_over());
  }
}

TEST_CASE("a stage is skipped when the jack turns before it and comes to the next one") {
  StageFinder finder = three_moves();
  Site site{finder};
  site.ramp(0, 192000);
  site.ramp(192000, 180000);
  CHECK(finder.present() == 1);
  CHECK(finder.is_skipped(0));
  CHECK_FALSE(finder.is_skipped(1));
  CHECK(finder.is_reached());
  CHECK(finder.memory().begin.force[0] == 192000);
}

TEST_CASE("a wedge that holds passes the lock and what was to be done before it") {
  const CourseShape shape = {{{0}, false}, {{0}, false}, {{0}, true}};
  const std::vector<PlanStage> stages = {at({2e5}), at({1.8e5}), at({1.8e5}, {1})};
  StageFinder finder(shape, stages, at({0}), {200});
  Site site{finder};
  site.ramp(0, 2e5);
  site.row(2e5);
  site.row(2e5);
  CHECK(finder.present() == 1);
  site.ramp(2e5, 1.9e5);
  site.row(1.9e5, 1);
  CHECK(finder.is_over());
  CHECK_FALSE(finder.is_skipped(0));
  CHECK(finder.is_skipped(1));
  CHECK_FALSE(finder.is_skipped(2));
}

TEST_CASE("two cables in turn: what the other takes is no move, and half of its own move is") {
  const CourseShape shape = {{{0}, false}, {{1}, false}, {{0}, false}};
  const std::vector<PlanStage> stages = {at({2e5, 0}), at({2e5, 1e5}), at({1.9e5, 1e5})};
  StageFinder finder(shape, stages, at({0, 0}), {200, 200});
  double time = 0;
  for (double force = 0; force <= 1.5e5; force += 5000) finder.take(time++, at({force, force / 10}));
  CHECK(finder.present() == 0);
  for (double force = 15000; force < 45000; force += 5000) finder.take(time++, at({1.5e5, force}));
  CHECK(finder.present() == 0);
  finder.take(time++, at({1.5e5, 51000}));
  CHECK(finder.present() == 1);
  CHECK(finder.is_skipped(0));
  CHECK_FALSE(finder.is_reached());
}

TEST_CASE("what a finder remembers is enough to go on, at every row") {
  std::vector<double> rows;
  for (double force = 0; force <= 203000; force += 7000) rows.push_back(force);
  for (int i = 0; i < 4; ++i) rows.push_back(203000);
  for (double force = 203000; force > 180000; force -= 3000) rows.push_back(force);
  for (int i = 0; i < 4; ++i) rows.push_back(180000);
  rows.push_back(190000);
  StageFinder whole = three_moves();
  std::vector<std::size_t> present;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    whole.take(static_cast<double>(i), at({rows[i]}));
    present.push_back(whole.present());
  }
  CHECK(whole.present() == 2);
  for (std::size_t cut = 0; cut < rows.size(); ++cut) {
    StageFinder first = three_moves();
    for (std::size_t i = 0; i < cut; ++i) first.take(static_cast<double>(i), at({rows[i]}));
    StageFinder second = three_moves();
    second.go_on(first.memory());
    for (std::size_t i = cut; i < rows.size(); ++i) {
      second.take(static_cast<double>(i), at({rows[i]}));
      CHECK(second.present() == present[i]);
    }
  }
}

TEST_CASE("of the way of two jacks the turning points and corners stay, and nothing of its noise") {
  const unsigned seed = 20261;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-300, 300);
  JackPath path({1000, 1000});
  const std::vector<std::vector<double>> corners = {
      {0, 0}, {2e5, 0}, {2e5, 1e5}, {1.7e5, 1e5}, {1.9e5, 1.2e5}};
  for (std::size_t c = 0; c + 1 < corners.size(); ++c)
    for (int i = 0; i <= 500; ++i) {
      PastMove now{at({0, 0}), {}};
      for (std::size_t k = 0; k < 2; ++k)
        now.stage.force[k] = corners[c][k] + (corners[c + 1][k] - corners[c][k]) * i / 500 +
                             (i % 500 == 0 ? 0 : noise(random));
      path.take(now);
    }
  const std::vector<PastMove> moves = path.moves();
  // 2000 points have become a few, and every corner is one of them.
  CHECK(moves.size() <= corners.size() + 2);
  for (const std::vector<double>& corner : corners) {
    double nearest = 1e300;
    for (const PastMove& move : moves)
      nearest = std::min(nearest, std::max(std::fabs(move.stage.force[0] - corner[0]),
                                           std::fabs(move.stage.force[1] - corner[1])));
    CHECK(nearest <= 1000);
  }
  // A break in the middle of it changes nothing but that a point on a straight line may stay.
  JackPath again({1000, 1000});
  again.go_on(moves);
  again.take({at({1.95e5, 1.25e5}), {}});
  CHECK(again.moves().size() <= moves.size() + 1);
  CHECK(again.moves().back().stage.force[0] == 1.95e5);
}

TEST_CASE("where a jack is locked its force stays, and the way there is one of its own") {
  JackPath path({1000});
  path.take({at({0}), {0}});
  path.take({at({1e5}), {0}});
  path.take({at({1e5}, {1}), {0}});
  path.take({at({1e5}, {1}), {0.5}});  // a load comes on
  path.take({at({1e5}, {1}), {1}});
  const std::vector<PastMove> moves = path.moves();
  REQUIRE(moves.size() == 4);
  CHECK(moves[1].stage.locked[0] == 0);
  CHECK(moves[2].stage.locked[0] == 1);
  CHECK(moves[2].factor[0] == 0);
  CHECK(moves[3].factor[0] == 1);
}

TEST_CASE(
    "mu is news beyond twice its spread or when the spread has halved, and never by wandering within it") {
  const Scratch scratch;
  write_scene(scratch);  // three joints, mu 0.2 with 0.1, shared
  const SceneDescription scene = read_scene_file((scratch.path / "scene.json").string());
  const auto known = [](double mu, double sd) {
    return KnownMu{std::vector<double>(3, mu), std::vector<double>(3, sd)};
  };
  const KnownMu planned = known_mu(scene);
  REQUIRE(planned.sd.size() == 3);
  for (const double sd : planned.sd) CHECK(sd == doctest::Approx(0.1));
  const auto is_other = [&](const KnownMu& before, const KnownMu& now) {
    const auto news = mu_news(scene, before, now);
    return news && news->is_other;
  };
  CHECK_FALSE(mu_news(scene, planned, known(0.2, 0.1)));
  CHECK_FALSE(mu_news(scene, planned, known(0.26, 0.06)));
  CHECK(is_other(planned, known(0.26, 0.05)));
  REQUIRE(mu_news(scene, planned, known(0.22, 0.05)));
  CHECK_FALSE(is_other(planned, known(0.22, 0.05)));  // known better, and that is all
  REQUIRE(mu_news(scene, known(0.2, 0.02), known(0.26, 0.02)));
  CHECK(mu_news(scene, known(0.2, 0.02), known(0.26, 0.02))->why == "mu of C is 0.260 and not 0.200");
  CHECK_FALSE(mu_news(scene, known(0.2, 0.001), known(0.203, 0.001)));  // not worth it
  CHECK_FALSE(mu_news(scene, known(0.2, 0.002), known(0.2, 0.0005)));
  // One mu of three.
  KnownMu one = known(0.2, 0.06);
  one.mu[1] = 0.4;
  SceneDescription apart = scene;
  apart.cables[0].shared_mu = false;
  REQUIRE(mu_news(apart, known(0.2, 0.06), one));
  CHECK(mu_news(apart, known(0.2, 0.06), one)->why == "mu of joint 2 of C is 0.400 and not 0.200");
  // An estimator that learns, with a mean that is drawn as it should be: as many plans as halvings, about.
  const unsigned seed = 20262;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  int all_plans = 0, most_plans = 0, most_news = 0;
  for (int site = 0; site < 300; ++site) {
    KnownMu last = planned;
    double mu = 0.2, sd = 0.1;
    int plans = 0, all = 0;
    for (int row = 0; row < 2000; ++row) {
      // A reading of mu with a standard deviation of 0.3.
      const double narrower = 1 / std::sqrt(1 / (sd * sd) + 1 / 0.09);
      mu += std::sqrt(sd * sd - narrower * narrower) * normal(random);
      sd = narrower;
      const auto news = mu_news(scene, last, known(mu, sd));
      if (!news) continue;
      if (news->is_other) last.mu = known(mu, sd).mu;
      last.sd = known(mu, sd).sd;
      plans += news->is_other;
      ++all;
    }
    all_plans += plans;
    most_plans = std::max(most_plans, plans);
    most_news = std::max(most_news, all);
  }
  // From 0.1 to 0.0067 the spread halves three times. Between two halvings mu moves by sqrt(3) of what is
  // left as its spread, so that more than half of them are more than one of it.
  CHECK(all_plans >= 300);
  CHECK(all_plans <= 300 * 4);
  CHECK(most_plans <= 8);
  CHECK(most_news <= 10);
}
