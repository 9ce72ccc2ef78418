// Scene files: what the reader makes of them, and what reaches the core.
#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

#include "lib/files/input_error.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/files/status_text.hpp"
#include "lib/kinds/capacities.hpp"
#include "lib/kinds/scene_build.hpp"
#include "lib/kinds/valid_scene.hpp"

using namespace taut;
using namespace taut::host;

namespace {

SceneDescription every_key() { return read_scene_file(TAUT_FILES "/every_key.json"); }

template <class Items>
std::vector<std::string> names(const Items& items) {
  std::vector<std::string> all;
  for (const auto& item : items) all.push_back(item.name);
  return all;
}

std::string refusal(const std::string& text) {
  try {
    require_valid(read_scene(text, "f"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string chosen(const SceneDescription& scene) {
  return with_capacity(scene, [](auto kind) { return decltype(kind)::Capacity::name; });
}

// Every class is chosen for what just fits, and the next one for a node or a load pattern more.
template <class Cap>
void check_chosen(CapacityList<Cap>) {}
template <class Cap, class Next, class... Larger>
void check_chosen(CapacityList<Cap, Next, Larger...>) {
  SceneDescription scene;
  scene.nodes.resize(Cap::nodes);
  scene.loads.resize(Cap::loads);
  CHECK(chosen(scene) == Cap::name);
  scene.nodes.emplace_back();
  CHECK(chosen(scene) == Next::name);
  scene.nodes.pop_back();
  scene.loads.emplace_back();
  CHECK(chosen(scene) == Next::name);
  check_chosen(CapacityList<Next, Larger...>{});
}

}  // namespace

TEST_CASE("a scene with every key is accepted and valid") { CHECK_NOTHROW(require_valid(every_key())); }

TEST_CASE("nodes, cables and loads keep the order of the file") {
  const SceneDescription scene = every_key();
  CHECK(names(scene.nodes) ==
        std::vector<std::string>{"w", "mid/1", "mid~2", "e", "top1", "top2", "h1", "h2", "h3"});
  CHECK(names(scene.cables) == std::vector<std::string>{"main", "hoop", "plain"});
  CHECK(names(scene.loads) == std::vector<std::string>{"snow", "heat", "both"});
  CHECK(scene.loads[0].forces[0].node == 2);
  CHECK(scene.loads[1].temperatures[0].cable == 2);
}

TEST_CASE("a scene is checked for what is surely a mistake unless it says not to") {
  CHECK_FALSE(every_key().plausible);
  CHECK(read_scene_file(TAUT_FILES "/one_jack.json").plausible);
}

TEST_CASE("every value of a cable arrives") {
  const CableDescription cable = every_key().cables[0];
  CHECK(cable.path == std::vector<int>{0, 1, 2, 3});
  CHECK(cable.E == 1.6e11);
  CHECK(cable.A == 1.0e-3);
  CHECK(cable.is_jacked(0));
  CHECK_FALSE(cable.is_jacked(1));
  CHECK(cable.law == FrictionLaw::capstan);
  CHECK(cable.mu == std::vector<double>{0.05, 0.06});
  CHECK(cable.prestrain == std::vector<double>{0.0001, 0.0002, 0});
  CHECK(cable.wobble == 0.005);
  CHECK(cable.mu_sd == 0.02);
  CHECK(cable.alpha == 1.2e-5);
  CHECK(cable.seating == 0.006);
  CHECK(cable.cell[0].sd.value_or(0) == 100.5);
  CHECK(cable.cell[1].sd.value_or(0) == 200);
}

TEST_CASE("one number for mu and prestrain goes to every joint and segment of a closed cable") {
  const CableDescription hoop = every_key().cables[1];
  CHECK(hoop.mu == std::vector<double>(3, 0.1));
  CHECK(hoop.prestrain == std::vector<double>(3, 0.001));
  CHECK(hoop.shared_mu);
  CHECK_FALSE(hoop.is_jacked(0));
}

TEST_CASE("without a friction law a joint is a point contact without friction") {
  const SceneDescription scene = read_scene(R"({ "taut": 1, "name": "", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0], "c": [2, 1] },
    "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 1, "A": 1, "start": "jacked", "end": "jacked" } ] })",
                                            "f");
  CHECK(scene.cables[0].law == FrictionLaw::point);
  CHECK(scene.cables[0].mu == std::vector<double>{0});
  CHECK(scene.cables[0].prestrain == std::vector<double>{0, 0});
}

TEST_CASE("everything but the head and the nodes may be absent") {
  const SceneDescription scene =
      read_scene(R"({ "taut": 1, "name": "n", "dimension": 2, "nodes": { "a": [0, 0] } })", "f");
  CHECK(scene.nodes.size() == 1);
  CHECK(scene.nodes[0].held == held_none);
  CHECK(scene.cables.empty());
}

TEST_CASE("letters of a support may come in any order") {
  const SceneDescription scene = every_key();
  CHECK(scene.nodes[3].held == held_xyz);
  CHECK(scene.nodes[2].held == held_y);
  CHECK(scene.nodes[5].held == (held_xyz | held_rx | held_ry | held_rz));
}

TEST_CASE("every value of a beam arrives, and in the core as members with the hinges at their ends") {
  const SceneDescription in_space = every_key();
  REQUIRE(in_space.beams.size() == 1);
  const auto space = make_valid_scene<3, Large>(in_space);
  REQUIRE(space->beams.size() == 1);
  CHECK(space->beams[0].nodes == std::array<int, 2>{4, 5});
  CHECK(space->beams[0].hinged == std::array<bool, 2>{true, false});
  const auto& girder = space->beams[0].section;
  CHECK(girder.E == 2.1e11);
  CHECK(girder.A == 0.02);
  CHECK(girder.Iy == 4e-4);
  CHECK(girder.Iz == 1e-4);
  CHECK(girder.J == 9e-6);
  CHECK(girder.G == 8e10);
  CHECK(girder.up == std::array<double, 3>{0.5, 0.25, 1});

  const SceneDescription in_plane = read_scene(R"({ "taut": 1, "name": "", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0], "c": [2, 1], "d": [2, 2] }, "supports": { "a": "r yx", "d": "xy" },
    "beams": [ { "nodes": ["a", "b", "c"], "E": 3, "A": 2, "I": 1, "hinges": ["b"] },
               { "nodes": ["d", "c"], "E": 6, "A": 5, "I": 4 } ] })",
                                               "f");
  CHECK(in_plane.nodes[0].held == (held_xy | held_r));
  const auto plane = make_valid_scene<2, Large>(in_plane);
  REQUIRE(plane->beams.size() == 3);
  CHECK(plane->beams[0].hinged == std::array<bool, 2>{false, true});
  CHECK(plane->beams[1].nodes == std::array<int, 2>{1, 2});
  CHECK(plane->beams[1].hinged == std::array<bool, 2>{true, false});
  CHECK(plane->beams[1].section.E == 3);
  CHECK(plane->beams[1].section.A == 2);
  CHECK(plane->beams[1].section.I == 1);
  CHECK(plane->beams[2].nodes == std::array<int, 2>{3, 2});
  CHECK(plane->beams[2].section.I == 4);
}

TEST_CASE("in space a beam has the shear modulus of steel and up along z unless it says otherwise") {
  const SceneDescription scene = read_scene(R"({ "taut": 1, "name": "", "dimension": 3,
    "nodes": { "a": [0, 0, 0], "b": [1, 0, 0] }, "supports": { "a": "xyzrxryrz" },
    "beams": [ { "nodes": ["a", "b"], "E": 2.6e11, "A": 2, "Iy": 1, "Iz": 1, "J": 1 } ] })",
                                            "f");
  CHECK(scene.nodes[0].held == (held_xyz | held_rx | held_ry | held_rz));
  CHECK(scene.beams[0].G == doctest::Approx(1e11).epsilon(1e-15));
  CHECK(scene.beams[0].up == std::array<double, 3>{0, 0, 1});
}

