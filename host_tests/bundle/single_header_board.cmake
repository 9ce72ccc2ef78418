# The header in one file on a board: it compiles, and fuses no product with a sum although the compiler may.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
need_tool(cross arm-none-eabi-g++)
need_tool(objdump arm-none-eabi-objdump)
foreach(scene IN ITEMS arch beam_string)
  run_or_fail(${PROGRAM} export ${TAUT}/host_tests/export/${scene}.json -o ${WORK}/${scene}.hpp)
endforeach()
file(READ ${TAUT}/host_tests/export/device.cpp source)
string(REPLACE "#include \"taut/device.hpp\"" "#include \"taut_device.hpp\"" source "${source}")
file(WRITE ${WORK}/device.cpp "${source}")
run_or_fail(${cross} ${for_board} -I${BUNDLE} -I${WORK} -c ${WORK}/device.cpp -o ${WORK}/board.o)
# vmla rounds both.
execute_process(COMMAND ${objdump} -d ${WORK}/board.o OUTPUT_VARIABLE code)
string(REGEX MATCH "vfn?m[as][^\n]*" fused "${code}")
string(FIND "${code}" "vmul.f32" at)
if(fused OR at EQUAL -1)
  message(FATAL_ERROR "products and sums are fused, or there are none: ${fused}")
endif()

# The line in the README of the bundle, as it stands.
file(STRINGS ${BUNDLE}/README.md line REGEX "^    arm-none-eabi-g.. ")
separate_arguments(line UNIX_COMMAND "${line}")
file(COPY ${BUNDLE}/taut_device.hpp ${TAUT}/firmware_example/data/rolling_joint.hpp DESTINATION ${WORK}/readme)
file(WRITE ${WORK}/readme/main.cpp "#include \"taut_device.hpp\"\n#include \"rolling_joint.hpp\"\n"
           "namespace roller = rolling_cable_strut_joint_three_set_ups_side_by_side;\n"
           "taut::Tracker<taut::Condensed<float, roller::Capacity>> tracker;\n"
           "bool begin() { return bool(tracker.start(roller::condensed<float>).status); }\n")
run_or_fail(${CMAKE_COMMAND} -E chdir ${WORK}/readme ${line})
need_files(${WORK}/readme main.o)
