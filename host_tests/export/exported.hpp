// Compares an exported scene and what is known of it with what the library and the program find for the same
// file.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>

#include "files/run_program.hpp"
#include "lib/files/log_file.hpp"
#include "lib/files/log_verdict.hpp"
#include "lib/files/result_file.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/kinds/scene_build.hpp"
#include "lib/kinds/solver_values.hpp"
#include "taut/condensation/condense.hpp"
#include "taut/estimation/estimator.hpp"
#include "taut/estimation/find_friction_prior.hpp"
#include "taut/tracking/target_state.hpp"
#include "taut/tracking/tracker.hpp"

namespace exported {

using namespace taut;
using namespace taut::host;

inline std::string folder() { return TAUT_EXPORT; }

/// The exported capacity with room for the scene as it was before condensation.
template <class Cap>
struct Whole : Cap {
  static constexpr int nodes = 16, substructure_nodes = 4, substructure_entries = 32, forces = 8,
                       temperatures = 4;
};

template <class T, int N>
bool same_bits(const FixedArray<T, N>& a, const FixedArray<T, N>& b) {
  return N == 0 || std::memcmp(a.items.data(), b.items.data(), sizeof(T) * static_cast<std::size_t>(N)) == 0;
}

template <class Scalar, int Segments>
bool same_coupling(const ElasticCoupling<Scalar, Segments>& a, const ElasticCoupling<Scalar, Segments>& b) {
  return same_bits(a.entries, b.entries);
}
template <class Scalar, int Segments>
bool same_coupling(const NoCoupling<Scalar, Segments>& a, const NoCoupling<Scalar, Segments>& b) {
  return same_bits(a.axial, b.axial);
}

template <class Scalar>
bool same_layout(const CableLayout<Scalar>& a, const CableLayout<Scalar>& b) {
  return a.closed == b.closed && a.ends == b.ends &&
         std::memcmp(&a.seating, &b.seating, sizeof a.seating) == 0 && a.nodes == b.nodes &&
         a.first_segment == b.first_segment && a.first_joint == b.first_joint;
}

template <class Scalar, class Cap, class Other>
void check_linear(const Condensed<Scalar, Cap>& found, const Condensed<Scalar, Other>& expected) {
  REQUIRE(found.cables.size() == expected.cables.size());
  for (int c = 0; c < found.cables.size(); ++c) CHECK(same_layout(found.cables[c], expected.cables[c]));
  CHECK(found.segments == expected.segments);
  CHECK(found.joints == expected.joints);
  CHECK(found.loads == expected.loads);
  CHECK(same_coupling(found.coupling, expected.coupling));
  CHECK(same_bits(found.prestrain, expected.prestrain));
  CHECK(same_bits(found.load, expected.load));
  CHECK(same_bits(found.rho, expected.rho));
  CHECK(same_bits(found.cos_alpha, expected.cos_alpha));
  CHECK(same_bits(found.sin_alpha, expected.sin_alpha));
  CHECK(same_bits(found.most_force, expected.most_force));
  CHECK(same_bits(found.most_factor, expected.most_factor));
}
template <class Rows, class Others>
void check_rows(const Rows& found, const Others& expected) {
  CHECK(same_bits(found.load, expected.load));
  CHECK(same_bits(found.prestrain, expected.prestrain));
  CHECK(same_bits(found.elongation, expected.elongation));
}

template <class Rows, class Others>
void check_leaning(const Rows& found, const Others& expected) {
  check_rows(found.rows, expected.rows);
  CHECK(same_bits(found.by_bar, expected.by_bar));
}

/// Every bit of the constant against condensation at run time, with a capacity that only the scene before it
/// needs to be larger.
template <class Scalar, int Dimension, class Cap>
void check_bits(const std::string& file, const Condensed<Scalar, Cap>& found,
                const CondensedStruts<Scalar, Cap>* rows) {
  using SceneType = Scene<double, Dimension, Whole<Cap>>;
  const auto scene = std::make_unique<SceneType>();
  build(read_scene_file(folder() + "/" + file), *scene);
  const auto condensation = std::make_unique<Condensation<Scalar, SceneType>>();
  Condensed<Scalar, Whole<Cap>> expected;
  CondensedStruts<Scalar, Whole<Cap>> expected_rows;
  REQUIRE(condensation->run(*scene, expected, &expected_rows).ok());
  check_linear(found, expected);
  if (rows != nullptr) check_rows(*rows, expected_rows);
}
template <class Scalar, int Dimension, class Cap>
void check_bits(const std::string& file, const SecondOrder<Scalar, Cap>& found,
                const LevelStruts<Scalar, Cap>* rows) {
  using SceneType = Scene<double, Dimension, Whole<Cap>>;
  const SceneDescription described = read_scene_file(folder() + "/" + file);
  const auto scene = std::make_unique<SceneType>();
  build(described, *scene);
  const auto condensation = std::make_unique<SecondOrderCondensation<Scalar, SceneType>>();
  SecondOrder<Scalar, Whole<Cap>> expected;
  LevelStruts<Scalar, Whole<Cap>> expected_rows;
  const auto target = target_of<Scalar, Whole<Cap>>(*described.second_order);
  REQUIRE(condensation->run(*scene, target, expected, expected_rows).ok());
  check_linear(found.low, expected.low);
  CHECK(same_bits(found.low_by_bar, expected.low_by_bar));
  check_leaning(found.rise, expected.rise);
  check_leaning(found.bow, expected.bow);
  CHECK(found.target_force == expected.target_force);
  CHECK(found.curve.k == expected.curve.k);
  CHECK(found.lean.struts == expected.lean.struts);
  CHECK(found.lean.beams == expected.lean.beams);
  check_leaning(found.lean.bends, expected.lean.bends);
  check_rows(found.lean.aside, expected.lean.aside);
  CHECK(same_bits(found.lean.kappa_by_bend, expected.lean.kappa_by_bend));
  CHECK(same_bits(found.lean.by_own_lean, expected.lean.by_own_lean));
  CHECK(same_bits(found.lean.own_aside, expected.lean.own_aside));
  check_leaning(found.lean.thrust, expected.lean.thrust);
  CHECK(same_bits(found.lean.low_thrust, expected.lean.low_thrust));
  CHECK(same_bits(found.lean.thrust_rise, expected.lean.thrust_rise));
  CHECK(same_bits(found.lean.thrust_bow, expected.lean.thrust_bow));
  CHECK(same_bits(found.lean.bends_by_push, expected.lean.bends_by_push));
  CHECK(same_bits(found.lean.aside_by_push, expected.lean.aside_by_push));
  REQUIRE(rows != nullptr);
  check_leaning(rows->low, expected_rows.low);
  check_leaning(rows->rise, expected_rows.rise);
  check_leaning(rows->bow, expected_rows.bow);
  CHECK(same_bits(rows->curve, expected_rows.curve));
  CHECK(same_bits(rows->by_push, expected_rows.by_push));
  CHECK(rows->count == expected_rows.count);
}

/// The scene of a file; where mu has no standard deviation it is half of the mean mu.
inline SceneDescription described(const std::string& name) {
  SceneDescription scene = read_scene_file(folder() + "/" + name + ".json");
  for (CableDescription& cable : scene.cables) {
    if (cable.has_mu_sd || cable.joints() == 0) continue;
    cable.mu_sd =
        0.5 * std::accumulate(cable.mu.begin(), cable.mu.end(), 0.0) / static_cast<double>(cable.joints());
  }
  return scene;
}

/// Every bit of the constant against collecting it from the scene at run time.
template <class Scalar, int Dimension, class Cap>
void check_prior(const std::string& name, const FrictionPrior<Scalar, Cap>& found) {
  using SceneType = Scene<double, Dimension, Whole<Cap>>;
  const auto scene = std::make_unique<SceneType>();
  build(described(name), *scene);
  FrictionPrior<Scalar, Whole<Cap>> expected;
  find_friction_prior(*scene, expected);
  CHECK(same_bits(found.mu, expected.mu));
  CHECK(same_bits(found.contact_factor, expected.contact_factor));
  CHECK(same_bits(found.capstan, expected.capstan));
  CHECK(same_bits(found.mu_sd, expected.mu_sd));
  CHECK(same_bits(found.shared, expected.shared));
  CHECK(found.cell == expected.cell);
}

/// The result of a tracker that runs on the constant, as the program would write it with --hex.
template <class Exported>
std::string tracked(const std::string& name, const Exported& condensed,
                    const typename Exported::Struts* rows) {
  using Scalar = typename Exported::Scalar;
  using Cap = typename Exported::Capacity;
  const bool single = sizeof(Scalar) == sizeof(float);
  const NumberFormat format{single ? ScalarType::float32 : ScalarType::float64, true};
  const SceneDescription scene = read_scene_file(folder() + "/" + name + ".json");
  std::ifstream stream = open_log(folder() + "/" + name + ".csv");
  LogReader log(stream, name + ".csv", scene);
  Tracker<Exported> tracker;
  REQUIRE(tracker.start(condensed).status.ok());
  std::string text = result_header(scene);
  LogRow row = log.first_row();
  Response<Scalar, Cap> response;
  Answer answer;
  while (log.next(row)) {
    REQUIRE(tracker.advance(sample_of<Scalar, Cap>(row, scene)).status.ok());
    tracker.respond(response, rows);
    read_response(response, scene, answer);
    text += result_row(scene, row.time, answer, format);
  }
  return text;
}

/// The result of an estimator that runs on the constants, as the program would write it with --hex.
template <int Unknowns, int Further, class Exported, class Known>
std::string estimated(const std::string& name, bool fits_exactly, const Exported& condensed,
                      const Known& prior, const typename Exported::Struts* rows) {
  using Scalar = typename Exported::Scalar;
  using Cap = typename Exported::Capacity;
  const NumberFormat format{sizeof(Scalar) == sizeof(float) ? ScalarType::float32 : ScalarType::float64,
                            true};
  const SceneDescription scene = described(name);
  std::ifstream stream = open_log(folder() + "/" + name + ".csv");
  LogReader log(stream, name + ".csv", scene);
  Estimator<Exported, Unknowns, Further> estimator;
  REQUIRE(estimator.start(condensed, prior).status.ok());
  CHECK(estimator.unknowns() <= Unknowns + Further);
  CHECK((estimator.unknowns() == Unknowns + Further || !fits_exactly || Unknowns == 1));
  std::string text = result_header(scene, ResultColumns::estimate);
  LogRow row = log.first_row();
  Response<Scalar, Cap> response;
  Readings<Scalar, Cap> readings;
  Answer answer;
  taut::host::LogVerdict verdict(scene);
  for (double before = 0; log.next(row); before = row.time) {
    const double dt = row.row == 1 ? 1 : row.time - before;
    read_row(row, scene, dt, readings);
    REQUIRE(estimator.advance(readings).status.ok());
    estimator.respond(response, rows);
    read_response(response, scene, answer);
    read_certainty(estimator, scene, answer);
    answer.verdict = verdict.take(row, answer.alarms);
    text += result_row(scene, row.time, answer, format, ResultColumns::estimate);
  }
  return text;
}

template <class Scalar>
std::string program_says(const std::string& command, const std::string& name) {
  const Scratch scratch;
  const std::string files = "'" + folder() + "/" + name + ".json' '" + folder() + "/" + name + ".csv'";
  const Outcome outcome = run_taut(scratch, command + " " + files + " --hex --scalar " +
                                                (sizeof(Scalar) == sizeof(float) ? "float" : "double"));
  CHECK_MESSAGE(outcome.status == 0, outcome.err);
  return outcome.out;
}

/// A tracker and an estimator on the constants against the program.
template <int Unknowns, int Further = 0, class Exported, class Known>
void check_answers(const std::string& name, bool fits_exactly, const Exported& condensed, const Known& prior,
                   const typename Exported::Struts* rows = nullptr) {
  using Scalar = typename Exported::Scalar;
  CHECK(tracked(name, condensed, rows) == program_says<Scalar>("simulate", name));
  CHECK(estimated<Unknowns, Further>(name, fits_exactly, condensed, prior, rows) ==
        program_says<Scalar>("estimate", name));
}

/// The same, and the constants against condensation at run time.
template <int Dimension, int Unknowns, int Further = 0, class Exported, class Known>
void check(const std::string& name, const Exported& condensed, const Known& prior,
           const typename Exported::Struts* rows = nullptr) {
  using Scalar = typename Exported::Scalar;
  check_bits<Scalar, Dimension>(name + ".json", condensed, rows);
  check_prior<Scalar, Dimension>(name, prior);
  check_answers<Unknowns, Further>(name, true, condensed, prior, rows);
}

}  // namespace exported
