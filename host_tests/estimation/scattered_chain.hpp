// A chain of joints that slide, with a mu of its own at every joint: what their scatter does to forces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/random.hpp"
#include "taut/estimation/friction_scatter.hpp"
#include "taut/scene/scene.hpp"

namespace estimation {

struct ChainCapacity {
  static constexpr int segments = 40;
};
using ChainScatter = taut::FrictionScatter<double, ChainCapacity>;

/// Variance of the force of a segment whose derivative by unknown p is sensitivity(p).
template <class Scatter, class Sensitivity>
auto variance_of(const Scatter& scatter, int segment, const Sensitivity& sensitivity) {
  const int p = scatter.parameter(segment);
  if (p < 0) return 0 * scatter.variance(0, 0);
  const auto S = sensitivity(p);
  return S * S * scatter.variance(segment, 0);
}

/// What FrictionScatter asks of a cable.
struct ChainLayout {
  int first_segment, first_joint, number;
  std::array<taut::End, 2> ends{taut::End::jacked, taut::End::jacked};
  bool closed = false;
  int joints() const { return number; }
  int segments() const { return number + 1; }
};

/// The tension behind joint j is (1 - mu c) / (1 + mu c) of that before, with the contact factor c. The
/// shared unknown p changes every mu by `by_unknown` p; each scatters about that by the part `scatter`.
struct ScatteredChain {
  std::vector<double> contact_factor, mu;
  double by_unknown = 0.7, scatter = 0.05;
  std::array<taut::End, 2> ends{taut::End::jacked, taut::End::jacked};

  static ScatteredChain random(std::uint64_t seed) {
    support::Random random(seed);
    ScatteredChain chain;
    const int joints = 6 + random.below(6);
    for (int j = 0; j < joints; ++j) {
      chain.contact_factor.push_back(random.between(0.05, 0.25));
      chain.mu.push_back(random.between(0.1, 0.25));
    }
    return chain;
  }
  int joints() const { return static_cast<int>(contact_factor.size()); }
  double contact_factor_of(int j) const { return contact_factor[static_cast<std::size_t>(j)]; }
  double mu_of(int j) const { return mu[static_cast<std::size_t>(j)]; }
  double weight(int j) const { return by_unknown * contact_factor_of(j); }
  /// Derivative of a force by the unknown, in first order of mu: by all joints on its way from the jack.
  static auto sensitivity(double force, double way) {
    return [S = -2 * force * way](int) { return S; };
  }
  void find(ChainScatter& into, int segment, int joint, int parameter) const {
    into.clear();
    find_in(into, segment, joint, parameter);
  }
  void find_in(ChainScatter& into, int segment, int joint, int parameter, double nominal = 1) const {
    into.find(
        ChainLayout{segment, joint, joints(), ends}, parameter, nominal,
        [&](int j) { return weight(j - joint); },
        [&](int j) { return scatter * mu_of(j - joint) * contact_factor_of(j - joint); });
  }
};

/// Logarithms of the forces by that of the jack, of many chains drawn, and of what they lose over all joints.
class Strays {
 public:
  explicit Strays(int segments) : sum_(static_cast<std::size_t>(segments)), square_(sum_), product_(sum_) {}

  void add(const std::vector<double>& log_force, double whole) {
    ++count_;
    whole_ += whole;
    whole_square_ += whole * whole;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      sum_[i] += log_force[i];
      square_[i] += log_force[i] * log_force[i];
      product_[i] += log_force[i] * whole;
    }
  }
  /// In the mean, of a jack force of one.
  double force(int segment) const { return std::exp(sum_[static_cast<std::size_t>(segment)] / count_); }
  /// Of the logarithm of a force, given what all joints hold together: about its regression on that.
  double variance(int segment) const {
    const auto i = static_cast<std::size_t>(segment);
    const double own = square_[i] - sum_[i] * sum_[i] / count_,
                 of_whole = whole_square_ - whole_ * whole_ / count_,
                 both = product_[i] - sum_[i] * whole_ / count_;
    return std::max(0.0, own - both * both / of_whole) / count_;
  }

 private:
  std::vector<double> sum_, square_, product_;
  double count_ = 0, whole_ = 0, whole_square_ = 0;
};

/// Draws mu_j = mu (1 + scatter g_j) forty thousand times, with independent g_j.
inline Strays draw_strays(const ScatteredChain& chain, bool jacked_at_start, std::uint64_t seed) {
  support::Random random(1000 + seed);
  const int joints = chain.joints();
  Strays strays(joints + 1);
  std::vector<double> log_force(static_cast<std::size_t>(joints) + 1);
  // As often as is needed for a hundredth.
  for (int draw = 0; draw < 40000; ++draw) {
    double log = 0;
    for (int step = 0; step <= joints; ++step) {
      const int segment = jacked_at_start ? step : joints - step;
      log_force[static_cast<std::size_t>(segment)] = log;
      if (step == joints) break;
      const int j = jacked_at_start ? segment : segment - 1;
      const double mu = chain.mu_of(j) * (1 + chain.scatter * support::gaussian(random)),
                   kappa = mu * chain.contact_factor_of(j);
      log += std::log((1 - kappa) / (1 + kappa));
    }
    strays.add(log_force, log);
  }
  return strays;
}

}  // namespace estimation
