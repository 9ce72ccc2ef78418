# Runs a command; if it fails, the test ends with the command and its output.
function(run_or_fail)
  execute_process(
    COMMAND ${ARGN}
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message("${command}\n${output}") # by itself, for an error message would be wrapped
    message(FATAL_ERROR "the command above ended with: ${result}")
  endif()
endfunction()
