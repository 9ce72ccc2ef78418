# The library for Arduino in a sketchbook: the builder of Arduino's IDE finds it by the header that the example includes, makes a source of
# the example, and builds it for a board.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
need_tool(builder arduino-builder)
need_tool(ctags arduino-ctags)
need_tool(cross arm-none-eabi-g++)

file(COPY ${here}/stubs/arduino_board/ DESTINATION ${WORK}/hardware/maker/boards)
file(COPY ${here}/stubs/Arduino.h DESTINATION ${WORK}/hardware/maker/boards/cores/core)
file(WRITE ${WORK}/hardware/maker/boards/cores/core/main.cpp
     "#include <Arduino.h>\nint main() {\n  setup();\n  for (;;) loop();\n}\n")
file(COPY ${BUNDLE}/taut DESTINATION ${WORK}/libraries)
file(MAKE_DIRECTORY ${WORK}/build ${WORK}/tools)
execute_process(
  COMMAND ${builder} -compile -hardware ${WORK}/hardware -tools ${WORK}/tools -libraries ${WORK}/libraries -fqbn maker:boards:board
          -ide-version=10819 -prefs tools.ctags.program=${ctags} -build-path ${WORK}/build
          ${WORK}/libraries/taut/examples/JackLoad/JackLoad.ino
  OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "arduino-builder ends with ${status}:\n${said}")
endif()
if(NOT said MATCHES "Sketch uses [0-9]+ bytes")
  message(FATAL_ERROR "arduino-builder says nothing of a program:\n${said}")
endif()
need_files(${WORK}/build JackLoad.ino.elf)
file(STRINGS ${WORK}/build/includes.cache found REGEX "libraries/taut/src" LIMIT_COUNT 1)
if(NOT found)
  message(FATAL_ERROR "arduino-builder did not take taut from the sketchbook")
endif()
