// `taut export`: condensed scenes as a C++ header with constants for flash.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace taut::host {

struct ExportOptions {
  std::vector<std::string> scenes;    ///< at least one
  std::string output;                 ///< empty: standard output
  std::optional<std::string> c_name;  ///< of a C interface beside it
};

/// Writes the header and returns the exit status: 0, or 1 if a structure cannot be condensed, with the
/// reason on standard error and nothing written. With a C interface its two files lie beside the header,
/// which then needs a name. Throws InputError for unusable input.
int export_scenes(const ExportOptions& options);

}  // namespace taut::host
