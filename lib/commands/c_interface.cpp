#include "lib/commands/c_interface.hpp"

#include <cstddef>
#include <string_view>

#include "lib/files/text.hpp"

namespace taut::host {
namespace {

// The templates below have these in place of what the scene is.
struct Word {
  const char* placeholder;
  std::string text;
};

std::string filled_in(std::string_view pattern, const std::vector<Word>& words) {
  std::string text;
  for (std::size_t i = 0; i < pattern.size();) {
    const Word* found = nullptr;
    for (const Word& word : words)
      if (pattern.compare(i, std::string_view(word.placeholder).size(), word.placeholder) == 0) found = &word;
    if (found == nullptr) {
      text += pattern[i++];
    } else {
      text += found->text;
      i += std::string_view(found->placeholder).size();
    }
  }
  return text;
}

std::string capitals(std::string word) {
  for (char& c : word)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return word;
}

// Within a comment of C, on one line.
std::string commented(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte < 0x20 || byte > 0x7E || c == '*' || c == '/' || c == '\\' || c == '?' ? '_' : c;
  }
  return text;
}

// One line a cable or load: its number and its name.
std::string numbered(const std::string& what, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += " *   " + what + " " + std::to_string(i) + ": " + commented(names[i]) + "\n";
  return text;
}

std::vector<Word> pattern_words(const ExportedScene& scene, const std::string& name) {
  const SceneDescription& described = scene.description;
  std::vector<std::string> loads, cables;
  std::size_t segments = 0, joints = 0;
  for (const LoadDescription& load : described.loads) loads.push_back(load.name);
  for (const CableDescription& cable : described.cables) {
    std::string text = cable.name + ", segments " + std::to_string(segments) + " to " +
                       std::to_string(segments + cable.segments() - 1);
    if (cable.joints() > 0)
      text += ", joints " + std::to_string(joints) + " to " + std::to_string(joints + cable.joints() - 1);
    for (std::size_t end = 0; end < 2 && !cable.closed; ++end)
      text += std::string(", ") + end_name(end) + (cable.is_jacked(end) ? " jacked" : " anchored");
    cables.push_back(cable.closed ? text + ", closed" : text);
    segments += cable.segments();
    joints += cable.joints();
  }
  return {{"@NAME@", capitals(name)},
          {"@name@", name},
          {"@space@", identifier(described.name)},
          {"@scene@", commented(described.name)},
          {"@segments@", std::to_string(segments)},
          {"@joints@", std::to_string(joints)},
          {"@cables@", std::to_string(described.cables.size())},
          {"@loads@", std::to_string(loads.size())},
          {"@factors@", std::to_string(loads.empty() ? 1 : loads.size())},
          {"@list@", numbered("cable", cables) + numbered("load", loads)}};
}

constexpr std::string_view header_pattern =
    R"(/* The forces in every segment of the scene "@scene@", in C99. Written by `taut export --c`: do not edit.
 *
@list@ *
 * All storage is static; one caller at a time. Forces in N, times in s, strokes in m; numbers count from 0.
 * Forces that a call answers are those of the last row that came to its end.
 */
#ifndef @NAME@_H
#define @NAME@_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define @NAME@_SEGMENTS @segments@
#define @NAME@_JOINTS @joints@
#define @NAME@_CABLES @cables@
#define @NAME@_LOADS @loads@

/* What a call came to. */
typedef struct {
  int code;  /* 0: all is well; else @name@_describe() says what is wrong */
  int place; /* what `index` counts, as taut::Place */
  int index; /* -1: nothing in particular */
  int cable; /* -1: `index` counts over all cables */
} @name@_status;

/* What the instruments at one end of a cable say. */
typedef struct {
  int has_force; /* whether there is a reading of the load cell */
  float force;
  int has_stroke; /* whether there is a reading of the jack's stroke */
  float stroke;
  int locked; /* a wedge holds this end; of no meaning where there is no jack */
} @name@_end;

/* A row of readings: all zero is one without any. */
typedef struct {
  float dt;                /* since the row before, > 0 */
  float factor[@factors@]; /* of every load */
  @name@_end end[@NAME@_CABLES][2]; /* start and end of every cable */
} @name@_row;

/* Something odd: kind as taut::Alarm::Kind, see @name@_alarm_name(). */
typedef struct {
  int kind;
  int cable; /* -1: `place` is a strut */
  int place; /* end 0 or 1, segment or joint of the cable; -1: all joints */
} @name@_alarm_info;

/* Begins without loads. Everything else needs this first. */
@name@_status @name@_start(void);
/* Follows the readings of a row. With an error nothing after it can be trusted until start or restore. */
@name@_status @name@_advance(const @name@_row* row);

/* Tension of a segment and its standard deviation; NaN if there is no such segment, or before start. */
float @name@_force(int segment);
float @name@_sd(int segment);
/* Friction coefficient of a joint and its standard deviation; NaN as above. */
float @name@_mu(int joint);
float @name@_mu_sd(int joint);
/* What a joint does: 's' sticks, 'f' slides forward, 'b' backward, 'o' open; '?' if there is no such joint. */
char @name@_state(int joint);

/* Alarms and notices of the last row. */
int @name@_alarms(void);
@name@_alarm_info @name@_alarm(int number);
const char* @name@_alarm_name(int kind);

/* Bytes of a saved state, for the same program alone. */
size_t @name@_state_size(void);
/* Writes the state, if `size` is large enough; returns the bytes written, or 0. */
size_t @name@_save(void* buffer, size_t size);
/* Goes on where the state was saved. Only the size is checked: keep a checksum beside the bytes, and give back
 * those of the same program and scene alone. */
@name@_status @name@_restore(const void* buffer, size_t size);

/* A status in words. */
const char* @name@_describe(@name@_status status);

/* The next moves of one jack, from what is known of friction by now: there if @NAME@_PLAN is defined wherever this is included,
 * @name@.cpp too. They take a tracker more in RAM. See taut::JackPlanner. */
#ifdef @NAME@_PLAN
/* What the forces are to be; all zero is nothing. */
typedef struct {
  float target[@NAME@_SEGMENTS]; /* of every segment; 0: does not matter */
  float most_force;              /* of the jack; 0: what the cable can carry */
  float most_tension;            /* of every segment; 0: no limit */
  float most_stroke;             /* of the jack; 0: no limit */
  int lock;                      /* what counts is after lock-off */
  float worth_a_move;            /* a move more is asked for where it brings so much of the error */
} @name@_goal;
typedef struct {
  int count;      /* of moves: 0 to 2 */
  float force[2]; /* of the jack at the end of each */
  float error;    /* largest |force - target| / target then */
} @name@_moves;
/* Begins to look for the moves of the jack at an end of a cable, from where it stands. */
@name@_status @name@_plan(const @name@_goal* goal, int cable, int end);
/* Looks on for so many events; rows may come in between. Not zero once there is nothing left to look for. */
int @name@_plan_on(int events);
/* The best until now, and the force of a segment then; NaN if there is no such segment, or before @name@_plan(). */
@name@_moves @name@_plan_moves(void);
float @name@_plan_force(int segment);
#endif

#ifdef __cplusplus
}
#endif

