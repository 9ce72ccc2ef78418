# The condensed roof is what condense_roof writes, and in linear theory it is the roof that it was made from.
#   cmake -DTAUT=... -DCONDENSE=condense_roof -DREFERENCE=large_displacements -DDATA=... -DFOLDER=... -P roof.cmake
file(MAKE_DIRECTORY "${FOLDER}")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status ERROR_VARIABLE said OUTPUT_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}: ${said}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect_same one other most)
  foreach(scene IN ITEMS one other)
    run("${TAUT}" simulate "${${scene}}" "${DATA}/condensed_roof.csv" -o "${FOLDER}/${scene}.csv")
  endforeach()
  run("${REFERENCE}" --compare "${FOLDER}/one.csv" "${FOLDER}/other.csv")
  foreach(kind IN ITEMS segments struts payouts)
    if(NOT output MATCHES "${kind} +([0-9.e+-]+) of" OR CMAKE_MATCH_1 GREATER most)
      message(FATAL_ERROR "${one} and ${other} differ: ${output}")
    endif()
  endforeach()
endfunction()

set(full "${DATA}/beam_string_vertical.json")
set(condensed "${DATA}/condensed_roof.json")
run("${CONDENSE}" "${full}" 946900 -o "${FOLDER}/written.json")
expect_same("${FOLDER}/written.json" "${condensed}" 1e-8)

# In linear theory a substructure is the beams that it was condensed from; in second-order theory to first order in the thrust.
foreach(scene IN ITEMS full condensed)
  file(READ "${${scene}}" text)
  string(REGEX REPLACE ",[ \n]*\"second_order\".*$" " }\n" text "${text}")
  file(WRITE "${FOLDER}/${scene}.linear.json" "${text}")
endforeach()
expect_same("${FOLDER}/full.linear.json" "${FOLDER}/condensed.linear.json" 1e-8)
