# What scripts ask of result files.

# Rows behind the header; 0 if there is no file.
function(rows_of file to)
  set(rows 0)
  if(EXISTS ${file})
    file(STRINGS ${file} lines)
    list(LENGTH lines rows)
    math(EXPR rows "${rows} - 1")
  endif()
  set(${to} ${rows} PARENT_SCOPE)
endfunction()

# Columns of displacements, separated by commas: as many as a run of taut gives at once.
function(displacement_columns_of file to)
  file(STRINGS ${file} header LIMIT_COUNT 1)
  string(REPLACE "," ";" header "${header}")
  list(FILTER header INCLUDE REGEX "\\.[xyz]$")
  list(SUBLIST header 0 48 header)
  list(JOIN header "," header)
  set(${to} "${header}" PARENT_SCOPE)
endfunction()
