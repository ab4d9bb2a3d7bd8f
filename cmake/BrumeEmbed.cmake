# Part of the installed package, for effects of others.

# brume_embed(TARGET NAMESPACE FUNCTION FILES...): the files' texts, embedded into TARGET: std::string_view FUNCTION(std::string_view
# name) of NAMESPACE gives that of the file of a name.
function(brume_embed target namespace function)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_${function}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DNAMESPACE=${namespace} -DFUNCTION=${function} "-DFILES=${ARGN}"
            -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedText.cmake
    DEPENDS ${ARGN} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedText.cmake VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
