// The condensed scene: the few arrays that a running controller needs.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include "taut/numerics/axpy.hpp"
#include "taut/numerics/bits.hpp"
#include "taut/numerics/fixed_list.hpp"
#include "taut/numerics/wide.hpp"
#include "taut/scene/path.hpp"
#include "taut/scene/scene.hpp"

namespace taut {

/// Whether scenes of this capacity have nothing elastic but their cables.
template <class Cap>
constexpr bool has_rigid_saddles = Cap::struts == 0 && Cap::beams == 0 && Cap::substructures == 0;

/// The part of both tensions together that friction can hold back, from rho: Eq. (3).
template <class Real>
constexpr Real kappa_of(Real rho) {
  return (1 - rho) / (1 + rho);
}

/// Tensions of all segments from elongations imposed on them, all joints stuck: the matrix C of Eq. (8)
/// [N/m], column by column. It is symmetric but in second-order theory, whose level follows.
template <class Scalar, int Segments>
struct ElasticCoupling {
  FixedArray<Scalar, Segments * Segments> entries;

  constexpr Scalar operator()(int i, int k) const { return entries[k * Segments + i]; }
  constexpr void set(int i, int k, Scalar value) { entries[k * Segments + i] = value; }
  /// T += coupling x e, for n segments, in the numbers of e.
  template <class Vector>
  void add(int n, const Vector& e, Vector& T) const {
    constexpr bool takes_four = takes_several && std::is_same<decltype(e[0]), const Scalar&>::value;
    FixedArray<int, 4> some;
    int count = 0;
    for (int k = 0; k < n; ++k) {
      if (bits_of(e[k]) == 0) continue;
      if constexpr (!takes_four) {
        add(n, k, e[k], T);
      } else {
        some[count++] = k;
        if (count < 4) continue;
        add_four(n, some, e, T);
        count = 0;
      }
    }
    for (int i = 0; i < count; ++i) add(n, some[i], e[some[i]], T);
  }
  /// The same where segment k alone is lengthened.
  template <class Number, class Vector>
  void add(int n, int k, Number by, Vector& T) const {
    axpy(n, by, &entries[k * Segments], &T[0]);
  }

 private:
  /// T is read and written once for four columns: the same sums in the same order.
  template <class Vector>
  void add_four(int n, const FixedArray<int, 4>& of, const Vector& e, Vector& T) const {
    const Scalar* const a = &entries[of[0] * Segments];
    const Scalar* const b = &entries[of[1] * Segments];
    const Scalar* const c = &entries[of[2] * Segments];
    const Scalar* const d = &entries[of[3] * Segments];
    const Scalar ea = e[of[0]], eb = e[of[1]], ec = e[of[2]], ed = e[of[3]];
    Scalar* const __restrict sum = &T[0];
    for (int i = 0; i < n; ++i) sum[i] = sum[i] + ea * a[i] + eb * b[i] + ec * c[i] + ed * d[i];
  }
};

/// The matrix C of Eq. (8) between rigid saddles: EA/L of each segment on the diagonal [N/m], for a segment
/// knows nothing of the others.
template <class Scalar, int Segments>
struct NoCoupling {
  FixedArray<Scalar, Segments> axial;

  constexpr Scalar operator()(int i, int k) const { return i == k ? axial[i] : Scalar(0); }
  constexpr void set(int i, int k, Scalar value) {
    if (i == k) axial[i] = value;
  }
  template <class Vector>
  void add(int n, const Vector& e, Vector& T) const {
    for (int i = 0; i < n; ++i) add(n, i, e[i], T);
  }
  template <class Number, class Vector>
  void add(int, int k, Number by, Vector& T) const {
    T[k] += static_cast<Number>(axial[k]) * by;
  }
};

template <class Real, int Count, class Cap>
struct CondensedRows;

/// Displacements that there are rows for. Rigid saddles need none: nothing moves.
template <class Cap>
constexpr int max_displacements = has_rigid_saddles<Cap> ? 0 : Cap::displacements;

template <class Scalar, class Cap, class Rows = CondensedRows<Wide<Scalar>, max_displacements<Cap>, Cap>>
struct CondensedDisplacements;

/// A scene after static condensation of its structure: Eq. (8).
///
/// T = load x factors + prestrain + coupling x e, where e is the elongation imposed on each segment by what
/// moves along the cable: e_i = delta_i - delta_{i-1} + extension of a jack + slack length, Eq. (6). An
/// aggregate: it can be a constant in flash.
///
/// The numbers are double for a tracker in float too: what is redundant in a structure makes rows that all
/// but depend on one another, and rounded one by one they would contradict.
template <class Scalar_, class Cap>
struct Condensed {
  using Scalar = Scalar_;
  using Capacity = Cap;
  using Real = Wide<Scalar>;
  using Coupling = std::conditional_t<has_rigid_saddles<Cap>, NoCoupling<Real, Cap::segments>,
                                      ElasticCoupling<Real, Cap::segments>>;
  using Linear = Condensed;
  using AtLevel = Condensed;                             ///< what a tracker computes with
  using Struts = CondensedRows<Real, Cap::struts, Cap>;  ///< CondensedStruts
  using Displacements = CondensedDisplacements<Scalar, Cap>;
  /// Its numbers hold whatever the forces are: linear theory.
  static constexpr bool has_level = false;

