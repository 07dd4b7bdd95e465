# SPDX-License-Identifier: MIT
# kaamos_embed_texts(TARGET NAME file...): makes the files part of a library, as the array kaamos::hlsl::NAME of
# pairs of a file's name and its text, up to a pair of empty ones. The build runs this file as a script for it.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  set(type "const std::pair<std::string_view, std::string_view> ${NAME}[]")
  set(code "#include <string_view>\n#include <utility>\n\nnamespace kaamos::hlsl {\n")
  string(APPEND code "using namespace std::string_view_literals;\nextern ${type};\nconstinit ${type} = {\n")
  foreach(file IN LISTS FILES)
    file(READ "${file}" text)
    get_filename_component(name "${file}" NAME)
    string(APPEND code "{\"${name}\"sv, R\"KAAMOS_TEXT(${text})KAAMOS_TEXT\"sv},\n")
  endforeach()
  string(APPEND code "{}};\n}  // namespace kaamos::hlsl\n")
  file(WRITE "${OUTPUT}" "${code}")
  return()
endif()
include_guard()

function(kaamos_embed_texts target name)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
  add_custom_command(OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} -D "OUTPUT=${output}" -D "NAME=${name}" -D "FILES=${ARGN}" -P "${CMAKE_CURRENT_FUNCTION_LIST_FILE}"
    DEPENDS ${ARGN} "${CMAKE_CURRENT_FUNCTION_LIST_FILE}" VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
