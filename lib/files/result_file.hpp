// Writes a result.
#pragma once

#include <string>
#include <vector>

#include "lib/files/answer.hpp"
#include "lib/files/result_selection.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// The floating-point type of a computation.
enum class ScalarType { float32, float64 };

/// How the numbers of a result are written.
struct NumberFormat {
  ScalarType scalar = ScalarType::float64;
  bool hex = false;  ///< the bits of the IEEE value, 8 or 16 lower-case digits, in place of decimals
};

/// Appends a number in the format, as the shortest decimal that reads back the same; a value of a float
/// computation is rounded to float first.
void append_number(std::string& text, double value, const NumberFormat& format);

/// The first number of an answer that no structure can have, a NaN for one, as `C.T1 = nan`; empty if there
/// is none.
std::string impossible_number(const SceneDescription& scene, const Answer& answer);

/// The word for a state.
const char* state_word(JointState state);

/// The columns of a result: what every method finds, or also what `estimate` says of its certainty, with
/// alarms, notices and verdict.
enum class ResultColumns { state, estimate };

/// Names of these columns in their order.
std::vector<std::string> result_columns(const SceneDescription& scene, ResultColumns columns);

/// Names of the columns that are written where select_columns() names them: how much of friction is used at
/// every joint and, for `state`, the displacements of all nodes.
std::vector<std::string> further_columns(const SceneDescription& scene, ResultColumns columns);

/// The displacements among these names, in the order of further_columns().
std::vector<DisplacementDescription> displacements_among(const std::vector<std::string>& names,
                                                         const SceneDescription& scene);

/// `time`, and then the columns with these names in this order; a name that is there again has no effect.
/// Throws InputError for a name that no column has.
ResultSelection select_columns(const std::vector<std::string>& names, const SceneDescription& scene,
                               ResultColumns columns);

/// Header line of a result of the scene.
std::string result_header(const SceneDescription& scene, ResultColumns columns = ResultColumns::state,
                          const ResultSelection& selection = {});

/// Line of a result: the time [s] and the answer, in the columns of result_header(). Decimals have the digits
/// that they deserve, see with_deserved_digits().
std::string result_row(const SceneDescription& scene, double time, const Answer& answer,
                       const NumberFormat& format, ResultColumns columns = ResultColumns::state,
                       const ResultSelection& selection = {});

}  // namespace taut::host
