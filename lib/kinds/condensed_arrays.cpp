#include "lib/kinds/condensed_arrays.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>

#include "lib/files/number_range.hpp"
#include "lib/kinds/condensed_kind.hpp"
#include "lib/kinds/large_objects.hpp"
#include "lib/kinds/scene_gauges.hpp"
#include "lib/kinds/valid_scene.hpp"

namespace taut::host {
namespace {

using Row = CondensedArrays::Row;

template <class Values>
Row row_of(const Values& values, int count) {
  Row row;
  for (int i = 0; i < count; ++i) row.push_back(static_cast<double>(values[i]));
  return row;
}

template <class Rows>
std::vector<Row> rows_of(const Rows& rows, int count, int length) {
  std::vector<Row> copied;
  for (int k = 0; k < count; ++k) copied.push_back(row_of(rows[k], length));
  return copied;
}

template <class Coupling>
std::vector<Row> coupling_of(const Coupling& coupling, int segments) {
  std::vector<Row> columns(static_cast<std::size_t>(segments));
  for (int k = 0; k < segments; ++k)
    for (int i = 0; i < segments; ++i)
      columns[static_cast<std::size_t>(k)].push_back(static_cast<double>(coupling(i, k)));
  return columns;
}

template <class Scalar>
CableLayout<double> layout_of(const CableLayout<Scalar>& cable) {
  return {cable.closed, cable.ends,          static_cast<double>(cable.seating),
          cable.nodes,  cable.first_segment, cable.first_joint};
}

bool are_possible(const Row& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return is_possible(number); });
}
bool are_possible(const std::vector<Row>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return are_possible(row); });
}
bool are_possible(const RowsArrays& rows) {
  return are_possible(rows.load) && are_possible(rows.prestrain) && are_possible(rows.elongation);
}
bool are_possible(const LinearArrays& arrays) {
  return are_possible(arrays.coupling) && are_possible(arrays.prestrain) && are_possible(arrays.load) &&
         are_possible(arrays.rho) && are_possible(arrays.cos_alpha) && are_possible(arrays.sin_alpha);
}
bool are_possible(const LeaningArrays& arrays) {
  return are_possible(arrays.rows) && are_possible(arrays.by_bar);
}
bool are_possible(const LevelArrays& arrays) {
  return are_possible(arrays.low_by_bar) && are_possible(arrays.rise) && are_possible(arrays.bow) &&
         are_possible(arrays.low_strut_by_bar) && are_possible(arrays.strut_rise) &&
         are_possible(arrays.strut_bow) && are_possible(arrays.strut_curve) && are_possible(arrays.bends) &&
         are_possible(arrays.aside) && are_possible(arrays.kappa_by_bend) &&
         are_possible(arrays.by_own_lean) && are_possible(arrays.own_aside) && are_possible(arrays.thrust) &&
         are_possible(arrays.low_thrust) && are_possible(arrays.thrust_rise) &&
         are_possible(arrays.thrust_bow) && are_possible(arrays.strut_by_push) &&
         are_possible(arrays.bends_by_push) && are_possible(arrays.aside_by_push) &&
         is_possible(arrays.target_force) && is_possible(arrays.curve);
}
bool are_possible(const CondensedArrays& arrays) {
  return is_possible(arrays.condensing.condition) && are_possible(static_cast<const LinearArrays&>(arrays)) &&
         are_possible(arrays.struts) && (!arrays.level || are_possible(*arrays.level));
}

template <class Rows, class Model>
RowsArrays copied(const Rows& rows, const Model& condensed, int count) {
  return {rows_of(rows.load, condensed.loads, count), row_of(rows.prestrain, count),
          rows_of(rows.elongation, condensed.segments, count)};
}

template <class Scalar, class Cap>
LinearArrays copied(const Condensed<Scalar, Cap>& condensed) {
  const int segments = condensed.segments, joints = condensed.joints, loads = condensed.loads;
  LinearArrays arrays;
  for (const auto& cable : condensed.cables) arrays.cables.push_back(layout_of(cable));
  arrays.coupling = coupling_of(condensed.coupling, segments);
  arrays.prestrain = row_of(condensed.prestrain, segments);
  arrays.load = rows_of(condensed.load, loads, segments);
  arrays.rho = row_of(condensed.rho, joints);
  arrays.cos_alpha = row_of(condensed.cos_alpha, joints);
  arrays.sin_alpha = row_of(condensed.sin_alpha, joints);
  arrays.most_force = row_of(condensed.most_force, condensed.cables.size());
  arrays.most_factor = row_of(condensed.most_factor, loads);
  return arrays;
}

