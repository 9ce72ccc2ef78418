# Makes the folder of what others take: a header, a library for boards, recipes for packages, a Debian package.
# cmake -D TAUT=folder -D BUILD=folder -D VERSION=0.2.0 -D OUTPUT=folder [-D CONFIG=Release] -P make_bundle.cmake
#
# Without the program in BUILD there is no Debian package. In what is copied from this folder @VERSION@ is the version.
cmake_minimum_required(VERSION 3.22)
set(here ${CMAKE_CURRENT_LIST_DIR})

# Copies the files of a folder beside this script, with the version in them.
function(copy_with_version from to)
  file(GLOB_RECURSE files RELATIVE ${here}/${from} ${here}/${from}/*)
  foreach(file IN LISTS files)
    configure_file(${here}/${from}/${file} ${to}/${file} @ONLY)
  endforeach()
endfunction()

# Runs a command; its output is shown only if it fails.
function(run_or_stop)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message("${command}\n${said}") # by itself, for an error message would be wrapped
    message(FATAL_ERROR "the command above ended with: ${status}")
  endif()
endfunction()

file(READ ${TAUT}/lib/CHANGELOG.md changes LIMIT 1000)
if(NOT changes MATCHES "\n## ([0-9.]+), ([0-9-]+)\n" OR NOT CMAKE_MATCH_1 STREQUAL VERSION)
  message(FATAL_ERROR "lib/CHANGELOG.md does not begin with \"## ${VERSION}, year-month-day\": say what is new")
endif()
set(date ${CMAKE_MATCH_2})

file(REMOVE_RECURSE ${OUTPUT})
configure_file(${here}/README.md ${OUTPUT}/README.md @ONLY)
file(COPY ${TAUT}/LICENSE ${TAUT}/lib/CHANGELOG.md DESTINATION ${OUTPUT})

run_or_stop(${CMAKE_COMMAND} -D TAUT=${TAUT} -D VERSION=${VERSION} -D OUTPUT=${OUTPUT}/taut_device.hpp -P
            ${here}/single_header.cmake)

# One folder for Arduino, PlatformIO, Zephyr and ESP-IDF.
copy_with_version(taut ${OUTPUT}/taut)
file(COPY ${TAUT}/LICENSE ${TAUT}/lib/CHANGELOG.md DESTINATION ${OUTPUT}/taut)
file(COPY ${OUTPUT}/taut_device.hpp DESTINATION ${OUTPUT}/taut/src)
file(COPY ${TAUT}/firmware_example/data/rolling_joint.hpp DESTINATION ${OUTPUT}/taut/examples/JackLoad)

# A board: the program of the README, with the one header in place of the library.
copy_with_version(stm32f405 ${OUTPUT}/stm32f405)
file(COPY ${TAUT}/firmware_example/data/rolling_joint.json DESTINATION ${OUTPUT}/stm32f405)
file(READ ${TAUT}/README.md text)
set(first "#include <taut/taut.hpp>\n")
string(FIND "${text}" "```cpp\n${first}" begin)
if(begin EQUAL -1)
  message(FATAL_ERROR "README.md has no program")
endif()
string(LENGTH "```cpp\n${first}" length)
math(EXPR begin "${begin} + ${length}")
string(SUBSTRING "${text}" ${begin} -1 text)
string(FIND "${text}" "```" end)
string(SUBSTRING "${text}" 0 ${end} text)
file(WRITE ${OUTPUT}/stm32f405/main.cpp "#include \"taut_device.hpp\"\n${text}")

copy_with_version(conan ${OUTPUT}/conan)
file(COPY ${TAUT}/LICENSE ${TAUT}/include DESTINATION ${OUTPUT}/conan)

copy_with_version(vcpkg ${OUTPUT}/vcpkg/taut)
file(COPY ${TAUT}/CMakeLists.txt ${TAUT}/LICENSE ${TAUT}/include DESTINATION ${OUTPUT}/vcpkg/taut/source)
file(COPY ${TAUT}/lib/cmake DESTINATION ${OUTPUT}/vcpkg/taut/source/lib PATTERN *.sh EXCLUDE)

find_program(dpkg dpkg)
find_program(cpack cpack)
find_program(program taut PATHS ${BUILD} NO_DEFAULT_PATH)
if(NOT dpkg OR NOT cpack OR NOT program)
  message("no Debian package: it needs dpkg, cpack and the program")
  return()
endif()
set(WORK ${BUILD}/bundle_debian)
set(STAGE ${WORK}/stage)
file(REMOVE_RECURSE ${WORK})
run_or_stop(${CMAKE_COMMAND} --install ${BUILD} --config "${CONFIG}" --prefix ${STAGE}/usr)
file(COPY_FILE ${TAUT}/LICENSE ${STAGE}/usr/share/doc/taut/copyright)
file(REMOVE ${STAGE}/usr/share/doc/taut/LICENSE)
file(COPY ${TAUT}/lib/CHANGELOG.md DESTINATION ${STAGE}/usr/share/doc/taut)
file(MAKE_DIRECTORY ${STAGE}/usr/share/man/man1 ${STAGE}/usr/share/bash-completion/completions)
file(COPY_FILE ${here}/debian/taut.bash ${STAGE}/usr/share/bash-completion/completions/taut)
run_or_stop(${CMAKE_COMMAND} -D PROGRAM=${program} -D VERSION=${VERSION} -D DATE=${date} -D
            OUTPUT=${STAGE}/usr/share/man/man1/taut.1 -P ${here}/debian/man_page.cmake)
configure_file(${here}/debian/cpack.cmake ${WORK}/cpack.cmake @ONLY)
run_or_stop(${cpack} --config ${WORK}/cpack.cmake)
file(GLOB package ${WORK}/*.deb)
file(COPY ${package} DESTINATION ${OUTPUT})