#endif
)";

constexpr std::string_view source_pattern =
    R"(// What is behind @name@.h. Written by `taut export --c`: do not edit.
#include "@name@.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <type_traits>

#if __has_include("taut/device.hpp")
#include "taut/device.hpp"
#else
#include "taut_device.hpp"  // taut in one header
#endif

#include "@file@"

namespace {

namespace scene = ::@space@;
using Model = std::decay_t<decltype(scene::condensed<float>)>;
using Estimator = taut::Estimator<Model, scene::unknowns, scene::reading_unknowns>;
using State = Estimator::State;
static_assert(std::is_trivially_copyable_v<State>, "bytes are what is saved");

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr int most_calls = 64;  // for the events of one row

Estimator estimator;
taut::Readings<float, scene::Capacity> readings;
taut::Response<float, scene::Capacity> response;
State state;
bool is_started = false;
#ifdef @NAME@_PLAN
using Planner = taut::JackPlanner<Estimator::TrackerType>;
Planner planner;
bool is_planned = false;
#endif

const auto& layout() { return taut::linear_part(scene::condensed<float>); }
bool is_segment(int segment) { return is_started && segment >= 0 && segment < layout().segments; }
bool is_joint(int joint) { return is_started && joint >= 0 && joint < layout().joints; }

@name@_status answer(const taut::Status& status) {
  return {static_cast<int>(status.code), static_cast<int>(status.place), status.index, status.cable};
}
@name@_status wrong_call() { return {static_cast<int>(taut::Code::bad_sample), 0, -1, -1}; }

taut::AlarmLimits<float> limits() {
  float sd = 0;
@limits@  return taut::AlarmLimits<float>{}.with_stroke_noise(sd);
}

}  // namespace

