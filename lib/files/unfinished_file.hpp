// A file that must not stay behind when a signal ends the program.
#pragma once

#include <cstdio>

namespace taut::host {

/// Opens a new file for writing, as with `wbx`, and has it removed if SIGINT, SIGTERM, SIGHUP or SIGPIPE ends
/// the program before forget_unfinished(). One file at a time. The path must stay where it is until then;
/// null on failure, with errno.
std::FILE* open_unfinished(const char* path);

/// The file is complete, or removed.
void forget_unfinished();

}  // namespace taut::host
