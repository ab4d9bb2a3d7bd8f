# Functions that the library, its plugins and the tests share.

include(${CMAKE_CURRENT_LIST_DIR}/BrumeEmbed.cmake)

# brume_check_shader(TARGET FILE [DEFINES...]): the pass goes through glslangValidator at build time, preceded by what the
# host puts before it, with these NAME=VALUE and its includes from shaders/lib. Once for every set that is in use.
function(brume_check_shader target file)
  string(MAKE_C_IDENTIFIER "${file} ${ARGN}" name)
  string(REGEX REPLACE ".*passes_" "" name ${name})
  set(stamp ${CMAKE_CURRENT_BINARY_DIR}/${name}.checked)
  add_custom_command(OUTPUT ${stamp}
    COMMAND ${CMAKE_COMMAND} -DVALIDATOR=${GLSLANG_VALIDATOR} -DLIB=${PROJECT_SOURCE_DIR}/shaders/lib -DFILE=${file}
            "-DDEFINES=${ARGN}" -DSTAMP=${stamp} -P ${PROJECT_SOURCE_DIR}/cmake/CheckShader.cmake
    DEPENDS ${file} ${BRUME_SHADER_LIB} ${PROJECT_SOURCE_DIR}/cmake/CheckShader.cmake VERBATIM)
  target_sources(${target} PRIVATE ${stamp})
endfunction()

# An effect: a module in lib/brume/ that sees the public headers only.
function(brume_add_effect name)
  add_library(${name} MODULE ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/sdk/include ${PROJECT_SOURCE_DIR}/shaders
                             ${PROJECT_SOURCE_DIR}/plugins)
  # Template statics of the standard library would otherwise be unique symbols, which keep a plugin from unloading.
  target_link_options(${name} PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/effect.map)
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/brume
    LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/effect.map
    CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  add_dependencies(effects ${name})
  install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/brume COMPONENT runtime)
endfunction()
