# The pictures of the guide are what draw_structure draws of its scenes, but for the forces.
#   cmake -DDRAW=draw_structure -DDATA=firmware_example/data -DFOLDER=... [-DWRITE=ON] -P pictures.cmake
# WRITE puts them into DATA.
file(MAKE_DIRECTORY "${FOLDER}")
foreach(name IN ITEMS beam_string_vertical beam_string_radial truss_string suspen_dome_one_rod suspen_dome_two_rods
                      rigid_saddles condensed_roof)
  set(picture "${FOLDER}/${name}.svg")
  if(WRITE)
    set(picture "${DATA}/${name}.svg")
  endif()
  execute_process(COMMAND "${DRAW}" "${DATA}/${name}.json" "${DATA}/${name}.csv" -o "${picture}" RESULT_VARIABLE status
                  ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${name}: ${status}: ${said}")
  endif()
  foreach(file IN ITEMS "${picture}" "${DATA}/${name}.svg")
    file(READ "${file}" text)
    if(NOT text MATCHES "prefers-color-scheme:dark" OR NOT text MATCHES "<svg xmlns=")
      message(FATAL_ERROR "${file} is no picture for light and dark")
    endif()
    # Colours and numbers of forces.
    string(REGEX REPLACE "<title>[^<]*</title>|cable c[0-9]+|class=\"strut( tension)?\"" "" text "${text}")
    if(DEFINED other AND NOT WRITE AND NOT text STREQUAL other)
      message(FATAL_ERROR "${name}.svg is not what is drawn: cmake --build build/host --target guide_pictures")
    endif()
    set(other "${text}")
  endforeach()
  unset(other)
endforeach()
