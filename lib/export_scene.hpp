// `taut export`: the condensed scene as a C++ header with constants for flash.
#pragma once

#include <string>

namespace taut::host {

struct ExportOptions {
  std::string scene;
  std::string output;  ///< empty: standard output
};

/// Writes the header and returns the exit status: 0, or 1 if the structure cannot be condensed, with the
/// reason on standard error and nothing written. Throws InputError for unusable input.
int export_scene(const ExportOptions& options);

}  // namespace taut::host
