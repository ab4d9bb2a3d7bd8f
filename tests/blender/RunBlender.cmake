# cmake -DBLENDER= -DWORK= -DTOOL= -DADDON= -DSCRIPT= -P RunBlender.cmake
# Runs the script in a Blender that knows no user: its settings and add-ons are in WORK.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/config ${WORK}/scripts)
set(ENV{BLENDER_USER_CONFIG} ${WORK}/config)
set(ENV{BLENDER_USER_SCRIPTS} ${WORK}/scripts)
set(ENV{PYTHONDONTWRITEBYTECODE} 1)
set(ENV{BRUME_WORK} ${WORK})
set(ENV{BRUME_TOOL} ${TOOL})
set(ENV{BRUME_ADDON} ${ADDON})
set(ENV{OCIO} "")
execute_process(COMMAND ${BLENDER} -b --factory-startup --python-exit-code 3 -P ${SCRIPT} RESULT_VARIABLE result
  OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT result EQUAL 0)
  string(REGEX REPLACE "\n(Fra:|Saved:| Time:)[^\n]*" "" said "${said}")
  message(FATAL_ERROR "status ${result}\n${said}")
endif()
