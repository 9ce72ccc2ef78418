# The installed program runs, wherever it was installed to.
include(${CMAKE_CURRENT_LIST_DIR}/run_or_fail.cmake)
file(REMOVE_RECURSE ${WORK})

run_or_fail(${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${WORK})
run_or_fail(${WORK}/bin/taut --help)
foreach(installed IN ITEMS include/taut/taut.hpp share/doc/taut/LICENSE)
  if(NOT EXISTS ${WORK}/${installed})
    message(FATAL_ERROR "${installed} was not installed")
  endif()
endforeach()
