#include "large_displacements/scenes.hpp"

#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "support/random.hpp"

namespace large_displacements {
namespace {

const double pi = std::acos(-1.0);
constexpr double steel = 2.1e11, strand = 1.6e11;  // [N/m2]

Row held(const Model& model, const Target& target, double time, double load, double force, bool locked) {
  Row row;
  row.time = time;
  row.factors.assign(model.loads.size(), 0);
  if (!row.factors.empty()) row.factors[0] = load * target.factors[0];
  row.jacks.resize(model.cables.size());
  for (std::size_t c = 0; c < model.cables.size(); ++c)
    for (const int end : {0, 1}) row.jacks[c][end] = {force * target.forces[c][end], locked};
  return row;
}

Cable cable_along(std::vector<int> path, double A, double mu, Law law, bool closed) {
  Cable cable;
  cable.name = "C";
  cable.path = std::move(path);
  cable.E = strand;
  cable.A = A;
  cable.closed = closed;
  cable.law = law;
  cable.mu.assign(cable.joints(), mu);
  cable.prestrain.assign(cable.segments(), 0);
  return cable;
}

std::string short_number(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

}  // namespace

std::vector<Row> ramp_and_lock(const Model& model, const Target& target, double over) {
  std::vector<Row> rows;
  double time = 0;
  const auto leg = [&](int count, double load_from, double load_to, double force_from, double force_to) {
    for (int i = 1; i <= count; ++i) {
      const double part = double(i) / count;
      rows.push_back(held(model, target, time += 60, load_from + part * (load_to - load_from),
                          force_from + part * (force_to - force_from), false));
    }
  };
  leg(40, 0, 1, 0, 1);
  leg(5, 1, 1, 1, 1 + over);
  leg(8, 1, 1, 1 + over, 1);
  rows.push_back(held(model, target, time += 60, 1, 1, true));
  for (int i = 1; model.loads.size() > 1 && i <= 6; ++i) {
    rows.push_back(held(model, target, time += 60, 1, 1, true));
    rows.back().factors[1] = i <= 4 ? i / 4.0 : 1 - (i - 4) / 4.0;
  }
  return rows;
}

Jacking beam_string(const BeamString& given) {
  Jacking made;
  Model& model = made.model;
  const double span = given.span, sag = given.sag * span, spacing = span / (given.struts + 1);
  const auto parabola = [&](double x) { return 4 * x * (span - x) / (span * span); };
  const auto roof_at = [&](double x) { return Vector(x, given.rise * span * parabola(x), 0); };
  const auto below = [&](int i) {
    const double x = i * spacing;
    return Vector(x, i == 0 || i == given.struts + 1 ? 0 : -sag * parabola(x), 0);
  };

  // Where struts meet the roof.
  std::vector<double> heads;
  for (int i = 1; i <= given.struts; ++i) {
    const Vector foot = below(i);
    if (given.kind == Struts::v) {
      heads.push_back(foot.x() - spacing / 2);
      if (i == given.struts) heads.push_back(foot.x() + spacing / 2);
      continue;
    }
    double x = foot.x();
    if (given.kind == Struts::radial || given.kind == Struts::fixed) {
      const Vector up =
          ((below(i - 1) - foot).normalized() + (below(i + 1) - foot).normalized()).normalized();
      for (int k = 0; k < 50; ++k) x = foot.x() + up.x() / up.y() * (roof_at(x).y() - foot.y());
    }
    heads.push_back(x);
  }
  std::vector<int> roof{model.add_node("r0", roof_at(0), "xy")};
  for (const double x : heads) roof.push_back(model.add_node("r" + std::to_string(roof.size()), roof_at(x)));
  roof.push_back(model.add_node("r" + std::to_string(roof.size()), roof_at(span), "y"));
  std::vector<int> cable{roof.front()};
  for (int i = 1; i <= given.struts; ++i) {
    cable.push_back(model.add_node("c" + std::to_string(i), below(i)));
    if (given.kind == Struts::fixed) {
      Beam strut;
      strut.nodes = {roof[i], cable.back()};
      strut.E = steel;
      strut.A = 6e-3;
      strut.Iz = 3e-5;
      model.beams.push_back(strut);
      continue;
    }
    model.struts.push_back({cable.back(), roof[i], steel, 6e-3});
    if (given.kind == Struts::v) model.struts.push_back({cable.back(), roof[i + 1], steel, 6e-3});
  }
  cable.push_back(roof.back());

  const double dead = 12e3, live = 5e3;  // [N/m]
  const double force = dead * span * span / (8 * (sag + given.rise * span));
  Beam beam;
  beam.nodes = roof;
  beam.E = steel;
  beam.A = 0.025 * span / 80;
  const double depth = span / given.slenderness;
  beam.Iz = beam.A * depth * depth / 5.5;
  model.beams.push_back(beam);
  model.cables.push_back(cable_along(cable, force / 5e8, given.mu, given.law, false));
  model.cables[0].jacked[1] = true;
  model.cables[0].seating = 0.004;

  for (const auto& [name, load] : {std::pair{"dead", dead}, {"live", live}}) {
    model.loads.emplace_back();
    model.loads.back().name = name;
    for (std::size_t i = 1; i + 1 < roof.size(); ++i) {
      const double width = (model.nodes[roof[i + 1]].at.x() - model.nodes[roof[i - 1]].at.x()) / 2;
      model.loads.back().forces.push_back({roof[i], Vector(0, -load * width, 0), Vector::Zero()});
    }
  }
  const char* const kinds[] = {"vertical", "radial", "v", "fixed"};
  model.name = "beam-string-" + short_number(span) + "-" + std::to_string(given.struts) + "-" +
               (given.slenderness == 120 ? "" : "d" + short_number(given.slenderness) + "-") +
               (given.rise > 0 ? "arched-" : "") + kinds[static_cast<int>(given.kind)] + "-" +
               short_number(given.mu);
  made.target = {true, {1, 0}, {{0, force}}};
  made.rows = ramp_and_lock(model, made.target, 0.05);
  return made;
}

Jacking dome_hoop(const DomeHoop& given) {
  Jacking made;
  Model& model = made.model;
  model.dimension = 3;
  const double radius = 30, height = 4, outer = 38;
  const auto around = [&](double place, double R, double z) {
    const double angle = 2 * pi * place / given.nodes;
    return Vector(R * std::cos(angle), R * std::sin(angle), z);
  };
  std::vector<int> hoop;
  model.loads.emplace_back();
  model.loads[0].name = "dead";
  for (int i = 0; i < given.nodes; ++i) {
    const std::string number = std::to_string(i);
    hoop.push_back(model.add_node("h" + number, around(i, radius, -height)));
    const int top = model.add_node("t" + number, around(i, radius, 0), "xy");
    model.substructures.push_back({"roof" + number, {top}, Vector(0, 0, 2e7).asDiagonal()});
    model.struts.push_back({hoop.back(), top, steel, 5e-3});
    for (int rod = 0; rod < given.rods; ++rod) {
      const double aside = given.rods == 1 ? 0 : rod - 0.5;
      const int support =
          model.add_node("s" + number + (rod == 0 ? "a" : "b"), around(i + aside, outer, 0), "xyz");
      model.struts.push_back({hoop.back(), support, steel, 2e-3});
    }
    model.loads[0].forces.push_back({hoop.back(), Vector(0, 0, -2e4), Vector::Zero()});
  }
  if (given.jacked) {
    // The jack stands at a node of its own, 1 m from the first one on the last chord, and holds on to it.
    const Vector first = model.nodes[hoop.front()].at, last = model.nodes[hoop.back()].at;
    const int end = model.add_node("jack", first + (last - first).normalized());
    model.struts.push_back({hoop.front(), end, steel, 1e-2});
    model.substructures.push_back({"chair", {end}, Vector(1e5, 1e5, 1e5).asDiagonal()});
    hoop.push_back(end);
  }
  const double force = 1.5e6;
  model.cables.push_back(cable_along(hoop, force / 5e8, given.mu, Law::point, !given.jacked));
  model.cables[0].jacked[1] = given.jacked;
  if (!given.jacked) model.cables[0].prestrain.assign(given.nodes, 4e-3);
  model.name = "dome-hoop-" + std::to_string(given.rods) + (given.jacked ? "-jacked-" : "-closed-") +
               short_number(given.mu);
  made.target = {true, {1}, {{0, given.jacked ? force : 0}}};
  made.rows = ramp_and_lock(model, made.target, 0.05);
  if (!given.jacked) {
    // Nothing to jack: a load on one half, up and down.
    Load half{"half", {}, {}};
    for (int i = 0; i < given.nodes / 2; ++i)
      half.forces.push_back({hoop[i], Vector(0, 0, -8e4), Vector::Zero()});
    model.loads.push_back(half);
    made.target.factors = {1, 0};
    made.rows = ramp_and_lock(model, made.target, 0);
  }
  return made;
}

Jacking random_jacking(std::uint64_t seed) {
  support::Random random(seed);
  Jacking made;
  std::string kind;
  const double mu = 0.03 * std::pow(10, random.between(0, 1));
  if (random.below(4) > 0) {
    const char* const kinds[] = {"vertical", "radial", "v", "fixed"};
    BeamString given;
    given.kind = static_cast<Struts>(random.below(4));
    given.span = random.between(40, 140);
    given.struts = 3 + random.below(10);
    given.mu = mu;
    // A vertical strut needs friction for its lean to the bisector.
    given.sag = given.kind == Struts::vertical ? std::min(1.0 / 12, mu / 4.5) * random.between(0.6, 1)
                                               : random.between(1.0 / 20, 1.0 / 8);
    if (given.kind != Struts::vertical && random.coin()) given.rise = random.between(0, 0.08);
    given.law = random.below(3) == 0 ? Law::capstan : Law::point;
    made = beam_string(given);
    kind = kinds[static_cast<int>(given.kind)];
  } else {
    const int nodes = 6 + random.below(15), rods = 1 + random.below(2);
    const bool jacked = random.coin();
    made = dome_hoop({nodes, rods, mu, jacked});
    kind = "hoop-" + std::to_string(rods) + (jacked ? "-jacked" : "-closed");
  }
  Model& model = made.model;
  for (Load& load : model.loads)
    for (Load::At& at : load.forces) at.force *= random.between(0.7, 1.3);
  for (Cable& cable : model.cables) {
    for (double& each : cable.mu) each *= random.between(0.8, 1.2);
    std::vector<Vector> moved;
    for (int j = 0; j < cable.joints(); ++j) {
      const Vector at = model.nodes[cable.joint_node(j)].at;
      const double near = (at - model.nodes[cable.on_path(cable.closed ? j - 1 : j)].at).norm();
      Vector to = at;
      for (int axis = 0; axis < model.dimension; ++axis) to[axis] += random.between(-0.01, 0.01) * near;
      moved.push_back(to);
    }
    for (int j = 0; j < cable.joints(); ++j)
      model.nodes[cable.joint_node(j)].at = moved[static_cast<std::size_t>(j)];
  }
  model.name = "random-" + std::to_string(seed) + "-" + kind;
  return made;
}

namespace {

void each_scene(const std::function<void(const std::function<Jacking()>&)>& see) {
  const std::pair<double, int> spans[] = {{60, 7}, {80, 9}, {120, 11}};
  const auto beam_strings = [&](double slenderness, double span, int struts) {
    for (const double mu : {.03, .05, .1, .2, .3})
      for (const Struts kind : {Struts::radial, Struts::vertical, Struts::v, Struts::fixed}) {
        BeamString given;
        given.slenderness = slenderness;
        given.span = span;
        given.struts = struts;
        given.mu = mu;
        given.kind = kind;
        // A vertical strut needs friction for its lean to the bisector: less where the cable is flatter.
        if (kind == Struts::vertical) given.sag = std::min(1.0 / 12, mu / 4.5);
        see([given] { return beam_string(given); });
        // Under an arch the struts at the ends are longer, and lean by less.
        given.rise = 0.05;
        if (kind == Struts::radial) see([given] { return beam_string(given); });
      }
  };
  for (const double slenderness : {120, 60, 40})
    for (const auto& [span, struts] : spans) beam_strings(slenderness, span, struts);
  for (const double mu : {.05, .1, .3})
    for (const int rods : {1, 2})
      for (const bool jacked : {true, false}) see([=] { return dome_hoop({16, rods, mu, jacked}); });
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  each_scene([&](const auto& make) { names.push_back(make().model.name); });
  return names;
}
Jacking scene_by_name(const std::string& name) {
  const std::string random = "random-";
  if (name.compare(0, random.size(), random) == 0)
    return random_jacking(std::stoull(name.substr(random.size())));
  Jacking found;
  each_scene([&](const auto& make) {
    if (!found.model.name.empty()) return;
    Jacking made = make();
    if (made.model.name == name) found = std::move(made);
  });
  if (found.model.name.empty()) throw std::out_of_range("no scene is called " + name);
  return found;
}

}  // namespace large_displacements
