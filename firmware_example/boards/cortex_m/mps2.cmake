# What every MPS2 board builds; the board sets board_processor before.
set(board_folder ${CMAKE_CURRENT_SOURCE_DIR})
include(${monitor_folder}/boards/cortex_m/firmware.cmake)

add_firmware(monitor ${monitor_folder}/boards/cortex_m/main.cpp ${monitor_folder}/boards/cortex_m/mps2.cpp)

foreach(number RANGE 9)
  add_heap_probe(${number})
endforeach()

# For firmware_example/measure.
set(MONITOR_BENCH "" CACHE STRING "What of sizes/bench.cpp to build")
add_firmware(bench ${monitor_folder}/sizes/bench.cpp)
set_target_properties(bench PROPERTIES EXCLUDE_FROM_ALL ON)
target_compile_definitions(bench PRIVATE ${MONITOR_BENCH})
target_include_directories(bench PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/../..)
add_dependencies(bench flash_scene)