// The numbers of a scene's bars among those of the capacity, `kept` of `stride` numbers each.
template <class Cap>
Row bars_of(const Row& all, int segments, const LevelArrays& level, int kept, int stride) {
  Row numbers;
  const auto add = [&](int first, int count) {
    for (int bar = first; bar < first + count; ++bar)
      for (int n = 0; n < kept; ++n) numbers.push_back(all[static_cast<std::size_t>(bar * stride + n)]);
  };
  add(0, segments);
  add(Cap::segments, level.struts);
  add(Cap::segments + Cap::struts, level.beams);
  return numbers;
}

// Those of struts and beams.
template <class Cap, class Table>
std::vector<Row> by_bar(const Table& table, const LevelArrays& level, int length) {
  std::vector<Row> rows;
  for (int i = 0; i < level.struts; ++i) rows.push_back(row_of(table[i], length));
  for (int i = 0; i < level.beams; ++i) rows.push_back(row_of(table[Cap::struts + i], length));
  return rows;
}

// Those of the pushes of struts.
template <class Cap, class Table>
std::vector<Row> by_push(const Table& table, const LevelArrays& level, int length) {
  std::vector<Row> rows;
  for (int i = 0; i < level.struts; ++i)
    for (int n = 0; n < level.normals; ++n) rows.push_back(row_of(table[i * Cap::normals + n], length));
  return rows;
}

template <class Cap, class Rows, class Model>
LeaningArrays leaning(const Rows& rows, const Model& condensed, const LevelArrays& level, int count) {
  return {copied(rows.rows, condensed, count), by_bar<Cap>(rows.by_bar, level, count)};
}

// In the plane nothing leans along the second normal.
template <int Dimension, class Scalar, class Cap>
LevelArrays level_arrays(const SecondOrder<Scalar, Cap>& condensed, const LevelStruts<Scalar, Cap>& struts) {
  const Condensed<Scalar, Cap>& low = condensed.low;
  LevelArrays arrays;
  arrays.struts = condensed.lean.struts;
  arrays.beams = condensed.lean.beams;
  arrays.normals = Dimension - 1;
  arrays.target_force = static_cast<double>(condensed.target_force);
  arrays.curve = static_cast<double>(condensed.curve.k);
  arrays.low_by_bar = by_bar<Cap>(condensed.low_by_bar, arrays, low.segments);
  arrays.rise = leaning<Cap>(condensed.rise, low, arrays, low.segments);
  arrays.bow = leaning<Cap>(condensed.bow, low, arrays, low.segments);
  arrays.low_strut_by_bar = by_bar<Cap>(struts.low.by_bar, arrays, arrays.struts);
  arrays.strut_rise = leaning<Cap>(struts.rise, low, arrays, arrays.struts);
  arrays.strut_bow = leaning<Cap>(struts.bow, low, arrays, arrays.struts);
  arrays.strut_curve = row_of(struts.curve, arrays.struts);
  arrays.strut_by_push = by_push<Cap>(struts.by_push, arrays, arrays.struts);
  arrays.bends = leaning<Cap>(condensed.lean.bends, low, arrays, low.joints);
  arrays.by_own_lean =
      bars_of<Cap>(row_of(condensed.lean.by_own_lean, max_bars<Cap>), low.segments, arrays, 1, 1);
  arrays.kappa_by_bend = row_of(condensed.lean.kappa_by_bend, low.joints);
  const RowsArrays aside = copied(condensed.lean.aside, low, max_bars<Cap> * Cap::normals);
  const auto kept = [&](const Row& row) {
    return bars_of<Cap>(row, low.segments, arrays, arrays.normals, Cap::normals);
  };
  arrays.own_aside = kept(row_of(condensed.lean.own_aside, max_bars<Cap> * Cap::normals));
  for (const Row& row : aside.load) arrays.aside.load.push_back(kept(row));
  arrays.aside.prestrain = kept(aside.prestrain);
  for (const Row& row : aside.elongation) arrays.aside.elongation.push_back(kept(row));
  arrays.thrust = leaning<Cap>(condensed.lean.thrust, low, arrays, arrays.struts);
  arrays.low_thrust = row_of(condensed.lean.low_thrust, arrays.struts);
  arrays.thrust_rise = row_of(condensed.lean.thrust_rise, arrays.struts);
  arrays.thrust_bow = row_of(condensed.lean.thrust_bow, arrays.struts);
  arrays.bends_by_push = by_push<Cap>(condensed.lean.bends_by_push, arrays, low.joints);
  for (const Row& row : by_push<Cap>(condensed.lean.aside_by_push, arrays, max_bars<Cap> * Cap::normals))
    arrays.aside_by_push.push_back(kept(row));
  return arrays;
}

