// SPDX-License-Identifier: MIT
// A stage sees a payload with access qualifiers as a working copy of its own: the fields that it
// may read are copied in, and those that it may write are copied back. DXR leaves all other fields
// undefined; here they are zero. [DXR: Payload access qualifiers, Detailed semantics]
#include "runtime/hlsl/check/checker.h"
#include "runtime/hlsl/check/payload_access.h"

namespace kaamos::hlsl {

const ir::Expr* Lowerer::payload_field(const ir::Variable* payload, const PayloadLeaf& leaf) {
  const ir::Expr* expr = build_.read(payload);
  for (const uint32_t index : leaf.path) expr = build_.field(expr, index);
  return expr;
}

// Uses the place without folding: a copy of `from`'s field, or zero without `from`.
void Lowerer::copy_payload_field(const ir::Variable* to, const ir::Variable* from,
                                 const PayloadLeaf& leaf) {
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kAssign);
  statement->place = payload_field(to, leaf);
  statement->value = from ? payload_field(from, leaf) : build_.zero(leaf.type);
  emit(statement);
}

// TraceRay gets a payload object of its own: what the caller may not write does not reach the
// stages, and what it may not read does not come back.
void Lowerer::emit_trace(ir::Stmt* statement, const ir::Variable* payload, const Type* type,
                         SourceLocation location) {
  if (!type->structure->is_payload) {
    statement->place = build_.read(payload);
    emit(statement);
    return;
  }
  trace_payloads_[statement] = {payload, type->structure, location};
  const std::vector<PayloadLeaf> leaves = payload_leaves(*type->structure);
  if (all_access(leaves, kPayloadCaller)) {
    statement->place = build_.read(payload);
    emit(statement);
    return;
  }
  const ir::Variable* passed = empty_temporary(type->ir);
  for (const PayloadLeaf& leaf : leaves) {
    if (leaf.access.write & kPayloadCaller) copy_payload_field(passed, payload, leaf);
  }
  statement->place = build_.read(passed);
  emit(statement);
  for (const PayloadLeaf& leaf : leaves) {
    const bool returns = leaf.access.read & kPayloadCaller;
    copy_payload_field(payload, returns ? passed : nullptr, leaf);
  }
}

// The source's entry point becomes an ordinary function; the new entry point makes the working copy
// and calls it.
void Lowerer::wrap_payload(FunctionInfo* function, ir::EntryPoint& entry) {
  if (!function->ir || function->parameters.empty()) return;
  const StructInfo& structure = *function->parameters[0].type->structure;
  if (!structure.is_payload) return;
  entry.unbounded_payload = !checker_.options_->target.ends_with("6_6");
  const uint8_t stage = payload_stage_of(entry.stage);
  const std::vector<PayloadLeaf> leaves = payload_leaves(structure);
  if (all_access(leaves, stage)) return;
  for (const Checker::Wrapper& one : checker_.wrappers_) {
    if (one.wrapped == function) {
      entry.function = one.function;
      return;
    }
  }
  ir::Function* wrapper = &checker_.module_->function_pool.emplace_back();
  wrapper->name = function->qualified;
  // The export keeps the name that DXC gives it.
  wrapper->mangled = function->ir->mangled;
  function->ir->mangled += "#body";
  wrapper->result = types_.void_type()->ir;
  wrapper->location = function->ir->location;
  wrapper->end_location = function->ir->end_location;
  BodyScope body(*this, nullptr, &wrapper->body, function->scope);
  at(function->definition->location);
  ir::Stmt* call = build_.stmt(ir::StmtKind::kCall);
  call->function = function->ir;
  call->outlives_end = true;
  for (const ir::Variable* parameter : function->ir->parameters) {
    ir::Variable* variable =
        build_.variable(parameter->name, parameter->type, ir::Storage::kParameter);
    variable->mode = parameter->mode;
    wrapper->parameters.push_back(variable);
  }
  const ir::Variable* payload = wrapper->parameters[0];
  const ir::Variable* copy = empty_temporary(payload->type);
  for (const PayloadLeaf& leaf : leaves) {
    if (leaf.access.read & stage) copy_payload_field(copy, payload, leaf);
  }
  call->arguments.push_back(build_.read(copy));
  for (size_t i = 1; i < wrapper->parameters.size(); ++i) {
    call->arguments.push_back(build_.read(wrapper->parameters[i]));
  }
  emit(call);
  for (const PayloadLeaf& leaf : leaves) {
    if (leaf.access.write & stage) copy_payload_field(payload, copy, leaf);
  }
  checker_.wrappers_.push_back({wrapper, function, entry.stage});
  entry.function = wrapper;
}

}  // namespace kaamos::hlsl
