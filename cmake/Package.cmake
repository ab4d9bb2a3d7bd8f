# Installation: headers, library, effects, CMake package, pkg-config file; CPack makes the .deb.
include(CMakePackageConfigHelpers)
install(TARGETS brume EXPORT brume-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development)
install(DIRECTORY sdk/include/brume DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
# The maths, for effects that compute as these do: GLSL that is C++ too, in brume/maths/, target brume::maths.
file(GLOB maths CONFIGURE_DEPENDS shaders/*.hpp shaders/*.inc)
install(FILES ${maths} LICENSE DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/brume/maths COMPONENT development)
install(DIRECTORY shaders/lib DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/brume/maths COMPONENT development)
install(EXPORT brume-targets NAMESPACE brume:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brume COMPONENT development)
configure_package_config_file(cmake/brume-config.cmake.in ${CMAKE_BINARY_DIR}/brume-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brume PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/brume-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/BrumeEmbed.cmake cmake/EmbedText.cmake ${CMAKE_BINARY_DIR}/brume-config.cmake ${CMAKE_BINARY_DIR}/brume-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brume COMPONENT development)
# Relative, so that `cmake --install --prefix` and the .deb may put it anywhere.
file(RELATIVE_PATH BRUME_PREFIX_FROM_PC /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/brume.pc.in ${CMAKE_BINARY_DIR}/brume.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/brume.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME brume)
set(CPACK_PACKAGE_CONTACT "The Brume authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
include(CPack)
