// SPDX-License-Identifier: MIT
//
// Functions without a body: what a library by itself knows of them, and their definitions where
// several libraries are linked.
#pragma once

#include "runtime/hlsl/check/stages/exports.h"
#include "runtime/hlsl/check/stages/stage_part.h"

namespace kaamos::hlsl {

class Imports : StagePart {
 public:
  Imports(Program& program, Lowerer& lowerer, Exports& exports)
      : StagePart(program, lowerer), exports_(exports) {}

  bool is_importable(const FunctionInfo& function) const;
  void make_import(FunctionInfo* function, SourceLocation use);

 private:
  FunctionInfo* linked_definition(const FunctionInfo& import);
  bool same_signatures(const FunctionInfo& import, const FunctionInfo& definition,
                       SourceLocation use);

  Exports& exports_;
};

}  // namespace kaamos::hlsl
