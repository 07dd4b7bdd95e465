// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {

void Lowerer::emit_trace(ir::Stmt* statement, const ir::Variable* payload, const Type* type,
                         SourceLocation location) {
  const StructInfo& structure = *type->structure;
  if (structure.is_payload) {
    checker_.payloads_.traces[statement] = {payload, structure.ir, location.raw};
    const PayloadLeaves leaves = payload_leaves(structure);
    if (!all_access(leaves, kPayloadCaller)) {
      for (const ir::Stmt* one : trace_with_copy(build_, statement, payload, leaves)) emit(one);
      return;
    }
  }
  statement->place = build_.read(payload);
  emit(statement);
}

// The source's entry point becomes an ordinary function; the new entry point makes the working copy
// and calls it.
void Lowerer::wrap_payload(FunctionInfo* function, ir::EntryPoint& entry) {
  if (!function->ir || function->parameters.empty()) return;
  const StructInfo& structure = *function->parameters[0].type->structure;
  if (!structure.is_payload) return;
  entry.unbounded_payload = !checker_.options_->target.ends_with("6_6");
  const uint8_t stage = payload_stage_of(entry.stage);
  const PayloadLeaves leaves = payload_leaves(structure);
  if (all_access(leaves, stage)) return;
  for (const ModuleFacts::Wrapper& one : checker_.facts_.wrappers) {
    if (one.wrapped == function) {
      entry.function = one.function;
      return;
    }
  }
  const ir::Location before = build_.location;
  at(function->definition->location);
  ir::Function* wrapper =
      make_payload_wrapper(*checker_.module_, build_, function->ir, leaves, stage);
  build_.location = before;
  checker_.facts_.wrappers.push_back({wrapper, function, entry.stage});
  entry.function = wrapper;
}

}  // namespace kaamos::hlsl
