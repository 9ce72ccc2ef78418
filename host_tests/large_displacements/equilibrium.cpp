#include "large_displacements/equilibrium.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace large_displacements {
namespace {

constexpr double exact = 1e-10;       // of the largest force
constexpr double good_enough = 1e-8;  // if iterations bring no more
constexpr int choosing_iterations = 25, iterations_of_a_set = 25;

/// present - initial, without the digits that subtracting lengths would cost
double lengthening(const Vector& initial, const Vector& moved, double length) {
  return (2 * initial + moved).dot(moved) / (length + initial.norm());
}

}  // namespace

int Model::add_node(const std::string& node_name, const Vector& place, const std::string& held) {
  Node node;
  node.name = node_name;
  node.at = place;
  std::string text = held;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ' ') continue;
    int axis = 0;
    if (text[i] == 'r' && i + 1 < text.size() && text[i + 1] >= 'x' && text[i + 1] <= 'z' && dimension == 3)
      axis = 3 + text[++i] - 'x';
    else if (text[i] == 'r')
      axis = 5;
    else
      axis = text[i] - 'x';
    if (axis < 0 || axis > 5) throw std::invalid_argument("support letters are x, y, z, r, rx, ry, rz");
    node.held[axis] = true;
  }
  nodes.push_back(node);
  return static_cast<int>(nodes.size()) - 1;
}
int Model::node(const std::string& node_name) const {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].name == node_name) return static_cast<int>(i);
  throw std::out_of_range("no node is called " + node_name);
}

Equilibrium::Equilibrium(const Model& model) : model_(model) {
  for (const Node& node : model_.nodes) at_.push_back(node.at);
  node_frame_.assign(at_.size(), -1);
  for (int b = 0; b < static_cast<int>(model_.beams.size()); ++b) {
    const Beam& beam = model_.beams[b];
    first_element_.push_back(static_cast<int>(elements_.size()));
    int frame_before = frame(b, beam.nodes[0]);
    for (std::size_t i = 0; i + 1 < beam.nodes.size(); ++i) {
      const int from = beam.nodes[i], to = beam.nodes[i + 1];
      const Vector way = at_[to] - at_[from];
      int node_before = from;
      for (int piece = 1; piece <= model_.pieces; ++piece) {
        BeamElement element;
        element.a = node_before;
        element.frame_a = frame_before;
        if (piece == model_.pieces) {
          element.b = to;
          element.frame_b = frame(b, to);
        } else {
          element.b = nodes();
          at_.push_back(model_.nodes[from].at + way * (double(piece) / model_.pieces));
          element.frame_b = static_cast<int>(frame_held_.size());
          frame_held_.push_back({model_.dimension == 2, model_.dimension == 2, false});
        }
        element.length = way.norm() / model_.pieces;
        element.EA = beam.E * beam.A;
        element.EIy = beam.E * beam.Iy;
        element.EIz = beam.E * beam.Iz;
        element.GJ = (beam.G > 0 ? beam.G : beam.E / 2.6) * beam.J;
        const Vector x = way.normalized();
        const Vector up = model_.dimension == 2 ? Vector(Vector::UnitZ()) : beam.up;
        const Vector y = up.cross(x).normalized();
        element.axes << x, y, x.cross(y);
        loose_hinge_ = std::max(loose_hinge_, 1e-9 * element.EIz / element.length);
        elements_.push_back(element);
        node_before = element.b;
        frame_before = element.frame_b;
      }
    }
  }
  first_element_.push_back(static_cast<int>(elements_.size()));
  number();
}