TEST_CASE("beams fill a capacity member by member") {
  SceneDescription scene;
  scene.file = "big.json";
  scene.beams.resize(2);
  for (BeamDescription& beam : scene.beams) beam.nodes.resize(514);
  CHECK_THROWS_WITH(require_valid(scene),
                    "big.json: /beams: the scene has 1026 beam members; this program holds at most 1024");
}

TEST_CASE("a byte order mark before the scene does not count") {
  CHECK_NOTHROW(read_scene(
      "\xEF\xBB\xBF{ \"taut\": 1, \"name\": \"n\", \"dimension\": 2, \"nodes\": { \"a\": [0, 0] } }", "f"));
}

TEST_CASE("places of names with slashes and tildes are valid JSON pointers") {
  const std::string head = R"({ "taut": 1, "name": "n", "dimension": 2, "nodes": )";
  CHECK(refusal(head + R"({ "a/b": [1] } })").rfind("f: /nodes/a~1b: ", 0) == 0);
  CHECK(refusal(head + R"({ "a~b": [1] } })").rfind("f: /nodes/a~0b: ", 0) == 0);
}

TEST_CASE("the core scene holds everything in the order of the file") {
  const SceneDescription described = every_key();
  const auto scene = make_valid_scene<3, Large>(described);
  CHECK(scene->nodes.size() == 9);
  CHECK(scene->nodes[4].at == std::array<double, 3>{4, 0, 2});
  CHECK(scene->struts[1].nodes == std::array<int, 2>{2, 5});
  CHECK(scene->cables.size() == 3);
  CHECK(scene->cables[1].closed);
  CHECK(scene->cables[2].first_segment == 6);
  CHECK(scene->prestrain[1] == 0.0002);
  CHECK(scene->mu[1] == 0.06);
  CHECK(scene->mu[4] == 0.1);
  CHECK(scene->substructures.size() == 2);
  CHECK(scene->substructure_entries.size() == 9 + 36);
  CHECK(scene->loads == 3);
  CHECK(scene->forces[2].load == 2);
  CHECK(scene->temperatures[2].cable == 1);
}

