#include "large_displacements/result.hpp"

namespace large_displacements {

double friction_used(const Path& path, int cable, int joint) {
  const Cable& on = path.equilibrium.model().cables[cable];
  const double before = path.T(cable, on.before(joint)), behind = path.T(cable, on.behind(joint));
  const double rho = path.friction(cable, joint).rho, kappa = (1 - rho) / (1 + rho);
  if (!(before + behind > 0)) return 0;
  return (behind - before) / (before + behind) / kappa;
}

void write_header(std::ostream& out, const Model& model) {
  out << "time";
  for (const Cable& cable : model.cables) {
    const auto numbered = [&](const char* what, int count) {
      for (int i = 1; i <= count; ++i) out << "," << cable.name << "." << what << i;
    };
    numbered("T", cable.segments());
    numbered("slip", cable.joints());
    numbered("state", cable.joints());
    numbered("used", cable.joints());
    for (const int end : {0, 1})
      if (cable.jacked[end]) out << "," << cable.name << (end == 0 ? ".start.payout" : ".end.payout");
  }
  for (std::size_t s = 1; s <= model.struts.size(); ++s) out << ",strut" << s;
  const char* const axes[] = {".x", ".y", ".z"};
  for (const Node& node : model.nodes)
    for (int axis = 0; axis < model.dimension; ++axis) out << "," << node.name << axes[axis];
  out << ",stability\n";
}

void write_row(std::ostream& out, double time, const Path& path) {
  const Model& model = path.equilibrium.model();
  out.precision(13);
  out << time;
  for (int c = 0; c < static_cast<int>(model.cables.size()); ++c) {
    const Cable& cable = model.cables[c];
    for (int i = 0; i < cable.segments(); ++i) out << "," << path.T(c, i);
    for (int j = 0; j < cable.joints(); ++j) out << "," << path.slip(c, j);
    const char* const words[] = {"stick", "forward", "backward", "open"};
    for (int j = 0; j < cable.joints(); ++j) out << "," << words[static_cast<int>(path.mode(c, j))];
    for (int j = 0; j < cable.joints(); ++j) out << "," << friction_used(path, c, j);
    for (const int end : {0, 1})
      if (cable.jacked[end]) out << "," << path.extension(c, end);
  }
  for (int s = 0; s < static_cast<int>(model.struts.size()); ++s) out << "," << path.strut(s);
  for (int n = 0; n < static_cast<int>(model.nodes.size()); ++n)
    for (int axis = 0; axis < model.dimension; ++axis) out << "," << path.moved(n)[axis];
  out << "," << path.stability() << "\n";
}

}  // namespace large_displacements
