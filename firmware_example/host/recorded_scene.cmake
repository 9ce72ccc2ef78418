# Compares the scene of the recorded experiment in data/ with what `taut export` writes, or with -D WRITE=ON writes it.
# The sizes in its first comment are left out: they are those of the tracker, not of the scene.
# cmake -D TAUT=program -D SCENE=scene.json -D HEADER=scene.hpp [-D WRITE=ON] -P recorded_scene.cmake
execute_process(COMMAND ${TAUT} export ${SCENE} OUTPUT_VARIABLE exported RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "taut export ${SCENE} failed")
endif()
string(REGEX REPLACE "\n//\n// What is not used[^\n]*\n(// (float|double):[^\n]*\n)+" "\n" exported "${exported}")
if(WRITE)
  file(WRITE ${HEADER} "${exported}")
  return()
endif()
file(READ ${HEADER} kept)
if(NOT kept STREQUAL exported)
  message(FATAL_ERROR "${HEADER} is not what `taut export` writes of ${SCENE}; "
                      "make it anew: cmake --build --preset host --target recorded_scene")
endif()
