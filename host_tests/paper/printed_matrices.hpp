// The element matrices as they are printed in section 2, on (u3, v3, u4, v4, sigma_n, sigma_s).
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace paper {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Eq. (14).
inline Eigen::Matrix<double, 2, 4> printed_L(double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  Eigen::Matrix<double, 2, 4> L;
  L << -c, -s, c, s,  //
      s, -c, -s, c;
  return L;
}

/// Eq. (4): forces on nodes 3 and 4 from the internal ones.
inline Eigen::Matrix<double, 4, 2> printed_equilibrium(double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  Eigen::Matrix<double, 4, 2> B;
  B << -c, s,  //
      -s, -c,  //
      c, -s,   //
      s, c;
  return B;
}

/// Eq. (35), with the misprint in row 4.
inline Matrix6 printed_K1(double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  Matrix6 K;
  K << 0, 0, 0, 0, -c, s,  //
      0, 0, 0, 0, -s, -c,  //
      0, 0, 0, 0, c, -s,   //
      0, 0, 0, 0, s, s,    //
      -c, -s, c, s, 0, 0,  //
      s, -c, -s, c, 0, 0;
  return K;
}

/// Eq. (35), with row 4 from Eq. (4).
inline Matrix6 corrected_K1(double theta) {
  Matrix6 K = printed_K1(theta);
  K(3, 5) = std::cos(theta);
  return K;
}

/// Eq. (37).
inline Matrix6 printed_K2(double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  Matrix6 K;
  K << 0, 0, 0, 0, -c, 0,  //
      0, 0, 0, 0, -s, 0,   //
      0, 0, 0, 0, c, 0,    //
      0, 0, 0, 0, s, 0,    //
      -c, -s, c, s, 0, 0,  //
      0, 0, 0, 0, 0, 1;
  return K;
}

/// Eq. (38).
inline Vector6 printed_f2(double theta, double T) {
  const double c = std::cos(theta), s = std::sin(theta);
  Vector6 f;
  f << -T * s, T * c, T * s, -T * c, 0, T;
  return f;
}

/// Eq. (39).
inline Matrix6 printed_K3() {
  Matrix6 K = Matrix6::Zero();
  K(4, 4) = K(5, 5) = 1;
  return K;
}

/// Eq. (40).
inline Vector6 printed_f3(double theta, double N, double T) {
  const double c = std::cos(theta), s = std::sin(theta);
  Vector6 f;
  f << N * c - T * s, N * s + T * c, -N * c + T * s, -N * s - T * c, N, T;
  return f;
}

}  // namespace paper
