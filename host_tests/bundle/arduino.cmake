# The library for Arduino: its example, made a source as the tools of Arduino do it, prints the forces of README.md on this computer,
# with the bits of `taut estimate --scalar float`.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(library ${BUNDLE}/taut)
need_files(${library} src/taut_device.hpp keywords.txt LICENSE CHANGELOG.md examples/JackLoad/JackLoad.ino)

# Without one of these a library is not loaded, or not shown.
file(STRINGS ${library}/library.properties properties)
foreach(key IN ITEMS name version author maintainer sentence paragraph category architectures includes)
  if(NOT "${properties}" MATCHES "(^|;)${key}=[^;]+")
    message(FATAL_ERROR "library.properties has no ${key}")
  endif()
endforeach()
if(NOT "version=${VERSION}" IN_LIST properties OR NOT "includes=taut_device.hpp" IN_LIST properties)
  message(FATAL_ERROR "library.properties is not of version ${VERSION}, or names another header: ${properties}")
endif()
file(STRINGS ${library}/keywords.txt wrong REGEX "^[^\t]+$|[^\t]+\t[^KL]| ")
file(STRINGS ${library}/keywords.txt keywords REGEX "^[A-Za-z_]+\t(KEYWORD[12]|LITERAL1)$")
if(wrong OR NOT keywords)
  message(FATAL_ERROR "keywords.txt: a word, a tab and its kind are wanted, not: ${wrong}")
endif()
file(READ ${library}/src/taut_device.hpp header)
foreach(keyword IN LISTS keywords)
  string(REGEX REPLACE "\t.*" "" keyword "${keyword}")
  if(NOT header MATCHES "[^A-Za-z_]${keyword}[^A-Za-z_]")
    message(FATAL_ERROR "keywords.txt has ${keyword}, and taut_device.hpp has not")
  endif()
endforeach()

include(${here}/sketch.cmake)
file(WRITE ${WORK}/main.cpp "#include <Arduino.h>\nint main() {\n  setup();\n  for (int i = 0; i < 10; ++i) loop();\n}\n")

# Makes a list of the numbers below the first line of a text.
macro(take_rows text)
  string(FIND "${${text}}" "\n" first)
  string(SUBSTRING "${${text}}" ${first} -1 ${text})
  string(REGEX MATCHALL "[0-9a-f.]+" ${text} "${${text}}")
endmacro()

# The table of README.md as such a list.
file(READ ${TAUT}/README.md readme)
string(REGEX MATCH "far end .N.    sd [|]    mu     sd\n([0-9 .|\n]+)```" table "${readme}")
string(REGEX MATCHALL "[0-9.]+" table "${CMAKE_MATCH_1}")
list(LENGTH table count)
if(NOT count EQUAL 20)
  message(FATAL_ERROR "README.md no longer has the table of its program, four rows of five numbers: ${table}")
endif()

file(COPY_FILE ${TAUT}/firmware_example/data/rolling_joint.json ${WORK}/scene.json)
file(READ ${WORK}/scene.json scene)
string(REPLACE "\"sensors\": {" "\"sensors\": { \"original.start\": { \"sd\": 100, \"gain_sd\": 0, \"zero_sd\": 0 }," scene "${scene}")
file(WRITE ${WORK}/scene.json "${scene}")
file(WRITE ${WORK}/log.csv "time,original.start,original.end\n1,,20000\n2,33350,40000\n3,,30000\n4,,20000\n")
execute_process(
  COMMAND ${PROGRAM} estimate --scalar float --hex --columns original.T1,original.sd1,original.mu1,original.mu_sd1
          ${WORK}/scene.json ${WORK}/log.csv
  OUTPUT_VARIABLE expected COMMAND_ERROR_IS_FATAL ANY ERROR_QUIET)
take_rows(expected)
list(REMOVE_AT expected 0 5 10 15) # the time

# The flags of boards as far as they mean something here; where the processor can, compilers then fuse products and sums unless told otherwise.
set(flags -std=gnu++17 -Os -fno-exceptions -fno-rtti -w)
if(fuses)
  list(APPEND flags -mfma)
endif()
set(compilers ${CXX})
find_program(clang clang++)
if(clang)
  list(APPEND compilers ${clang})
endif()
foreach(compiler IN LISTS compilers)
  run_or_fail(${compiler} ${flags} ${include} ${source} ${WORK}/main.cpp -o ${WORK}/example)
  execute_process(COMMAND ${WORK}/example OUTPUT_VARIABLE said)
  take_rows(said)
  need_equal("${compiler}: JackLoad prints other numbers than README.md" "${said}" "${table}")

  execute_process(COMMAND ${CMAKE_COMMAND} -E env SHOW_BITS=1 ${WORK}/example OUTPUT_VARIABLE said)
  take_rows(said)
  list(REMOVE_AT said 0 5 10 15) # the force of the jack
  need_equal("${compiler}: JackLoad has other bits than taut estimate" "${said}" "${expected}")
endforeach()
