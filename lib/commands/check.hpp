// `taut check`: what a scene holds and needs, and whether it stands.
#pragma once

#include <string>

namespace taut::host {

/// Prints a summary of the scene on standard output and returns the exit status: 0, or 1 if it has no
/// equilibrium before any load, with the reason on standard error. Says which joints hang on their cable
/// alone, and, where there is a load to say it at (a log, or the target of second-order theory), how far
/// linear theory is off: see compare_theories(). Warns on standard error of joints that set their node free
/// when they slide, and of a linear scene that linear theory does not do for. `log` may be empty. Throws
/// InputError if scene or log cannot be used.
int check(const std::string& scene, const std::string& log);

}  // namespace taut::host