template <class Scalar, int Dimension, class Cap>
CondensedArrays condensed_arrays(const SceneDescription& scene) {
  const auto condensed = make_zeroed<CondensedOf<Scalar, Cap>>();
  const auto struts = make_zeroed<StrutsOf<Scalar, Cap>>();
  CondensedArrays arrays;
  arrays.rigid = has_rigid_saddles<Cap>;
  arrays.condensing = condense_scene<Scalar, Dimension, Cap>(scene, *condensed, *struts);
  if (!arrays.condensing.status) return arrays;
  static_cast<LinearArrays&>(arrays) = copied(linear_part(*condensed));
  arrays.struts =
      copied(linear_part(*struts), linear_part(*condensed), static_cast<int>(scene.struts.size()));
  if constexpr (CondensedOf<Scalar, Cap>::AtLevel::has_level)
    arrays.level = level_arrays<Dimension>(*condensed, *struts);
  if (!are_possible(arrays)) arrays.condensing.status.code = Code::not_finite;
  return arrays;
}

template <class Scalar, int Dimension, class Cap>
FrictionPriorArrays friction_prior_arrays(const SceneDescription& scene) {
  const auto prior = std::make_unique<FrictionPrior<Scalar, Cap>>();
  know_scene<Scalar, Dimension, Cap>(scene, *prior);
  const auto cables = static_cast<int>(scene.cables.size());
  std::size_t joints = 0, segments = 0;
  for (const CableDescription& cable : scene.cables) {
    joints += cable.joints();
    segments += cable.segments();
  }
  FrictionPriorArrays arrays;
  arrays.mu = row_of(prior->mu, static_cast<int>(joints));
  arrays.contact_factor = row_of(prior->contact_factor, static_cast<int>(joints));
  arrays.mu_sd = row_of(prior->mu_sd, cables);
  arrays.seating_sd = row_of(prior->seating_sd, cables);
  arrays.scatter = row_of(prior->scatter, cables);
  arrays.drift_sd = row_of(prior->drift_sd, cables);
  arrays.length = row_of(prior->length, static_cast<int>(segments));
  for (int c = 0; c < cables; ++c) {
    arrays.capstan.push_back(prior->capstan[c]);
    arrays.shared.push_back(prior->shared[c]);
    const auto& cell = prior->cell[c];
    arrays.cell.push_back({LoadCell<double>::of(cell[0]), LoadCell<double>::of(cell[1])});
    for (int end = 0; end < 2; ++end) {
      const CableDescription& cable = scene.cables[static_cast<std::size_t>(c)];
      if (!has_stroke(cable, static_cast<std::size_t>(end))) continue;
      const auto stroke = LoadCell<Scalar>::of(stroke_cell(cable, static_cast<std::size_t>(end)));
      arrays.stroke.push_back({LoadCell<double>::of(stroke), c, end});
    }
  }
  return arrays;
}

}  // namespace

CondensedArrays condense(const SceneDescription& scene, ScalarType scalar) {
  require_valid(scene);
  return with_condensed_kind(scene, scalar, [&](auto kind) {
    using Kind = decltype(kind);
    return condensed_arrays<typename Kind::Scalar, Kind::dimension, typename Kind::Capacity>(scene);
  });
}

FrictionPriorArrays know(const SceneDescription& scene, ScalarType scalar) {
  return with_condensed_kind(scene, scalar, [&](auto kind) {
    using Kind = decltype(kind);
    return friction_prior_arrays<typename Kind::Scalar, Kind::dimension, typename Kind::Capacity>(scene);
  });
}

}  // namespace taut::host
