// Room on the stack that does not depend on the limits of the shell.
#pragma once

#include <functional>

namespace taut::host {

/// Calls a function that must not throw, on a stack of its own with room for the solvers of the largest
/// capacity: they put systems of equations of megabytes there. Where no such stack is to be had it is called
/// on the present one. Returns what it returns.
int call_with_own_stack(const std::function<int()>& function);

}  // namespace taut::host
