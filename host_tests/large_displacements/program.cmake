# Writes two scenes with their logs, and follows them: one to the end, one until a strut runs away.
function(follow name expected)
  execute_process(COMMAND "${PROGRAM}" --write ${name} "${FOLDER}" RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "--write ${name}: ${status}")
  endif()
  execute_process(
    COMMAND "${PROGRAM}" "${FOLDER}/${name}.json" "${FOLDER}/${name}.csv" -o "${FOLDER}/${name}.forces.csv" --steps 4
    RESULT_VARIABLE status
    ERROR_VARIABLE said)
  if(NOT status EQUAL expected)
    message(FATAL_ERROR "${name}: ${status} and not ${expected}: ${said}")
  endif()
  file(STRINGS "${FOLDER}/${name}.forces.csv" forces)
  file(STRINGS "${FOLDER}/${name}.csv" log)
  list(LENGTH forces rows)
  list(LENGTH log log_rows)
  if(expected EQUAL 0 AND NOT rows EQUAL log_rows)
    message(FATAL_ERROR "${name}: ${rows} lines for ${log_rows}")
  endif()
  if(expected EQUAL 1 AND NOT said MATCHES "^row ${rows}: no stable equilibrium")
    message(FATAL_ERROR "${name}: ${rows} lines, but it says: ${said}")
  endif()
endfunction()

follow(dome-hoop-2-jacked-0.1 0)
follow(beam-string-60-7-radial-0.05 1)
