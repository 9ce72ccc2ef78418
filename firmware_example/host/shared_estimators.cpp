#include "host/shared_estimators.hpp"

template class taut::Tracker<monitor::host::InFlash::Model, monitor::host::InFlash::unknowns>;
template class taut::Tracker<monitor::host::AtStartUp::Model, monitor::host::AtStartUp::unknowns>;
template class taut::Estimator<monitor::host::InFlash::Model, monitor::host::InFlash::unknowns,
                               monitor::host::InFlash::reading_unknowns>;
template class taut::Estimator<monitor::host::AtStartUp::Model, monitor::host::AtStartUp::unknowns,
                               monitor::host::AtStartUp::reading_unknowns>;
