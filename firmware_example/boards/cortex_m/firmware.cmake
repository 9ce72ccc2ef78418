# How firmware for a Cortex-M is compiled and linked.

# What every answer rests on: no contraction (of taut::taut), no -ffast-math. What keeps it small: no exceptions, no
# run-time types, no unwinding. -O0 and -Og leave calls of operator new behind that nobody makes: not for the device. So does -Os where
# a scene in space is condensed on the device: take -O2 there, or export the scene.
set(MONITOR_OPTIMIZATION -Os CACHE STRING "Optimization of firmware")
add_library(cortex_m INTERFACE)
target_compile_options(
  cortex_m
  INTERFACE ${board_processor}
            -mthumb
            -mfloat-abi=hard
            ${MONITOR_OPTIMIZATION}
            -fno-exceptions
            -fno-rtti
            -fno-unwind-tables
            -fno-asynchronous-unwind-tables
            -fno-threadsafe-statics
            -fno-use-cxa-atexit
            -ffunction-sections
            -fdata-sections
            -fno-math-errno
            -fstack-usage
            -fcallgraph-info=su)
include(${monitor_folder}/boards/contracted.cmake)
target_compile_definitions(cortex_m INTERFACE NDEBUG EIGEN_NO_IO EIGEN_DONT_VECTORIZE EIGEN_MAX_ALIGN_BYTES=0)
target_include_directories(cortex_m INTERFACE ${monitor_folder} ${board_folder})
target_link_libraries(cortex_m INTERFACE taut::taut taut_warnings $<TARGET_NAME_IF_EXISTS:contracted>)
target_link_options(
  cortex_m
  INTERFACE
  ${board_processor}
  -mthumb
  -mfloat-abi=hard
  -nostartfiles
  --specs=nano.specs
  -T${board_folder}/board.ld
  -L${monitor_folder}/boards/cortex_m
  LINKER:--gc-sections)
# The linker names whoever refers to the heap, if anybody does.
foreach(symbol IN ITEMS malloc _malloc_r free _free_r _sbrk _Znwj _Znaj _ZdlPv _ZdlPvj _ZdaPv)
  target_link_options(cortex_m INTERFACE LINKER:-y,${symbol})
endforeach()

# Adds a program with start-up code.
function(add_firmware name)
  add_executable(${name} ${ARGN} ${monitor_folder}/boards/cortex_m/start_up.cpp)
  target_link_libraries(${name} PRIVATE cortex_m)
  target_link_options(${name} PRIVATE LINKER:-Map=${CMAKE_BINARY_DIR}/${name}.map)
  set_target_properties(${name} PROPERTIES SUFFIX .elf LINK_DEPENDS
    "${board_folder}/board.ld;${monitor_folder}/boards/cortex_m/sections.ld")
endfunction()

# The same program once more with something that refers to the heap, or with the number 0 to nothing.
function(add_heap_probe number)
  add_executable(heap_probe_${number} EXCLUDE_FROM_ALL ${monitor_folder}/tests/heap_probe.cpp $<TARGET_OBJECTS:monitor>)
  target_compile_definitions(heap_probe_${number} PRIVATE HEAP_PROBE=${number})
  target_link_libraries(heap_probe_${number} PRIVATE cortex_m)
endfunction()
