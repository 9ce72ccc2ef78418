#include "estimation_site/files.hpp"

#include <cstdio>

namespace estimation_site {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
/// A reading with as many digits as anyone writes down.
std::string rounded(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}
std::string node_name(int i) { return "\"n" + std::to_string(i) + "\""; }

template <class Items, class Write>
std::string joined(const Items& items, const Write& write) {
  std::string text;
  for (const auto& item : items) {
    const std::string part = write(item);
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  }
  return text;
}

/// What differs between the scene of the drawings and the true one.
struct Particulars {
  std::string cable, friction, loads, sensors;
  double E = 0;
};

std::string scene_with(const Ground& ground, const Particulars& particulars) {
  std::string nodes, supports;
  for (std::size_t i = 0; i < ground.nodes.size(); ++i) {
    nodes += (i > 0 ? ", " : "") + node_name(static_cast<int>(i)) + ": [" + number(ground.nodes[i][0]) +
             ", " + number(ground.nodes[i][1]) + "]";
    if (ground.held[i] == taut::held_none) continue;
    supports += (supports.empty() ? "" : ", ") + node_name(static_cast<int>(i)) +
                (ground.held[i] == taut::held_xy ? ": \"xy\"" : ": \"y\"");
  }
  const std::string struts = joined(ground.struts, [&](const Bar& bar) {
    return "{ \"nodes\": [" + node_name(bar.from) + ", " + node_name(bar.to) +
           "], \"E\": " + number(ground.strut_E) + ", \"A\": " + number(bar.A) + " }";
  });
  std::string text = "{ \"taut\": 1, \"name\": \"site\", \"dimension\": 2,\n\"nodes\": { " + nodes +
                     " },\n\"supports\": { " + supports + " },\n";
  if (!struts.empty()) text += "\"struts\": [ " + struts + " ],\n";
  text += "\"cables\": [ { \"name\": \"C\", \"path\": [" + joined(ground.path, node_name) +
          "], \"E\": " + number(particulars.E) + ", \"A\": " + number(ground.A) +
          ", \"alpha\": " + number(ground.alpha) +
          ", \"start\": " + (ground.two_jacks ? "\"jacked\"" : "\"anchored\"") + ", \"end\": \"jacked\"" +
          particulars.cable +
          ",\n\"friction\": { \"law\": " + (ground.capstan ? "\"capstan\"" : "\"point\"") +
          particulars.friction + " } } ]";
  if (!particulars.loads.empty()) text += ",\n\"loads\": { " + particulars.loads + " }";
  if (!particulars.sensors.empty()) text += ",\n\"sensors\": { " + particulars.sensors + " }";
  return text + " }\n";
}

std::string load_patterns(const Ground& ground, bool with_dead, bool with_sun) {
  std::string text;
  if (with_dead)
    text = "\"dead\": { \"forces\": { " +
           joined(ground.loaded,
                  [&](int node) { return node_name(node) + ": [0, " + number(-ground.dead) + "]"; }) +
           " } }";
  if (with_sun) text += std::string(text.empty() ? "" : ", ") + "\"sun\": { \"temperature\": { \"C\": 1 } }";
  return text;
}

std::string cell_text(const char* column, const Jacked& jacked, const Case& tried, bool is_jack,
                      bool declared) {
  const auto& rules = tried.instruments;
  std::string text = std::string("\"") + column + "\": { \"sd\": " + number(jacked.readings.sd);
  if (declared) {
    text += ", \"gain_sd\": " + number(is_jack ? rules.jack_gain_sd : rules.far_gain_sd) +
            ", \"zero_sd\": " + number(rules.zero_sd * jacked.ground.full);
    if (rules.step > 0) text += ", \"resolution\": " + number(jacked.readings.step);
    if (is_jack && tried.jacking.ram > 0)
      text += ", \"hysteresis\": { \"part\": " + number(tried.jacking.ram) +
              ", \"sd\": " + number(tried.jacking.ram_sd) + ", \"calibrated\": \"mean\" }";
  }
  return text + " }";
}

std::string sensors_text(const Jacked& jacked, const Case& tried, bool far, bool declared) {
  std::vector<std::string> cells{cell_text("C.end", jacked, tried, true, declared)};
  if (jacked.ground.two_jacks) cells.push_back(cell_text("C.start", jacked, tried, true, declared));
  if (far) cells.push_back(cell_text("C.start", jacked, tried, false, declared));
  if (declared && tried.logs_stroke)
    cells.push_back("\"C.end.stroke\": { \"sd\": 0.001, \"zero\": \"free\" }");
  return joined(cells, [](const std::string& cell) { return cell; });
}

}  // namespace

