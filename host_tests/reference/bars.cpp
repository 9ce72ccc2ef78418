#include "reference/bars.hpp"

#include <Eigen/LU>

namespace reference {

Matrix product(const Matrix& A, const Matrix& B) { return A * B; }

/// The factored stiffness, rows and columns scaled to ones on the diagonal.
class Bars::Support {
 public:
  explicit Support(const Matrix& K)
      : scale_(K.diagonal().cwiseMax(least_stiffness(K)).cwiseSqrt().cwiseInverse()) {
    const Matrix scaled = scale_.asDiagonal() * K * scale_.asDiagonal();
    factored_.compute(K.rows() > 0 ? scaled : Matrix::Identity(1, 1));
  }
  bool sound() const { return factored_.isInvertible(); }
  Matrix displaced(const Matrix& forces) const {
    if (scale_.size() == 0) return Matrix::Zero(0, forces.cols());
    const Matrix scaled = scale_.asDiagonal() * forces;
    return scale_.asDiagonal() * factored_.solve(scaled);
  }

 private:
  static Exact least_stiffness(const Matrix& K) {
    return K.size() == 0 ? Exact(1) : K.diagonal().maxCoeff() * Exact(1e-18L);
  }
  Vector scale_;
  Eigen::FullPivLU<Matrix> factored_;
};

Bars::Bars(const Structure& scene) : scene_(scene), anatomy_(scene) {
  number();
  const Index rows = segments() + struts();
  lines_ = Matrix::Zero(free_, rows);
  axial_ = Vector::Zero(rows);
  add_bars();
  Matrix K = product(lines_ * axial_.asDiagonal(), lines_.transpose());
  for (const auto& body : scene.substructures) add_body(body, K);
  const Support support(K);
  sound_ = support.sound();
  if (sound_) respond(support);
}

void Bars::number() {
  for (const auto& node : scene_.nodes)
    for (int axis = 0; axis < Structure::dimension; ++axis)
      place_.push_back(node.is_held(axis) ? -1 : free_++);
}

void Bars::add_bar(Index bar, int a, int b, Exact EA) {
  axial_[bar] = EA / anatomy_.length(a, b);
  const auto along = anatomy_.direction(a, b);
  for (int axis = 0; axis < Structure::dimension; ++axis) {
    if (place(a, axis) >= 0) lines_(place(a, axis), bar) = -along[axis];
    if (place(b, axis) >= 0) lines_(place(b, axis), bar) = along[axis];
  }
}

void Bars::add_bars() {
  for (const auto& cable : scene_.cables)
    for (int i = 0; i < cable.segments(); ++i) {
      const auto ends = scene_.segment_nodes(cable, i);
      add_bar(cable.first_segment + i, ends[0], ends[1], Exact(cable.E) * Exact(cable.A));
    }
  for (int i = 0; i < struts(); ++i) {
    const auto& strut = scene_.struts[i];
    add_bar(segments() + i, strut.nodes[0], strut.nodes[1], Exact(strut.E) * Exact(strut.A));
  }
}

void Bars::add_body(const taut::Substructure& body, Matrix& K) const {
  const int size = body.nodes * Structure::dimension;
  const auto at = [&](int i) {
    return place(scene_.substructure_nodes[body.first_node + i / Structure::dimension],
                 i % Structure::dimension);
  };
  for (int i = 0; i < size; ++i)
    for (int k = 0; k < size; ++k)
      if (at(i) >= 0 && at(k) >= 0)
        K(at(i), at(k)) += Exact(scene_.substructure_entries[body.first_entry + i * size + k]);
}

/// Forces of all bars when each had the force `initial` before anything moved, and `forces` act on the nodes.
Matrix Bars::bar_forces(const Support& support, const Matrix& forces, const Matrix& initial) const {
  const Matrix u = support.displaced(forces - product(lines_, initial));
  return axial_.asDiagonal() * product(lines_.transpose(), u) + initial;
}

void Bars::respond(const Support& support) {
  const Index rows = axial_.size();
  Matrix forces = Matrix::Zero(free_, scene_.loads), initial = Matrix::Zero(rows, scene_.loads);
  for (const auto& given : scene_.forces)
    for (int axis = 0; axis < Structure::dimension; ++axis)
      if (place(given.node, axis) >= 0)
        forces(place(given.node, axis), given.load) += Exact(given.force[static_cast<std::size_t>(axis)]);
  for (const auto& change : scene_.temperatures) {
    const auto& cable = scene_.cables[change.cable];
    for (int i = 0; i < cable.segments(); ++i)
      initial(cable.first_segment + i, change.load) -=
          Exact(cable.E) * Exact(cable.A) * Exact(cable.alpha) * Exact(change.kelvin);
  }
  load_ = bar_forces(support, forces, initial);

  Matrix strained = Matrix::Zero(rows, 1);
  for (const auto& cable : scene_.cables)
    for (int i = cable.first_segment; i < cable.first_segment + cable.segments(); ++i)
      strained(i, 0) = Exact(cable.E) * Exact(cable.A) * Exact(scene_.prestrain[i]);
  prestrain_ = bar_forces(support, Matrix::Zero(free_, 1), strained).col(0);

  Matrix imposed = Matrix::Zero(rows, segments());
  for (int i = 0; i < segments(); ++i) imposed(i, i) = axial_[i];
  elongation_ = bar_forces(support, Matrix::Zero(free_, segments()), imposed);
}

}  // namespace reference