/// The rotation of a beam at a node: that of the node, or the beam's own where it is hinged.
int Equilibrium::frame(int beam, int node) {
  const bool plane = model_.dimension == 2;
  const auto& hinges = model_.beams[beam].hinges;
  if (std::find(hinges.begin(), hinges.end(), node) != hinges.end()) {
    frame_held_.push_back({plane, plane, false});
    hinge_frames_.push_back(static_cast<int>(frame_held_.size()) - 1);
    return hinge_frames_.back();
  }
  if (node_frame_[node] < 0) {
    node_frame_[node] = static_cast<int>(frame_held_.size());
    const auto& held = model_.nodes[node].held;
    frame_held_.push_back({plane || held[3], plane || held[4], held[5]});
  }
  return node_frame_[node];
}

void Equilibrium::number() {
  int next = 0;
  const auto named = static_cast<int>(model_.nodes.size());
  Vector low = at_[0], high = at_[0];
  for (int n = 0; n < nodes(); ++n) {
    std::array<int, 3> place{-1, -1, -1};
    for (int axis = 0; axis < model_.dimension; ++axis)
      if (n >= named || !model_.nodes[n].held[axis]) place[axis] = next++;
    place_.push_back(place);
    low = low.cwiseMin(at_[n]);
    high = high.cwiseMax(at_[n]);
  }
  size_ = (high - low).norm();
  shortest_ = size_;
  for (const Strut& strut : model_.struts)
    shortest_ = std::min(shortest_, (at_[strut.b] - at_[strut.a]).norm());
  for (const Cable& cable : model_.cables)
    for (int i = 0; i < cable.segments(); ++i)
      shortest_ = std::min(shortest_, (at_[cable.on_path(i + 1)] - at_[cable.on_path(i)]).norm());
  for (const auto& held : frame_held_) {
    std::array<int, 3> place{-1, -1, -1};
    for (int axis = 0; axis < 3; ++axis)
      if (!held[axis]) place[axis] = next++;
    turn_place_.push_back(place);
  }
  displacements_ = next;
  for (const Cable& cable : model_.cables) {
    first_.push_back(materials_);
    materials_ += cable.joints() + 2;
  }
}

State Equilibrium::rest() const {
  State state;
  state.moved.assign(at_.size(), Vector::Zero());
  state.turned.assign(frame_held_.size(), Eigen::Matrix3d::Identity());
  state.spin.assign(frame_held_.size(), Vector::Zero());
  state.material = Eigen::VectorXd::Zero(materials_);
  state.modes.assign(materials_, Mode::stick);
  return state;
}
Inputs Equilibrium::no_inputs() const {
  Inputs inputs;
  inputs.factors.assign(model_.loads.size(), 0);
  inputs.prestrain = 0;
  for (const Cable& cable : model_.cables) {
    inputs.ends.emplace_back();
    for (int end : {0, 1}) inputs.ends.back()[end].jacked = cable.jacked[end];
  }
  return inputs;
}
Vector Equilibrium::rotation(const State& state, int node) const {
  return node_frame_[node] < 0 ? Vector::Zero() : state.spin[node_frame_[node]];
}

double Equilibrium::imposed_strain(const Inputs& inputs, int c, int i) const {
  const Cable& cable = model_.cables[c];
  double strain = cable.prestrain[i] * inputs.prestrain;
  for (std::size_t load = 0; load < model_.loads.size(); ++load)
    for (const auto& warming : model_.loads[load].temperatures)
      if (warming.cable == c) strain -= cable.alpha * warming.kelvin * inputs.factors[load];
  return strain;
}