  FixedList<CableLayout<Scalar>, Cap::cables> cables;
  int segments = 0;
  int joints = 0;
  int loads = 0;
  Coupling coupling;  ///< segments x segments, symmetric [N/m]; rigid saddles: its diagonal
  FixedArray<Real, Cap::segments> prestrain;                     ///< tensions from prestrain alone [N]
  FixedArray<FixedArray<Real, Cap::segments>, Cap::loads> load;  ///< tensions from a unit factor [N]
  FixedArray<Real, Cap::joints> rho;          ///< smallest T_small / T_big of every joint; 0: self-locking
  FixedArray<Scalar, Cap::joints> cos_alpha;  ///< half the angle between the segments, for N and f
  FixedArray<Scalar, Cap::joints> sin_alpha;
  /// What a sample may ask for: more is a mistake, of a unit or of an instrument. No cable carries a tenth of
  /// its E A, for wires break at a few per cent of strain.
  FixedArray<Scalar, Cap::cables> most_force;  ///< of a jack of every cable: a tenth of its E A [N]
  FixedArray<Scalar, Cap::loads> most_factor;  ///< that alone gives a segment a hundred times that

  /// The cable of a segment.
  constexpr int cable_of(int segment) const {
    int c = 0;
    while (segment >= cables[c].first_segment + cables[c].segments()) ++c;
    return c;
  }
  constexpr bool is_self_locking(int joint) const { return !is_one_span<Cap> && !(rho[joint] > 0); }

  /// Contact and friction forces of all joints from the tensions of the response:
  /// N = (T1 + T2) cos(alpha), f = (T2 - T1) sin(alpha), Eq. (2) [N].
  constexpr void resolve_joints(Response<Scalar, Cap>& response) const {
    for (int c = 0; c < cables.size(); ++c)
      for (int k = 0; k < cables[c].joints(); ++k) {
        const int j = cables[c].first_joint + k;
        const auto sides = cables[c].joint_segments(k);
        const Scalar T1 = response.tension[sides[0]], T2 = response.tension[sides[1]];
        response.contact[j] = (T1 + T2) * cos_alpha[j];
        response.friction[j] = (T2 - T1) * sin_alpha[j];
      }
  }
};

/// `capacity_exceeded`, naming the cable, if and only if there are more sliding spans than Capacity::spans,
/// or hoops, prestrain or joints without friction where the capacity says that there are none. Cost: a pass
/// over segments and joints; nothing where the capacity leaves all that open.
template <class Scalar, class Cap>
constexpr Status check_capacity(const Condensed<Scalar, Cap>& model) {
  int spans = 0;
  for (int c = 0; c < model.cables.size(); ++c) {
    const auto& cable = model.cables[c];
    bool fits = Cap::hoops || !cable.closed;
    if constexpr (!Cap::prestrain)
      for (int i = 0; i < cable.segments(); ++i) fits = fits && model.prestrain[cable.first_segment + i] == 0;
    if constexpr (!Cap::smooth || Cap::spans >= 0) {
      int locking = 0;
      for (int j = 0; j < cable.joints(); ++j) {
        fits = fits && (Cap::smooth || model.rho[cable.first_joint + j] < 1);
        locking += model.rho[cable.first_joint + j] > 0 ? 0 : 1;
      }
      spans += !cable.closed ? locking + 1 : locking > 0 ? locking : 1;
      fits = fits && (Cap::spans < 0 || spans <= Cap::spans);
    }
    if (!fits) return Status::at(Code::capacity_exceeded, Place::cable, c);
  }
  return Status::success();
}

/// `bad_sample` if and only if a load factor is not finite or beyond most_factor, or the force of an unlocked
/// jack is not finite, negative or beyond most_force.
template <class Scalar, class Cap>
Status check_sample(const Condensed<Scalar, Cap>& model, const Sample<Scalar, Cap>& sample) {
  for (int i = 0; i < model.loads; ++i)
    if (!(std::fabs(sample.factor[i]) <= model.most_factor[i]))
      return Status::at(Code::bad_sample, Place::load, i);
  Status status = Status::success();
  for_each_jacked_end(model.cables, [&](int c, std::size_t end) {
    const Jack<Scalar>& jack = sample.jack[c][end];
    if (!jack.locked && !(jack.force >= 0 && jack.force <= model.most_force[c]) && status.ok())
      status = Status::along(Code::bad_sample, Place::cable_end, c, static_cast<int>(end));
  });
  return status;
}

/// Rows that give `Count` numbers of the state: load x factors + prestrain + elongation x e, with e as in
/// Condensed. An aggregate, too.
template <class Real, int Count, class Cap>
struct CondensedRows {
  FixedArray<FixedArray<Real, Count>, Cap::loads> load;  ///< for a unit factor
  FixedArray<Real, Count> prestrain;
  FixedArray<FixedArray<Real, Count>, Cap::segments> elongation;  ///< for a unit elongation of each segment

