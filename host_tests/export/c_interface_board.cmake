# The C interface of a scene on an emulated Cortex-M4F: a program in C99 that follows a log with it has the bits of
# `taut estimate --scalar float`.
#   cmake -D TAUT=program -D SOURCE=folder -D NAME=scene -D "ARGUMENTS=loads -- ends" -D COLUMNS=C.T1,.. -D EMULATOR=qemu-system-arm
#         -D WORK=folder -P c_interface_board.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/board/run_on_board.cmake)
set(here ${CMAKE_CURRENT_LIST_DIR})
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run_or_fail(${TAUT} export ${here}/${NAME}.json -o ${WORK}/${NAME}.hpp --c jack)

separate_arguments(arguments UNIX_COMMAND "test ${here}/${NAME}.csv ${ARGUMENTS}")
list(TRANSFORM arguments REPLACE "(.+)" "\"\\1\",\n")
list(JOIN arguments "" arguments)
file(WRITE ${WORK}/arguments.h "${arguments}")
run_on_board(c_interface_test.c "-DC_INTERFACE=jack;-DC_HEADER=\"jack.h\"" 60)
set(found "${on_board}")
execute_process(
  COMMAND ${TAUT} estimate --scalar float --hex --columns ${COLUMNS} ${here}/${NAME}.json ${here}/${NAME}.csv
  OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY ERROR_QUIET)
string(FIND "${said}" "\n" header)
math(EXPR rows "${header} + 1")
string(SUBSTRING "${said}" ${rows} -1 expected)
if(NOT found STREQUAL expected OR found STREQUAL "")
  message(FATAL_ERROR "on the board the interface in C has other bits than taut estimate:\n${found}\n${expected}")
endif()
