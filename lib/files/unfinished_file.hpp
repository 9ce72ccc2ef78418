// A file that must not stay behind when a signal ends the program.
#pragma once

#include <cstdio>

namespace taut::host {

/// So many files may be unfinished at once.
constexpr int most_unfinished = 8;

/// Opens a new file for writing, as with `wbx`, and has it removed if SIGINT, SIGTERM, SIGHUP or SIGPIPE ends
/// the program before forget_unfinished(). Not from several threads at once. The path must stay where it is
/// until then; null on failure, with errno (EMFILE: most_unfinished are open).
std::FILE* open_unfinished(const char* path);

/// The file that was opened with this very pointer is complete, or removed.
void forget_unfinished(const char* path);

}  // namespace taut::host
