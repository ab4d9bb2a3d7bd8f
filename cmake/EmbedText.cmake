# cmake -DOUTPUT=x.cpp -DNAMESPACE=brume -DFUNCTION=shader_text -DFILES=a;b -P EmbedText.cmake
# Writes a C++ file whose FUNCTION(name) returns the text of the file of that name.
set(cases "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND cases "    if (name == \"${name}\")\n        return R\"brume_text(${text})brume_text\";\n")
endforeach()
file(WRITE "${OUTPUT}" "#include <string_view>

namespace ${NAMESPACE} {

std::string_view ${FUNCTION}(std::string_view name)
{
${cases}    return {};
}

}  // namespace ${NAMESPACE}
")
