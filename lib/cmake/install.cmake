# What `cmake --install` puts into place of the headers: with it find_package(taut) works.
# The program is installed by lib/CMakeLists.txt.
include_guard(GLOBAL)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(taut_package_dir ${CMAKE_INSTALL_DATADIR}/cmake/taut) # headers are the same for every architecture

write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/tautConfigVersion.cmake
  COMPATIBILITY SameMinorVersion
  ARCH_INDEPENDENT)

install(TARGETS taut EXPORT tautTargets)
install(
  EXPORT tautTargets
  NAMESPACE taut::
  DESTINATION ${taut_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/lib/cmake/tautConfig.cmake ${PROJECT_BINARY_DIR}/tautConfigVersion.cmake
        DESTINATION ${taut_package_dir})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/taut DESTINATION include)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
