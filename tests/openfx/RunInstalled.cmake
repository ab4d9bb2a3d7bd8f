# cmake -DSCRIPT= -DBUILD= -DHOST= -DWORK= -P RunInstalled.cmake
# Runs the page's commands with a home of their own, on this build.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/build)
file(CREATE_LINK ${BUILD} ${WORK}/build/release SYMBOLIC)
set(ENV{HOME} ${WORK})
set(ENV{HOST} ${HOST})
execute_process(COMMAND sh -x ${SCRIPT} WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
