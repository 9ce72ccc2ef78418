// Numbering of the unknowns: every one has its own place, and connected ones lie close together.
#include "taut/stepwise/numbering.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>

#include "support/scenes.hpp"
#include "support/transform.hpp"

namespace numbering_test {
using namespace support;

namespace {

/// A row of `n` free nodes between two held ones, tied by struts.
void strut_chain(Plane& scene, int n) {
  scene = {};
  for (int i = 0; i < n; ++i)
    scene.add_node({1.0 * i, 0}, i % (n - 1) == 0 ? taut::held_xy : taut::held_none);
  for (int i = 0; i + 1 < n; ++i) scene.add_strut(i, i + 1, steel, 1e-3);
}

std::vector<int> shuffled(int n, std::uint64_t seed) {
  Random random(seed);
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(random.below(i + 1))]);
  return order;
}

template <class SceneType>
int band_of(const SceneType& scene) {
  const auto numbering = std::make_unique<taut::Numbering<SceneType>>();
  numbering->make(scene);
  return numbering->band();
}

Plane scene, other;

}  // namespace

TEST_CASE("a chain of struts has the bandwidth of two neighbouring nodes, whatever the order of its nodes") {
  strut_chain(scene, 20);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    permute_nodes(scene, other, shuffled(20, seed));
    CHECK(band_of(other) == 3);  // 2 x 2 displacements, first to last
  }
}

TEST_CASE("a cable over saddles on struts keeps its bandwidth when its nodes are shuffled") {
  rigid_saddles(scene, steel_cable(0.2), chain_points(8));
  const int band = band_of(scene);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    permute_nodes(scene, other, shuffled(9, seed));
    CHECK(band_of(other) == band);
  }
  CHECK(band == 7);  // two joints of 2 displacements and 2 forces each
}

TEST_CASE("every unknown has a place of its own and every place an unknown") {
  truss_string(scene, steel_cable(0.2), 8);
  const auto numbering = std::make_unique<taut::Numbering<Plane>>();
  numbering->make(scene);
  std::multiset<int> places;
  for (int node = 0; node < scene.nodes.size(); ++node)
    for (int axis = 0; axis < 2; ++axis) {
      const int place = numbering->displacement(node, axis);
      CHECK((place < 0) == scene.nodes[node].is_held(axis));
      if (place >= 0) places.insert(place);
    }
  for (int joint = 0; joint < scene.mu.size(); ++joint)
    for (int i = 0; i < 2; ++i) {
      places.insert(numbering->cable_point(joint, i));
      places.insert(numbering->internal_force(joint, i));
    }
  REQUIRE(static_cast<int>(places.size()) == numbering->count());
  int expected = 0;
  for (const int place : places) CHECK(place == expected++);
}

TEST_CASE("no two unknowns of one bar are further apart than the bandwidth") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    truss_string(other, steel_cable(0.2), 3 + random.below(6), Variation(random));
    permute_nodes(other, scene, shuffled(other.nodes.size(), seed));
    const auto numbering = std::make_unique<taut::Numbering<Plane>>();
    numbering->make(scene);
    for (const auto& strut : scene.struts)
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) {
          const int p = numbering->displacement(strut.nodes[0], a),
                    q = numbering->displacement(strut.nodes[1], b);
          if (p >= 0 && q >= 0) CHECK(std::abs(p - q) <= numbering->band());
        }
  }
}

TEST_CASE("parts of a structure that do not touch are all numbered") {
  scene = {};
  for (int i = 0; i < 6; ++i) scene.add_node({1.0 * i, 0});
  scene.add_strut(0, 3, steel, 1e-3);
  scene.add_strut(1, 4, steel, 1e-3);
  const auto numbering = std::make_unique<taut::Numbering<Plane>>();
  numbering->make(scene);
  CHECK(numbering->count() == 12);
  CHECK(numbering->band() == 3);
}

TEST_CASE("a substructure ties its nodes together like a bar") {
  scene = {};
  for (int i = 0; i < 3; ++i) scene.add_node({1.0 * i, 0});
  const int ends[] = {0, 2};
  const double stiffness[16] = {};
  scene.add_substructure(ends, 2, stiffness);
  const auto numbering = std::make_unique<taut::Numbering<Plane>>();
  numbering->make(scene);
  CHECK(std::abs(numbering->displacement(0, 0) - numbering->displacement(2, 0)) == 2);
  CHECK(numbering->band() == 3);
}

}  // namespace numbering_test
