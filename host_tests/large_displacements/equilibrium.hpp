// Equilibrium of a structure at large displacements, with friction at the present angles of its joints: one
// implicit step after another.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "large_displacements/beam_element.hpp"
#include "large_displacements/joint_friction.hpp"
#include "large_displacements/model.hpp"

namespace large_displacements {

enum class Mode { stick, forward, backward, open };

/// Where everything is. Slips and extensions are one list: of each cable its joints, then its start and its
/// end.
struct State {
  std::vector<Vector> moved;            ///< of each node [m]
  std::vector<Eigen::Matrix3d> turned;  ///< of each frame, see Equilibrium
  std::vector<Vector> spin;             ///< sum of the increments of rotation; in the plane the angle
  Eigen::VectorXd material;             ///< slips and extensions [m]
  std::vector<Mode> modes;              ///< in the order of `material`
};

/// What the structure is given at one moment.
struct Inputs {
  std::vector<double> factors;  ///< one a load pattern
  double prestrain = 1;         ///< part of every prestrain
  struct End {
    bool jacked = false;  ///< `value` is the force [N], otherwise the extension [m]
    double value = 0;
  };
  std::vector<std::array<End, 2>> ends;  ///< one a cable
};

class Equilibrium {
 public:
  explicit Equilibrium(const Model& model);

  const Model& model() const { return model_; }
  State rest() const;
  Inputs no_inputs() const;

  /// Goes on to `inputs` in one implicit step; false, and `state` as it was, if no stable equilibrium is
  /// found.
  bool step(State& state, const Inputs& inputs);

  double tension(const State& state, const Inputs& inputs, int cable, int segment) const;
  double strut_force(const State& state, int strut) const;
  double beam_axial(const State& state, int beam, int piece) const;
  Vector position(const State& state, int node) const { return at_[node] + state.moved[node]; }
  /// Rotation that the beams at a node share; zero where there is none.
  Vector rotation(const State& state, int node) const;
  JointFriction friction(const State& state, int cable, int joint) const;
  int slip(int cable, int joint) const { return first_[cable] + joint; }  ///< place in `State::material`
  int extension(int cable, int end) const { return first_[cable] + model_.cables[cable].joints() + end; }

  /// Smallest real part of an eigenvalue of the tangent by the displacements and rotations: jacks keep their
  /// forces, joints that slide keep sliding. Scaled to a unit diagonal. Negative: the equilibrium is
  /// unstable.
  double stability(const State& state, const Inputs& inputs) const;
  /// Largest part of equilibrium, friction and jack forces that is missing, of the largest force.
  double imbalance(const State& state, const Inputs& inputs) const;

  /// Largest displacement of one step, of the shortest strut or segment: what goes on for more is a jump.
  double step_limit = 0.02;
  bool always_check_stability = false;  ///< otherwise only where the determinant has changed its sign
  int nodes() const { return static_cast<int>(at_.size()); }

 private:
  struct Segment {
    double T, by_length, by_material, length;
    Vector direction;
    int a, b;
    std::array<int, 4> material;  ///< -1: none
    std::array<double, 4> sign;
  };
  struct System {
    Eigen::MatrixXd tangent;
    Eigen::VectorXd rest;
    double scale = 0;     ///< largest force
    double rounding = 0;  ///< what forces may be off by because displacements are rounded
    std::vector<double>
        wish;  ///< of each joint: its slip in the step, and what it lacks to its cone, as a slip
  };

  int frame(int beam, int node);
  void number();
  void assemble(const State& state, const State& from, const Inputs& inputs, bool choose,
                std::vector<Mode>& modes, System& system) const;
  BeamForces forces_of(const State& state, const BeamElement& beam) const;
  Segment segment(const State& state, const Inputs& inputs, int cable, int i) const;
  void add_axial(System& system, int a, int b, const Vector& direction, double length, double force,
                 double by_length) const;
  void add_tension(System& system, int row, const Segment& segment, double times) const;
  void add_point(System& system, int row, int node, const Vector& gradient) const;
  void move(State& state, const Eigen::VectorXd& by) const;
  double imposed_strain(const Inputs& inputs, int cable, int i) const;
  double smallest_eigenvalue(const Eigen::MatrixXd& tangent) const;
  bool iterate(const State& from, const Inputs& inputs, bool choose, State& state) const;
  bool flip_one(const State& from, const Inputs& inputs, State& state) const;

  Model model_;
  std::vector<Vector> at_;  ///< nodes, then those inside of beams
  std::vector<BeamElement> elements_;
  std::vector<int> first_element_;
  std::vector<int> node_frame_;
  std::vector<std::array<bool, 3>> frame_held_;
  std::vector<std::array<int, 3>> place_, turn_place_;  ///< of nodes and frames among the unknowns; -1: held
  std::vector<int> first_;
  int displacements_ = 0, materials_ = 0;
  double size_ = 0, shortest_ = 0;
  double loose_hinge_ = 0;
  std::vector<int> hinge_frames_;
};

}  // namespace large_displacements
