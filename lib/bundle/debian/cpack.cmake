# What CPack makes the package of: the folder that make_bundle.cmake has filled.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME taut)
set(CPACK_PACKAGE_FILE_NAME taut-@VERSION@)
set(CPACK_PACKAGE_VERSION @VERSION@)
set(CPACK_PACKAGE_VENDOR "The taut authors")
set(CPACK_PACKAGE_CONTACT "The taut authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "forces in the cables of a structure while they are tensioned")
set(CPACK_PACKAGE_DESCRIPTION
    "taut follows friction at struts and saddles through stick and slip, and gives the force in every segment of every
 cable its standard deviation. The program, and the headers for C++17.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS libeigen3-dev)
# Where its tool is missing the package says nothing of the libraries that the program needs.
find_program(shlibdeps dpkg-shlibdeps)
if(shlibdeps)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_INSTALLED_DIRECTORIES "@STAGE@;/")
set(CPACK_SET_DESTDIR ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /)
set(CPACK_STRIP_FILES usr/bin/taut)
set(CPACK_PACKAGE_DIRECTORY "@WORK@")