TEST_CASE("the smallest capacity that holds the scene is chosen") { check_chosen(Capacities{}); }

TEST_CASE("a scene beyond the largest capacity is refused with both numbers") {
  SceneDescription scene;
  scene.file = "big.json";
  scene.struts.resize(2049);
  CHECK_THROWS_WITH(require_valid(scene),
                    "big.json: /struts: the scene has 2049 struts; this program holds at most 2048");
}

TEST_CASE("a failure of a run names the joint, its cable and its node") {
  const SceneDescription scene = every_key();
  CHECK(failure_text(Status::along(Code::state_iterations, Place::joint, 0, 1), scene).english() ==
        "joint 2 of cable \"main\" at node \"mid~2\": jammed: the joint states do not settle; "
        "try taut simulate --method stepwise --substeps 100, or stay below this load");
  CHECK(failure_text(Status::at(Code::mechanism, Place::node, 1), scene).english() ==
        "node \"mid/1\": mechanism: nothing holds this node; add a strut, a support or a substructure that "
        "holds it");
}

TEST_CASE("every key of an instrument arrives") {
  const SceneDescription scene = read_scene(R"({ "taut": 1, "name": "", "dimension": 2,
    "nodes": { "a": [0, 0], "b": [1, 0], "c": [2, 1] },
    "struts": [ { "nodes": ["a", "b"], "E": 1, "A": 1 }, { "nodes": ["b", "c"], "E": 1, "A": 1 } ],
    "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": 1, "A": 1, "start": "jacked", "end": "jacked",
                  "E_sd": 0.02, "seating_sd": 0.001, "temperature_sd": 3,
                  "friction": { "law": "point", "mu": 0.1, "scatter": 0.2, "drift": 0.01 } } ],
    "sensors": {
      "C.start": { "exact": true },
      "C.end": { "sd": 200, "gain_sd": 0.01, "zero_sd": 500, "resolution": 1000, "lag": 0.5,
                 "hysteresis": { "part": 0.03, "sd": 0.01, "calibrated": "up" },
                 "calibration": [[0, 100], [10, 300e3], [40, 1200e3]] },
      "C.end.stroke": { "sd": 0.002, "zero": "start", "resolution": 0.001 },
      "C.start.stroke": {},
      "C.T2": { "sd": 5000, "gain_sd": 0.02 },
      "strut2": { "sd": 3000, "zero_sd": 0 } } })",
                                            "f");
  const CableDescription& cable = scene.cables[0];
  CHECK(cable.E_sd == 0.02);
  CHECK(cable.seating_sd.value_or(0) == 0.001);
  CHECK(cable.temperature_sd == 3);
  CHECK(cable.scatter == 0.2);
  CHECK(cable.drift == 0.01);
  CHECK(cable.cell[0].exact);
  const InstrumentDescription& cell = cable.cell[1];
  CHECK_FALSE(cell.exact);
  CHECK(cell.sd.value_or(0) == 200);
  CHECK(cell.gain_sd.value_or(0) == 0.01);
  CHECK(cell.zero_sd.value_or(0) == 500);
  CHECK(cell.resolution == 1000);
  CHECK(cell.lag == 0.5);
  CHECK(cell.part == 0.03);
  CHECK(cell.part_sd == 0.01);
  CHECK(cell.right_while_it_pulls);
  CHECK(cell.force_of(25) == 750e3);
  CHECK(cell.force_of(50) == 1500e3);
  CHECK(cable.stroke[1].sd.value_or(0) == 0.002);
  CHECK_FALSE(cable.stroke[1].has_free_zero);
  CHECK(cable.stroke[1].resolution == 0.001);
  CHECK(cable.stroke[0].has_free_zero);
  CHECK_FALSE(cable.force[0].is_given);
  CHECK(cable.force[1].sd.value_or(0) == 5000);
  CHECK(cable.force[1].gain_sd.value_or(0) == 0.02);
  CHECK_FALSE(cable.force[1].zero_sd.has_value());
  CHECK_FALSE(scene.struts[0].gauge.is_given);
  CHECK(scene.struts[1].gauge.sd.value_or(0) == 3000);
  CHECK(scene.struts[1].gauge.zero_sd.value_or(1) == 0);
}
