#include "host/memory_monitor.hpp"

template class monitor::Application<monitor::host::MemoryBoard, monitor::Settings,
                                    monitor::FromFlash<monitor::FlashScene>,
                                    monitor::CondensedAtStartUp<monitor::scenes::truss_string>>;
