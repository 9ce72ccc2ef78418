// The estimators of the two scenes of the monitor, compiled once for all programs of the host.
#pragma once

#include "monitor/scenes.hpp"

namespace monitor::host {

using InFlash = FromFlash<FlashScene>;
using AtStartUp = CondensedAtStartUp<scenes::truss_string>;

}  // namespace monitor::host

extern template class taut::Tracker<monitor::host::InFlash::Model, monitor::host::InFlash::unknowns>;
extern template class taut::Tracker<monitor::host::AtStartUp::Model, monitor::host::AtStartUp::unknowns>;
extern template class taut::Estimator<monitor::host::InFlash::Model, monitor::host::InFlash::unknowns,
                                      monitor::host::InFlash::reading_unknowns>;
extern template class taut::Estimator<monitor::host::AtStartUp::Model, monitor::host::AtStartUp::unknowns,
                                      monitor::host::AtStartUp::reading_unknowns>;