Equilibrium::Segment Equilibrium::segment(const State& state, const Inputs& inputs, int c, int i) const {
  const Cable& cable = model_.cables[c];
  Segment found;
  found.a = cable.on_path(i);
  found.b = cable.on_path(i + 1);
  found.material = {-1, -1, -1, -1};
  found.sign = {0, 0, 0, 0};
  const int joints = cable.joints();
  int count = 0;
  const auto add = [&](int material, double sign) {
    found.material[count] = material;
    found.sign[count++] = sign;
  };
  // Slip j goes from the segment in front of joint j to the one behind it.
  if (cable.closed) {
    add(slip(c, (i + 1) % joints), 1);
    add(slip(c, i), -1);
  } else {
    if (i < joints) add(slip(c, i), 1);
    if (i > 0) add(slip(c, i - 1), -1);
    if (i == 0) add(extension(c, 0), 1);
    if (i == joints) add(extension(c, 1), 1);
  }
  double taken = 0;
  for (int k = 0; k < count; ++k) taken += found.sign[k] * state.material[found.material[k]];
  const Vector initial = at_[found.b] - at_[found.a], moved = state.moved[found.b] - state.moved[found.a];
  const Vector way = initial + moved;
  found.length = way.norm();
  found.direction = way / found.length;
  const double EA = cable.E * cable.A, distance = initial.norm();
  const double strain = imposed_strain(inputs, c, i);
  const double elongation = lengthening(initial, moved, found.length) + strain * distance + taken;
  if (model_.reference_length == ReferenceLength::initial) {
    found.T = EA / distance * elongation;
    found.by_length = found.by_material = EA / distance;
  } else {
    const double unstressed = (1 - strain) * distance - taken;
    found.T = EA / unstressed * elongation;
    found.by_length = EA / unstressed;
    found.by_material = EA / unstressed * (found.length / unstressed);
  }
  return found;
}

double Equilibrium::tension(const State& state, const Inputs& inputs, int cable, int i) const {
  return std::max(0.0, segment(state, inputs, cable, i).T);
}
double Equilibrium::strut_force(const State& state, int s) const {
  const Strut& strut = model_.struts[s];
  const Vector initial = at_[strut.b] - at_[strut.a], moved = state.moved[strut.b] - state.moved[strut.a];
  const double length = (initial + moved).norm(), distance = initial.norm();
  const double longer = lengthening(initial, moved, length), EA = strut.E * strut.A;
  if (model_.strut_strain == Strain::engineering) return EA * longer / distance;
  return EA * longer * (length + distance) / (2 * distance * distance) * (length / distance);
}
double Equilibrium::beam_axial(const State& state, int beam, int piece) const {
  return forces_of(state, elements_[first_element_[beam] + piece]).axial;
}
BeamForces Equilibrium::forces_of(const State& state, const BeamElement& beam) const {
  return beam_forces(beam, at_[beam.b] - at_[beam.a], state.moved[beam.b] - state.moved[beam.a],
                     state.turned[beam.frame_a], state.turned[beam.frame_b], model_.dimension == 2);
}
JointFriction Equilibrium::friction(const State& state, int c, int j) const {
  const Cable& cable = model_.cables[c];
  const int at = cable.joint_node(j);
  const int before = cable.on_path(cable.before(j)), behind = cable.on_path(cable.behind(j) + 1);
  const Vector to_before = position(state, before) - position(state, at);
  const Vector to_behind = position(state, behind) - position(state, at);
  const double wobble = cable.wobble * ((at_[before] - at_[at]).norm() + (at_[behind] - at_[at]).norm()) / 2;
  return joint_friction(cable.law, cable.mu[j], wobble, to_before.normalized(), to_before.norm(),
                        to_behind.normalized(), to_behind.norm());
}