extern "C" {

@name@_status @name@_start(void) {
  const auto progress = estimator.start(scene::condensed<float>, scene::prior<float>, limits()@cells@);
  is_started = progress.status.ok() && !(progress.fraction < 1);
  return answer(progress.status);
}

@name@_status @name@_advance(const @name@_row* row) {
  if (!is_started || row == nullptr || !(row->dt > 0) || !std::isfinite(row->dt)) return wrong_call();
  readings = {};
  readings.dt = row->dt;
  for (int i = 0; i < layout().loads; ++i) readings.sample.factor[i] = row->factor[i];
  for (int c = 0; c < layout().cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      const @name@_end& given = row->end[c][end];
      readings.sample.jack[c][end] = {given.force, given.locked != 0};
      readings.ends[c][end] = {given.has_force != 0, given.has_stroke != 0, given.force, given.stroke};
    }
  auto progress = estimator.advance(readings);
  for (int call = 1; progress.status.ok() && progress.fraction < 1 && call < most_calls; ++call) {
    // They are taken; what follows is the rest of the path.
    readings.dt = 0;
    for (int c = 0; c < layout().cables.size(); ++c) readings.ends[c] = {};
    progress = estimator.advance(readings);
  }
  if (!progress.status.ok()) return answer(progress.status);
  if (progress.fraction < 1) return {static_cast<int>(taut::Code::state_iterations), 0, -1, -1};
@strokes@  return answer(progress.status);
}

float @name@_force(int segment) { return is_segment(segment) ? estimator.estimate(segment).force : none; }
float @name@_sd(int segment) { return is_segment(segment) ? estimator.estimate(segment).deviation : none; }
float @name@_mu(int joint) { return is_joint(joint) ? estimator.mu(joint) : none; }
float @name@_mu_sd(int joint) { return is_joint(joint) ? estimator.mu_deviation(joint) : none; }

char @name@_state(int joint) {
  if (!is_joint(joint)) return '?';
  estimator.respond(response);
  switch (response.state[joint]) {
    case taut::JointState::stick:
      return 's';
    case taut::JointState::forward:
      return 'f';
    case taut::JointState::backward:
      return 'b';
    case taut::JointState::open:
      return 'o';
  }
  return '?';
}

int @name@_alarms(void) { return is_started ? estimator.alarms().size() : 0; }
@name@_alarm_info @name@_alarm(int number) {
  if (number < 0 || number >= @name@_alarms()) return {-1, -1, -1};
  const taut::Alarm& alarm = estimator.alarms()[number];
  return {static_cast<int>(alarm.kind), alarm.cable, alarm.place};
}
const char* @name@_alarm_name(int kind) {
  static constexpr const char* names[] = {"outlier",    "sensor",    "mu",             "stuck",   "elongation",
                                          "force-high", "force-low", "no-information", "gauge",   "lift-off",
                                          "gauge",      "unknown-past", "model-misfit", "frozen", "gain",
                                          "unread",     "late-lock",  "early-unlock"};
  constexpr int count = static_cast<int>(sizeof names / sizeof names[0]);
  static_assert(count == static_cast<int>(taut::Alarm::Kind::early_unlock) + 1, "every kind has a name");
  return kind >= 0 && kind < count ? names[kind] : "?";
}

size_t @name@_state_size(void) { return sizeof(State); }
size_t @name@_save(void* buffer, size_t size) {
  if (!is_started || buffer == nullptr || size < sizeof(State)) return 0;
  new (&state) State(estimator.save());
  std::memcpy(buffer, &state, sizeof(State));
  return sizeof(State);
}
@name@_status @name@_restore(const void* buffer, size_t size) {
  if (buffer == nullptr || size != sizeof(State)) return wrong_call();
  std::memcpy(static_cast<void*>(&state), buffer, sizeof(State));
  const taut::Status status =
      estimator.restore(scene::condensed<float>, scene::prior<float>, state, limits()@cells@);
  is_started = status.ok();
  return answer(status);
}

const char* @name@_describe(@name@_status status) {
  return taut::describe(static_cast<taut::Code>(status.code));
}

#ifdef @NAME@_PLAN
@name@_status @name@_plan(const @name@_goal* given, int cable, int end) {
  is_planned = false;
  if (!is_started || given == nullptr || cable < 0 || cable >= layout().cables.size() || end < 0 || end > 1)
    return wrong_call();
  Planner::Goal goal;
  for (int i = 0; i < layout().segments; ++i) goal.target[i] = given->target[i];
  goal.most_force = given->most_force;
  goal.most_tension = given->most_tension;
  goal.most_stroke = given->most_stroke;
  goal.lock = given->lock != 0;
  goal.worth_a_move = given->worth_a_move;
  const taut::Status status = planner.begin(estimator, goal, cable, static_cast<std::size_t>(end));
  is_planned = status.ok();
  return answer(status);
}
int @name@_plan_on(int events) { return !is_planned || planner.step(events) ? 1 : 0; }
@name@_moves @name@_plan_moves(void) {
  if (!is_planned) return {0, {0, 0}, none};
  const auto& best = planner.best();
  return {best.count, {best.force[0], best.force[1]}, best.error};
}
float @name@_plan_force(int segment) {
  return is_planned && is_segment(segment) ? planner.best().tension[segment] : none;
}
#endif

}  // extern "C"
)";

}  // namespace

