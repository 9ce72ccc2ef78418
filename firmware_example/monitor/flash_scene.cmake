# Makes flash_scene.hpp, which gives the namespace of an exported header the name that the application knows.
# cmake -D HEADER=exported.hpp -D OUTPUT=flash_scene.hpp -P flash_scene.cmake
file(READ ${HEADER} header)
if(NOT header MATCHES "\nnamespace ([A-Za-z_0-9]+) {\n")
  message(FATAL_ERROR "${HEADER} is no header that `taut export` wrote; export the scene again")
endif()
set(name ${CMAKE_MATCH_1})
if(NOT header MATCHES "make_condensed\\(float\\)")
  message(FATAL_ERROR "The scene in ${HEADER} cannot be condensed in float; `taut check` says what is stiff and soft")
endif()
if(NOT header MATCHES "make_knowledge\\(float\\)")
  message(FATAL_ERROR "${HEADER} is of an older `taut export`; export the scene again")
endif()
set(rows "nullptr")
if(header MATCHES "make_struts\\(float\\)")
  set(rows "&${name}::struts<float>")
endif()
get_filename_component(directory ${HEADER} ABSOLUTE)
file(
  CONFIGURE
  OUTPUT ${OUTPUT}
  CONTENT
    [[// The exported scene under the name that the application knows. Made by the build: do not edit.
#pragma once

#include "@directory@"

namespace monitor {

struct FlashScene {
  using Capacity = ::@name@::Capacity;
  static constexpr const ::taut::Condensed<float, Capacity>& model() { return ::@name@::condensed<float>; }
  static constexpr const ::taut::CondensedStruts<float, Capacity>* struts() { return @rows@; }
  static constexpr const ::taut::Knowledge<float, Capacity>& knowledge() { return ::@name@::knowledge<float>; }
  static constexpr int unknowns = ::@name@::unknowns;
  static constexpr const auto& cable_names() { return ::@name@::names::cables; }
};

}  // namespace monitor
]]
  @ONLY)