  /// The numbers in the state of `model` that `drive` (a Drive) and the elongations e [m] describe; what is
  /// beyond `Count` stays as it is.
  template <class Scalar, class Loads, class Elongations, class Number, int Size>
  constexpr void evaluate(const Condensed<Scalar, Cap>& model, const Loads& drive, const Elongations& e,
                          FixedArray<Number, Size>& numbers) const {
    static_assert(Count <= Size, "there is room for every number");
    for (int i = 0; i < Count; ++i) {
      Real sum = drive.prestrain * prestrain[i];
      for (int k = 0; k < model.loads; ++k) sum += drive.factor[k] * load[k][i];
      for (int segment = 0; segment < model.segments; ++segment) sum += e[segment] * elongation[segment][i];
      numbers[i] = static_cast<Number>(sum);
    }
  }
};

/// Number `i` of all these rows alone.
template <class Model, class Real, int Count, class Cap, class Loads, class Elongations>
Real number_of(const CondensedRows<Real, Count, Cap>& rows, int i, const Model& model, const Loads& drive,
               const Elongations& e) {
  Real value = drive.prestrain * rows.prestrain[i] + change_of(rows, i, model, e);
  for (int k = 0; k < model.loads; ++k) value += drive.factor[k] * rows.load[k][i];
  return value;
}
/// What elongations alone make of it.
template <class Model, class Real, int Count, class Cap, class Elongations>
Real change_of(const CondensedRows<Real, Count, Cap>& rows, int i, const Model& model, const Elongations& e) {
  Real sum = 0;
  for (int k = 0; k < model.segments; ++k) sum += rows.elongation[k][i] * e[k];
  return sum;
}

/// On request: the rows that give strut forces [N], tension positive.
template <class Scalar, class Cap>
using CondensedStruts = CondensedRows<Wide<Scalar>, Cap::struts, Cap>;

/// The rows that give axial forces of beams [N], tension positive.
template <class Scalar, class Cap>
using CondensedBeams = CondensedRows<Wide<Scalar>, Cap::beams, Cap>;

/// Segments, struts and beams, in this order.
template <class Cap>
constexpr int max_bars = Cap::segments + Cap::struts + Cap::beams;
/// What says how far geometry has changed: LevelModel::shifts().
template <class Cap>
constexpr int max_shifts = Cap::joints + Cap::segments* Cap::normals;

/// What `Count` numbers of the state change by with a unit elongation of every strut and, after
/// Capacity::struts, of every beam.
template <class Real, int Count, class Cap>
using RowsByBar = FixedArray<FixedArray<Real, Count>, Cap::struts + Cap::beams>;

/// Rows, and what a unit elongation of bars adds to their numbers, as leaning does: Eq. (43).
template <class Real, int Count, class Cap>
struct LeaningRows {
  CondensedRows<Real, Count, Cap> rows;
  RowsByBar<Real, Count, Cap> by_bar;
};
/// What bars that are lengthened by `q` [m] add to number `i` of them. Costs bars.
template <class Real, int Count, class Cap, class Lean, class Stretches>
Real stretched(const LeaningRows<Real, Count, Cap>& of, int i, const Lean& lean, int segments,
               const Stretches& q) {
  Real sum = 0;
  lean.for_each_bar(segments, [&](int b) {
    sum += q[b] * (b < Cap::segments ? of.rows.elongation[b][i] : of.by_bar[b - Cap::segments][i]);
  });
  return sum;
}
/// Number `i` of them alone, in a state of the LevelModel whose bars are lengthened by `q` [m]. Costs
/// segments + bars.
template <class Model, class Real, int Count, class Cap, class Loads, class Elongations, class Stretches>
Real number_of(const LeaningRows<Real, Count, Cap>& of, int i, const Model& model, const Loads& drive,
               const Elongations& e, const Stretches& q) {
  return number_of(of.rows, i, model, drive, e) + stretched(of, i, model.lean(), model.segments, q);
}

/// What `Count` numbers of the state change by with a unit push of every strut along each of its normals, as
/// leaning does: Eq. (46).
template <class Real, int Count, class Cap>
using RowsByPush = FixedArray<FixedArray<Real, Count>, Cap::struts * Cap::normals>;

/// What second-order theory needs to know of displacements.
template <class Scalar, class Cap>
struct CondensedLean {
  using Real = Wide<Scalar>;
  /// By what part of itself the bend of the cable changes at every joint [-], Eq. (44).
  LeaningRows<Real, Cap::joints, Cap> bends;
  /// By what part of itself kappa changes where the bend does by such a part.
  FixedArray<Real, Cap::joints> kappa_by_bend;
  /// By how much the ends of every bar move apart across it, for each normal, by the root of twice its
  /// length: their squares are what leaning lengthens it by [m^1/2].
  CondensedRows<Real, max_bars<Cap> * Cap::normals, Cap> aside;
  /// 1 / length of every bar [1/m]: by what part of itself its force is more along the axis that it has come
  /// to, for a metre that its lean lengthens it by, Eq. (45).
  FixedArray<Real, max_bars<Cap>> by_own_lean;
  /// What a unit elongation of a bar does to its own `aside` [m^-1/2].
  FixedArray<Real, max_bars<Cap> * Cap::normals> own_aside;
  /// Forces of struts [N], tension positive, and what they are on the straight way to the target: at the
  /// lowest level, and what Eq. (48) adds with k = 0.
  LeaningRows<Real, Cap::struts, Cap> thrust;
  FixedArray<Real, Cap::struts> low_thrust, thrust_rise, thrust_bow;
  /// What the pushes of struts do to `bends` and `aside`.
  RowsByPush<Real, Cap::joints, Cap> bends_by_push;
  RowsByPush<Real, max_bars<Cap> * Cap::normals, Cap> aside_by_push;
  int struts = 0, beams = 0;  ///< that the scene has

