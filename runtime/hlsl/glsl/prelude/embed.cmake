# SPDX-License-Identifier: MIT
# cmake -D OUTPUT=file.cpp -D "INPUTS=a.glsl;b.glsl" -P embed.cmake: the texts as C++ strings.
set(code "// Generated from runtime/hlsl/glsl/prelude/*.glsl\n#include <string_view>\n\nnamespace kaamos::hlsl {\n")
string(APPEND code "extern const std::string_view kGlslPreludeSources[];\n")
string(APPEND code "const std::string_view kGlslPreludeSources[] = {\n")
foreach(input IN LISTS INPUTS)
  file(READ "${input}" text)
  string(APPEND code "R\"GLSL(${text})GLSL\",\n")
endforeach()
string(APPEND code "std::string_view()};\n}  // namespace kaamos::hlsl\n")
file(WRITE "${OUTPUT}" "${code}")
