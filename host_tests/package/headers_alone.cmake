# Every header compiles as the first and only one, without exceptions and RTTI and without a warning.
file(GLOB_RECURSE headers RELATIVE ${TAUT}/include ${TAUT}/include/taut/*.hpp)
file(REMOVE_RECURSE ${WORK})
list(TRANSFORM EIGEN_INCLUDE PREPEND -isystem)

set(failures "")
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} name)
  # Twice, so that a header without an include guard is noticed.
  file(WRITE ${WORK}/${name}.cpp "#include <${header}>\n#include <${header}>\n")
  execute_process(
    COMMAND ${CXX} -std=c++17 -fsyntax-only -fno-exceptions -fno-rtti ${WARNINGS} -I${TAUT}/include
            ${EIGEN_INCLUDE} ${WORK}/${name}.cpp
    RESULT_VARIABLE result
    ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(APPEND failures "${header}:\n${output}\n")
  endif()
endforeach()
if(failures)
  message("${failures}") # by itself, for an error message would be wrapped
  message(FATAL_ERROR "not all headers compile alone")
endif()
list(LENGTH headers count)
message("${count} headers")
