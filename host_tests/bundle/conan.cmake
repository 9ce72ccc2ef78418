# The recipe for Conan: its package, made with what stands for Conan or by Conan itself where it is installed, has the headers and the
# licence, and a program compiles with it.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
need_tool(python python3)
set(recipe ${BUNDLE}/conan)
need_files(${recipe} conanfile.py LICENSE include/taut/taut.hpp)
file(COPY ${recipe}/conanfile.py DESTINATION ${WORK})
run_or_fail(${python} -m py_compile ${WORK}/conanfile.py)
run_or_fail(${CMAKE_COMMAND} -E env PYTHONPATH=${here}/stubs PYTHONDONTWRITEBYTECODE=1 ${python} ${here}/stubs/make_conan_package.py
            ${recipe} ${WORK}/package ${VERSION})
need_files(${WORK}/package licenses/LICENSE include/taut/device.hpp)
list(TRANSFORM EIGEN_INCLUDE PREPEND -I)
run_or_fail(${CXX} -std=c++17 -ffp-contract=off -I${WORK}/package/include ${EIGEN_INCLUDE}
            ${TAUT}/host_tests/package/consumer/main.cpp -fsyntax-only)
find_program(conan conan)
if(conan)
  run_or_fail(${CMAKE_COMMAND} -E env CONAN_HOME=${WORK}/home ${conan} export ${recipe})
endif()
