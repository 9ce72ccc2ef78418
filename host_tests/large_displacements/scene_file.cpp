#include "large_displacements/scene_file.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace large_displacements {
namespace {

using Json = nlohmann::ordered_json;

Vector vector_of(const Json& numbers) {
  Vector found = Vector::Zero();
  for (std::size_t i = 0; i < numbers.size() && i < 3; ++i)
    found[static_cast<int>(i)] = numbers[i].get<double>();
  return found;
}
Json numbers_of(const Vector& vector, int dimension) {
  Json found = Json::array();
  for (int i = 0; i < dimension; ++i) found.push_back(vector[i]);
  return found;
}
std::vector<double> one_or_many(const Json& given, int count) {
  if (given.is_number()) return std::vector<double>(count, given.get<double>());
  const auto list = given.get<std::vector<double>>();
  if (static_cast<int>(list.size()) != count)
    throw std::runtime_error("a list has " + std::to_string(list.size()) + " numbers and not " +
                             std::to_string(count));
  return list;
}
Json many_or_one(const std::vector<double>& list) {
  for (const double number : list)
    if (number != list.front()) return list;
  return list.empty() ? 0.0 : list.front();
}

std::vector<int> nodes_of(const Json& names, const Model& model) {
  std::vector<int> found;
  for (const auto& name : names) found.push_back(model.node(name.get<std::string>()));
  return found;
}
Json names_of(const std::vector<int>& nodes, const Model& model) {
  Json found = Json::array();
  for (const int node : nodes) found.push_back(model.nodes[node].name);
  return found;
}

Cable cable_of(const Json& given, const Model& model) {
  Cable cable;
  cable.name = given.at("name");
  cable.path = nodes_of(given.at("path"), model);
  cable.E = given.at("E");
  cable.A = given.at("A");
  cable.closed = given.value("closed", false);
  cable.jacked = {given.value("start", "") == "jacked", given.value("end", "") == "jacked"};
  cable.alpha = given.value("alpha", 0.0);
  cable.seating = given.value("seating", 0.0);
  const Json friction = given.value("friction", Json::object());
  cable.law = friction.value("law", "point") == "capstan" ? Law::capstan : Law::point;
  cable.mu = one_or_many(friction.value("mu", Json(0.0)), cable.joints());
  cable.wobble = friction.value("wobble", 0.0);
  cable.prestrain = one_or_many(given.value("prestrain", Json(0.0)), cable.segments());
  return cable;
}

Beam beam_of(const Json& given, const Model& model) {
  Beam beam;
  beam.nodes = nodes_of(given.at("nodes"), model);
  beam.E = given.at("E");
  beam.A = given.at("A");
  if (model.dimension == 2) {
    beam.Iz = given.at("I");
  } else {
    beam.Iy = given.at("Iy");
    beam.Iz = given.at("Iz");
    beam.J = given.at("J");
    beam.G = given.value("G", 0.0);
    beam.up = vector_of(given.at("up"));
  }
  beam.hinges = nodes_of(given.value("hinges", Json::array()), model);
  return beam;
}

Load load_of(const std::string& name, const Json& given, const Model& model) {
  Load load;
  load.name = name;
  const Json forces = given.value("forces", Json::object());
  for (const auto& [node, force] : forces.items())
    load.forces.push_back({model.node(node), vector_of(force), Vector::Zero()});
  const Json temperatures = given.value("temperature", Json::object());
  for (const auto& [cable, kelvin] : temperatures.items())
    for (std::size_t c = 0; c < model.cables.size(); ++c)
      if (model.cables[c].name == cable) load.temperatures.push_back({static_cast<int>(c), kelvin});
  return load;
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found(1);
  for (const char c : line) {
    if (c == ',')
      found.emplace_back();
    else if (c != '\r' && c != ' ')
      found.back() += c;
  }
  return found;
}

Json json_of(const Beam& beam, const Model& model) {
  Json written{{"nodes", names_of(beam.nodes, model)}, {"E", beam.E}, {"A", beam.A}};
  if (model.dimension == 2) {
    written["I"] = beam.Iz;
  } else {
    written["Iy"] = beam.Iy;
    written["Iz"] = beam.Iz;
    written["J"] = beam.J;
    written["up"] = numbers_of(beam.up, 3);
  }
  if (!beam.hinges.empty()) written["hinges"] = names_of(beam.hinges, model);
  return written;
}
Json json_of(const Cable& cable, const Model& model) {
  Json written{{"name", cable.name}, {"path", names_of(cable.path, model)}, {"E", cable.E}, {"A", cable.A}};
  if (cable.closed) {
    written["closed"] = true;
  } else {
    written["start"] = cable.jacked[0] ? "jacked" : "anchored";
    written["end"] = cable.jacked[1] ? "jacked" : "anchored";
  }
  written["friction"] = {{"law", cable.law == Law::point ? "point" : "capstan"},
                         {"mu", many_or_one(cable.mu)}};
  if (cable.wobble != 0) written["friction"]["wobble"] = cable.wobble;
  written["prestrain"] = many_or_one(cable.prestrain);
  if (cable.alpha != 0) written["alpha"] = cable.alpha;
  if (cable.seating != 0) written["seating"] = cable.seating;
  return written;
}

}  // namespace

