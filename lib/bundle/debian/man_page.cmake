# Writes the man page of the program, with the commands and options that it says itself that it has.
# cmake -D PROGRAM=taut -D VERSION=0.2.0 -D DATE=2026-01-31 -D OUTPUT=taut.1 -P man_page.cmake
cmake_minimum_required(VERSION 3.22)

# Sets `lines` to what the program says to --help. What a list of CMake does not bear is in other letters until the end.
macro(ask)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE lines RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} ${ARGN} --help ended with: ${status}")
  endif()
  string(REPLACE "\\" "\\e" lines "${lines}")
  string(REPLACE ";" "<semicolon>" lines "${lines}")
  string(REPLACE "[" "<left>" lines "${lines}")
  string(REPLACE "]" "<right>" lines "${lines}")
  string(REPLACE "\n" ";" lines "${lines}")
endmacro()

# Appends to `page` the paragraphs of the lines that say what an argument, an option or a command is.
macro(append_entries)
  foreach(line IN LISTS lines)
    if(line MATCHES "^  ([^ ].*[^ ])   *([^ ].*)$")
      set(entry "${CMAKE_MATCH_1}")
      set(meaning "${CMAKE_MATCH_2}")
    elseif(line MATCHES "^  ([^ ].*[^ ]) *$")
      set(entry "${CMAKE_MATCH_1}")
      set(meaning "")
    elseif(line MATCHES "^      +([^ ].*)$")
      string(APPEND page "${CMAKE_MATCH_1}\n")
      continue()
    else()
      continue()
    endif()
    # Of the types that the program names, what one would write.
    string(REGEX MATCH "^[^ ]+" name "${entry}")
    if(entry MATCHES "{(.*)}")
      string(REPLACE "," "|" values "${CMAKE_MATCH_1}")
      set(entry "${name} ${values}")
    elseif(name MATCHES "^-" AND entry MATCHES " INT| FLOAT")
      set(entry "${name} NUMBER")
    elseif(name MATCHES "^-" AND entry MATCHES " TEXT")
      set(entry "${name} TEXT")
    else()
      set(entry "${name}")
    endif()
    string(REPLACE "-" "\\-" entry "${entry}")
    string(APPEND page ".TP\n.B ${entry}\n")
    if(meaning)
      string(APPEND page "${meaning}\n")
    endif()
  endforeach()
endmacro()

set(page
    ".TH TAUT 1 ${DATE} \"taut ${VERSION}\" \"User Commands\"
.SH NAME
taut \\- forces in the cables of a structure while they are tensioned
.SH SYNOPSIS
.B taut
.I COMMAND
.RI [ OPTION \\|.\\|.\\|.]
.I SCENE
.RI [ LOG ]
.SH DESCRIPTION
From the loads of the jacks
.B taut
finds the force in every segment of every cable, through friction at struts and saddles that stick and slip, with its
standard deviation. A scene is a structure as JSON, a log is a table of readings as CSV.
.SH COMMANDS
")
ask()
set(commands)
list(FILTER lines INCLUDE REGEX "^  <?[a-z]")
append_entries()
foreach(line IN LISTS lines)
  string(REGEX MATCH "[a-z]+" command "${line}")
  list(APPEND commands ${command})
endforeach()
if(NOT "estimate" IN_LIST commands)
  message(FATAL_ERROR "${PROGRAM} --help does not list its commands as lib/bundle/debian/man_page.cmake takes them to be")
endif()
foreach(command IN LISTS commands)
  ask(${command})
  string(TOUPPER ${command} title)
  string(APPEND page ".SH \"OPTIONS OF ${title}\"\n")
  append_entries()
endforeach()
string(APPEND page ".SH \"EXIT STATUS\"
.TP
.B 0
done
.TP
.B 1
the scene has no answer somewhere
.TP
.B 2
input that cannot be used; the message names the file, the place in it, and what would be right
.SH EXAMPLES
.TP
.B taut template scene.json \\-o log.csv
the header of a log, to be filled with readings
.TP
.B taut estimate scene.json log.csv
forces with standard deviations, row by row
.TP
.B taut export scene.json \\-o scene.hpp \\-\\-c jack
the same for firmware, in C++ and in C
.SH SEE ALSO
.I /usr/share/doc/taut
")
string(REPLACE "<semicolon>" ";" page "${page}")
string(REPLACE "<left>" "[" page "${page}")
string(REPLACE "<right>" "]" page "${page}")
file(WRITE ${OUTPUT} "${page}")
