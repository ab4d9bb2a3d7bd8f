# Installation: headers, library, effects, CMake package, pkg-config file; cmake/Debian.cmake makes packages of it.
include(CMakePackageConfigHelpers)
install(TARGETS brume EXPORT brume-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development)
install(DIRECTORY sdk/include/brume DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
# The maths, for effects that compute as these do: GLSL that is C++ too, in brume/maths/, target brume::maths.
file(GLOB maths CONFIGURE_DEPENDS shaders/*.hpp shaders/*.inc)
install(FILES ${maths} LICENSE DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/brume/maths COMPONENT development)
install(DIRECTORY shaders/lib DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/brume/maths COMPONENT development)
install(EXPORT brume-targets NAMESPACE brume:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brume COMPONENT development)
configure_package_config_file(cmake/brume-config.cmake.in ${PROJECT_BINARY_DIR}/brume-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brume PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/brume-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/BrumeEmbed.cmake cmake/EmbedText.cmake ${PROJECT_BINARY_DIR}/brume-config.cmake ${PROJECT_BINARY_DIR}/brume-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brume COMPONENT development)
# Relative, so that `cmake --install --prefix` and the .deb may put it anywhere.
file(RELATIVE_PATH BRUME_PREFIX_FROM_PC /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/brume.pc.in ${PROJECT_BINARY_DIR}/brume.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/brume.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
if(BRUME_DEBIAN)
  include(cmake/Debian.cmake)
else()
  install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
endif()