std::string c_header(const ExportedScene& scene, const std::string& name) {
  return filled_in(header_pattern, pattern_words(scene, name));
}

std::string c_source(const ExportedScene& scene, const std::string& name, const std::string& header) {
  const bool has_strokes = !scene.in_float.prior.stroke.empty();
  std::vector<Word> words = pattern_words(scene, name);
  words.push_back({"@file@", header});
  words.push_back({"@cells@", has_strokes ? ", scene::strokes<float>" : ""});
  words.push_back({"@limits@", has_strokes ? "  for (const auto& stroke : scene::strokes<float>)\n"
                                             "    if (stroke.sd > sd) sd = stroke.sd;\n"
                                           : ""});
  words.push_back(
      {"@strokes@", has_strokes ? "  for (int s = 0; s < scene::strokes<float>.size(); ++s) {\n"
                                  "    const auto& stroke = scene::strokes<float>[s];\n"
                                  "    const " +
                                      name +
                                      "_end& given = row->end[stroke.cable][stroke.end];\n"
                                      "    if (given.has_stroke != 0)\n"
                                      "      estimator.take_stroke(stroke.cable, "
                                      "static_cast<std::size_t>(stroke.end), given.stroke, taut::Gauge{s});\n"
                                      "  }\n"
                                : ""});
  return filled_in(source_pattern, words);
}

}  // namespace taut::host
