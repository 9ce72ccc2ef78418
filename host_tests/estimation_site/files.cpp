#include "estimation_site/files.hpp"

#include <algorithm>
#include <cmath>
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
  if (std::isnan(value)) return "";
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
struct CableParticulars {
  double E = 0;
  std::string cable, friction;
};
struct Particulars {
  std::vector<CableParticulars> cables;
  std::string loads, sensors;
};

std::string cable_text(const Cable& cable, const std::string& name, const CableParticulars& particulars) {
  return "{ \"name\": \"" + name + "\", \"path\": [" + joined(cable.path, node_name) +
         "], \"E\": " + number(particulars.E) + ", \"A\": " + number(cable.A) +
         ", \"alpha\": " + number(cable.alpha) +
         ", \"start\": " + (cable.two_jacks ? "\"jacked\"" : "\"anchored\"") + ", \"end\": \"jacked\"" +
         particulars.cable + ",\n\"friction\": { \"law\": " + (cable.capstan ? "\"capstan\"" : "\"point\"") +
         particulars.friction + " } }";
}

std::string scene_with(const Ground& ground, const Particulars& particulars) {
  std::string nodes, supports, cables;
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
  for (std::size_t c = 0; c < ground.cables.size(); ++c)
    cables += (c > 0 ? ",\n" : "") + cable_text(ground.cables[c], cable_name(c), particulars.cables[c]);
  text += "\"cables\": [ " + cables + " ]";
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
  if (!with_sun) return text;
  std::string warmed;
  for (std::size_t c = 0; c < ground.cables.size(); ++c)
    warmed += (c > 0 ? ", \"" : "\"") + cable_name(c) + "\": 1";
  return text + (text.empty() ? "" : ", ") + "\"sun\": { \"temperature\": { " + warmed + " } }";
}

std::string cell_text(const std::string& column, double full, const Readings& readings, const Case& tried,
                      bool is_jack, bool declared) {
  const auto& rules = tried.instruments;
  std::string text = "\"" + column + "\": { \"sd\": " + number(readings.sd);
  if (declared) {
    text += ", \"gain_sd\": " + number(is_jack ? rules.jack_gain_sd : rules.far_gain_sd) +
            ", \"zero_sd\": " + number(rules.zero_sd * full);
    if (rules.step > 0) text += ", \"resolution\": " + number(readings.step);
    if (rules.filtered) text += ", \"lag\": " + number(readings.lag);
    if (is_jack && tried.jacking.ram > 0)
      text += ", \"hysteresis\": { \"part\": " + number(tried.jacking.ram) +
              ", \"sd\": " + number(tried.jacking.ram_sd) + ", \"calibrated\": \"mean\" }";
  }
  return text + " }";
}

std::string sensors_text(const Jacked& jacked, const Case& tried, bool far, bool declared) {
  std::vector<std::string> cells;
  for (std::size_t c = 0; c < jacked.readings.size(); ++c) {
    const Cable& cable = jacked.ground.cables[c];
    const std::string start = cable_name(c) + ".start", end = cable_name(c) + ".end";
    const auto add = [&](const std::string& column, bool is_jack) {
      cells.push_back(cell_text(column, cable.full, jacked.readings[c], tried, is_jack, declared));
    };
    add(end, true);
    if (cable.two_jacks || far) add(start, cable.two_jacks);
    for (const std::string& jack : {start, end})
      if (declared && tried.logs_stroke && (jack == end || cable.two_jacks))
        cells.push_back("\"" + jack + ".stroke\": { \"sd\": 0.001, \"zero\": \"free\" }");
  }
  for (const GaugeReadings& gauge : jacked.gauges) {
    std::string text = "\"" + gauge.column + "\": { \"sd\": " + number(gauge.sd);
    if (declared)
      text += ", \"gain_sd\": " + number(tried.instruments.gauge_gain_sd) +
              ", \"zero_sd\": " + number(gauge.zero_sd);
    cells.push_back(text + " }");
  }
  return joined(cells, [](const std::string& cell) { return cell; });
}

/// Whether the log says in row `i` that an end is locked: so many rows late, and that it is no more at once,
/// or as soon as the pump runs again.
bool says_locked(const Jacked& jacked, std::size_t c, std::size_t end, std::size_t i, const Case& tried) {
  for (std::size_t back = 0; back <= std::min(tried.locks_late, i); ++back)
    if (!jacked.rows[i - back].pulls[c].locked[end]) return false;
  if (!tried.unlocks_early) return true;
  const auto level = [&](std::size_t row) { return jacked.rows[row].pulls[c].level; };
  return i == 0 || !(level(i) > level(i - 1));
}

}  // namespace

std::string cable_name(std::size_t cable) { return {static_cast<char>('C' + cable)}; }

std::string scene_text(const Jacked& jacked, const Case& tried, bool far, bool declared) {
  Particulars particulars;
  for (const Cable& cable : jacked.ground.cables) {
    CableParticulars own;
    own.E = cable.E;
    own.cable = ", \"seating\": " + number(cable.seating);
    own.friction = ", \"mu\": " + number(cable.mu) + ", \"mu_sd\": " + number(cable.mu_sd) +
                   ", \"shared\": " + (cable.shared ? "true" : "false");
    if (declared) {
      own.cable += ", \"E_sd\": " + number(tried.ground.E_sd) +
                   ", \"seating_sd\": " + number(tried.ground.seating_sd * cable.seating) +
                   ", \"temperature_sd\": " +
                   number(tried.jacking.year_rows > 0 ? tried.jacking.year_sd : tried.jacking.warming_locked);
      if (cable.shared) own.friction += ", \"scatter\": " + number(tried.ground.scatter);
    }
    particulars.cables.push_back(own);
  }
  particulars.loads = load_patterns(jacked.ground, tried.logs_dead, tried.logs_sun);
  if (!tried.silent) particulars.sensors = sensors_text(jacked, tried, far, declared);
  return scene_with(jacked.ground, particulars);
}

