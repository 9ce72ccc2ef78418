# Every exported header by itself: no warnings, and nothing in the object file if nothing is used.
string(REPLACE "," ";" WARNINGS "${WARNINGS}")
foreach(header IN LISTS HEADERS)
  get_filename_component(name ${header} NAME_WE)
  set(unit ${WORK}/${name}_alone.cpp)
  set(object ${WORK}/${name}_alone.o)
  file(WRITE ${unit} "#include \"${header}\"\n")
  execute_process(COMMAND ${COMPILER} -std=c++17 ${WARNINGS} -I${TAUT}/include -fsyntax-only ${unit}
                  RESULT_VARIABLE status ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${header} does not compile by itself:\n${errors}")
  endif()
  execute_process(COMMAND ${COMPILER} -std=c++17 -O0 -I${TAUT}/include -c ${unit} -o ${object}
                  RESULT_VARIABLE status)
  file(STRINGS ${object} symbols REGEX "condensed|struts|prior|joint_nodes")
  if(NOT status EQUAL 0 OR symbols)
    message(FATAL_ERROR "${header} costs memory although nothing of it is used: ${symbols}")
  endif()
endforeach()
