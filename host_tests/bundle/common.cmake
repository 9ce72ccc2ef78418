# What the tests of the bundle share. They are given BUNDLE, WORK, TAUT, PROGRAM, VERSION, CXX, WARNINGS.
include(${CMAKE_CURRENT_LIST_DIR}/../package/run_or_fail.cmake)
set(here ${CMAKE_CURRENT_LIST_DIR})
string(REPLACE "," ";" WARNINGS "${WARNINGS}")
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

# Sets `variable` to a tool, or ends the script where it is missing. ctest knows the message for that of a skipped test.
macro(need_tool variable)
  find_program(${variable} ${ARGN})
  if(NOT ${variable})
    message("skipped: needs ${ARGN}")
    return()
  endif()
endmacro()

# As the tools of Arduino call the compiler of a board with a Cortex-M4F.
set(for_board -std=gnu++17 -Os -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -fno-exceptions -fno-rtti -w
              -ffunction-sections -fdata-sections)

# Fails unless all files are there.
function(need_files folder)
  foreach(file IN LISTS ARGN)
    if(NOT EXISTS ${folder}/${file})
      message(FATAL_ERROR "${folder} has no ${file}")
    endif()
  endforeach()
endfunction()

# Fails unless both are the same.
function(need_equal what found expected)
  if(NOT found STREQUAL expected)
    message("found:\n${found}\nexpected:\n${expected}")
    message(FATAL_ERROR "${what}")
  endif()
endfunction()

# Whether the processor of this computer can fuse products and sums.
set(fuses OFF)
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo flags REGEX "^flags.* fma " LIMIT_COUNT 1)
  if(flags)
    set(fuses ON)
  endif()
endif()