  /// Calls visit(number) for every segment, strut and beam.
  template <class Visit>
  constexpr void for_each_bar(int segments, Visit visit) const {
    for (int i = 0; i < segments; ++i) visit(i);
    if constexpr (Cap::struts > 0)
      for (int i = 0; i < struts; ++i) visit(Cap::segments + i);
    if constexpr (Cap::beams > 0)
      for (int i = 0; i < beams; ++i) visit(Cap::segments + Cap::struts + i);
  }
  /// Calls visit(push, strut, aside) for every normal of every strut, with the numbers of all three.
  template <class Visit>
  constexpr void for_each_push(Visit visit) const {
    if constexpr (Cap::struts > 0)
      for (int n = 0; n < struts * Cap::normals; ++n)
        visit(n, n / Cap::normals, Cap::segments * Cap::normals + n);
  }
};

/// A displacement: of a node, along an axis (0, 1 or 2).
struct NodeAxis {
  int node = 0;
  int axis = 0;
};

/// On request: the rows that give displacements of nodes [m], at most Capacity::displacements. Which ones is
/// chosen with add() before Condensation::run(), which fills the rows; LevelRows in second-order theory.
template <class Scalar, class Cap, class Rows>
struct CondensedDisplacements {
  FixedList<NodeAxis, Cap::displacements> of;
  Rows rows;

  /// Chooses a displacement; returns its number, -1 if there is no room.
  constexpr int add(int node, int axis) { return of.add({node, axis}); }
  /// Chooses all displacements of a scene: that of a node along an axis is number node x dimension + axis.
  template <class SceneType>
  constexpr void add_all(const SceneType& scene) {
    for (int node = 0; node < scene.nodes.size(); ++node)
      for (int axis = 0; axis < SceneType::dimension; ++axis) add(node, axis);
  }

  /// The displacements [m] at the loads `drive` (a Drive) and the elongations e [m] of the segments.
  template <class Model, class Loads, class Elongations>
  constexpr void evaluate(const Model& model, const Loads& drive, const Elongations& e,
                          FixedArray<Scalar, Cap::displacements>& displacements) const {
    displacements.fill(Scalar(0));
    rows.evaluate(model, drive, e, displacements);
  }
};

}  // namespace taut
