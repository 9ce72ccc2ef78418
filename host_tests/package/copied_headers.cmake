# The headers copied into a project that knows nothing of CMake: a compiler and -I is all they need.
include(${CMAKE_CURRENT_LIST_DIR}/run_or_fail.cmake)
file(REMOVE_RECURSE ${WORK})
file(COPY ${TAUT}/include DESTINATION ${WORK})

list(TRANSFORM EIGEN_INCLUDE PREPEND -I)
run_or_fail(${CXX} -std=c++17 -I${WORK}/include ${EIGEN_INCLUDE} ${CMAKE_CURRENT_LIST_DIR}/consumer/main.cpp -o
            ${WORK}/consumer)
run_or_fail(${WORK}/consumer)
