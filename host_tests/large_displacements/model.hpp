// What the large-displacement reference is asked about, in plain structures of its own.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

namespace large_displacements {

using Vector = Eigen::Vector3d;

/// A node; what is plane lies at z = 0.
struct Node {
  std::string name;
  Vector at = Vector::Zero();
  std::array<bool, 6> held{};  ///< x, y, z, rotation about x, y, z
};

/// A bar with pins at both ends, for tension and compression.
struct Strut {
  int a = 0, b = 0;
  double E = 0, A = 0;
};

enum class Law { point, capstan };

struct Cable {
  std::string name;
  std::vector<int> path;
  double E = 0, A = 0;
  bool closed = false;
  std::array<bool, 2> jacked{};  ///< its start, its end
  Law law = Law::point;
  std::vector<double> mu;         ///< one a joint
  double wobble = 0;              ///< [rad/m], of the initial lengths
  std::vector<double> prestrain;  ///< one a segment
  double alpha = 0, seating = 0;

  int segments() const { return static_cast<int>(path.size()) - (closed ? 0 : 1); }
  int joints() const { return closed ? segments() : segments() - 1; }
  int on_path(int i) const {
    const int n = static_cast<int>(path.size());
    return path[(i + n) % n];
  }
  /// Node of joint j (from 0), and the segments in front of and behind it.
  int joint_node(int j) const { return on_path(closed ? j : j + 1); }
  int before(int j) const { return closed ? (j + segments() - 1) % segments() : j; }
  int behind(int j) const { return closed ? j : j + 1; }
};

/// A chain of Euler-Bernoulli beams, rigid in itself at its nodes. In the plane only E, A and Iz count.
struct Beam {
  std::vector<int> nodes;
  double E = 0, A = 0, Iz = 0, Iy = 0, G = 0, J = 0;
  Vector up = Vector::UnitZ();  ///< local z lies in the plane of the axis and this
  std::vector<int> hinges;      ///< nodes at which it does not share its rotation with other beams
};

/// A constant stiffness on the displacements of its nodes, axis by axis within a node.
struct Substructure {
  std::string name;
  std::vector<int> nodes;
  Eigen::MatrixXd stiffness;
};

struct Load {
  struct At {
    int node;
    Vector force = Vector::Zero(), moment = Vector::Zero();
  };
  struct Warming {
    int cable;
    double kelvin;
  };
  std::string name;
  std::vector<At> forces;
  std::vector<Warming> temperatures;
};

/// What a segment's strain is related to: its initial distance, as linear theory has it, or the unstressed
/// length that it has at present.
enum class ReferenceLength { initial, present };
enum class Strain { engineering, green };

struct Model {
  std::string name;
  int dimension = 2;
  std::vector<Node> nodes;
  std::vector<Strut> struts;
  std::vector<Cable> cables;
  std::vector<Beam> beams;
  std::vector<Substructure> substructures;
  std::vector<Load> loads;
  ReferenceLength reference_length = ReferenceLength::initial;
  Strain strut_strain = Strain::engineering;
  int pieces = 1;  ///< beam elements between two nodes of a beam

  int add_node(const std::string& node_name, const Vector& at, const std::string& held = {});
  int node(const std::string& node_name) const;  ///< throws std::out_of_range
};

/// One row of a log.
struct Row {
  struct End {
    double force = 0;
    bool locked = false;
  };
  double time = 0;
  std::vector<double> factors;            ///< one a load pattern
  std::vector<std::array<End, 2>> jacks;  ///< of each cable: its start, its end
};

}  // namespace large_displacements