std::string log_text(const Jacked& jacked, const Case& tried, bool far) {
  const auto& cables = jacked.ground.cables;
  std::string text = "time";
  for (std::size_t c = 0; c < cables.size(); ++c) {
    const std::string name = cable_name(c);
    text += "," + name + ".end," + name + ".end.locked";
    if (far || cables[c].two_jacks) text += "," + name + ".start";
    if (cables[c].two_jacks) text += "," + name + ".start.locked";
  }
  if (tried.logs_dead) text += ",dead";
  if (tried.logs_sun) text += ",sun";
  if (tried.logs_stroke)
    for (std::size_t c = 0; c < cables.size(); ++c) {
      text += "," + cable_name(c) + ".end.stroke";
      if (cables[c].two_jacks) text += "," + cable_name(c) + ".start.stroke";
    }
  for (const GaugeReadings& gauge : jacked.gauges) text += ',' + gauge.column;
  text += '\n';
  for (std::size_t i = 0; i < jacked.rows.size(); ++i) {
    const Deed& deed = jacked.rows[i];
    text += rounded(deed.time, 3);
    for (std::size_t c = 0; c < cables.size(); ++c) {
      const auto locked = [&](std::size_t end) {
        return says_locked(jacked, c, end, i, tried) ? ",1" : ",0";
      };
      text += ',' + rounded(jacked.readings[c].end[i], 1) + locked(1);
      if (far || cables[c].two_jacks) text += ',' + rounded(jacked.readings[c].start[i], 1);
      if (cables[c].two_jacks) text += locked(0);
    }
    if (tried.logs_dead) text += ',' + number(deed.factor[dead]);
    if (tried.logs_sun) text += ',' + number(deed.logged_sun);
    if (tried.logs_stroke)
      for (std::size_t c = 0; c < cables.size(); ++c) {
        const auto& locked = deed.pulls[c].locked;
        const auto& stroke = jacked.readings[c].stroke;
        text += ',' + (locked[1] ? "" : rounded(stroke[1][i], 4));
        if (cables[c].two_jacks) text += ',' + (locked[0] ? "" : rounded(stroke[0][i], 4));
      }
    for (const GaugeReadings& gauge : jacked.gauges) text += ',' + rounded(gauge.force[i], 1);
    text += '\n';
  }
  return text;
}

std::string true_scene_text(const Jacked& jacked) {
  Particulars particulars;
  for (std::size_t c = 0; c < jacked.reality.size(); ++c) {
    const CableReality& reality = jacked.reality[c];
    particulars.cables.push_back({jacked.ground.cables[c].E * reality.stiffness,
                                  ", \"seating\": " + number(reality.seating),
                                  ", \"mu\": [" + joined(reality.mu, number) + "]"});
  }
  particulars.loads = load_patterns(jacked.ground, !jacked.ground.loaded.empty(), true);
  return scene_with(jacked.ground, particulars);
}

std::string true_log_text(const Jacked& jacked) {
  const auto& cables = jacked.ground.cables;
  const bool has_dead = !jacked.ground.loaded.empty();
  std::string text = "time";
  for (std::size_t c = 0; c < cables.size(); ++c) {
    const std::string name = cable_name(c);
    text += "," + name + ".end," + name + ".end.locked";
    if (cables[c].two_jacks) text += "," + name + ".start," + name + ".start.locked";
  }
  if (has_dead) text += ",dead";
  text += ",sun\n";
  for (const Deed& deed : jacked.rows) {
    text += number(deed.time);
    for (std::size_t c = 0; c < cables.size(); ++c) {
      const Pull& pull = deed.pulls[c];
      text += ',' + number(pull.force[1]) + (pull.is_held(1) ? ",1" : ",0");
      if (cables[c].two_jacks) text += ',' + number(pull.force[0]) + (pull.is_held(0) ? ",1" : ",0");
    }
    if (has_dead) text += ',' + number(deed.factor[dead]);
    text += ',' + number(deed.factor[sun]) + '\n';
  }
  return text;
}

std::string truth_text(const Jacked& jacked) {
  const auto& cables = jacked.ground.cables;
  std::string text = "time";
  for (std::size_t c = 0; c < cables.size(); ++c) {
    const std::string name = cable_name(c);
    text += "," + name + ".phase";
    for (int i = 1; i <= cables[c].segments(); ++i) text += "," + name + ".T" + std::to_string(i);
    text += "," + name + ".end.payout";
  }
  text += '\n';
  for (const Deed& deed : jacked.rows) {
    text += rounded(deed.time, 3);
    for (std::size_t c = 0; c < cables.size(); ++c) {
      text += std::string(",\"") + name_of(deed.pulls[c].phase) + '"';
      for (int i = 0; i < cables[c].segments(); ++i)
        text += ',' + number(deed.tension[static_cast<std::size_t>(cables[c].first_segment + i)]);
      text += ',' + number(deed.pulls[c].extension[1]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace estimation_site