void Equilibrium::add_axial(System& system, int a, int b, const Vector& direction, double length,
                            double force, double by_length) const {
  const Eigen::Matrix3d along = direction * direction.transpose();
  const Eigen::Matrix3d block = by_length * along + force / length * (Eigen::Matrix3d::Identity() - along);
  for (int i = 0; i < 3; ++i) {
    const int row_a = place_[a][i], row_b = place_[b][i];
    if (row_a >= 0) system.rest[row_a] -= force * direction[i];
    if (row_b >= 0) system.rest[row_b] += force * direction[i];
    for (int k = 0; k < 3; ++k) {
      const int column_a = place_[a][k], column_b = place_[b][k];
      if (row_a >= 0 && column_a >= 0) system.tangent(row_a, column_a) += block(i, k);
      if (row_a >= 0 && column_b >= 0) system.tangent(row_a, column_b) -= block(i, k);
      if (row_b >= 0 && column_a >= 0) system.tangent(row_b, column_a) -= block(i, k);
      if (row_b >= 0 && column_b >= 0) system.tangent(row_b, column_b) += block(i, k);
    }
  }
  system.scale = std::max(system.scale, std::fabs(force));
}
void Equilibrium::add_point(System& system, int row, int node, const Vector& gradient) const {
  for (int i = 0; i < 3; ++i)
    if (place_[node][i] >= 0) system.tangent(row, place_[node][i]) += gradient[i];
}
void Equilibrium::add_tension(System& system, int row, const Segment& found, double times) const {
  add_point(system, row, found.b, times * found.by_length * found.direction);
  add_point(system, row, found.a, -times * found.by_length * found.direction);
  for (int k = 0; k < 4; ++k)
    if (found.material[k] >= 0)
      system.tangent(row, displacements_ + found.material[k]) += times * found.sign[k] * found.by_material;
}

