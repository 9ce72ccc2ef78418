// A small finite element program for plane roofs: what a designer's own program hands over for a
// substructure.
//
//     condense_roof SCENE THRUST -o OUT.json
//
// Takes the beams of a plane scene out and puts their stiffness in, condensed to the nodes that struts,
// cables, loads and supports name, with the geometric stiffness of a THRUST [N] in all of them. Shares no
// code with taut.
#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::ordered_json;
using Matrix = Eigen::MatrixXd;
using Element = Eigen::Matrix<double, 6, 6>;

Json read_scene(const char* path) {
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return Json::parse(text, nullptr, true, true);
}

// Euler-Bernoulli in the plane: u, v, rotation of both ends, turned by the direction of the member.
struct Member {
  Element elastic = Element::Zero(), geometric = Element::Zero();

  Member(double dx, double dy, double E, double A, double I, double thrust) {
    const double L = std::hypot(dx, dy), c = dx / L, s = dy / L;
    Element turn = Element::Zero(), k = Element::Zero(), g = Element::Zero();
    for (const int end : {0, 3}) {
      turn.block<2, 2>(end, end) << c, s, -s, c;
      turn(end + 2, end + 2) = 1;
    }
    k(0, 0) = k(3, 3) = E * A / L;
    k(0, 3) = k(3, 0) = -E * A / L;
    const std::array<int, 4> bending{1, 2, 4, 5};
    Eigen::Matrix4d stiff, geometry;
    stiff << 12, 6 * L, -12, 6 * L, 6 * L, 4 * L * L, -6 * L, 2 * L * L, -12, -6 * L, 12, -6 * L, 6 * L,
        2 * L * L, -6 * L, 4 * L * L;
    geometry << 36, 3 * L, -36, 3 * L, 3 * L, 4 * L * L, -3 * L, -L * L, -36, -3 * L, 36, -3 * L, 3 * L,
        -L * L, -3 * L, 4 * L * L;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const int row = bending[static_cast<std::size_t>(i)], column = bending[static_cast<std::size_t>(j)];
        k(row, column) = E * I / (L * L * L) * stiff(i, j);
        g(row, column) = -thrust / (30 * L) * geometry(i, j);
      }
    elastic = turn.transpose() * k * turn;
    geometric = turn.transpose() * g * turn;
  }
};

std::set<std::string> named_nodes(const Json& scene) {
  std::set<std::string> named;
  for (const auto& strut : scene.at("struts"))
    for (const auto& node : strut.at("nodes")) named.insert(node);
  for (const auto& cable : scene.at("cables"))
    for (const auto& node : cable.at("path")) named.insert(node);
  for (const auto& [name, load] : scene.at("loads").items())
    for (const auto& [node, force] : load.at("forces").items()) named.insert(node);
  for (const auto& [node, held] : scene.at("supports").items()) named.insert(node);
  return named;
}

// The roof in its own numbering: displacements of the nodes that stay first.
class Roof {
 public:
  Roof(const Json& scene, double thrust) {
    const std::set<std::string> named = named_nodes(scene);
    std::vector<std::string> inner;
    for (const auto& beam : scene.at("beams"))
      for (const std::string node : beam.at("nodes")) {
        auto& list = named.count(node) > 0 ? kept : inner;
        if (number_.emplace(node, 0).second) list.push_back(node);
      }
    int next = 0;
    for (const auto* list : {&kept, &inner})
      for (const std::string& node : *list) number_[node] = next++;
    const int nodes = next, all = 3 * nodes, stay = 2 * static_cast<int>(kept.size());
    Matrix K = Matrix::Zero(all, all), G = K;
    const auto place = [&](const std::string& node, int axis) {
      const int n = number_.at(node);
      if (2 * n < stay) return axis < 2 ? 2 * n + axis : stay + n;
      return 3 * n + axis;
    };
    for (const auto& beam : scene.at("beams")) {
      const auto& chain = beam.at("nodes");
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const auto &from = scene.at("nodes").at(chain[i]), &to = scene.at("nodes").at(chain[i + 1]);
        const auto step = [&](int axis) { return to[axis].get<double>() - from[axis].get<double>(); };
        const Member member(step(0), step(1), beam.at("E"), beam.at("A"), beam.at("I"), thrust);
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) {
            const auto end = [&](int index) -> std::string {
              return chain[i + static_cast<std::size_t>(index / 3)];
            };
            const int row = place(end(r), r % 3), column = place(end(c), c % 3);
            K(row, column) += member.elastic(r, c);
            G(row, column) += member.geometric(r, c);
          }
      }
    }
    // What is left out follows as the stiffness has it; to first order in the thrust so does its geometric
    // part.
    const int rest = all - stay;
    Matrix follow(all, stay);
    follow << Matrix::Identity(stay, stay),
        -K.bottomRightCorner(rest, rest).ldlt().solve(K.bottomLeftCorner(rest, stay));
    stiffness = follow.transpose() * K * follow;
    geometric_stiffness = follow.transpose() * G * follow;
  }

  std::vector<std::string> kept;
  Matrix stiffness, geometric_stiffness;

 private:
  std::map<std::string, int> number_;
};

