// One cable with any coupling between its segments, and its laws in dense matrices.
#pragma once

#include <vector>

#include "support/dense.hpp"
#include "taut/tracking/active_set.hpp"

namespace unit {

using support::Matrix;
using support::product;
using support::Random;
using support::Vector;

constexpr int most = 8;
/// On a structure every segment feels every other, between rigid saddles none; and a capacity for both.
struct OnStructure : taut::Capacity {
  static constexpr int struts = 1, segments = most, joints = most, loads = 2;
};
struct OnSaddles : taut::Capacity {
  static constexpr int segments = most, joints = most, loads = 2;
};
struct OnEither : OnStructure {
  static constexpr bool saddles = true;
};

/// A condensed scene of one cable of n segments, with random numbers of order one.
template <class Cap, class Scalar = double>
struct AnyCable {
  using Model = taut::Condensed<Scalar, Cap>;
  using Laws = taut::JointConstraints<Model>;
  using Tensions = taut::FixedArray<double, most>;

  AnyCable(Random& random, int n, bool closed, bool coupled) {
    taut::CableLayout<Scalar> cable;
    cable.closed = closed;
    cable.ends = {taut::End::jacked, taut::End::jacked};
    cable.nodes = closed ? n : n + 1;
    model.cables.add(cable);
    model.segments = n;
    model.joints = cable.joints();
    model.loads = 2;
    C = Matrix::Zero(n, n);
    if (coupled) C = product(support::random_matrix(random, n, n), support::random_matrix(random, n, n));
    C = 0.5 * product(C, C.transpose());
    for (int i = 0; i < n; ++i) C(i, i) += random.between(0.5, 2);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) model.coupling.set(i, k, C(i, k));
      model.prestrain[i] = random.between(-1, 1);
      for (int load = 0; load < 2; ++load) model.load[load][i] = random.between(-1, 1);
    }
    for (int j = 0; j < model.joints; ++j) model.rho[j] = random.between(0.3, 0.95);
    laws.find(model);
  }

  int n() const { return model.segments; }
  int before(int joint) const { return model.cables[0].closed ? (joint + n() - 1) % n() : joint; }
  int after(int joint) const { return model.cables[0].closed ? joint : joint + 1; }

  taut::ActiveConstraint slip(int joint, bool forward) const {
    return laws.sliding(
        taut::SlipMode::of(joint, forward ? taut::JointState::forward : taut::JointState::backward));
  }
  taut::ActiveConstraint slack_length(int segment) const {
    return {taut::SlipVariable::of(taut::SlipVariable::Kind::slack_length, segment, segment),
            static_cast<std::int16_t>(segment)};
  }
  taut::ActiveConstraint extension(int end) const {
    const int segment = end == 0 ? 0 : n() - 1;
    return {taut::SlipVariable::of(taut::SlipVariable::Kind::extension, end, segment),
            static_cast<std::int16_t>(segment)};
  }
  /// A slip variable with its law, of any kind.
  taut::ActiveConstraint any(Random& random) const {
    const int kind = random.below(10);
    if (kind < 7 && model.joints > 0) return slip(random.below(model.joints), random.coin());
    if (kind < 9 || model.cables[0].closed) return slack_length(random.below(n()));
    return extension(random.below(2));
  }

  /// Coefficients of a law on the tensions, and elongations of a unit slip.
  Vector law(const taut::ActiveConstraint& active) const {
    Vector row = Vector::Zero(n());
    if (!active.slides()) {
      row[active.on] = 1;
      return row;
    }
    const int joint = active.variable.index;
    const bool forward = active.sense > 0;
    row[forward ? before(joint) : after(joint)] = 1;
    row[forward ? after(joint) : before(joint)] = -model.rho[joint];
    return row;
  }
  Vector elongation(const taut::ActiveConstraint& active) const {
    Vector e = Vector::Zero(n());
    if (active.variable.kind == taut::SlipVariable::Kind::slip) {
      e[before(active.variable.index)] += 1;
      e[after(active.variable.index)] -= 1;
    } else {
      e[active.on] = 1;
    }
    return e;
  }

  /// The laws R of some slips, their elongations E, and R C E.
  struct Dense {
    Matrix R, E, RW;
  };
  Dense dense(const std::vector<taut::ActiveConstraint>& values) const { return dense(values, C); }
  Dense dense(const std::vector<taut::ActiveConstraint>& values, const Matrix& coupling) const {
    const int m = static_cast<int>(values.size());
    Dense made{Matrix::Zero(m, n()), Matrix::Zero(n(), m), Matrix::Zero(m, m)};
    for (int i = 0; i < m; ++i) {
      made.R.row(i) = law(values[static_cast<std::size_t>(i)]).transpose();
      made.E.col(i) = elongation(values[static_cast<std::size_t>(i)]);
    }
    made.RW = product(made.R, product(coupling, made.E));
    return made;
  }

  Model model{};
  Laws laws;
  Matrix C;  // the coupling
};

template <class Array>
Vector to_vector(const Array& from, int n) {
  Vector made(n);
  for (int i = 0; i < n; ++i) made[i] = from[i];
  return made;
}
template <class Array>
void fill(Array& to, const Vector& from) {
  to.fill(0);
  for (int i = 0; i < from.size(); ++i) to[i] = from[i];
}

}  // namespace unit