void Equilibrium::assemble(const State& state, const State& from, const Inputs& inputs, bool choose,
                           std::vector<Mode>& modes, System& system) const {
  const int size = displacements_ + materials_;
  system.tangent.setZero(size, size);
  system.rest.setZero(size);
  system.scale = 0;
  system.rounding = 0;
  const auto round = [&](double EA, double length, int a, int b) {
    const double moved = std::max(state.moved[a].norm(), state.moved[b].norm());
    system.rounding = std::max(system.rounding, 1e-15 * EA / length * moved);
  };
  system.wish.assign(materials_, 0);

  for (std::size_t s = 0; s < model_.struts.size(); ++s) {
    const Strut& strut = model_.struts[s];
    const Vector way = position(state, strut.b) - position(state, strut.a);
    const double length = way.norm(), distance = (at_[strut.b] - at_[strut.a]).norm();
    const double EA = strut.E * strut.A, ratio = length / distance;
    const double by_length = model_.strut_strain == Strain::engineering
                                 ? EA / distance
                                 : EA / distance * (3 * ratio * ratio - 1) / 2;
    round(EA, distance, strut.a, strut.b);
    add_axial(system, strut.a, strut.b, way / length, length, strut_force(state, static_cast<int>(s)),
              by_length);
  }

  for (const BeamElement& beam : elements_) {
    const BeamForces found = forces_of(state, beam);
    round(beam.EA, beam.length, beam.a, beam.b);
    std::array<int, 12> places;
    for (int i = 0; i < 3; ++i) {
      places[i] = place_[beam.a][i];
      places[3 + i] = turn_place_[beam.frame_a][i];
      places[6 + i] = place_[beam.b][i];
      places[9 + i] = turn_place_[beam.frame_b][i];
    }
    for (int i = 0; i < 12; ++i) {
      if (places[i] < 0) continue;
      system.rest[places[i]] += found.force[i];
      for (int k = 0; k < 12; ++k)
        if (places[k] >= 0) system.tangent(places[i], places[k]) += found.stiffness(i, k);
      system.scale = std::max(system.scale, std::fabs(found.force[i]));
    }
  }
  // In space a piece that is hinged at both ends would spin about its axis.
  if (model_.dimension == 3)
    for (const int hinge : hinge_frames_)
      for (int i = 0; i < 3; ++i)
        if (turn_place_[hinge][i] >= 0) {
          system.rest[turn_place_[hinge][i]] += loose_hinge_ * state.spin[hinge][i];
          system.tangent(turn_place_[hinge][i], turn_place_[hinge][i]) += loose_hinge_;
        }

  for (const Substructure& body : model_.substructures) {
    const int axes = model_.dimension, count = static_cast<int>(body.nodes.size()) * axes;
    for (int i = 0; i < count; ++i) {
      const int row = place_[body.nodes[i / axes]][i % axes];
      if (row < 0) continue;
      for (int k = 0; k < count; ++k) {
        const int other = body.nodes[k / axes], column = place_[other][k % axes];
        system.rest[row] += body.stiffness(i, k) * state.moved[other][k % axes];
        if (column >= 0) system.tangent(row, column) += body.stiffness(i, k);
      }
    }
  }

  for (std::size_t load = 0; load < model_.loads.size(); ++load)
    for (const Load::At& given : model_.loads[load].forces)
      for (int i = 0; i < 3; ++i) {
        const int row = place_[given.node][i], frame = node_frame_[given.node];
        if (row >= 0) system.rest[row] -= inputs.factors[load] * given.force[i];
        if (frame >= 0 && turn_place_[frame][i] >= 0)
          system.rest[turn_place_[frame][i]] -= inputs.factors[load] * given.moment[i];
        system.scale = std::max(system.scale, std::fabs(inputs.factors[load] * given.force[i]));
      }

  for (int c = 0; c < static_cast<int>(model_.cables.size()); ++c) {
    const Cable& cable = model_.cables[c];
    std::vector<Segment> segments;
    for (int i = 0; i < cable.segments(); ++i) {
      segments.push_back(segment(state, inputs, c, i));
      const Segment& s = segments.back();
      system.scale = std::max(system.scale, s.T);
      system.rounding = std::max(system.rounding, -1e-12 * s.T);
      round(cable.E * cable.A, s.length, s.a, s.b);
      // What is just tight counts, for a cable at rest has to begin somewhere.
      if (s.T < -1e-12 * cable.E * cable.A) continue;
      add_axial(system, s.a, s.b, s.direction, s.length, s.T, s.by_length);
      for (int k = 0; k < 4; ++k) {
        if (s.material[k] < 0) continue;
        const int column = displacements_ + s.material[k];
        const Vector pull = s.sign[k] * s.by_material * s.direction;
        for (int axis = 0; axis < 3; ++axis) {
          if (place_[s.a][axis] >= 0) system.tangent(place_[s.a][axis], column) -= pull[axis];
          if (place_[s.b][axis] >= 0) system.tangent(place_[s.b][axis], column) += pull[axis];
        }
      }
    }
    for (int j = 0; j < cable.joints(); ++j) {
      const int material = slip(c, j), row = displacements_ + material;
      const Segment &before = segments[cable.before(j)], &behind = segments[cable.behind(j)];
      const JointFriction now = friction(state, c, j);
      const double stiff = before.by_material + behind.by_material;
      const double slipped = state.material[material] - from.material[material];
      const double rho = now.rho;
      const double to_forward = slipped + (rho * behind.T - before.T) / stiff;
      const double to_backward = slipped - (rho * before.T - behind.T) / stiff;
      if (choose) {
        if (rho <= 0)
          modes[material] = Mode::stick;
        else if (std::max(before.T, behind.T) < -1e-12 * cable.E * cable.A)
          modes[material] = Mode::open;
        else if (to_forward > 0 && (to_backward >= 0 || to_forward > -to_backward))
          modes[material] = Mode::forward;
        else if (to_backward < 0)
          modes[material] = Mode::backward;
        else
          modes[material] = Mode::stick;
      }
      switch (modes[material]) {
        case Mode::stick:
          // How far outside of its cone.
          system.wish[material] = rho <= 0          ? 0
                                  : to_forward > 0  ? to_forward
                                  : to_backward < 0 ? to_backward
                                                    : 0;
          system.rest[row] = stiff * slipped;
          system.tangent(row, row) = stiff;
          break;
        case Mode::forward:
          system.wish[material] = std::min(0.0, slipped);
          system.rest[row] = before.T - rho * behind.T;
          add_tension(system, row, before, 1);
          add_tension(system, row, behind, -rho);
          add_point(system, row, before.a, -behind.T * now.by_before);
          add_point(system, row, behind.b, -behind.T * now.by_behind);
          add_point(system, row, before.b, behind.T * (now.by_before + now.by_behind));
          break;
        case Mode::backward:
          system.wish[material] = std::max(0.0, slipped);
          system.rest[row] = rho * before.T - behind.T;
          add_tension(system, row, before, rho);
          add_tension(system, row, behind, -1);
          add_point(system, row, before.a, before.T * now.by_before);
          add_point(system, row, behind.b, before.T * now.by_behind);
          add_point(system, row, before.b, -before.T * (now.by_before + now.by_behind));
          break;
        case Mode::open:
          // Where the material of a slack span lies is of no account: strain is the same on both sides.
          system.rest[row] = before.T - behind.T;
          add_tension(system, row, before, 1);
          add_tension(system, row, behind, -1);
          break;
      }
    }
    for (int end : {0, 1}) {
      const int material = extension(c, end), row = displacements_ + material;
      const Inputs::End& given = inputs.ends[c][end];
      const Segment& s = end == 0 ? segments.front() : segments.back();
      if (given.jacked) {
        system.rest[row] = s.T - given.value;
        add_tension(system, row, s, 1);
        system.scale = std::max(system.scale, given.value);
      } else {
        system.rest[row] = s.by_material * (state.material[material] - given.value);
        system.tangent(row, row) = s.by_material;
      }
    }
  }
}

