# Completion in bash offers the commands, the options of each, values and files.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
need_tool(bash bash)
file(WRITE ${WORK}/scene.json "{}")
get_filename_component(folder ${PROGRAM} DIRECTORY)
file(WRITE ${WORK}/ask [[
set -euo pipefail
source "$1"
complete -p taut >/dev/null
PATH=$2:$PATH
shift 2
COMP_WORDS=(taut "$@")
COMP_CWORD=$#
_taut
printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ' '
]])
function(expect expected)
  execute_process(COMMAND ${bash} ${WORK}/ask ${TAUT}/lib/bundle/debian/taut.bash ${folder} ${ARGN} WORKING_DIRECTORY ${WORK}
                  OUTPUT_VARIABLE said ERROR_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE)
  need_equal("taut ${ARGN} is completed otherwise" "${said}" "${expected}")
endfunction()
expect("estimate export" e)
expect("simulate" sim)
expect("--version" --v)
expect("--state" estimate scene.json log.csv --st)
expect("--c" export scene.json -o scene.hpp --c)
expect("double" simulate --scalar d)
expect("stepwise" simulate --method s)
expect("scene.json" check sc)
expect("" check --no-such-option)
