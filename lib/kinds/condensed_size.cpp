#include "lib/kinds/condensed_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "lib/kinds/condensed_kind.hpp"
#include "taut/condensation/second_order.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut::host {
namespace {

// All members of the types are lists whose lengths are products of at most two counts, so a size is a
// quadratic function of the counts. It is known from the sizes at a few capacities; with multiples of eight
// nothing there is padding.
constexpr int unit = 8;
constexpr std::size_t variables = 8;     // cables, segments, joints, loads, jacks, struts, beams, spans
constexpr std::size_t none = variables;  // of the variables
using Grid = std::array<double, (variables + 1) * (variables + 1)>;

// The kinds of scenes that take other room: rigid saddles and linear theory, each without prestrain and with
// it, and second-order theory by the normals of a bar.
enum class Room { rigid, prestrained_rigid, linear, prestrained_linear, leaning_in_plane, leaning_in_space };

// One unit of everything, and one more of variable A and of variable B.
template <std::size_t A, std::size_t B, Room Is>
struct Sampled : Capacity {
  static constexpr int count(std::size_t variable) {
    return unit * (1 + (A == variable ? 1 : 0) + (B == variable ? 1 : 0));
  }
  static constexpr bool is_rigid = Is == Room::rigid || Is == Room::prestrained_rigid,
                        is_linear = is_rigid || Is == Room::linear || Is == Room::prestrained_linear,
                        prestrain = Is != Room::rigid && Is != Room::linear;
  static constexpr int cables = count(0), segments = count(1), joints = count(2), loads = count(3);
  static constexpr int jacks = count(4), struts = is_rigid ? 0 : count(5), beams = is_linear ? 0 : count(6);
  static constexpr int spans = count(7), substructures = is_rigid ? 0 : 1,
                       normals = Is == Room::leaning_in_plane ? 1 : 2;
};

template <class Scalar, class Cap>
using SampledScene = std::conditional_t<Cap::is_linear, Condensed<Scalar, Cap>, SecondOrder<Scalar, Cap>>;

template <template <class> class SizeOf, Room Is, std::size_t A, std::size_t B>
constexpr double sampled = static_cast<double>(SizeOf<Sampled<(A < B ? B : A), (A < B ? A : B), Is>>::bytes);

template <template <class> class SizeOf, Room Is, std::size_t... I>
Grid sampled_sizes(std::index_sequence<I...>) {
  return {sampled<SizeOf, Is, I / (variables + 1), I % (variables + 1)>...};
}

// Newton's forward interpolation.
template <template <class> class SizeOf, Room Is>
std::size_t interpolated(const CondensedCounts& counts) {
  static const Grid sizes =
      sampled_sizes<SizeOf, Is>(std::make_index_sequence<std::tuple_size<Grid>::value>());
  const auto at = [](std::size_t a, std::size_t b) { return sizes[a * (variables + 1) + b]; };
  const std::array<int, variables> given = {counts.cables, counts.segments, counts.joints, counts.loads,
                                            counts.jacks,  counts.struts,   counts.beams,  counts.spans};
  const auto steps = [&](std::size_t a) { return static_cast<double>(given[a]) / unit - 1; };
  const double base = at(none, none);
  double bytes = base;
  for (std::size_t a = 0; a < variables; ++a) {
    bytes += (at(a, none) - base) * steps(a);
    bytes += (at(a, a) - 2 * at(a, none) + base) * steps(a) * (steps(a) - 1) / 2;
    for (std::size_t b = 0; b < a; ++b)
      bytes += (at(a, b) - at(a, none) - at(b, none) + base) * steps(a) * steps(b);
  }
  // All of them hold doubles.
  return sizeof(double) * static_cast<std::size_t>(std::ceil(bytes / sizeof(double)));
}

template <class Scalar>
struct Sizes {
  template <class Cap>
  struct OfScene {
    static constexpr std::size_t bytes = sizeof(SampledScene<Scalar, Cap>);
  };
  template <class Cap>
  struct OfStrutRows {
    static constexpr std::size_t bytes = sizeof(typename SampledScene<Scalar, Cap>::Struts);
  };
  template <class Cap>
  struct OfTracker {
    static constexpr std::size_t bytes = sizeof(Tracker<SampledScene<Scalar, Cap>>);
  };

