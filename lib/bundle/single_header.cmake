# Writes all that taut/device.hpp includes of taut into one header.
# cmake -D TAUT=folder -D VERSION=0.2.0 -D OUTPUT=taut_device.hpp -P single_header.cmake
cmake_minimum_required(VERSION 3.22)

# Appends a header of taut to `code`, after those that it includes, each once, and what it includes of the standard library to
# the global property `standard`.
function(append header)
  get_property(seen GLOBAL PROPERTY seen)
  if(header IN_LIST seen)
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY seen ${header})
  file(READ ${TAUT}/include/${header} own)
  string(REGEX REPLACE "#pragma once\n+" "" own "${own}")
  string(REGEX MATCHALL "#include [<\"][^>\"\n]+[>\"]\n" includes "${own}")
  foreach(include IN LISTS includes)
    if(include MATCHES "\"(taut/[^\"]+)\"")
      append(${CMAKE_MATCH_1})
    elseif(include MATCHES "<([a-z_]+)>")
      set_property(GLOBAL APPEND PROPERTY standard ${CMAKE_MATCH_1})
    else()
      message(FATAL_ERROR "include/${header} has ${include}which has no place in a header for devices")
    endif()
    string(REPLACE "${include}" "" own "${own}")
  endforeach()
  string(REGEX REPLACE "\n\n\n+" "\n\n" own "${own}")
  set(code "${code}// ---- ${header}\n${own}\n" PARENT_SCOPE)
endfunction()

# What device.hpp does itself goes around all of it.
file(READ ${TAUT}/include/taut/device.hpp device)
string(REGEX MATCH "^(//[^\n]*\n)+" introduction "${device}")
string(REGEX MATCHALL "#pragma push_macro[^\n]+\n" push "${device}")
string(REGEX MATCHALL "#undef [^\n]+\n" undefine "${device}")
string(REGEX MATCHALL "#pragma pop_macro[^\n]+\n" pop "${device}")
string(REGEX MATCHALL "\"taut/[^\"]+\"" parts "${device}")
list(JOIN push "" push)
list(JOIN undefine "" undefine)
list(JOIN pop "" pop)
if(NOT introduction OR NOT push OR NOT undefine OR NOT pop)
  message(FATAL_ERROR "include/taut/device.hpp is not built as lib/bundle/single_header.cmake takes it to be")
endif()
set(code "")
foreach(part IN LISTS parts)
  string(REPLACE "\"" "" part "${part}")
  append(${part})
endforeach()

get_property(standard GLOBAL PROPERTY standard)
list(REMOVE_DUPLICATES standard)
list(SORT standard)
list(TRANSFORM standard REPLACE "(.+)" "#include <\\1>\n")
list(JOIN standard "" standard)
file(READ ${TAUT}/LICENSE licence)
string(REGEX REPLACE "([^\n]*)\n" "// \\1\n" licence "${licence}")
string(REGEX REPLACE " +\n" "\n" licence "${licence}")

file(
  WRITE ${OUTPUT}
  "// taut ${VERSION} in one header. Made from taut/device.hpp: do not edit.
//
${introduction}//
${licence}#pragma once

#if __cplusplus < 201703L && (!defined(_MSVC_LANG) || _MSVC_LANG < 201703L)
#error \"taut is written in C++17: compile with -std=gnu++17\"
#endif

#define TAUT_DEVICE_HPP \"${VERSION}\"

${push}${undefine}
${standard}
// a * b + c must be rounded twice, also where the flags of a compiler cannot be set.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC push_options
#pragma GCC optimize(\"-ffp-contract=off\")
#endif

${code}#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC pop_options
#endif

${pop}")
