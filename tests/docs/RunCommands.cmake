# cmake -DSCRIPT= -DMAKE_FRAMES= -DTOOL= -DSCENES= -DWORK= -P RunCommands.cmake
# Runs the docs' commands in a fresh WORK, with README.md's scene file as fog.json and docs/datasets.md's as haze.json.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
file(GLOB scene ${SCENES}/README.md.*.json)
file(COPY_FILE ${scene} ${WORK}/fog.json)
file(GLOB scene ${SCENES}/docs_datasets.md.*.json)
file(COPY_FILE ${scene} ${WORK}/haze.json)
get_filename_component(bin ${TOOL} DIRECTORY)
set(ENV{PATH} "${bin}:$ENV{PATH}")
set(ENV{OCIO} "")
# What is calibrated here is not to be kept for the user.
set(ENV{XDG_CACHE_HOME} ${WORK}/cache)
execute_process(COMMAND ${MAKE_FRAMES} ${WORK} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND sh -x ${SCRIPT} WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
foreach(file fogged/shot.0003.exr out/shot.0002.exr out/wide.exr out/aces.png out/layers.exr out/stats.json out/sky.exr
    set/fog.0004.png set/t.0004.png set.jsonl gold/shot.0003.exr new/report.xml new/report/index.html)
  if(NOT EXISTS ${WORK}/${file})
    message(FATAL_ERROR "${file} was not written")
  endif()
endforeach()
