// SPDX-License-Identifier: MIT
//
// The tools with which every part of the checker makes the module.
#pragma once

#include <memory>

#include "runtime/hlsl/builder/finish/payload_uses.h"
#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/builder/ir_types.h"
#include "runtime/hlsl/check/names/messages.h"
#include "runtime/hlsl/check/names/types.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct VariableInfo;

struct Workbench {
  Workbench(const SourceManager& sources, DiagnosticEngine& diagnostics)
      : made(std::make_unique<ir::Module>()),
        module(*made),
        ir_types(module),
        types(ir_types),
        build(module, ir_types),
        messages(sources, diagnostics, module) {}

  std::unique_ptr<ir::Module> made;  // given away in the end
  ir::Module& module;
  IrTypes ir_types;
  TypeTable types;
  IrBuilder build;
  Messages messages;
  PayloadFacts payloads;
  ir::Variable* is_helper = nullptr;     // ModuleFacts::is_helper
  VariableInfo* print_thread = nullptr;  // Printing::thread()
  VariableInfo* sample_count = nullptr;  // of the targets; pixel shaders fill it
  int depth = 0;                         // of nested declarations, statements and expressions
};

}  // namespace kaamos::hlsl
