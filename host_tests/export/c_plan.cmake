# The next moves through the C interface of a scene: they have the bits of taut::JackPlanner in C++ on the host and, where EMULATOR is
# given, on an emulated Cortex-M4F.
#   cmake -D TAUT=program -D SOURCE=folder -D NAME=scene -D SPACE=namespace -D "SETTINGS=-DPULL=..;-DTARGET=..;-DEVENTS=.." -D C=gcc -D CXX=g++
#         -D WARNINGS=.. [-D EMULATOR=qemu-system-arm] -D WORK=folder -P c_plan.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/board/run_on_board.cmake)
set(here ${CMAKE_CURRENT_LIST_DIR})
string(REPLACE "," ";" warnings "${WARNINGS}")
string(REPLACE "," ";" settings "${SETTINGS}")
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run_or_fail(${TAUT} export ${here}/${NAME}.json -o ${WORK}/${NAME}.hpp --c jack)

# On the host, through C and in C++.
run_or_fail(${CXX} -std=c++17 -O1 ${warnings} -ffp-contract=off -DJACK_PLAN -I${SOURCE}/include -c ${WORK}/jack.cpp -o ${WORK}/jack.o)
run_or_fail(${C} -std=c99 -Wall -Wextra -pedantic -Werror -I${WORK} ${settings} -c ${here}/c_plan_test.c -o ${WORK}/test.o)
run_or_fail(${CXX} ${WORK}/test.o ${WORK}/jack.o -o ${WORK}/through_c)
run_or_fail(${CXX} -std=c++17 -O1 ${warnings} -ffp-contract=off -I${SOURCE}/include -I${WORK} ${settings} -DSPACE=${SPACE}
            -DSCENE="${NAME}.hpp" ${here}/plan_bits.cpp -o ${WORK}/in_cpp)
execute_process(COMMAND ${WORK}/through_c OUTPUT_VARIABLE through_c COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/in_cpp OUTPUT_VARIABLE in_cpp COMMAND_ERROR_IS_FATAL ANY)
if(NOT through_c STREQUAL in_cpp OR NOT through_c MATCHES "\n[12] ")
  message(FATAL_ERROR "through C other moves are found than in C++:\n${through_c}\n${in_cpp}")
endif()
if(NOT EMULATOR)
  return()
endif()

file(WRITE ${WORK}/arguments.h "\"test\",\n")
run_on_board(c_plan_test.c "-DJACK_PLAN;${settings}" 240)
if(NOT on_board STREQUAL through_c)
  message(FATAL_ERROR "on the board other moves are found than on the host:\n${on_board}\n${through_c}")
endif()
