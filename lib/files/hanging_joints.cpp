#include "lib/files/hanging_joints.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace taut::host {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;
using Block = Eigen::Matrix<double, 6, 6>;  // displacements and rotations of a node

Vector place(const SceneDescription& scene, int node) {
  const auto& at = scene.nodes[static_cast<std::size_t>(node)].at;
  return {at[0], at[1], at[2]};
}

// Stiffness E A / L along the line to a neighbour.
void add_bar(const SceneDescription& scene, int node, int other, double EA, Block& block) {
  const Vector along = place(scene, other) - place(scene, node);
  const double L = along.norm();
  if (L > 0) block.topLeftCorner<3, 3>() += EA / (L * L * L) * along * along.transpose();
}

// Whether the end of a member at the node is kept from turning, by a support or by another member.
bool is_clamped(const SceneDescription& scene, const BeamDescription& beam, int node) {
  if (beam.has_hinge(node)) return false;
  if ((scene.nodes[static_cast<std::size_t>(node)].held & (held_rx | held_ry | held_rz)) != 0) return true;
  int ends = 0;
  for (const BeamDescription& each : scene.beams)
    for (std::size_t i = 0; i < each.nodes.size(); ++i)
      if (each.nodes[i] == node && !each.has_hinge(node)) ends += i > 0 && i + 1 < each.nodes.size() ? 2 : 1;
  return ends > 1;
}

// The end of a member at the node, its other end held. Bending stiffness is that of the weaker axis.
void add_member(const SceneDescription& scene, const BeamDescription& beam, int node, int other,
                Block& block) {
  add_bar(scene, node, other, beam.E * beam.A, block);
  const Vector along = place(scene, other) - place(scene, node);
  const double L = along.norm();
  const bool here = beam.has_hinge(node), there = !is_clamped(scene, beam, other);
  if (!(L > 0) || (here && there)) return;
  const double I = scene.dimension == 2 ? beam.I : std::min(beam.Iy, beam.Iz);
  const double k = beam.E * I / (L * L * L);
  const Vector axis = along / L;
  const Matrix across = Matrix::Identity() - axis * axis.transpose();
  block.topLeftCorner<3, 3>() += (here || there ? 3 : 12) * k * across;
  if (here) return;
  // A rotation r of the end moves it as r x axis does.
  Matrix turn;
  turn << 0, axis.z(), -axis.y(), -axis.z(), 0, axis.x(), axis.y(), -axis.x(), 0;
  const Matrix coupling = (there ? 3 : 6) * k * L * turn;
  block.topRightCorner<3, 3>() += coupling;
  block.bottomLeftCorner<3, 3>() += coupling.transpose();
  block.bottomRightCorner<3, 3>() += (there ? 3 : 4) * k * L * L * across;
}

void add_substructure(const SceneDescription& scene, const SubstructureDescription& part, int node,
                      Block& block) {
  const auto axes = static_cast<std::size_t>(scene.dimension), rows = axes * part.nodes.size();
  for (std::size_t n = 0; n < part.nodes.size(); ++n)
    for (std::size_t i = 0; i < axes && part.nodes[n] == node; ++i)
      for (std::size_t j = 0; j < axes; ++j)
        block(static_cast<int>(i), static_cast<int>(j)) +=
            part.stiffness[(n * axes + i) * rows + n * axes + j];
}

// All but what slides over the node.
Block block_of(const SceneDescription& scene, int node) {
  Block block = Block::Zero();
  for (const StrutDescription& strut : scene.struts)
    for (const int end : {0, 1})
      if (strut.nodes[static_cast<std::size_t>(end)] == node)
        add_bar(scene, node, strut.nodes[static_cast<std::size_t>(1 - end)], strut.E * strut.A, block);
  for (const BeamDescription& beam : scene.beams)
    for (std::size_t i = 0; i < beam.members(); ++i) {
      if (beam.nodes[i] == node) add_member(scene, beam, node, beam.nodes[i + 1], block);
      if (beam.nodes[i + 1] == node) add_member(scene, beam, node, beam.nodes[i], block);
    }
  for (const SubstructureDescription& part : scene.substructures) add_substructure(scene, part, node, block);
  for (const CableDescription& cable : scene.cables) {
    if (cable.closed) continue;
    const double EA = cable.E * cable.A;
    if (!cable.is_jacked(0) && cable.path.front() == node) add_bar(scene, node, cable.path[1], EA, block);
    if (!cable.is_jacked(1) && cable.path.back() == node)
      add_bar(scene, node, cable.path[cable.path.size() - 2], EA, block);
  }
  return block;
}

// What tension gives across the cable at a joint [N/m].
double tension_stiffness(const SceneDescription& scene, const CableDescription& cable, std::size_t at) {
  constexpr double strain = 0.0025;
  const std::size_t nodes = cable.path.size();
  const Vector here = place(scene, cable.path[at]);
  double sum = 0;
  for (const std::size_t other : {(at + nodes - 1) % nodes, (at + 1) % nodes})
    sum += strain * cable.E * cable.A / (place(scene, cable.path[other]) - here).norm();
  return sum;
}

}  // namespace

int hanging_directions(const SceneDescription& scene, int node, double least) {
  Block block = block_of(scene, node);
  const unsigned held = scene.nodes[static_cast<std::size_t>(node)].held;
  const bool plane = scene.dimension == 2;
  const auto can_move = [&](int axis) { return axis < scene.dimension && (held >> axis & 1U) == 0; };
  const auto can_turn = [&](int axis) {
    return (!plane || axis == 2) && (held & static_cast<unsigned>(held_rx) << axis) == 0;
  };
  // Rotations follow: those that nothing resists turn along.
  Matrix turning = block.bottomRightCorner<3, 3>(), coupling = block.topRightCorner<3, 3>();
  for (int axis = 0; axis < 3; ++axis) {
    if (can_turn(axis)) continue;
    turning.row(axis).setZero();
    turning.col(axis).setZero();
    coupling.col(axis).setZero();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> turns(turning);
  Matrix resisting = block.topLeftCorner<3, 3>();
  for (int i = 0; i < 3; ++i) {
    const double value = turns.eigenvalues()[i];
    if (value <= 1e-12 * turns.eigenvalues()[2]) continue;
    const Vector moved = coupling * turns.eigenvectors().col(i);
    resisting -= moved * moved.transpose() / value;
  }
  int most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (can_move(axis)) {
      ++most;
      continue;
    }
    resisting.row(axis).setZero();
    resisting.col(axis).setZero();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> resists(resisting);
  int hanging = most - 3;  // the axes that are held have an eigenvalue of zero
  for (int i = 0; i < 3; ++i) hanging += resists.eigenvalues()[i] < least ? 1 : 0;
  return std::max(0, hanging);
}

std::vector<HangingJoint> hanging_joints(const SceneDescription& scene) {
  std::vector<HangingJoint> found;
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const CableDescription& cable = scene.cables[c];
    for (std::size_t j = 0; j < cable.joints(); ++j) {
      const std::size_t at = cable.closed ? j : j + 1;
      const int node = cable.path[at];
      const int directions = hanging_directions(scene, node, 0.1 * tension_stiffness(scene, cable, at));
      if (directions > 0) found.push_back({c, j, node, directions});
    }
  }
  return found;
}

}  // namespace taut::host
