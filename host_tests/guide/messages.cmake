# What the guide quotes is what the program says of scenes that are drawn wrong:
#   cmake -DTAUT=... -DDATA=firmware_example/data -DFOLDER=... -P messages.cmake
# Without DATA/README.md, and with -DPRINT=ON, the messages are printed.
file(READ "${DATA}/README.md" guide)
set(failures "")

# Writes DATA/<name>.json with `from` replaced by `to`, runs the command on it, and looks for every line of standard
# error in the guide.
function(expect_quoted name from to status)
  file(READ "${DATA}/${name}.json" scene)
  string(REGEX REPLACE "${from}" "${to}" wrong "${scene}")
  if(wrong STREQUAL scene)
    message(FATAL_ERROR "${name}: nothing is ${from}")
  endif()
  file(MAKE_DIRECTORY "${FOLDER}")
  file(WRITE "${FOLDER}/${name}.json" "${wrong}")
  configure_file("${DATA}/${name}.csv" "${FOLDER}/${name}.csv" COPYONLY)
  execute_process(COMMAND "${TAUT}" ${ARGN} WORKING_DIRECTORY "${FOLDER}" RESULT_VARIABLE found OUTPUT_QUIET
                  ERROR_VARIABLE said)
  string(REGEX REPLACE "\n+$" "" said "${said}")
  if(PRINT)
    message("${name} (${found}): ${said}")
    return()
  endif()
  if(NOT found EQUAL status)
    set(failures "${failures}${name} without ${from}: status ${found} and not ${status}\n" PARENT_SCOPE)
  endif()
  if(said STREQUAL "")
    set(failures "${failures}${name} without ${from}: nothing is said\n" PARENT_SCOPE)
    return()
  endif()
  string(REPLACE "\n" "\n    " said "    ${said}")
  string(FIND "${guide}" "${said}\n" at)
  if(at EQUAL -1)
    set(failures "${failures}the guide does not quote\n${said}\n" PARENT_SCOPE)
  endif()
endfunction()

# Pinned struts in linear theory.
expect_quoted(beam_string_vertical ",[ \n]*\"second_order\".*$" " }\n" 0 check beam_string_vertical.json
              beam_string_vertical.csv)
expect_quoted(suspen_dome_one_rod ",[ \n]*\"second_order\".*$" " }\n" 0 check suspen_dome_one_rod.json
              suspen_dome_one_rod.csv)
# Too little friction for struts that are not on the bisector.
expect_quoted(beam_string_vertical "\"mu\": 0.2" "\"mu\": 0.1" 1 simulate beam_string_vertical.json
              beam_string_vertical.csv)
# A roof without bending stiffness.
expect_quoted(beam_string_radial "\"I\": 2.0e-3" "\"I\": 2.0e-3, \"hinges\": [\"h1\", \"h2\", \"h3\", \"h4\", \"h5\", \"h6\", \"h7\"]" 1 check
              beam_string_radial.json)
# A support that is forgotten.
expect_quoted(beam_string_radial "\"left\": \"xy\", \"right\": \"y\"" "\"left\": \"y\", \"right\": \"y\"" 2 check
              beam_string_radial.json)
# Megapascals.
expect_quoted(rigid_saddles "1.95e11" "195000" 2 check rigid_saddles.json)
# A wrong sign.
expect_quoted(condensed_roof "\\[569367910.6, " "[-569367910.6, " 2 check condensed_roof.json)
# The matrix of the thrust without the theory that needs it.
expect_quoted(condensed_roof ",[ \n]*\"second_order\".*$" " }\n" 0 check condensed_roof.json)

if(failures)
  message(FATAL_ERROR "${failures}")
endif()
