// SPDX-License-Identifier: MIT
//
// The input of a check besides the source: the options of a library, and libraries that are linked.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/front/ast.h"

namespace kaamos::hlsl {

// `Name1,Name2=Internal` in -exports makes two exports of one function.
struct ExportRequest {
  std::vector<std::string> names;
  std::string function;  // as written in the source, or mangled
};

struct CheckOptions {
  std::string name;                // the main file's, for ir::Module::name
  std::string target = "lib_6_6";  // lib_6_3 .. lib_6_10, lib_6_x, cs_6_0 .. cs_6_10
  std::string entry_point;         // cs_6_x: the kernel's name
  std::vector<ExportRequest> exports;
  // If true, every non-static function with a body is exported. [-default-linkage external]
  bool external_linkage = false;
  uint32_t automatic_space = 0;  // for bindings without a register [-auto-binding-space]
  // Resources that nothing reads keep the registers that the source gives them, as before shader
  // model 5.1. [-flegacy-resource-reservation]
  bool reserve_unused = false;
  bool native_16bit = false;  // [-enable-16bit-types]
  bool row_major = false;     // [-Zpr]
  // Before HLSL 2021, logical operators and ?: work on vectors and always evaluate both sides.
  // [-HV]
  uint32_t hlsl_version = 2021;
  // True if payload access qualifiers take effect. [-enable-payload-qualifiers,
  // -disable-payload-qualifiers]
  bool payload_qualifiers = false;
  bool strict = false;    // what DXC refuses is an error, not a warning
  bool coverage = false;  // the code tells what ran: kCover, Module::coverage
};

// Libraries that call each other's functions, as one module.
struct LinkedUnit {
  struct Register {
    std::string binding;
    uint32_t index = 0;
    uint32_t space = 0;
  };
  const TranslationUnit* tree = nullptr;
  CheckOptions options;
  std::vector<Register> registers;  // of bindings that have none in the source
};
struct Link {
  // A function without a body in `unit`, and its definition, by their mangled names. That of the
  // definition is the export's.
  struct Definition {
    uint32_t unit = 0;
    std::string import;
    uint32_t from = 0;
    std::string definition;
  };
  std::vector<LinkedUnit> units;
  std::vector<std::string> entries;  // exports of the first unit that become entry points
  std::vector<Definition> definitions;
};
// The minor version of a target such as lib_6_3; lib_6_x has everything that is final.
inline uint32_t shader_model_minor(const std::string& target) {
  if (target.ends_with("_10")) return 10;
  const char digit = target.empty() ? 'x' : target.back();
  return digit >= '0' && digit <= '9' ? static_cast<uint32_t>(digit - '0') : 9;
}

}  // namespace kaamos::hlsl