  // The large variables that live at once while the modes are decided, four rows of tensions and slips for a
  // direction, and a kilobyte for all calls.
  template <class Cap>
  struct OfStack {
    using Tracked = Tracker<SampledScene<Scalar, Cap>>;
    using Model = typename SampledScene<Scalar, Cap>::AtLevel;
    using Solver = ModeSolver<Model, typename CableSystem<Model, 0>::Laws>;
    static constexpr std::size_t bytes = sizeof(Solver) + 2 * sizeof(FixedList<SlipMode, 2 * Cap::joints>) +
                                         sizeof(typename Tracked::SlipState) +
                                         8 * sizeof(typename Solver::Tensions) +
                                         8 * sizeof(typename Solver::Values) + 1024;
  };

  template <Room Is>
  static CondensedSize of(const CondensedCounts& counts) {
    return {interpolated<OfScene, Is>(counts), counts.struts == 0 ? 0 : interpolated<OfStrutRows, Is>(counts),
            interpolated<OfTracker, Is>(counts), interpolated<OfStack, Is>(counts)};
  }
  static CondensedSize of(const CondensedCounts& counts) {
    if (counts.leans())
      return counts.normals == 1 ? of<Room::leaning_in_plane>(counts) : of<Room::leaning_in_space>(counts);
    if (counts.substructures == 0)
      return counts.prestrain ? of<Room::prestrained_rigid>(counts) : of<Room::rigid>(counts);
    return counts.prestrain ? of<Room::prestrained_linear>(counts) : of<Room::linear>(counts);
  }
};

}  // namespace

CondensedCounts condensed_counts(const SceneDescription& scene, const CondensedArrays& condensed) {
  CondensedCounts counts;
  counts.cables = static_cast<int>(scene.cables.size());
  counts.loads = static_cast<int>(scene.loads.size());
  counts.struts = static_cast<int>(scene.struts.size());
  if (leans(scene)) {
    for (const BeamDescription& beam : scene.beams) counts.beams += static_cast<int>(beam.members());
    counts.normals = scene.dimension - 1;
  }
  counts.substructures = is_rigid(scene) ? 0 : std::max(1, static_cast<int>(scene.substructures.size()));
  for (const CableDescription& cable : scene.cables) {
    counts.segments += static_cast<int>(cable.segments());
    counts.joints += static_cast<int>(cable.joints());
    for (std::size_t end = 0; end < 2; ++end) counts.jacks += cable.is_jacked(end) ? 1 : 0;
    counts.hoops = counts.hoops || cable.closed;
  }
  if (!condensed.condensing.status) {
    counts.spans = counts.segments;
    counts.prestrain = counts.smooth = true;
    return counts;
  }
  const auto any = [](const LinearArrays::Row& row, auto is) {
    return std::any_of(row.begin(), row.end(), is);
  };
  // In second-order theory other levels have other numbers.
  counts.prestrain = counts.leans() || any(condensed.prestrain, [](double T) { return T != 0; });
  counts.smooth = counts.leans() || any(condensed.rho, [](double rho) { return !(rho < 1); });
  for (const CableLayout<double>& cable : condensed.cables) {
    int locking = 0;
    for (int j = 0; j < cable.joints(); ++j)
      locking += condensed.rho[static_cast<std::size_t>(cable.first_joint + j)] > 0 ? 0 : 1;
    counts.spans += cable.closed ? std::max(1, locking) : 1 + locking;
  }
  return counts;
}

CondensedCounts larger(const CondensedCounts& a, const CondensedCounts& b) {
  return {std::max(a.cables, b.cables),
          std::max(a.jacks, b.jacks),
          std::max(a.segments, b.segments),
          std::max(a.joints, b.joints),
          std::max(a.loads, b.loads),
          std::max(a.struts, b.struts),
          std::max(a.beams, b.beams),
          std::max(a.normals, b.normals),
          std::max(a.substructures, b.substructures),
          a.saddles || b.saddles || a.has_rigid_saddles() != b.has_rigid_saddles(),
          std::max(a.spans, b.spans),
          a.hoops || b.hoops,
          a.prestrain || b.prestrain,
          a.smooth || b.smooth};
}

CondensedSize condensed_size(const CondensedCounts& counts, ScalarType scalar) {
  return scalar == ScalarType::float32 ? Sizes<float>::of(counts) : Sizes<double>::of(counts);
}

}  // namespace taut::host
