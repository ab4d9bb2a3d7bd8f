# cmake -DBUILD= -DWORK= -DPYTHON= -DPYTHON_DIR= -P Installed.cmake
# Installed anywhere, the package finds the library that was installed with it.
file(REMOVE_RECURSE ${WORK})
foreach(component runtime python)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/sdk --component ${component} OUTPUT_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
set(ENV{PYTHONPATH} ${WORK}/sdk/${PYTHON_DIR})
set(ENV{PYTHONDONTWRITEBYTECODE} 1)
execute_process(COMMAND ${PYTHON} -c "
import numpy, brume
print(brume.load())
fogged = brume.fog(numpy.ones((9, 16, 3), 'f'), numpy.full((9, 16), 30, 'f'), {'camera': {'vertical_fov': 50}, 'medium': {'absorption': 0.1}}, backend='cpu')
assert fogged.max() < 0.1, fogged
" WORKING_DIRECTORY ${WORK} OUTPUT_VARIABLE path COMMAND_ERROR_IS_FATAL ANY)
if(NOT path MATCHES "^${WORK}/sdk/")
  message(FATAL_ERROR "the library is ${path}; expected that of ${WORK}/sdk")
endif()
