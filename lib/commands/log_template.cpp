#include "lib/commands/log_template.hpp"

#include "lib/files/log_columns.hpp"
#include "lib/files/output_file.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/valid_scene.hpp"

namespace taut::host {
namespace {

const std::string measured = "; a measurement: simulate leaves it aside";

std::string unit_of(const InstrumentDescription& gauge) {
  return gauge.calibration.empty() ? "[N]"
                                   : "[as its gauge shows; the calibration in the scene makes N of it]";
}

std::string between(int from, int to, const SceneDescription& scene) {
  const auto name = [&](int node) { return quote(scene.nodes[static_cast<std::size_t>(node)].name); };
  return "from node " + name(from) + " to " + name(to);
}

std::string of_end(const LogColumn& column, const CableDescription& cable) {
  const std::string end = std::string(" ") + end_name(column.end) + " of cable " + quote(cable.name);
  if (column.quantity == Quantity::locked)
    return "[0 or 1]: 1 while a wedge holds the" + end + "; needed if it is locked off";
  if (column.quantity == Quantity::stroke) return "[m]: extension of the jack at the" + end + measured;
  const std::string unit = unit_of(cable.cell[column.end]);
  return cable.is_jacked(column.end)
             ? unit + ": force of the jack at the" + end + "; needed: without it the jack does not pull"
             : unit + ": load cell at the anchored" + end + measured;
}

std::string meaning(const LogColumn& column, const SceneDescription& scene) {
  switch (column.quantity) {
    case Quantity::time:
      return "[s]: needed; increases from row to row";
    case Quantity::factor:
      return "[1]: factor of this load; needed where the load acts: without it the factor is 0";
    case Quantity::segment_force: {
      const CableDescription& cable = scene.cables[column.index];
      const std::size_t next = (column.end + 1) % cable.path.size();
      return unit_of(cable.force[column.end]) + ": force of the segment " +
             between(cable.path[column.end], cable.path[next], scene) + measured;
    }
    case Quantity::strut_force: {
      const StrutDescription& strut = scene.struts[column.index];
      return unit_of(strut.gauge) + ": axial force of the strut " +
             between(strut.nodes[0], strut.nodes[1], scene) + ", tension positive" + measured;
    }
    case Quantity::force:
    case Quantity::locked:
    case Quantity::stroke:
      break;
  }
  return of_end(column, scene.cables[column.index]);
}

// Nobody locks off or extends an end without a jack.
bool is_possible(const LogColumn& column, const SceneDescription& scene) {
  const bool is_of_jack = column.quantity == Quantity::locked || column.quantity == Quantity::stroke;
  return !is_of_jack || scene.cables[column.index].is_jacked(column.end);
}

}  // namespace

std::string log_template(const SceneDescription& scene) {
  const LogColumns columns(scene);
  std::string remarks = "# Log for the scene " + quote(scene.name) +
                        ": one row a sample below the header.\n"
                        "# Remove the columns that you do not have. An empty field keeps the value before; "
                        "of a measurement it is none.\n"
                        "# Another unit may follow a name, as in time [min], force [kN], stroke [mm]; a time "
                        "may be a date such as 2026-03-01T10:00:00.\n"
                        "#\n";
  std::string header;
  for (const std::string& name : columns.names()) {
    const LogColumn& column = *columns.find(name);
    if (!is_possible(column, scene)) continue;
    remarks += "# " + name + " " + meaning(column, scene) + "\n";
    header += (header.empty() ? "" : ",") + name;
  }
  return remarks + header + "\n";
}

int write_log_template(const std::string& scene_file, const std::string& output) {
  const SceneDescription scene = read_scene_file(scene_file);
  require_valid(scene);
  keep_inputs(output, {scene_file});
  OutputFile file(output);
  file.write(log_template(scene));
  file.finish();
  return 0;
}

}  // namespace taut::host
