#include "large_displacements/beam_element.hpp"

#include "large_displacements/jet.hpp"

namespace large_displacements {
namespace {

template <int N>
using Jets = std::array<Jet<N>, 3>;

template <int N>
Jets<N> cross(const Jets<N>& a, const Jets<N>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <int N>
Jet<N> dot(const Jets<N>& a, const Jets<N>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <int N>
Jets<N> scaled(const Jets<N>& a, const Jet<N>& by) {
  return {a[0] * by, a[1] * by, a[2] * by};
}

/// v, turned by a spin of size zero: I + [w] + [w]^2 / 2 has the derivatives of the exponential there.
template <int N>
Jets<N> turned(const Jets<N>& w, const Vector& v) {
  const Jets<N> constant{Jet<N>(v.x()), Jet<N>(v.y()), Jet<N>(v.z())};
  const Jets<N> once = cross(w, constant), twice = cross(w, once);
  Jets<N> sum;
  for (int i = 0; i < 3; ++i) sum[i] = constant[i] + once[i] + twice[i] * 0.5;
  return sum;
}

/// Rotation vector from the element's frame r to the end's axes t.
template <int N>
Jets<N> rotation(const std::array<Jets<N>, 3>& r, const std::array<Jets<N>, 3>& t) {
  const auto part = [&](int i, int k) { return (dot(r[i], t[k]) - dot(r[k], t[i])) * 0.5; };
  const Jets<N> sine{part(2, 1), part(0, 2), part(1, 0)};
  return scaled(sine, angle_over_sine(dot(sine, sine)));
}

template <int N>
Jet<N> bending(const Jet<N>& at_a, const Jet<N>& at_b) {
  return at_a * at_a + at_a * at_b + at_b * at_b;
}
/// Mean of w'^2 / 2 over the element, by which bending shortens it.
template <int N>
Jet<N> bowing(const Jet<N>& at_a, const Jet<N>& at_b) {
  return (at_a * at_a * 2 - at_a * at_b + at_b * at_b * 2) * (1.0 / 30);
}

template <int N>
Jet<N> energy(const BeamElement& beam, const Jets<N>& from_a_to_b, double longer, const Jets<N>& w_a,
              const Jets<N>& w_b, const Eigen::Matrix3d& axes_a, const Eigen::Matrix3d& axes_b,
              double& axial) {
  const Jet<N> length = sqrt(dot(from_a_to_b, from_a_to_b));
  std::array<Jets<N>, 3> end_a, end_b, r;
  for (int k = 0; k < 3; ++k) {
    end_a[k] = turned(w_a, axes_a.col(k));
    end_b[k] = turned(w_b, axes_b.col(k));
  }
  r[0] = scaled(from_a_to_b, inverse(length));
  Jets<N> mean;
  for (int i = 0; i < 3; ++i) mean[i] = end_a[1][i] + end_b[1][i];
  r[2] = cross(r[0], mean);
  r[2] = scaled(r[2], inverse(sqrt(dot(r[2], r[2]))));
  r[1] = cross(r[2], r[0]);
  const Jets<N> a = rotation(r, end_a), b = rotation(r, end_b);
  Jet<N> stretch = length * (1 / beam.length);
  stretch.value = longer / beam.length;
  const Jet<N> strain = stretch + bowing(a[1], b[1]) + bowing(a[2], b[2]);
  const Jet<N> twist = b[0] - a[0];
  axial = beam.EA * strain.value;
  return strain * strain * (0.5 * beam.EA * beam.length) +
         bending(a[1], b[1]) * (2 * beam.EIy / beam.length) +
         bending(a[2], b[2]) * (2 * beam.EIz / beam.length) + twist * twist * (0.5 * beam.GJ / beam.length);
}

template <int N>
BeamForces forces(const BeamElement& beam, const Vector& initial, const Vector& moved,
                  const Eigen::Matrix3d& turned_a, const Eigen::Matrix3d& turned_b,
                  const std::array<int, N>& place) {
  std::array<Jets<N>, 4> given;  // displacements and spins of both ends
  for (int k = 0; k < N; ++k) given[place[k] / 3][place[k] % 3].first[k] = 1;
  Jets<N> chord;
  for (int i = 0; i < 3; ++i) chord[i] = Jet<N>(initial[i] + moved[i]) + given[2][i] - given[0][i];
  BeamForces found;
  const Eigen::Matrix3d axes_a = turned_a * beam.axes, axes_b = turned_b * beam.axes;
  // Lengths are not subtracted, for that costs digits.
  const double longer = (2 * initial + moved).dot(moved) / ((initial + moved).norm() + beam.length);
  const Jet<N> e = energy(beam, chord, longer, given[1], given[3], axes_a, axes_b, found.axial);
  for (int i = 0, k = 0; i < N; ++i) {
    found.force[place[i]] = e.first[i];
    for (int j = 0; j <= i; ++j, ++k) {
      found.stiffness(place[i], place[j]) = e.second[k];
      found.stiffness(place[j], place[i]) = e.second[k];
    }
  }
  return found;
}

}  // namespace

BeamForces beam_forces(const BeamElement& beam, const Vector& initial, const Vector& moved,
                       const Eigen::Matrix3d& turned_a, const Eigen::Matrix3d& turned_b, bool plane) {
  if (plane) return forces<6>(beam, initial, moved, turned_a, turned_b, {0, 1, 5, 6, 7, 11});
  return forces<12>(beam, initial, moved, turned_a, turned_b, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
}

}  // namespace large_displacements
