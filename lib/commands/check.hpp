// `taut check`: what a scene holds and needs, and whether it stands.
#pragma once

#include <string>

namespace taut::host {

/// Prints a summary of the scene on standard output and returns the exit status: 0, or 1 if it has no
/// equilibrium before any load, with the reason on standard error. Warns there of joints that set their node
/// free when they slide. Throws InputError if the scene cannot be used.
int check(const std::string& scene_path);

}  // namespace taut::host
