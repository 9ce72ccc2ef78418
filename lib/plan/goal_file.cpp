#include "lib/plan/goal_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/files/file_text.hpp"
#include "lib/files/json_field.hpp"
#include "lib/files/plausible_scene.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/condensed_arrays.hpp"

namespace taut::host {
namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20;
constexpr const char* stroke_key = "stroke";

const Keys goal_keys = {
    {"taut", true, "1, the version of the format"},
    {"loads", false, ""},
    {"target", true, "an object that gives cables the forces [N] that their segments are to have"},
    {"limits", false, ""},
    {"stages", false, ""},
    {"lock", false, ""},
};

class GoalReader {
 public:
  GoalReader(const Field& root, const SceneDescription& scene) : root_(root), scene_(scene) {}

  PlanGoal read(const std::string& file) {
    goal_.file = file;
    root_.require_head("goal", "{ \"taut\": 1, \"target\": { ... } }", goal_keys);
    require_jacks();
    goal_.factor.assign(scene_.loads.size(), 0);
    if (const auto loads = root_.find("loads")) read_loads(*loads);
    read_targets(root_.at("target"));
    goal_.most_segment.assign(goal_.target.size(), no_limit);
    goal_.most_force.assign(scene_.cables.size(), {no_limit, no_limit});
    goal_.most_stroke = goal_.most_force;
    if (const auto limits = root_.find("limits")) read_limits(*limits);
    if (const auto stages = root_.find("stages")) read_stages(*stages);
    if (const auto lock = root_.find("lock")) goal_.lock = lock->boolean("true or false");
    return std::move(goal_);
  }

 private:
  void require_jacks() const {
    for (const CableDescription& cable : scene_.cables)
      if (cable.is_jacked(0) || cable.is_jacked(1)) return;
    root_.at("target").refuse("the scene " + quote(scene_.name) + " has no jack that could pull",
                              "write \"end\": \"jacked\" for a cable in " + scene_.file);
  }

  void read_loads(const Field& field) {
    std::vector<std::string> known;
    for (const LoadDescription& load : scene_.loads) known.push_back(load.name);
    for (const auto& [name, factor] : field.members("an object that gives load patterns their factors")) {
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end())
        factor.refuse("there is no load pattern " + quote(name),
                      suggestion(name, known, "the load patterns are"));
      goal_.factor[static_cast<std::size_t>(found - known.begin())] = possible(
          factor, factor.number("a factor as a number"), static_cast<std::size_t>(found - known.begin()));
    }
  }

  // As in a log: more than the cables can carry is a mistake of the unit.
  double possible(const Field& field, double factor, std::size_t load) const {
    const std::vector<double> most = condense(scene_, ScalarType::float64).most_factor;
    if (load < most.size() && std::fabs(factor) > most[load])
      field.refuse("the factor " + plain(factor) + " is more than the cables can carry",
                   "write one of a size below " + plain(most[load]) + ": is the unit wrong?");
    return factor;
  }

  // Of a cable, and no more than it can carry.
  double carried(const Field& field, const std::string& what, std::size_t c) const {
    const double found = positive(field, what, "[N]"), most = most_force_of(scene_.cables[c]);
    if (scene_.plausible && found > most)
      field.refuse(what + " of " + plain(found) + " N is more than the cable can carry",
                   "write one in N, below " + plain(most) + remedy_if_meant);
    return found;
  }
  // A force that a plan can be measured by.
  static double positive(const Field& field, const std::string& what, const std::string& unit) {
    const double found = field.amount(what + " " + unit + " as a number");
    if (!(found > 0)) field.refuse(what + " of " + plain(found), "write one greater than zero " + unit);
    return found;
  }

  std::size_t cable(const Field& field, const std::string& name) const {
    std::vector<std::string> known;
    for (const CableDescription& each : scene_.cables) known.push_back(each.name);
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
      field.refuse("there is no cable " + quote(name), suggestion(name, known, "the cables are"));
    return static_cast<std::size_t>(found - known.begin());
  }

