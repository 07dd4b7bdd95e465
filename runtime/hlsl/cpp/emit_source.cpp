// SPDX-License-Identifier: MIT
//
// The source that a library carries, as C++.
#include <kaamos/shader/abi.h>

#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/cpp/emitter.h"

namespace kaamos::hlsl {

std::string source_table(const ir::Module& module) {
  // Compilers read many short literals faster than one long one, and some reject long ones.
  constexpr size_t kLiteral = 4000;
  std::string out = "static const char source[] =\n";
  for (size_t at = 0; at < module.source.size(); at += kLiteral) {
    out += quote(std::string_view(module.source).substr(at, kLiteral)) + "\n";
  }
  return out + ";\n";
}

std::string emit_source(const ir::Module& module, const std::string& entry_point) {
  std::string out = "#include <kaamos/shader/abi.h>\nnamespace {\nnamespace unit_" + entry_point +
                    " {\nnamespace ks = kaamos::shader;\n" + source_table(module);
  out +=
      "const ks::LibraryDesc library = {.abi_version = ks::kAbiVersion, .struct_bytes = "
      "sizeof(ks::LibraryDesc), .name = " +
      quote(module.name) + ", .target = " + quote(module.target) +
      ", .flags = ks::kLibrarySource, .source = source, .source_bytes = sizeof(source) - 1};\n";
  return out + "}}\nextern \"C\" __attribute__((visibility(\"default\"))) const " +
         "kaamos::shader::LibraryDesc* " + entry_point + "() { return &unit_" + entry_point +
         "::library; }\n";
}

}  // namespace kaamos::hlsl