// Half of both sides, so that rounding leaves it symmetric.
std::string text_of(const Matrix& matrix) {
  const double least = 1e-9 * matrix.cwiseAbs().maxCoeff();
  std::string text = "[";
  for (int i = 0; i < matrix.rows(); ++i) {
    text += i == 0 ? "[" : ",\n        [";
    for (int j = 0; j < matrix.cols(); ++j) {
      const double value = (matrix(i, j) + matrix(j, i)) / 2;
      std::array<char, 40> digits{};
      std::snprintf(digits.data(), digits.size(), "%.11g", std::abs(value) < least ? 0.0 : value);
      text += (j == 0 ? "" : ", ") + std::string(digits.data());
    }
    text += "]";
  }
  return text + "]";
}

// On one line, with blanks as in scenes that are written by hand.
std::string spaced(const Json& value) {
  if (!value.is_structured()) return value.dump();
  const bool is_object = value.is_object(),
             is_flat = value.is_array() && !(value.size() > 0 && value[0].is_object());
  std::string text;
  for (const auto& [key, item] : value.items())
    text += (text.empty() ? "" : ", ") + (is_object ? Json(key).dump() + ": " : "") + spaced(item);
  if (is_flat) return "[" + text + "]";
  return (is_object ? "{ " : "[ ") + text + (is_object ? " }" : " ]");
}

// A list or an object with an entry a line.
std::string lines(const Json& value) {
  std::string text;
  for (const auto& [key, item] : value.items())
    text += std::string(text.empty() ? "" : ",") + "\n    " +
            (value.is_object() ? Json(key).dump() + ": " : "") + spaced(item);
  return (value.is_object() ? "{" : "[") + text + (value.is_object() ? " }" : " ]");
}

std::string condensed(Json scene, double thrust) {
  const Roof roof(scene, thrust);
  const std::set<std::string> named = named_nodes(scene);
  Json nodes = Json::object();
  for (const auto& [name, at] : scene.at("nodes").items())
    if (named.count(name) > 0) nodes[name] = at;
  scene["nodes"] = nodes;
  scene["name"] = std::string(scene.at("name")) + ", the roof condensed";
  std::string text =
      "// The roof of another scene as a finite element program hands it over: written by condense_roof.\n{";
  for (const auto& [key, value] : scene.items()) {
    text += std::string(key == "taut" ? "" : ",") + "\n  \"";
    if (key != "beams") {
      text += key + "\": " + (value.is_structured() && key != "second_order" ? lines(value) : spaced(value));
      continue;
    }
    text += "substructures\": [ { \"name\": \"roof\",\n      \"nodes\": " + spaced(Json(roof.kept)) +
            ",\n      \"stiffness\": [\n        " + text_of(roof.stiffness).substr(1) +
            ",\n      \"geometric_stiffness\": [\n        " + text_of(roof.geometric_stiffness).substr(1) +
            " } ]";
  }
  return text + "\n}\n";
}

}  // namespace

int main(int count, char** words) try {
  if (count != 5 || std::string(words[3]) != "-o")
    throw std::runtime_error("usage: condense_roof SCENE THRUST -o OUT.json");
  const std::string text = condensed(read_scene(words[1]), std::strtod(words[2], nullptr));
  std::ofstream(words[4]) << text;
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