  void read_targets(const Field& field) {
    goal_.target.assign(scene_.first_segment(scene_.cables.size()), 0);
    for (const auto& [name, forces] :
         field.members("an object that gives cables the forces [N] of their segments")) {
      const std::size_t c = cable(forces, name), first = scene_.first_segment(c);
      const std::size_t count = scene_.cables[c].segments();
      const std::string wanted = "one force [N], or a list of " + counted(count, "force") +
                                 ": one a segment, null where it does not matter";
      if (!forces.is_array()) {
        if (!forces.is_number()) forces.number(wanted);
        const double force = carried(forces, "a target", c);
        std::fill_n(goal_.target.begin() + static_cast<std::ptrdiff_t>(first), count, force);
        continue;
      }
      const auto items = forces.elements(wanted);
      if (items.size() != count)
        forces.refuse("the list has " + counted(items.size(), "number") + " for " + counted(count, "segment"),
                      "write " + wanted);
      for (std::size_t i = 0; i < count; ++i)
        if (!items[i].is_null()) goal_.target[first + i] = carried(items[i], "a target", c);
    }
    double largest_strain = 0;
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t i = 0; i < scene_.cables[c].segments(); ++i)
        largest_strain = std::max(largest_strain, goal_.target[scene_.first_segment(c) + i] /
                                                      (scene_.cables[c].E * scene_.cables[c].A));
    if (largest_strain == 0) field.refuse("no segment has a target", "give at least one segment a force [N]");
    if (scene_.plausible && largest_strain < least_plausible_strain)
      field.refuse("no target strains its cable by as much as 1e-5",
                   std::string("write forces in N") + remedy_if_meant);
  }

  void read_limits(const Field& field) {
    std::vector<std::string> known = {stroke_key};
    for (const CableDescription& each : scene_.cables) known.push_back(each.name);
    for (const std::string& name : jacks()) known.push_back(name);
    for (const auto& [name, limit] : field.members("an object of largest forces [N] and strokes [m]")) {
      const bool is_cable = std::find(known.begin() + 1, known.end(), name) != known.end();
      if (name == stroke_key && !(is_cable && limit.is_number())) {
        read_strokes(limit);
      } else if (const auto found = jack(name); found.first < scene_.cables.size()) {
        goal_.most_force[found.first][found.second] = carried(limit, "a jack force", found.first);
      } else {
        if (!is_cable)
          limit.refuse("there is no cable and no jack " + quote(name),
                       suggestion(name, known, "limits can be those of"));
        const std::size_t c = cable(limit, name);
        std::fill_n(goal_.most_segment.begin() + static_cast<std::ptrdiff_t>(scene_.first_segment(c)),
                    scene_.cables[c].segments(), carried(limit, "a segment force", c));
      }
    }
  }
  void read_strokes(const Field& field) {
    for (const auto& [name, limit] : field.members("an object that gives jacks their largest strokes [m]")) {
      const auto found = jack(name);
      if (found.first == scene_.cables.size())
        limit.refuse("there is no jack " + quote(name), suggestion(name, jacks(), "the jacks are"));
      goal_.most_stroke[found.first][found.second] = positive(limit, "a stroke", "[m]");
    }
  }
  std::vector<std::string> jacks() const {
    std::vector<std::string> names;
    for (const CableDescription& each : scene_.cables)
      for (std::size_t end = 0; end < 2; ++end)
        if (each.is_jacked(end)) names.push_back(each.name + "." + end_name(end));
    return names;
  }
  // The jack whose column of the log has this name; no cable at all if there is none.
  std::pair<std::size_t, std::size_t> jack(const std::string& name) const {
    for (std::size_t c = 0; c < scene_.cables.size(); ++c)
      for (std::size_t end = 0; end < 2; ++end)
        if (scene_.cables[c].is_jacked(end) && name == scene_.cables[c].name + "." + end_name(end))
          return {c, end};
    return {scene_.cables.size(), 0};
  }

  void read_stages(const Field& field) {
    const std::string wanted = "a whole number from 1 to " + std::to_string(most_stages);
    const double found = field.number(wanted);
    if (!(found >= 1 && found <= most_stages && std::floor(found) == found))
      field.refuse(plain(found) + " moves of jacks", "write " + wanted);
    goal_.stages = static_cast<int>(found);
    goal_.has_stages = true;
  }

  Field root_;
  const SceneDescription& scene_;
  PlanGoal goal_;
};

}  // namespace

PlanGoal read_goal_file(const std::string& path, const SceneDescription& scene) {
  const JsonValue tree = parse_json(read_text(path, largest_file, "goal file"), path);
  return GoalReader(Field(tree, "", path), scene).read(path);
}

}  // namespace taut::host