std::string scene_text(const Jacked& jacked, const Case& tried, bool far, bool declared) {
  const Ground& ground = jacked.ground;
  Particulars particulars;
  particulars.E = ground.E;
  particulars.cable = ", \"seating\": " + number(ground.seating);
  particulars.friction = ", \"mu\": " + number(ground.mu) + ", \"mu_sd\": " + number(ground.mu_sd) +
                         ", \"shared\": " + (ground.shared ? "true" : "false");
  if (declared) {
    particulars.cable +=
        ", \"E_sd\": " + number(tried.ground.E_sd) +
        ", \"seating_sd\": " + number(tried.ground.seating_sd * ground.seating) + ", \"temperature_sd\": " +
        number(tried.jacking.year_rows > 0 ? tried.jacking.year_sd : tried.jacking.warming_locked);
    if (ground.shared) particulars.friction += ", \"scatter\": " + number(tried.ground.scatter);
  }
  particulars.loads = load_patterns(ground, tried.logs_dead, tried.logs_sun);
  if (!tried.silent) particulars.sensors = sensors_text(jacked, tried, far, declared);
  return scene_with(ground, particulars);
}

std::string log_text(const Jacked& jacked, const Case& tried, bool far) {
  const bool has_start = far || jacked.ground.two_jacks;
  std::string text = "time,C.end,C.end.locked";
  if (has_start) text += ",C.start";
  if (jacked.ground.two_jacks) text += ",C.start.locked";
  if (tried.logs_dead) text += ",dead";
  if (tried.logs_sun) text += ",sun";
  if (tried.logs_stroke) text += ",C.end.stroke";
  text += '\n';
  for (std::size_t i = 0; i < jacked.rows.size(); ++i) {
    const Deed& deed = jacked.rows[i];
    text += rounded(deed.time, 3) + ',' + rounded(jacked.readings.end[i], 1) + (deed.locked[1] ? ",1" : ",0");
    if (has_start) text += ',' + rounded(jacked.readings.start[i], 1);
    if (jacked.ground.two_jacks) text += deed.locked[0] ? ",1" : ",0";
    if (tried.logs_dead) text += ',' + number(deed.factor[dead]);
    if (tried.logs_sun) text += ',' + number(deed.logged_sun);
    if (tried.logs_stroke) text += ',' + (deed.locked[1] ? "" : rounded(jacked.readings.stroke[i], 4));
    text += '\n';
  }
  return text;
}

std::string true_scene_text(const Jacked& jacked) {
  Particulars particulars;
  particulars.E = jacked.ground.E * jacked.reality.stiffness;
  particulars.cable = ", \"seating\": " + number(jacked.reality.seating);
  particulars.friction = ", \"mu\": [" + joined(jacked.reality.mu, number) + "]";
  particulars.loads = load_patterns(jacked.ground, !jacked.ground.loaded.empty(), true);
  return scene_with(jacked.ground, particulars);
}

std::string true_log_text(const Jacked& jacked) {
  const bool two = jacked.ground.two_jacks, has_dead = !jacked.ground.loaded.empty();
  std::string text = "time,C.end,C.end.locked";
  if (two) text += ",C.start,C.start.locked";
  if (has_dead) text += ",dead";
  text += ",sun\n";
  for (const Deed& deed : jacked.rows) {
    text += number(deed.time) + ',' + number(deed.force[1]) + (deed.locked[1] ? ",1" : ",0");
    if (two) text += ',' + number(deed.force[0]) + (deed.locked[0] ? ",1" : ",0");
    if (has_dead) text += ',' + number(deed.factor[dead]);
    text += ',' + number(deed.factor[sun]) + '\n';
  }
  return text;
}

std::string truth_text(const Jacked& jacked) {
  std::string text = "time,phase";
  for (int i = 1; i <= jacked.ground.segments(); ++i) text += ",C.T" + std::to_string(i);
  text += ",C.end.payout\n";
  for (const Deed& deed : jacked.rows) {
    text += rounded(deed.time, 3) + ",\"" + name_of(deed.phase) + '"';
    for (const double T : deed.tension) text += ',' + number(T);
    text += ',' + number(deed.extension[1]) + '\n';
  }
  return text;
}

}  // namespace estimation_site