void Equilibrium::move(State& state, const Eigen::VectorXd& by) const {
  for (int n = 0; n < nodes(); ++n)
    for (int i = 0; i < 3; ++i)
      if (place_[n][i] >= 0) state.moved[n][i] += by[place_[n][i]];
  for (std::size_t f = 0; f < frame_held_.size(); ++f) {
    Vector spin = Vector::Zero();
    for (int i = 0; i < 3; ++i)
      if (turn_place_[f][i] >= 0) spin[i] = by[turn_place_[f][i]];
    state.spin[f] += spin;
    const double angle = spin.norm();
    if (angle > 0) state.turned[f] = Eigen::AngleAxisd(angle, spin / angle) * state.turned[f];
  }
  state.material += by.tail(materials_);
}

bool Equilibrium::iterate(const State& from, const Inputs& inputs, bool choose, State& state) const {
  System system;
  std::vector<Mode> before = state.modes;
  double last = HUGE_VAL;
  const int limit = choose ? choosing_iterations : iterations_of_a_set;
  for (int i = 0; i < limit; ++i) {
    // What sticks at first is tried to stick: a sliding start from no tension would find struts that lean.
    assemble(state, from, inputs, choose && i > 0, state.modes, system);
    const double off = system.rest.size() ? system.rest.cwiseAbs().maxCoeff() : 0;
    if (!(off < HUGE_VAL)) return false;
    const bool same = !choose || state.modes == before;
    if (off <= exact * system.scale || (same && off <= good_enough * system.scale && off > 0.5 * last))
      return true;
    last = off;
    before = state.modes;
    Eigen::VectorXd by = system.tangent.partialPivLu().solve(-system.rest);
    double stiffest = system.scale / size_;
    for (int k = 0; k < displacements_; ++k) stiffest = std::max(stiffest, std::fabs(system.tangent(k, k)));
    // Of the steps that are allowed; a cable without tension between two jacks goes through without a force.
    const auto too_far = [&] {
      double most = 0;
      for (int k = 0; k < displacements_; ++k) most = std::max(most, std::fabs(by[k]) / (0.05 * size_));
      for (int k = displacements_; k < by.size(); ++k)
        most = std::max(most, std::fabs(by[k]) / (2e-3 * size_));
      return most;
    };
    // What nothing holds yet is held a little; the equilibrium that is found is the same.
    for (double shift = 1e-9; (!by.allFinite() || too_far() > 1) && shift < 1e-2; shift *= 30) {
      Eigen::MatrixXd held = system.tangent;
      for (int k = 0; k < displacements_; ++k) held(k, k) += shift * stiffest;
      for (int k = displacements_; k < by.size(); ++k) held(k, k) *= 1 + 100 * shift;
      by = held.partialPivLu().solve(-system.rest);
    }
    if (!by.allFinite()) return false;
    if (too_far() > 1) by /= too_far();
    move(state, by);
  }
  return false;
}

