#include "lib/plan/friction_chain.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace taut::host {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int rounds = 50;  // of bisection

struct Band {
  double low, high;
};

Band band(const FrictionChain& chain, std::size_t i, double error) {
  if (!(chain.target[i] > 0)) return {0, chain.most[i]};
  return {(1 - error) * chain.target[i], std::min((1 + error) * chain.target[i], chain.most[i])};
}

// Forces that a chain can have up to each segment, and which segments keep them from being less or more.
struct Carried {
  Band forces;
  std::size_t low, high;
};

bool is_possible(const FrictionChain& chain, double error, FrictionBound& stop) {
  Carried at{{0, infinite}, 0, 0};
  for (std::size_t i = 0; i < chain.target.size(); ++i) {
    if (i > 0) {
      const double rho = chain.rho[i - 1];
      at.forces = rho > 0 ? Band{rho * at.forces.low, at.forces.high / rho} : Band{0, infinite};
    }
    const Band here = band(chain, i, error);
    if (here.low > here.high || here.low > at.forces.high || at.forces.low > here.high) {
      stop.high = here.low > here.high ? i : here.low > at.forces.high ? i : at.low;
      stop.low = here.low > here.high ? i : here.low > at.forces.high ? at.high : i;
      return false;
    }
    if (here.low > at.forces.low) {
      at.forces.low = here.low;
      at.low = i;
    }
    if (here.high < at.forces.high) {
      at.forces.high = here.high;
      at.high = i;
    }
  }
  return true;
}

// Goes from a segment to a jack; false if it needs more moves.
class Walk {
 public:
  Walk(const FrictionChain& chain, double error, std::size_t from, bool to_end)
      : chain_(chain), error_(error), to_end_(to_end), at_(from) {}

  bool run(double force, std::size_t moves) {
    bool rises = true;
    while (!is_at_jack()) {
      const double rho = rho_ahead();
      const std::size_t next = to_end_ ? at_ + 1 : at_ - 1;
      const Band wanted = band(chain_, next, error_);
      double ahead = rises ? force / rho : force * rho;
      if (rho == 0) {
        force_.clear();
        rises = true;
        ahead = wanted.low;
      } else if (rises && ahead > wanted.high) {
        turn(force, rises);
        ahead = wanted.high;
        if (ahead < force * rho) return false;
      } else if (!rises && ahead < wanted.low) {
        turn(force, rises);
        ahead = wanted.low;
        if (ahead > force / rho) return false;
      }
      if (!rises && ahead > wanted.high) return false;
      at_ = next;
      force = ahead;
    }
    force_.push_back(force);
    return force_.size() <= moves;
  }
  const std::vector<double>& force() const { return force_; }

 private:
  bool is_at_jack() const { return to_end_ ? at_ + 1 == chain_.target.size() : at_ == 0; }
  double rho_ahead() const { return chain_.rho[to_end_ ? at_ : at_ - 1]; }
  // The jack's force while this tooth was pulled, or let out.
  void turn(double force, bool& rises) {
    const std::size_t here = at_;
    for (; !is_at_jack(); at_ = to_end_ ? at_ + 1 : at_ - 1)
      force = rises ? force / rho_ahead() : force * rho_ahead();
    at_ = here;
    force_.push_back(force);
    rises = !rises;
  }

  const FrictionChain& chain_;
  double error_;
  bool to_end_;
  std::size_t at_;
  std::vector<double> force_;
};

}  // namespace

FrictionBound friction_bound(const FrictionChain& chain) {
  FrictionBound bound;
  if (is_possible(chain, 0, bound)) return bound;
  double below = 0, above = 1;
  for (int round = 0; round < rounds; ++round) {
    const double middle = (below + above) / 2;
    (is_possible(chain, middle, bound) ? above : below) = middle;
  }
  static_cast<void>(is_possible(chain, below, bound));
  bound.error = below;
  return bound;
}

std::optional<JackMoves> teeth(const FrictionChain& chain, std::array<bool, 2> jacked, double error,
                               std::size_t moves) {
  // With one jack all begins at the other end.
  const bool backwards = jacked[0] && !jacked[1];
  for (std::size_t k = 0; k < chain.target.size(); ++k) {
    const std::size_t i = backwards ? chain.target.size() - 1 - k : k;
    if (!(chain.target[i] > 0)) continue;
    JackMoves found;
    bool fits = true;
    for (std::size_t end = 0; end < 2 && fits; ++end) {
      if (!jacked[end]) continue;
      Walk walk(chain, error, i, end == 1);
      fits = walk.run(band(chain, i, error).low, moves);
      found[end] = walk.force();
    }
    if (fits) return found;
    if (jacked[0] != jacked[1]) break;
  }
  return std::nullopt;
}

JackMoves nearest_teeth(const FrictionChain& chain, std::array<bool, 2> jacked, std::size_t moves) {
  JackMoves best;
  double below = 0, above = 1;
  for (int round = 0; round < rounds; ++round) {
    const double middle = (below + above) / 2;
    if (auto found = teeth(chain, jacked, middle, moves)) {
      best = *found;
      above = middle;
    } else {
      below = middle;
    }
  }
  return best;
}

}  // namespace taut::host
