# How taut's own programs and tests are compiled. Nothing of this reaches a project that uses taut.
include_guard(GLOBAL)

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release) # without optimisation Eigen is slower by a factor of ten or more
endif()

if(NOT DEFINED CMAKE_CXX_STANDARD)
  set(CMAKE_CXX_STANDARD 17) # what does not link taut::taut would get the compiler's own
endif()
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}) # build/host/taut, not build/host/lib/taut

# The warnings of the house, for private use by every target. GCC leaves signs out of -Wconversion, Clang does not: there
# taut's headers are compiled with them (package.headers_clang), its own programs and tests are not.
set(TAUT_WARNINGS -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Werror)
add_library(taut_warnings INTERFACE)
target_compile_options(taut_warnings INTERFACE ${TAUT_WARNINGS}
                                               $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-sign-conversion>)

# GCC looks for memory that it no longer needs from 128 MB on, again and again, a tenth of its time; the largest files take
# more than this in any case.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("SHELL:--param ggc-min-heapsize=500000")
endif()

# What most files of a target include is parsed once. A compiler cache would have to leave such files alone, and clang-tidy
# cannot read what GCC has parsed.
set(TAUT_PRECOMPILED OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CXX_COMPILER_LAUNCHER AND NOT TAUT_CLANG_TIDY)
  set(TAUT_PRECOMPILED ON)
endif()
# By default all of it would count as headers of the system, of which nobody sees the warnings.
set(CMAKE_PCH_PROLOGUE "")

if(TAUT_SANITIZE)
  # For the whole build: code with and without address checks must not be mixed. A null pointer crashes by itself, and what
  # lies outside an object is found by its address; GCC looks for all of that a second time, at every access to a member or
  # an element, which takes half of the build.
  set(checks -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND checks -fno-sanitize=null,alignment,object-size,pointer-overflow)
  endif()
  add_compile_options(${checks})
  add_link_options(-fsanitize=address,undefined)
endif()

if(TAUT_CLANG_TIDY)
  find_program(TAUT_CLANG_TIDY_COMMAND clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${TAUT_CLANG_TIDY_COMMAND} --quiet)
endif()
