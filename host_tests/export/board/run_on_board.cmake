# Builds the C interface ${WORK}/jack.cpp and a program in C99 that calls it for a Cortex-M4F, runs it on the emulated one, and sets
# `on_board` to what it prints. `definitions` are for both.
include(${CMAKE_CURRENT_LIST_DIR}/../../package/run_or_fail.cmake)
function(run_on_board program definitions seconds)
  set(here ${SOURCE}/host_tests/export)
  set(processor -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard)
  run_or_fail(arm-none-eabi-g++ -std=c++17 -Os -ffp-contract=off -fno-exceptions -fno-rtti ${processor} ${definitions}
              -I${SOURCE}/include -c ${WORK}/jack.cpp -o ${WORK}/jack_board.o)
  foreach(source IN ITEMS ${program} board/start_up.c)
    get_filename_component(name ${source} NAME_WE)
    run_or_fail(arm-none-eabi-gcc -std=c99 -Os -Wall -Wextra -Werror ${processor} -I${WORK} ${definitions} -c ${here}/${source} -o
                ${WORK}/${name}_board.o)
    list(APPEND objects ${WORK}/${name}_board.o)
  endforeach()
  run_or_fail(arm-none-eabi-gcc ${processor} -nostartfiles --specs=rdimon.specs -T${here}/board/board.ld ${objects}
              ${WORK}/jack_board.o -lm -o ${WORK}/board.elf)
  execute_process(
    COMMAND ${EMULATOR} -M mps2-an386 -display none -monitor none -serial none -semihosting-config enable=on,target=native -kernel
            ${WORK}/board.elf
    RESULT_VARIABLE status OUTPUT_VARIABLE found ERROR_VARIABLE errors TIMEOUT ${seconds})
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "the program on the board ended with ${status}: ${found}${errors}")
  endif()
  set(on_board "${found}" PARENT_SCOPE)
endfunction()
