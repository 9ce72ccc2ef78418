// The elastic structure of the reference, with nothing sliding.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reference/structure.hpp"
#include "support/equilibrium.hpp"

namespace reference {

using Matrix = Eigen::Matrix<Exact, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Exact, Eigen::Dynamic, 1>;
using Index = Eigen::Index;
using Anatomy = support::Anatomy<Structure>;

/// A x B: Eigen's product of matrices takes seconds to compile, so once for all.
Matrix product(const Matrix& A, const Matrix& B);

/// The structure as bars and springs, all joints stuck: forces of segments and struts from whatever acts on
/// them.
///
/// Rows of every matrix: the segments, then the struts. Columns: forces of a unit load factor, of all
/// prestrain, of a unit elongation of a segment.
class Bars {
 public:
  explicit Bars(const Structure& scene);

  /// Whether the structure with all joints stuck carries loads at all.
  bool sound() const { return sound_; }
  int segments() const { return scene_.prestrain.size(); }
  int struts() const { return scene_.struts.size(); }
  const Matrix& load() const { return load_; }
  const Vector& prestrain() const { return prestrain_; }
  const Matrix& elongation() const { return elongation_; }

 private:
  class Support;

  void number();
  Index place(int node, int axis) const {
    return place_[static_cast<std::size_t>(node * Structure::dimension + axis)];
  }
  void add_bar(Index bar, int a, int b, Exact EA);
  void add_bars();
  void add_body(const taut::Substructure& body, Matrix& K) const;
  Matrix bar_forces(const Support& support, const Matrix& forces, const Matrix& initial) const;
  void respond(const Support& support);

  const Structure& scene_;
  Anatomy anatomy_;
  std::vector<Index> place_;
  Index free_ = 0;
  Matrix lines_;  // free displacements x bars: how each bar grows with each of them
  Vector axial_;
  Matrix load_, elongation_;
  Vector prestrain_;
  bool sound_ = false;
};

}  // namespace reference
