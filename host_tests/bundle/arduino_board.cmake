# The example for Arduino compiles for boards as the tools of Arduino call the compiler, with the macros of a core around it.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
need_tool(cross arm-none-eabi-g++)
include(${here}/sketch.cmake)
run_or_fail(${cross} ${for_board} ${include} -c ${source} -o ${WORK}/board.o)
# Without a unit for floating point too.
run_or_fail(${cross} -std=gnu++17 -Os -mcpu=cortex-m0plus -mthumb -fno-exceptions -fno-rtti -w ${include} -c ${source} -o
            ${WORK}/small_board.o)