std::string file_text(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Model read_scene(const std::string& text) try {
  const Json scene = Json::parse(text, nullptr, true, true);
  Model model;
  model.name = scene.value("name", "");
  model.dimension = scene.at("dimension");
  const Json supports = scene.value("supports", Json::object());
  for (const auto& [name, at] : scene.at("nodes").items())
    model.add_node(name, vector_of(at), supports.value(name, ""));
  for (const auto& given : scene.value("struts", Json::array())) {
    const auto nodes = nodes_of(given.at("nodes"), model);
    model.struts.push_back({nodes.at(0), nodes.at(1), given.at("E"), given.at("A")});
  }
  for (const auto& given : scene.value("cables", Json::array()))
    model.cables.push_back(cable_of(given, model));
  for (const auto& given : scene.value("beams", Json::array())) model.beams.push_back(beam_of(given, model));
  for (const auto& given : scene.value("substructures", Json::array())) {
    Substructure body{given.value("name", ""), nodes_of(given.at("nodes"), model), {}};
    const auto rows = given.at("stiffness").get<std::vector<std::vector<double>>>();
    const auto size = static_cast<Eigen::Index>(rows.size());
    body.stiffness.resize(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index k = 0; k < size; ++k)
        body.stiffness(i, k) = rows[static_cast<std::size_t>(i)].at(static_cast<std::size_t>(k));
    model.substructures.push_back(body);
  }
  const Json loads = scene.value("loads", Json::object());
  for (const auto& [name, given] : loads.items()) model.loads.push_back(load_of(name, given, model));
  return model;
} catch (const nlohmann::json::exception& error) {
  throw std::runtime_error(std::string("scene: ") + error.what());
}

std::vector<Row> read_log(const std::string& text, const Model& model) {
  std::istringstream lines(text);
  std::string line;
  std::vector<std::string> header;
  std::vector<Row> rows;
  Row row;
  row.factors.assign(model.loads.size(), 0);
  row.jacks.resize(model.cables.size());
  const auto take = [&](const std::string& column, double value) {
    if (column == "time") row.time = value;
    for (std::size_t i = 0; i < model.loads.size(); ++i)
      if (column == model.loads[i].name) row.factors[i] = value;
    for (std::size_t c = 0; c < model.cables.size(); ++c)
      for (const int end : {0, 1}) {
        const std::string name = model.cables[c].name + (end == 0 ? ".start" : ".end");
        if (column == name) row.jacks[c][end].force = value;
        if (column == name + ".locked") row.jacks[c][end].locked = value != 0;
      }
  };
  while (std::getline(lines, line)) {
    const auto parts = fields(line);
    if (line.empty() || line[0] == '#' || (parts.size() == 1 && parts[0].empty())) continue;
    if (header.empty()) {
      header = parts;
      continue;
    }
    for (std::size_t i = 0; i < parts.size() && i < header.size(); ++i)
      if (!parts[i].empty()) take(header[i], std::stod(parts[i]));
    rows.push_back(row);
  }
  return rows;
}

std::string scene_text(const Model& model, const Target& target) {
  Json scene{{"taut", 1}, {"name", model.name}, {"dimension", model.dimension}};
  scene["nodes"] = Json::object();
  scene["supports"] = Json::object();
  for (const Node& node : model.nodes) {
    scene["nodes"][node.name] = numbers_of(node.at, model.dimension);
    std::string held;
    const bool turned = model.dimension == 3 && (node.held[3] || node.held[4] || node.held[5]);
    const char* const letters[] = {"x", "y", "z", "rx", "ry", model.dimension == 3 ? "rz" : "r"};
    for (int axis = 0; axis < 6; ++axis)
      if (node.held[axis]) held += (turned && !held.empty() ? " " : "") + std::string(letters[axis]);
    if (!held.empty()) scene["supports"][node.name] = held;
  }
  scene["struts"] = Json::array();
  for (const Strut& strut : model.struts)
    scene["struts"].push_back(
        {{"nodes", names_of({strut.a, strut.b}, model)}, {"E", strut.E}, {"A", strut.A}});
  if (!model.beams.empty()) scene["beams"] = Json::array();
  for (const Beam& beam : model.beams) scene["beams"].push_back(json_of(beam, model));
  scene["cables"] = Json::array();
  for (const Cable& cable : model.cables) scene["cables"].push_back(json_of(cable, model));
  for (const Substructure& body : model.substructures) {
    Json written{{"name", body.name}, {"nodes", names_of(body.nodes, model)}, {"stiffness", Json::array()}};
    for (Eigen::Index i = 0; i < body.stiffness.rows(); ++i) {
      Json numbers = Json::array();
      for (Eigen::Index k = 0; k < body.stiffness.cols(); ++k) numbers.push_back(body.stiffness(i, k));
      written["stiffness"].push_back(numbers);
    }
    scene["substructures"].push_back(written);
  }
  if (!model.loads.empty()) scene["loads"] = Json::object();
  for (const Load& load : model.loads) {
    Json& written = scene["loads"][load.name];
    written["forces"] = Json::object();
    for (const Load::At& given : load.forces)
      written["forces"][model.nodes[given.node].name] = numbers_of(given.force, model.dimension);
    for (const Load::Warming& warming : load.temperatures)
      written["temperature"][model.cables[warming.cable].name] = warming.kelvin;
  }
  if (target.given) {
    Json state{{"loads", Json::object()}, {"forces", Json::object()}};
    for (std::size_t i = 0; i < model.loads.size(); ++i)
      if (target.factors[i] != 0) state["loads"][model.loads[i].name] = target.factors[i];
    for (std::size_t c = 0; c < model.cables.size(); ++c)
      for (const int end : {0, 1})
        if (model.cables[c].jacked[end])
          state["forces"][model.cables[c].name + (end == 0 ? ".start" : ".end")] = target.forces[c][end];
    scene["second_order"] = {{"target", state}};
  }
  return scene.dump(1) + "\n";
}

std::string log_text(const Model& model, const std::vector<Row>& rows) {
  std::ostringstream text;
  text.precision(17);
  text << "time";
  for (const Load& load : model.loads) text << "," << load.name;
  const auto each_jack = [&](const auto& what) {
    for (std::size_t c = 0; c < model.cables.size(); ++c)
      for (const int end : {0, 1})
        if (model.cables[c].jacked[end]) what(c, end);
  };
  each_jack([&](std::size_t c, int end) {
    const std::string name = model.cables[c].name + (end == 0 ? ".start" : ".end");
    text << "," << name << "," << name << ".locked";
  });
  text << "\n";
  for (const Row& row : rows) {
    text << row.time;
    for (const double factor : row.factors) text << "," << factor;
    each_jack([&](std::size_t c, int end) {
      text << "," << row.jacks[c][end].force << "," << (row.jacks[c][end].locked ? 1 : 0);
    });
    text << "\n";
  }
  return text.str();
}

void write_scene(const Model& model, const Target& target, const std::string& path) {
  std::ofstream(path) << scene_text(model, target);
}
void write_log(const Model& model, const std::vector<Row>& rows, const std::string& path) {
  std::ofstream(path) << log_text(model, rows);
}

}  // namespace large_displacements
