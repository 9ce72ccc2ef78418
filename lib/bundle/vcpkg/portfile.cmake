# taut for vcpkg, as an overlay port: its sources lie beside this file, nothing is downloaded.
set(VCPKG_BUILD_TYPE release) # headers only

vcpkg_cmake_configure(
  SOURCE_PATH "${CURRENT_PORT_DIR}/source"
  OPTIONS -DTAUT_BUILD_PROGRAM=OFF -DTAUT_BUILD_TESTS=OFF -DTAUT_BUILD_EXAMPLES=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/taut)

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/doc" "${CURRENT_PACKAGES_DIR}/share/cmake")
file(INSTALL "${CURRENT_PORT_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${CURRENT_PORT_DIR}/source/LICENSE")
