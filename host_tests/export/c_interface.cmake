# The C interface of a scene: its header is C99, its source has no warnings, and a program in C that follows a log with it has the bits
# of `taut estimate --scalar float`.
#   cmake -D TAUT=program -D SOURCE=folder -D NAME=scene -D "ARGUMENTS=loads -- ends" -D COLUMNS=C.T1,.. -D C=gcc -D CXX=g++
#         -D WARNINGS=.. -D WORK=folder -P c_interface.cmake
string(REPLACE "," ";" warnings "${WARNINGS}")
separate_arguments(arguments UNIX_COMMAND "${ARGUMENTS}")
file(MAKE_DIRECTORY ${WORK})
function(run_or_fail what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what}: ${status}\n${said}${errors}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

set(here ${SOURCE}/host_tests/export)
run_or_fail("export" ${TAUT} export ${here}/${NAME}.json -o ${WORK}/${NAME}.hpp --c ${NAME}_jack)
run_or_fail("the source" ${CXX} -std=c++17 -fno-exceptions ${warnings} -ffp-contract=off -I${SOURCE}/include -c ${WORK}/${NAME}_jack.cpp -o
            ${WORK}/${NAME}_jack.o)
run_or_fail("the header in C++" ${CXX} -std=c++17 ${warnings} -fsyntax-only -x c++ ${WORK}/${NAME}_jack.h)
run_or_fail("the program in C" ${C} -std=c99 -Wall -Wextra -pedantic -Werror -I${WORK} -DC_INTERFACE=${NAME}_jack
            -DC_HEADER="${NAME}_jack.h" -c ${here}/c_interface_test.c -o ${WORK}/${NAME}_test.o)
run_or_fail("linking without a library of C++" ${C} ${WORK}/${NAME}_test.o ${WORK}/${NAME}_jack.o -lm -o ${WORK}/${NAME}_test)
run_or_fail("the run" ${WORK}/${NAME}_test ${here}/${NAME}.csv ${arguments})
set(found "${said}")
run_or_fail("taut estimate" ${TAUT} estimate --scalar float --hex --columns ${COLUMNS} ${here}/${NAME}.json ${here}/${NAME}.csv)
string(FIND "${said}" "\n" header)
math(EXPR rows "${header} + 1")
string(SUBSTRING "${said}" ${rows} -1 expected)
if(NOT found STREQUAL expected OR found STREQUAL "")
  message(FATAL_ERROR "the interface in C has other bits than taut estimate:\n${found}\n${expected}")
endif()

# Names that C does not take, and places that there are not, are refused, and nothing is written.
foreach(bad IN ITEMS "2nd" "a-b" "while")
  execute_process(COMMAND ${TAUT} export ${here}/${NAME}.json -o ${WORK}/refused.hpp --c "${bad}" RESULT_VARIABLE status
                  OUTPUT_QUIET ERROR_VARIABLE errors)
  if(NOT status EQUAL 2 OR EXISTS ${WORK}/refused.hpp)
    message(FATAL_ERROR "--c ${bad} is not refused: ${status} ${errors}")
  endif()
endforeach()
execute_process(COMMAND ${TAUT} export ${here}/${NAME}.json -o ${WORK}/refused.hpp --c "" RESULT_VARIABLE status
                OUTPUT_QUIET ERROR_VARIABLE errors)
if(NOT status EQUAL 2 OR NOT errors MATCHES "is no identifier of C")
  message(FATAL_ERROR "--c without a name is not refused: ${status} ${errors}")
endif()
execute_process(COMMAND ${TAUT} export ${here}/${NAME}.json --c jack RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
if(NOT status EQUAL 2 OR NOT errors MATCHES "-o FOLDER/SCENE.hpp")
  message(FATAL_ERROR "--c without -o is not refused: ${status} ${errors}")
endif()
