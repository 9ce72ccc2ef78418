# All headers in one program compile with COMPILER as STANDARD, without exceptions and RTTI and without a warning.
include(${CMAKE_CURRENT_LIST_DIR}/run_or_fail.cmake)
file(GLOB_RECURSE headers RELATIVE ${TAUT}/include ${TAUT}/include/taut/*.hpp)
file(REMOVE_RECURSE ${WORK})
list(TRANSFORM EIGEN_INCLUDE PREPEND -isystem)

# From the last to the first, which is unlikely to be the order that any other file has them in.
list(REVERSE headers)
set(includes "")
foreach(header IN LISTS headers)
  string(APPEND includes "#include <${header}>\n")
endforeach()
file(READ ${CMAKE_CURRENT_LIST_DIR}/consumer/main.cpp main)
file(WRITE ${WORK}/main.cpp "${includes}${main}")

# Optimised: some warnings need the analysis that comes with it.
run_or_fail(${COMPILER} -std=c++${STANDARD} -O2 -fno-exceptions -fno-rtti ${WARNINGS} -I${TAUT}/include
            ${EIGEN_INCLUDE} ${WORK}/main.cpp -o ${WORK}/consumer)
run_or_fail(${WORK}/consumer)
