# cmake -DSOURCE= -DBUILD= -DWORK= -DGENERATOR= -DC_COMPILER= -DCXX_COMPILER= -P InstalledSdk.cmake
# Installs the SDK into WORK and builds and runs the samples against it as strangers do: nothing of the build tree is seen. With
# -DCLANG=ON, afterwards, what of it the other compiler is to take.
set(sdk ${WORK}/sdk)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}\nstatus ${result}\n${output}")
  endif()
  message("${output}")
endfunction()

function(build name source)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${source} -B ${WORK}/${name} -DCMAKE_PREFIX_PATH=${sdk}
    -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER})
  run(${CMAKE_COMMAND} --build ${WORK}/${name})
endfunction()

if(CLANG)
  find_program(CLANG_CXX NAMES clang++-16 clang++-17 clang++-18 clang++-19)
  if(NOT CLANG_CXX)
    message("not done: no clang++-16 to -19 is here")
    return()
  endif()
  # The maths are vector extensions and pragmas too: they are to compile as they are.
  run(${CLANG_CXX} -std=c++20 -Wall -Wextra -Werror -I${sdk}/include ${SOURCE}/tests/abi/installed/use_maths.cpp
    -o ${WORK}/use_maths_clang -lm)
  run(${WORK}/use_maths_clang)
  file(WRITE ${WORK}/lanes.cpp "#include <brume/maths/lanes.hpp>\n")
  run(${CLANG_CXX} -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I${sdk}/include ${WORK}/lanes.cpp)
  # So it is with the sample effects.
  string(REPLACE "clang++" "clang" C_COMPILER ${CLANG_CXX})
  set(CXX_COMPILER ${CLANG_CXX})
  build(third_party_plugin_clang ${SOURCE}/samples/third_party_plugin)
  run(${WORK}/load_effect/load_effect ${sdk} ${WORK}/third_party_plugin_clang)
  return()
endif()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
foreach(component runtime development)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${sdk} --component ${component})
endforeach()

build(minimal_c ${SOURCE}/samples/minimal_c)
run(${WORK}/minimal_c/minimal_c ${WORK}/by_cmake.ppm)

file(GLOB_RECURSE package ${sdk}/brume.pc)
get_filename_component(package_directory ${package} DIRECTORY)
get_filename_component(library_directory ${package_directory} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${package_directory})
find_program(PKG_CONFIG pkg-config REQUIRED)
# The file was configured for another prefix than this one.
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs brume OUTPUT_VARIABLE flags
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
run(${C_COMPILER} -std=c99 -Wall -Wextra -Wpedantic -Werror ${SOURCE}/samples/minimal_c/main.c -o ${WORK}/by_pkg_config
  ${flags} -lm -Wl,-rpath,${library_directory})
run(${WORK}/by_pkg_config ${WORK}/by_pkg_config.ppm)
run(${CMAKE_COMMAND} -E compare_files ${WORK}/by_cmake.ppm ${WORK}/by_pkg_config.ppm)

# Both pictures are in the file, and the lower differs from the upper.
file(SIZE ${WORK}/by_cmake.ppm size)
if(NOT size EQUAL 345615)
  message(FATAL_ERROR "by_cmake.ppm has ${size} bytes; expected a header of 15 and 320 x 360 pixels")
endif()
file(READ ${WORK}/by_cmake.ppm before OFFSET 15 LIMIT 172800 HEX)
file(READ ${WORK}/by_cmake.ppm after OFFSET 172815 LIMIT 172800 HEX)
if(before STREQUAL after)
  message(FATAL_ERROR "by_cmake.ppm: there is no fog")
endif()

build(third_party_plugin ${SOURCE}/samples/third_party_plugin)
build(load_effect ${SOURCE}/tests/abi/installed)
run(${WORK}/load_effect/load_effect ${sdk} ${WORK}/third_party_plugin)
run(${WORK}/load_effect/use_maths)

# The example of the page, by the lines that the page has for it.
file(MAKE_DIRECTORY ${WORK}/gain)
foreach(kind_file cpp:gain.cpp cmake:CMakeLists.txt)
  string(REGEX MATCH "(.*):(.*)" matched ${kind_file})
  run(${CMAKE_COMMAND} -DPAGES=${SOURCE}/docs/plugins.md -DKIND=${CMAKE_MATCH_1} -DDIRECTORY=${WORK}/blocks
    -P ${SOURCE}/tests/docs/Extract.cmake)
  file(GLOB block ${WORK}/blocks/*)
  file(COPY_FILE ${block} ${WORK}/gain/${CMAKE_MATCH_2})
endforeach()
build(gain/build ${WORK}/gain)
run(${WORK}/load_effect/load_effect ${sdk} ${WORK}/gain/build gain)
