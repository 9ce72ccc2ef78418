# The C interface of a scene on an emulated Cortex-M4F: a program in C99 that follows a log with it has the bits of
# `taut estimate --scalar float`.
#   cmake -D TAUT=program -D SOURCE=folder -D NAME=scene -D "ARGUMENTS=loads -- ends" -D COLUMNS=C.T1,.. -D EMULATOR=qemu-system-arm
#         -D WORK=folder -P c_interface_board.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/../package/run_or_fail.cmake)
set(here ${CMAKE_CURRENT_LIST_DIR})
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run_or_fail(${TAUT} export ${here}/${NAME}.json -o ${WORK}/${NAME}.hpp --c jack)

separate_arguments(arguments UNIX_COMMAND "test ${here}/${NAME}.csv ${ARGUMENTS}")
list(TRANSFORM arguments REPLACE "(.+)" "\"\\1\",\n")
list(JOIN arguments "" arguments)
file(WRITE ${WORK}/arguments.h "${arguments}")

set(processor -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard)
run_or_fail(arm-none-eabi-g++ -std=c++17 -Os -ffp-contract=off -fno-exceptions -fno-rtti ${processor} -I${SOURCE}/include -c
            ${WORK}/jack.cpp -o ${WORK}/jack.o)
foreach(source IN ITEMS c_interface_test.c board/start_up.c)
  get_filename_component(name ${source} NAME_WE)
  run_or_fail(arm-none-eabi-gcc -std=c99 -Os -Wall -Wextra -Werror ${processor} -I${WORK} -DC_INTERFACE=jack -DC_HEADER="jack.h" -c
              ${here}/${source} -o ${WORK}/${name}.o)
endforeach()
run_or_fail(arm-none-eabi-gcc ${processor} -nostartfiles --specs=rdimon.specs -T${here}/board/board.ld ${WORK}/start_up.o
            ${WORK}/c_interface_test.o ${WORK}/jack.o -lm -o ${WORK}/test.elf)

execute_process(
  COMMAND ${EMULATOR} -M mps2-an386 -display none -monitor none -serial none -semihosting-config enable=on,target=native -kernel
          ${WORK}/test.elf
  RESULT_VARIABLE status OUTPUT_VARIABLE found ERROR_VARIABLE errors TIMEOUT 60)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the program on the board ended with ${status}: ${found}${errors}")
endif()
execute_process(
  COMMAND ${TAUT} estimate --scalar float --hex --columns ${COLUMNS} ${here}/${NAME}.json ${here}/${NAME}.csv
  OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY ERROR_QUIET)
string(FIND "${said}" "\n" header)
math(EXPR rows "${header} + 1")
string(SUBSTRING "${said}" ${rows} -1 expected)
if(NOT found STREQUAL expected OR found STREQUAL "")
  message(FATAL_ERROR "on the board the interface in C has other bits than taut estimate:\n${found}\n${expected}")
endif()
