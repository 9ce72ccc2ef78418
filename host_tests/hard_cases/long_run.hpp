// How long the long run is.
#pragma once

namespace hard {

inline long long_run_samples = 200000;

}  // namespace hard
