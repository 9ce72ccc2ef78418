# Follows random jackings with second-order theory and with the reference, one after the other, and writes what came of
# each into LINES, which `large_displacements --summary LINES` makes a table of:
#   cmake -DTAUT=... -DPROGRAM=... -DFOLDER=... -DLINES=... -DFIRST=1 -DCOUNT=1000 -P random.cmake
# Up to the target, and up to the first row of which taut remarks that joints bend by more than the theory is made for.
include(${CMAKE_CURRENT_LIST_DIR}/results.cmake)
set(target 2400)

function(first_line text to)
  string(REGEX REPLACE "\n.*$" "" text "${text}")
  set(${to} "${text}" PARENT_SCOPE)
endfunction()

function(append_differences what result reference until)
  execute_process(COMMAND "${PROGRAM}" --compare ${result} ${reference} ${until} OUTPUT_VARIABLE said ERROR_QUIET)
  if(said)
    string(REGEX REPLACE "\n$" "" said "${said}")
    string(REGEX REPLACE "\n" "\n${what} " said "${said}")
    file(APPEND ${LINES} "${what} ${said}\n")
  endif()
endfunction()

file(WRITE ${LINES} "")
math(EXPR last "${FIRST} + ${COUNT} - 1")
foreach(seed RANGE ${FIRST} ${last})
  file(REMOVE_RECURSE ${FOLDER})
  file(MAKE_DIRECTORY ${FOLDER})
  execute_process(COMMAND "${PROGRAM}" --write random-${seed} ${FOLDER} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "--write random-${seed}: ${status}")
  endif()
  file(GLOB scene ${FOLDER}/*.json)
  get_filename_component(name ${scene} NAME_WE)
  set(stem ${FOLDER}/${name})
  file(APPEND ${LINES} "scene ${name}\n")

  # Jacks count by the length without tension; the prestrain of a closed hoop is a part of the distances in the scene.
  set(length --present-length)
  if(name MATCHES "closed")
    set(length "")
  endif()
  execute_process(COMMAND "${PROGRAM}" ${stem}.json ${stem}.csv -o ${stem}.reference.csv ${length} TIMEOUT 120
                  RESULT_VARIABLE status ERROR_VARIABLE said)
  rows_of(${stem}.reference.csv rows)
  first_line("${said}" said)
  file(APPEND ${LINES} "reference ${status} ${rows} ${said}\n")

  execute_process(COMMAND "${TAUT}" simulate ${stem}.json ${stem}.csv -o ${stem}.taut.csv TIMEOUT 120
                  RESULT_VARIABLE status ERROR_VARIABLE said)
  rows_of(${stem}.taut.csv rows)
  set(beyond ${target})
  if(said MATCHES "time ([0-9.]+) s[^\n]*made for a tenth")
    set(beyond ${CMAKE_MATCH_1})
    string(REGEX REPLACE "^remark:[^\n]*\n?" "" said "${said}")
  endif()
  first_line("${said}" said)
  file(APPEND ${LINES} "taut ${status} ${rows} ${said}\n")

  # To the row before that one.
  set(within ${target})
  if(beyond LESS ${target})
    math(EXPR within "${beyond} - 60")
  endif()
  displacement_columns_of(${stem}.reference.csv columns)
  execute_process(COMMAND "${TAUT}" simulate ${stem}.json ${stem}.csv -o ${stem}.moved.csv --columns "${columns}"
                  TIMEOUT 120 OUTPUT_QUIET ERROR_QUIET)
  foreach(result IN ITEMS taut moved)
    append_differences(target ${stem}.${result}.csv ${stem}.reference.csv ${target})
    append_differences(within ${stem}.${result}.csv ${stem}.reference.csv ${within})
  endforeach()
endforeach()