/// Changes the joint that disagrees most with its mode; false if all agree.
bool Equilibrium::flip_one(const State& from, const Inputs& inputs, State& state) const {
  System system;
  std::vector<Mode> chosen = state.modes;
  assemble(state, from, inputs, true, chosen, system);
  assemble(state, from, inputs, false, state.modes, system);
  int worst = -1;
  for (int m = 0; m < materials_; ++m)
    if (chosen[m] != state.modes[m] && std::fabs(system.wish[m]) > 1e-13 * size_ &&
        (worst < 0 || std::fabs(system.wish[m]) > std::fabs(system.wish[worst])))
      worst = m;
  if (worst < 0) return false;
  state.modes[worst] = chosen[worst];
  return true;
}

/// Of the tangent by the displacements and rotations, of a unit diagonal where they are stuck.
double Equilibrium::smallest_eigenvalue(const Eigen::MatrixXd& tangent) const {
  if (displacements_ == 0) return 1;
  const int d = displacements_, m = materials_;
  Eigen::MatrixXd reduced = tangent.topLeftCorner(d, d);
  const Eigen::VectorXd diagonal = reduced.diagonal().cwiseAbs();
  const double least = 1e-14 * diagonal.maxCoeff();
  if (!(least > 0)) return 0;
  if (m > 0)
    reduced -= tangent.topRightCorner(d, m) *
               tangent.bottomRightCorner(m, m).partialPivLu().solve(tangent.bottomLeftCorner(m, d));
  const Eigen::VectorXd scale = diagonal.cwiseMax(least).cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * reduced * scale.asDiagonal()).eval().eigenvalues().real().minCoeff();
}

double Equilibrium::stability(const State& state, const Inputs& inputs) const {
  System system;
  std::vector<Mode> modes = state.modes;
  assemble(state, state, inputs, false, modes, system);
  return smallest_eigenvalue(system.tangent);
}
double Equilibrium::imbalance(const State& state, const Inputs& inputs) const {
  System system;
  std::vector<Mode> modes = state.modes;
  assemble(state, state, inputs, false, modes, system);
  return system.scale > 0 ? system.rest.cwiseAbs().maxCoeff() / system.scale : 0;
}

bool Equilibrium::step(State& state, const Inputs& inputs) {
  State next = state;
  if (!iterate(state, inputs, true, next)) {
    // Where the load turns, what slid before is no good guess.
    next = state;
    std::fill(next.modes.begin(), next.modes.end(), Mode::stick);
    const State stuck = next;
    if (!iterate(state, inputs, true, next)) {
      // One joint at a time: all at once can go round in circles.
      next = stuck;
      std::set<std::vector<Mode>> seen;
      do {
        if (!seen.insert(next.modes).second || !iterate(state, inputs, false, next)) return false;
      } while (flip_one(state, inputs, next));
    }
  }
  for (int n = 0; n < nodes(); ++n)
    if (!((next.moved[n] - state.moved[n]).norm() <= step_limit * shortest_)) return false;
  System system;
  std::vector<Mode> modes = next.modes;
  assemble(next, next, inputs, false, modes, system);
  const auto factors = system.tangent.partialPivLu();
  const Eigen::VectorXd pivots = factors.matrixLU().diagonal();
  bool negative = factors.permutationP().determinant() < 0;
  for (const double pivot : pivots) negative = negative != (pivot < 0);
  if ((negative || always_check_stability) && smallest_eigenvalue(system.tangent) < -1e-12) return false;
  state = next;
  return true;
}

}  // namespace large_displacements
