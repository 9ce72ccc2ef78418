# Makes flash_scene.hpp, which gives the namespaces of exported headers names that the application knows.
# cmake -D "HEADERS=exported.hpp[;other.hpp]..." -D OUTPUT=flash_scene.hpp -P flash_scene.cmake
if(NOT HEADERS)
  message(FATAL_ERROR "flash_scene.cmake: give HEADERS")
endif()
set(includes "")
set(structs "")
set(sources "")
set(count 0)
foreach(HEADER IN LISTS HEADERS)
  file(STRINGS ${HEADER} lines
       REGEX "^namespace [A-Za-z_0-9]+ {$|^(struct|using) Capacity |make_[a-z]+\\(float\\)|^constexpr int strut_count")
  set(names)
  foreach(line IN LISTS lines)
    if(line MATCHES "^namespace ([A-Za-z_0-9]+) {$")
      set(namespace ${CMAKE_MATCH_1})
    elseif(line MATCHES "^(struct|using) Capacity ")
      # Of all namespaces only that of a scene has one.
      set(name ${namespace})
      list(APPEND names ${name})
      set(held_by_${name} "")
    else()
      string(APPEND held_by_${name} "${line}\n")
    endif()
  endforeach()
  if(NOT names)
    message(FATAL_ERROR "${HEADER} is no header that `taut export` wrote; export the scene again")
  endif()

  get_filename_component(header ${HEADER} ABSOLUTE)
  string(APPEND includes "#include \"${header}\"\n")
  set(types)
  foreach(name IN LISTS names)
    if(NOT held_by_${name} MATCHES "make_condensed\\(float\\)")
      message(FATAL_ERROR "The scene ${name} in ${HEADER} cannot be condensed in float; `taut check` says what is stiff and soft")
    endif()
    if(NOT held_by_${name} MATCHES "make_prior\\(float\\)")
      message(FATAL_ERROR "${HEADER} is of an older `taut export`; export the scene again")
    endif()
    set(rows "nullptr")
    if(held_by_${name} MATCHES "make_struts\\(float\\)")
      set(rows "&::${name}::struts<float>")
    endif()
    set(strokes "nullptr")
    set(stroke_count 0)
    if(held_by_${name} MATCHES "make_strokes\\(float\\)")
      set(strokes "::${name}::strokes<float>.items.data()")
      set(stroke_count "::${name}::strokes<float>.size()")
    endif()
    # Alone in a header, a scene fills its capacity.
    set(strut_count "Capacity::struts")
    if(held_by_${name} MATCHES "strut_count")
      set(strut_count "::${name}::strut_count")
    endif()
    set(type FlashScene)
    if(count GREATER 0)
      set(type FlashScene${count})
    endif()
    math(EXPR count "${count} + 1")
    list(APPEND types ${type})
    string(
      CONFIGURE
        [[struct @type@ {
  using Capacity = ::@name@::Capacity;
  using Model = std::decay_t<decltype(::@name@::condensed<float>)>;
  static constexpr const Model& model() { return ::@name@::condensed<float>; }
  static constexpr const Model::Struts* struts() { return @rows@; }
  static constexpr int strut_count = @strut_count@;
  static constexpr const ::taut::FrictionPrior<float, Capacity>& prior() { return ::@name@::prior<float>; }
  static constexpr auto strokes() { return @strokes@; }
  static constexpr int stroke_count = @stroke_count@;
  static constexpr int unknowns = ::@name@::unknowns, reading_unknowns = ::@name@::reading_unknowns;
  static constexpr const auto& cable_names() { return ::@name@::names::cables; }
};

]]
        struct
      @ONLY)
    string(APPEND structs "${struct}")
  endforeach()
  list(JOIN types ", " types)
  string(APPEND sources "Source<${types}>, ")
endforeach()
file(
  CONFIGURE
  OUTPUT ${OUTPUT}
  CONTENT
    [[// The exported scenes under names that the application knows. Made by the build: do not edit.
#pragma once

#include <type_traits>

@includes@
namespace monitor {

@structs@/// `All` of a Source for the scenes of every header, and of other sources.
template <template <class...> class All, template <class...> class Source, class... Others>
using OfFlashScenes = All<@sources@Others...>;

}  // namespace monitor
]]
  @ONLY)
