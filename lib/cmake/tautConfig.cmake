# Finds what taut needs and gives the target taut::taut.
if(NOT TARGET Eigen3::Eigen)
  # Without a version: Eigen 5 calls itself incompatible with 3.4 and the other way round, but taut takes both.
  find_package(Eigen3 CONFIG QUIET)
  if(NOT Eigen3_FOUND OR Eigen3_VERSION VERSION_LESS 3.4)
    set(taut_FOUND FALSE)
    set(taut_NOT_FOUND_MESSAGE "taut needs Eigen 3.4 or 5")
    return()
  endif()
endif()

include(${CMAKE_CURRENT_LIST_DIR}/tautTargets.cmake)
