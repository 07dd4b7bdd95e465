// SPDX-License-Identifier: MIT
//
// Finds what a library exports, and by which names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/check/stages/stage_part.h"

namespace kaamos::hlsl {

// A function that a library exports by a name.
struct Exported {
  std::string name;
  std::string mangled;
  FunctionInfo* function;
};

class Exports : StagePart {
 public:
  using StagePart::StagePart;

  static bool has_stage(const FunctionInfo& function);
  std::vector<std::string> export_names(const FunctionInfo* function);
  std::vector<Exported> exported_functions(uint32_t unit);
};

}  // namespace kaamos::hlsl
