// Whole structures, and the files that carry them.
#include "large_displacements/scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "large_displacements/comparison.hpp"
#include "large_displacements/result.hpp"

namespace scenes_test {
using namespace large_displacements;

namespace {

/// The plane scene in the plane of x and z, held across it.
Model upright(const Model& plane) {
  const auto turned = [](const Vector& v) { return Vector(v.x(), -v.z(), v.y()); };
  Model model = plane;
  model.dimension = 3;
  for (Node& node : model.nodes) {
    node.at = turned(node.at);
    const auto held = node.held;
    node.held = {held[0], true, held[1], true, held[5], true};
  }
  for (Beam& beam : model.beams) {
    beam.Iy = beam.J = beam.Iz;
    beam.up = turned(Vector::UnitZ());
  }
  for (Load& load : model.loads)
    for (Load::At& given : load.forces) given.force = turned(given.force);
  return model;
}

/// Equilibrium, stability and the cones of friction, with one row's states.
void check(const Path& path) {
  const Model& model = path.equilibrium.model();
  CHECK(path.equilibrium.imbalance(path.state, path.inputs) < 1e-8);
  CHECK(path.stability() > 0);
  for (int c = 0; c < static_cast<int>(model.cables.size()); ++c)
    for (int j = 0; j < model.cables[c].joints(); ++j) {
      CAPTURE(j);
      const double used = friction_used(path, c, j);
      CHECK(std::fabs(used) < 1 + 1e-6);
      if (path.mode(c, j) == Mode::forward) CHECK(std::fabs(used - 1) < 1e-6);
      if (path.mode(c, j) == Mode::backward) CHECK(std::fabs(used + 1) < 1e-6);
    }
}

/// Horizontal force of cable and roof together across a cut at x: none, for the roller gives none.
double force_across(const Path& path, double x) {
  const Model& model = path.equilibrium.model();
  double sum = 0;
  const Cable& cable = model.cables[0];
  for (int i = 0; i < cable.segments(); ++i) {
    const Vector a = path.equilibrium.position(path.state, cable.path[i]);
    const Vector b = path.equilibrium.position(path.state, cable.path[i + 1]);
    if (a.x() < x && x <= b.x()) sum += path.T(0, i) * (b - a).normalized().x();
  }
  const int last = static_cast<int>(model.beams.size()) - 1;  // after the struts
  const Beam& roof = model.beams[last];
  for (std::size_t i = 0; i + 1 < roof.nodes.size(); ++i) {
    const Vector a = path.equilibrium.position(path.state, roof.nodes[i]);
    const Vector b = path.equilibrium.position(path.state, roof.nodes[i + 1]);
    if (a.x() < x && x <= b.x()) sum += path.equilibrium.beam_axial(path.state, last, static_cast<int>(i));
  }
  return sum;
}

}  // namespace

TEST_CASE("every scene and its log is read as it was written") {
  for (const std::string& name : scene_names()) {
    CAPTURE(name);
    const Jacking made = scene_by_name(name);
    const std::string text = scene_text(made.model, made.target);
    const Model read = read_scene(text);
    CHECK(scene_text(read, made.target) == text);
    const std::string log = log_text(made.model, made.rows);
    CHECK(log_text(read, read_log(log, read)) == log);
  }
}

TEST_CASE(
    "beam strings and hoops: equilibrium and friction in every row, ramp, release, lock-off and live load") {
  for (const char* name :
       {"beam-string-60-7-v-0.1", "beam-string-60-7-fixed-0.05", "beam-string-60-7-radial-0.3",
        "dome-hoop-1-jacked-0.1", "dome-hoop-2-closed-0.05"}) {
    CAPTURE(name);
    const Jacking made = scene_by_name(name);
    Path path(made.model);
    REQUIRE(path.started);
    for (const Row& row : made.rows) {
      CAPTURE(row.time);
      REQUIRE(path.advance(row));
      check(path);
    }
  }
}

TEST_CASE("a self-anchored cable presses its roof together by as much as it pulls") {
  const Jacking made = scene_by_name("beam-string-60-7-fixed-0.1");
  Path path(made.model);
  for (std::size_t row = 0; row < 40; ++row) REQUIRE(path.advance(made.rows[row]));
  // The roof hardly bends: its shear has next to no horizontal part.
  CHECK(std::fabs(force_across(path, 1)) < 2e-3 * made.target.forces[0][1]);
}

TEST_CASE(
    "a pinned strut of a beam string runs away below the target where friction is small, later with more") {
  double before = 0;
  for (const char* mu : {"0.03", "0.05", "0.1"}) {
    CAPTURE(mu);
    const Jacking made = scene_by_name(std::string("beam-string-60-7-radial-") + mu);
    Path path(made.model);
    Reached reached;
    reached.whole = true;
    for (std::size_t row = 0; row < made.rows.size() && reached; ++row)
      reached = path.advance(made.rows[row]);
    CHECK_FALSE(reached);
    // Where it does, a joint has used its friction up.
    double most = 0;
    for (int j = 0; j < 7; ++j) most = std::max(most, std::fabs(friction_used(path, 0, j)));
    CHECK(std::fabs(most - 1) < 1e-4);
    CHECK(path.inputs.ends[0][1].value > before);
    before = path.inputs.ends[0][1].value;
    // It is no matter of how the path is divided.
    Path finer(made.model, 31);
    reached.whole = true;
    for (std::size_t row = 0; row < made.rows.size() && reached; ++row)
      reached = finer.advance(made.rows[row]);
    CHECK(std::fabs(finer.inputs.ends[0][1].value / before - 1) < 1e-5);
  }
}

TEST_CASE("a plane beam string that stands upright in space has the same forces") {
  const Jacking made = scene_by_name("beam-string-60-7-fixed-0.1");
  Path plane(made.model), space(upright(made.model));
  for (std::size_t row = 0; row < 45; row += 4) {
    CAPTURE(row);
    REQUIRE(plane.advance(made.rows[row]));
    REQUIRE(space.advance(made.rows[row]));
    for (int i = 0; i < 8; ++i)
      CHECK(std::fabs(plane.T(0, i) - space.T(0, i)) < 1e-7 * made.target.forces[0][1]);
    CHECK(std::fabs(plane.extension(0, 1) - space.extension(0, 1)) < 1e-9);
  }
}

TEST_CASE("finer beams and finer steps give the same forces") {
  const Jacking made = scene_by_name("beam-string-60-7-v-0.1");
  Model fine = made.model;
  fine.pieces = 3;
  Path path(made.model, 32), finer(fine, 64);
  for (std::size_t row = 2; row < 54; row += 6) {
    CAPTURE(row);
    REQUIRE(path.advance(made.rows[row]));
    REQUIRE(finer.advance(made.rows[row]));
    for (int i = 0; i < 8; ++i)
      CHECK(std::fabs(path.T(0, i) - finer.T(0, i)) < 5e-5 * made.target.forces[0][1]);
  }
}

TEST_CASE("the result has a number or a word for every column") {
  const Jacking made = scene_by_name("dome-hoop-2-jacked-0.1");
  std::ostringstream header, row;
  Path path(made.model);
  REQUIRE(path.advance(made.rows[0]));
  write_header(header, made.model);
  write_row(row, made.rows[0].time, path);
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  CHECK(commas(header.str()) == commas(row.str()));
  CHECK(header.str().rfind("time,C.T1,", 0) == 0);
}

TEST_CASE("a comparison finds the largest difference of each kind, of the largest value") {
  const std::string reference = "time,C.T1,C.T2,C.state1,strut1\n1,100,200,stick,-5\n2,150,400,stick,-10\n";
  const std::string result = "time,C.T1,C.T2,C.sd1,strut1\n1,100,200,7,-5\n2,148,400,7,-9\n3,1,1,1,1\n";
  const auto found = compare(result, reference);
  REQUIRE(found.size() == 2);
  CHECK(found[0].kind == "segments");
  CHECK(found[0].column == "C.T1");
  CHECK(found[0].time == 2);
  CHECK(found[0].part == doctest::Approx(2.0 / 400));
  CHECK(found[1].kind == "struts");
  CHECK(found[1].part == doctest::Approx(.1));
}

}  // namespace scenes_test
