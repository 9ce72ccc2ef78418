#include "lib/plan/prior.hpp"

#include <algorithm>
#include <cmath>

#include "lib/plan/objective.hpp"

namespace taut::host {
namespace {

constexpr std::size_t draws_linear = 100, draws_second_order = 32;

// The coordinates of a point of the sequence, one after the other.
class Coordinates {
 public:
  explicit Coordinates(std::size_t number) : number_(static_cast<double>(number) + 0.5) {}

  // Standard normal.
  double normal() {
    next_prime();
    const double at = number_ * std::sqrt(static_cast<double>(prime_));
    return quantile(std::clamp(at - std::floor(at), 1e-6, 1 - 1e-6));
  }

 private:
  void next_prime() {
    const auto is_prime = [](int n) {
      for (int d = 2; d * d <= n; ++d)
        if (n % d == 0) return false;
      return true;
    };
    do ++prime_;
    while (!is_prime(prime_));
  }
  // The inverse of the normal distribution, by bisection.
  static double quantile(double probability) {
    double low = -6, high = 6;
    for (int round = 0; round < 50; ++round) {
      const double middle = (low + high) / 2;
      (std::erfc(-middle / std::sqrt(2.0)) / 2 < probability ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  double number_;
  int prime_ = 1;
};

double mean(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double each : numbers) sum += each;
  return numbers.empty() ? 0 : sum / static_cast<double>(numbers.size());
}

// Of numbers in ascending order.
double quantile(const std::vector<double>& sorted, double probability) {
  const double at = probability * static_cast<double>(sorted.size()) - 0.5;
  const double clamped = std::clamp(at, 0.0, static_cast<double>(sorted.size() - 1));
  const auto below = static_cast<std::size_t>(clamped);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (clamped - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

bool has_prior(const SceneDescription& scene) {
  return std::any_of(scene.cables.begin(), scene.cables.end(),
                     [](const CableDescription& cable) { return cable.mu_sd > 0 && cable.joints() > 0; });
}

SceneDescription drawn(const SceneDescription& scene, std::size_t number) {
  SceneDescription other = scene;
  Coordinates coordinates(number);
  for (CableDescription& cable : other.cables) {
    if (!(cable.mu_sd > 0) || cable.joints() == 0) continue;
    const double middle = mean(cable.mu);
    const double factor = cable.shared_mu && middle > 0 ? 1 + cable.mu_sd / middle * coordinates.normal() : 1;
    for (double& mu : cable.mu) {
      if (cable.shared_mu)
        mu *= factor * (cable.scatter > 0 ? 1 + cable.scatter * coordinates.normal() : 1);
      else
        mu += cable.mu_sd * coordinates.normal();
      mu = std::max(mu, 0.0);
    }
  }
  return other;
}

SceneDescription with_mu(const SceneDescription& scene, const std::vector<double>& mu,
                         const std::vector<double>& deviation) {
  SceneDescription other = scene;
  std::size_t joint = 0;
  for (CableDescription& cable : other.cables) {
    std::vector<double> sd;
    for (double& each : cable.mu) {
      each = std::max(mu[joint], 0.0);
      sd.push_back(deviation[joint++]);
    }
    cable.mu_sd = mean(sd);
    cable.has_mu_sd = true;
  }
  return other;
}

std::size_t draws_of(const SceneDescription& scene) {
  return scene.second_order ? draws_second_order : draws_linear;
}

PriorOutcome outcome_over_prior(const SceneDescription& scene, const PlanGoal& goal,
                                const std::vector<PlanJack>& jacks, const std::vector<PlanStage>& stages,
                                const std::vector<PastMove>& past, const GiveUp& give_up) {
  PriorOutcome outcome;
  std::vector<double> error;
  std::vector<std::vector<std::vector<double>>> stroke(stages.size(),
                                                       std::vector<std::vector<double>>(jacks.size()));
  const std::size_t draws = draws_of(scene);
  for (std::size_t number = 0; number < draws; ++number) {
    const SceneDescription other = drawn(scene, number);
    Jacking jacking(other, goal, jacks, give_up);
    ++outcome.draws;
    bool whole = past.empty() ? jacking.begin() : jacking.begin_after(past);
    std::vector<LegPoint> points;
    for (std::size_t s = 0; s < stages.size() && whole; ++s) {
      const Leg leg = jacking.jump(stages[s]);
      whole = leg.whole;
      points.push_back(leg.end());
    }
    if (!whole) {
      ++outcome.failed;
      continue;
    }
    error.push_back(off_target(points.back().tension, goal.target));
    for (std::size_t s = 0; s < stages.size(); ++s)
      for (std::size_t k = 0; k < jacks.size(); ++k) stroke[s][k].push_back(points[s].stroke[k]);
  }
  if (error.empty()) return outcome;
  outcome.expected = mean(error);
  std::sort(error.begin(), error.end());
  outcome.at_95 = quantile(error, 0.95);
  for (auto& stage : stroke) {
    outcome.stroke.emplace_back();
    for (auto& of_jack : stage) {
      std::sort(of_jack.begin(), of_jack.end());
      outcome.stroke.back().push_back({quantile(of_jack, 0.025), quantile(of_jack, 0.975)});
    }
  }
  return outcome;
}

}  // namespace taut::host
