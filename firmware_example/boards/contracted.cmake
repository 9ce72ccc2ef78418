# For a test: what happens without -ffp-contract=off.
option(MONITOR_CONTRACT "Let the compiler fuse products and sums" OFF)
if(MONITOR_CONTRACT)
  add_library(contracted INTERFACE)
  target_compile_options(contracted INTERFACE -ffp-contract=fast)
endif()
