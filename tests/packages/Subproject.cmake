# cmake -DSOURCE= -DWORK= -DGENERATOR= -DC_COMPILER= -DCXX_COMPILER= [-DWHOLE=ON] -P Subproject.cmake
# Configures the project in subproject/, which takes Brume's source tree as a part of itself, and builds and runs its program that needs
# nothing compiled of it; WHOLE: all, the library and its effects anew. `./run packages` does.
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}\nstatus ${result}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/tests/packages/subproject -B ${WORK}/build -DBRUME_SOURCE=${SOURCE}
  -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER})
run(${CMAKE_COMMAND} --build ${WORK}/build --target use_maths)
run(${WORK}/build/use_maths)
if(WHOLE)
  run(${CMAKE_COMMAND} --build ${WORK}/build)
  run(${WORK}/build/minimal_c ${WORK}/fog.ppm)
  run(${CMAKE_COMMAND} --install ${WORK}/build --prefix ${WORK}/installed)
  if(NOT EXISTS ${WORK}/installed/bin/minimal_c)
    message(FATAL_ERROR "minimal_c is not installed")
  endif()
endif()
