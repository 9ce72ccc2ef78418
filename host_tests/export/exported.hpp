// Compares an exported scene with what the library and the program find for the same file.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "files/run_program.hpp"
#include "lib/log_file.hpp"
#include "lib/result_file.hpp"
#include "lib/scene_build.hpp"
#include "lib/scene_file.hpp"
#include "lib/solver_values.hpp"
#include "taut/condensation/condense.hpp"
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
  if (rows == nullptr) return;
  CHECK(same_bits(rows->load, expected_rows.load));
  CHECK(same_bits(rows->prestrain, expected_rows.prestrain));
  CHECK(same_bits(rows->elongation, expected_rows.elongation));
}

/// The result of a tracker that runs on the constant, as the program would write it with --hex.
template <class Scalar, class Cap>
std::string tracked(const std::string& name, const Condensed<Scalar, Cap>& condensed,
                    const CondensedStruts<Scalar, Cap>* rows) {
  const bool single = sizeof(Scalar) == sizeof(float);
  const NumberFormat format{single ? ScalarType::float32 : ScalarType::float64, true};
  const SceneDescription scene = read_scene_file(folder() + "/" + name + ".json");
  std::ifstream stream = open_log(folder() + "/" + name + ".csv");
  LogReader log(stream, name + ".csv", scene);
  Tracker<Condensed<Scalar, Cap>> tracker;
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

/// The constant against condensation at run time, and a tracker on it against the program.
template <int Dimension, class Scalar, class Cap>
void check(const std::string& name, const Condensed<Scalar, Cap>& condensed,
           const CondensedStruts<Scalar, Cap>* rows = nullptr) {
  check_bits<Scalar, Dimension>(name + ".json", condensed, rows);
  const Scratch scratch;
  const std::string files = "'" + folder() + "/" + name + ".json' '" + folder() + "/" + name + ".csv'";
  const Outcome outcome = run_taut(scratch, "simulate " + files + " --hex --scalar " +
                                                (sizeof(Scalar) == sizeof(float) ? "float" : "double"));
  CHECK_MESSAGE(outcome.status == 0, outcome.err);
  CHECK(tracked(name, condensed, rows) == outcome.out);
}

}  // namespace exported
