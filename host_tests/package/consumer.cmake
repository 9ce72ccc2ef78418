# Builds and runs the project in consumer/, which gets taut by the given WAY.
include(${CMAKE_CURRENT_LIST_DIR}/run_or_fail.cmake)
file(REMOVE_RECURSE ${WORK})

# The core must not need what only the program and the tests need: nothing of it may be found.
set(eigen_alone ${EIGEN_HINT} -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON
                -DCMAKE_DISABLE_FIND_PACKAGE_doctest=ON)
set(tools -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=Debug)

if(WAY STREQUAL find_package)
  run_or_fail(${CMAKE_COMMAND} -S ${TAUT} -B ${WORK}/taut ${tools} ${eigen_alone} -DTAUT_BUILD_PROGRAM=OFF
              -DTAUT_BUILD_TESTS=OFF -DTAUT_BUILD_EXAMPLES=OFF)
  run_or_fail(${CMAKE_COMMAND} --install ${WORK}/taut --prefix ${WORK}/prefix)
  # Somewhere else than it was installed to: nothing in it may hold a path.
  file(RENAME ${WORK}/prefix ${WORK}/moved)
endif()

run_or_fail(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${WORK}/build ${tools} ${eigen_alone}
            -DWAY=${WAY} -DTAUT=${TAUT} -DVERSION=${VERSION} -DCMAKE_PREFIX_PATH=${WORK}/moved)
run_or_fail(${CMAKE_COMMAND} --build ${WORK}/build)
run_or_fail(${WORK}/build/consumer)
