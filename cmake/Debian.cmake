# The .debs, one for each component: `./run packages` makes, checks and tries them.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGE_NAME brume)
set(CPACK_PACKAGE_VENDOR "The Brume authors")
# Else it goes before each description, which has a line of its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_PACKAGE_CONTACT "${BRUME_DEBIAN_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# Whatever the umask of who makes them.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SOURCE brume)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(BRUME_DEBIAN_VERSION ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
string(TIMESTAMP BRUME_DEBIAN_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)

get_target_property(BRUME_SOVERSION brume SOVERSION)
math(EXPR BRUME_NEXT_MINOR "${PROJECT_VERSION_MINOR} + 1")
set(library libbrume${BRUME_SOVERSION})
set(same "(= ${BRUME_DEBIAN_VERSION})")

file(READ ${PROJECT_SOURCE_DIR}/LICENSE BRUME_DEBIAN_LICENCE)
string(REGEX REPLACE "^.*All rights reserved\\.\n+" "" BRUME_DEBIAN_LICENCE "${BRUME_DEBIAN_LICENCE}")
string(STRIP "${BRUME_DEBIAN_LICENCE}" BRUME_DEBIAN_LICENCE)
string(REPLACE "\n\n" "\n.\n" BRUME_DEBIAN_LICENCE "${BRUME_DEBIAN_LICENCE}")
string(REPLACE "\n" "\n " BRUME_DEBIAN_LICENCE " ${BRUME_DEBIAN_LICENCE}")
set(made ${CMAKE_BINARY_DIR}/debian)
foreach(file changelog copyright shlibs)
  configure_file(cmake/debian/${file}.in ${made}/${file} @ONLY)
endforeach()
find_program(GZIP gzip REQUIRED)
execute_process(COMMAND ${GZIP} -9nc ${made}/changelog OUTPUT_FILE ${made}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${GZIP} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md OUTPUT_FILE ${made}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS CHANGELOG.md LICENSE)

set(CPACK_COMPONENTS_ALL "")
# brume_deb(COMPONENT PACKAGE SECTION DEPENDS DESCRIPTION): its line and what follows it.
macro(brume_deb component package section depends description)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}")
  install(FILES ${made}/copyright ${made}/changelog.Debian.gz ${made}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endmacro()

brume_deb(runtime ${library} libs "" "fog for finished HDR images, library
Brume puts fog into finished pictures: an HDR image and the distance to what
each pixel shows become the picture that a camera in the medium would take,
with multiple scattering and the airlight of lamps, on the CPU and on OpenGL.
.
This package has the shared library and its effects.")
# Before 1.0 a minor version may change structs, which versions of symbols, in a symbols file, would not tell.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${made}/shlibs ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
# OpenGL is loaded by name.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS libegl1)
brume_deb(development libbrume-dev libdevel "${library} ${same}" "fog for finished HDR images, development files
Headers, CMake package and pkg-config file of the library Brume, the maths of
its effects as GLSL that is C++ too, its documentation, and sample programs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS libglm-dev)
brume_deb(tool brume graphics "${library} ${same}" "fog for finished HDR images, command
The command brume puts fog into sequences of OpenEXR frames with depth, says
beforehand what would run and what it costs, and compares pictures for golden
tests. Pictures of other formats, previews and contact sheets need
brume-image.")
set(CPACK_DEBIAN_TOOL_PACKAGE_RECOMMENDS brume-image)
brume_deb(image brume-image graphics "brume ${same}" "fog for finished HDR images, picture formats
The module by which the command brume reads and writes TIFF, PNG, JPEG, DPX,
HDR and other pictures that are no OpenEXR files. It stands on OpenImageIO.")
brume_deb(python python3-brume python "python3, python3-numpy, ${library} ${same}" "fog for finished HDR images, Python package
Fogs numpy arrays without copying them, by scenes that are Python's own dicts,
and compares pictures with golden ones in pytest.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/python3-brume/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/python3-brume/prerm)
brume_deb(blender brume-blender graphics "brume (>= ${PROJECT_VERSION})" "fog for finished HDR images, Blender add-on
Fogs what Blender renders, frame by frame as it is written or a folder of
frames afterwards, and exports shots as scene files of the command brume.")
set(CPACK_DEBIAN_BLENDER_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_BLENDER_PACKAGE_ENHANCES blender)
if(TARGET openfx)
  brume_deb(openfx brume-openfx graphics "" "fog for finished HDR images, OpenFX plugin
Fogs pictures in hosts of OpenFX plugins, as compositing programs are.")
endif()

# For who writes programs.
file(GLOB pages docs/*.md)
install(FILES README.md ${pages} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libbrume-dev COMPONENT development)
install(DIRECTORY samples/minimal_c samples/gl_texture samples/ogre samples/osg samples/third_party_plugin
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libbrume-dev/examples COMPONENT development)
include(CPack)
