# cmake -DNM= -DLIBRARY= -DLIST= -P CheckSymbols.cmake: LIBRARY exports the symbols in LIST and no others.
execute_process(COMMAND ${NM} -D --defined-only --format=posix ${LIBRARY}
  OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${output}")
set(exported "")
foreach(line IN LISTS lines)
  # A is the version itself, as the linker script names it; u are statics of the standard library's inline functions,
  # which are unique in a process whatever the visibility.
  if(line MATCHES "^([^ @]+)[^ ]* ([^Au])")
    list(APPEND exported ${CMAKE_MATCH_1})
  endif()
endforeach()
list(SORT exported)
file(STRINGS ${LIST} expected)
list(SORT expected)
if(NOT exported STREQUAL expected)
  set(added ${exported})
  list(REMOVE_ITEM added ${expected})
  set(missing ${expected})
  list(REMOVE_ITEM missing ${exported})
  message(FATAL_ERROR "${LIBRARY}\nexported but not in ${LIST}: ${added}\nin it but not exported: ${missing}")
endif()
