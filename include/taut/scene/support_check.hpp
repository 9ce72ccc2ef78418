// Whether supports and substructures hold a scene as a whole.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "taut/elements/substructure.hpp"
#include "taut/numerics/constant.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/scene/scene.hpp"
#include "taut/status.hpp"

namespace taut {
namespace detail {

/// Supports and substructures against the rigid motions of the whole: a motion that nothing resists must move
/// no node. In constant expressions too.
template <class SceneType>
class SupportCheck {
 public:
  constexpr explicit SupportCheck(const SceneType& scene) : scene_(scene) {}

  /// Names the node that free motions move most.
  constexpr Status run() const {
    if (scene_.nodes.empty()) return Status::at(Code::unsupported, Place::node, -1);
    const Frame frame = frame_of_scene();
    const auto found = Eigen::of(resistance(frame));
    Real largest = 1;
    for (const Real value : found.values) largest = larger(largest, value);
    const auto is_free = [&](std::size_t mode) { return found.values[mode] <= 64 * epsilon * largest; };

    int moved_most = 0;
    Real most = 0;
    for (int node = 0; node < scene_.nodes.size(); ++node) {
      Real moved = 0;
      for (std::size_t mode = 0; mode < motions; ++mode)
        if (is_free(mode)) moved += square_moved(node, mode, found.vectors, frame);
      // Of nodes that move alike the first one, however they are rounded.
      if (moved <= Real(1.001) * most) continue;
      most = moved;
      moved_most = node;
    }
    if (most > least_motion * least_motion) return Status::at(Code::unsupported, Place::node, moved_most);
    return Status::success();
  }

 private:
  using Real = typename SceneType::Scalar;
  static constexpr std::size_t dimension = SceneType::dimension;
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  /// Of a motion of order one, what counts as moving a node.
  static constexpr Real least_motion = Real(1e-4);
  /// Translations, and rotations about the middle scaled to displacements of order one.
  static constexpr std::size_t motions = dimension == 2 ? 3 : 6;
  using Vector = std::array<Real, dimension>;
  using Row = std::array<Real, motions>;
  using Eigen = ConstantEigen<Real, motions>;
  using Matrix = typename Eigen::Matrix;

  /// The middle of all nodes, and how far the farthest is from there along an axis.
  struct Frame {
    Vector middle{};
    Real size = epsilon;
  };
  constexpr Frame frame_of_scene() const {
    Frame frame;
    for (int i = 0; i < scene_.nodes.size(); ++i)
      for (std::size_t axis = 0; axis < dimension; ++axis)
        frame.middle[axis] += scene_.nodes[i].at[axis] / static_cast<Real>(scene_.nodes.size());
    for (int i = 0; i < scene_.nodes.size(); ++i)
      for (std::size_t axis = 0; axis < dimension; ++axis)
        frame.size = larger(frame.size, magnitude(scene_.nodes[i].at[axis] - frame.middle[axis]));
    return frame;
  }

  /// What the rigid motions move a node along an axis.
  constexpr Row rigid_motion(int node, std::size_t axis, const Frame& frame) const {
    Vector x{};
    for (std::size_t i = 0; i < dimension; ++i)
      x[i] = (scene_.nodes[node].at[i] - frame.middle[i]) / frame.size;
    Row row{};
    row[axis] = 1;
    if constexpr (dimension == 2) {
      row[2] = axis == 0 ? -x[1] : x[0];
    } else {
      const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
      row[3 + next] = x[last];
      row[3 + last] = -x[next];
    }
    return row;
  }
  constexpr Real square_moved(int node, std::size_t mode, const Matrix& vectors, const Frame& frame) const {
    Real square = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      const Row row = rigid_motion(node, axis, frame);
      Real moved = 0;
      for (std::size_t k = 0; k < motions; ++k) moved += row[k] * vectors[k][mode];
      square += moved * moved;
    }
    return square;
  }

  static constexpr void add(Matrix& to, Real factor, const Row& a, const Row& b) {
    for (std::size_t i = 0; i < motions; ++i)
      for (std::size_t k = 0; k < motions; ++k) to[i][k] += factor * a[i] * b[k];
  }

  constexpr Matrix resistance(const Frame& frame) const {
    Matrix sum{};
    for (int i = 0; i < scene_.nodes.size(); ++i) {
      for (std::size_t axis = 0; axis < dimension; ++axis) {
        if (!scene_.nodes[i].is_held(static_cast<int>(axis))) continue;
        const Row row = rigid_motion(i, axis, frame);
        add(sum, 1, row, row);
      }
      for (int k = 0; k < SceneType::motions_of_node - SceneType::dimension; ++k) {
        const std::size_t rotation = dimension + static_cast<std::size_t>(k);
        if (scene_.nodes[i].is_rotation_held(k) && scene_.can_turn(i)) sum[rotation][rotation] += 1;
      }
    }
    for (int index = 0; index < scene_.substructures.size(); ++index) {
      const SubstructureElement<SceneType> K(scene_, index);
      Real trace = 0;
      for (int i = 0; i < K.size(); ++i) trace += K(i, i);
      if (!(trace > 0)) continue;
      for (int i = 0; i < K.size(); ++i)
        for (int k = 0; k < K.size(); ++k)
          add(sum, K(i, k) / trace, rigid_motion(K.node(i), static_cast<std::size_t>(K.axis(i)), frame),
              rigid_motion(K.node(k), static_cast<std::size_t>(K.axis(k)), frame));
    }
    // Of a matrix that is symmetric to half the digits only, what is.
    for (std::size_t i = 0; i < motions; ++i)
      for (std::size_t k = 0; k < i; ++k) sum[k][i] = sum[i][k];
    return sum;
  }

  const SceneType& scene_;
};

}  // namespace detail
}  // namespace taut
