// SPDX-License-Identifier: MIT
#include "runtime/hlsl/builder/payload_access.h"

#include <cstddef>
#include <string>

namespace kaamos::hlsl {
namespace {

constexpr const char* kStageNames[] = {"caller", "closesthit", "miss", "anyhit"};

const ir::Expr* payload_field(IrBuilder& build, const ir::Variable* payload,
                              const PayloadLeaf& leaf) {
  const ir::Expr* expr = build.read(payload);
  for (const uint32_t index : leaf.path) expr = build.field(expr, index);
  return expr;
}

// Uses the place without folding: a copy of `from`'s field, or zero without `from`.
const ir::Stmt* copy_field(IrBuilder& build, const ir::Variable* to, const ir::Variable* from,
                           const PayloadLeaf& leaf) {
  ir::Stmt* statement = build.stmt(ir::StmtKind::kAssign);
  statement->place = payload_field(build, to, leaf);
  statement->value = from ? payload_field(build, from, leaf) : build.zero(leaf.type);
  return statement;
}

const ir::Variable* declare_copy(IrBuilder& build, const ir::Type* type, ir::Block& out) {
  ir::Variable* variable = build.variable({}, type, ir::Storage::kLocal);
  ir::Stmt* statement = build.stmt(ir::StmtKind::kDeclare);
  statement->variable = variable;
  out.push_back(statement);
  return variable;
}

}  // namespace

const char* payload_stage_name(uint8_t stage) {
  for (size_t i = 0; i < 4; ++i) {
    if (stage == kPayloadStages[i]) return kStageNames[i];
  }
  return "";
}

uint8_t payload_stage(std::string_view word) {
  for (size_t i = 0; i < 4; ++i) {
    if (word == kStageNames[i]) return kPayloadStages[i];
  }
  return 0;
}

uint8_t payload_stage_of(uint32_t stage) {
  switch (stage) {
    case ir::kStageClosestHit:
      return kPayloadClosestHit;
    case ir::kStageMiss:
      return kPayloadMiss;
    case ir::kStageAnyHit:
      return kPayloadAnyHit;
    default:
      return kPayloadCaller;
  }
}

PayloadAccessBits as_caller(PayloadAccessBits access, PayloadRoles roles) {
  if ((access.read & roles.reads) != 0) access.read |= kPayloadCaller;
  if ((access.write & roles.writes) != 0) access.write |= kPayloadCaller;
  return access;
}

PayloadLeaves as_caller(PayloadLeaves leaves, PayloadRoles roles) {
  for (PayloadLeaf& leaf : leaves) leaf.access = as_caller(leaf.access, roles);
  return leaves;
}

bool all_access(const PayloadLeaves& leaves, uint8_t stage) {
  for (const PayloadLeaf& leaf : leaves) {
    if (!(leaf.access.read & leaf.access.write & stage)) return false;
  }
  return true;
}

ir::Block trace_with_copy(IrBuilder& build, ir::Stmt* trace, const ir::Variable* payload,
                          const PayloadLeaves& leaves) {
  ir::Block out;
  const ir::Variable* passed = declare_copy(build, payload->type, out);
  for (const PayloadLeaf& leaf : leaves) {
    if (leaf.access.write & kPayloadCaller) {
      out.push_back(copy_field(build, passed, payload, leaf));
    }
  }
  trace->place = build.read(passed);
  out.push_back(trace);
  for (const PayloadLeaf& leaf : leaves) {
    const bool returns = leaf.access.read & kPayloadCaller;
    out.push_back(copy_field(build, payload, returns ? passed : nullptr, leaf));
  }
  return out;
}

ir::Function* make_payload_wrapper(ir::Module& module, IrBuilder& build, ir::Function* body,
                                   const PayloadLeaves& leaves, uint8_t stage) {
  ir::Function* wrapper = make_wrapper(module, build, *body);
  // The export keeps the name that DXC gives it.
  wrapper->mangled = body->mangled;
  body->mangled += "#body";
  ir::Stmt* call = build.stmt(ir::StmtKind::kCall);
  call->function = body;
  call->outlives_end = true;
  for (const ir::Variable* parameter : body->parameters) {
    ir::Variable* variable =
        build.variable(parameter->name, parameter->type, ir::Storage::kParameter);
    variable->mode = parameter->mode;
    wrapper->parameters.push_back(variable);
  }
  const ir::Variable* payload = wrapper->parameters[0];
  const ir::Variable* copy = declare_copy(build, payload->type, wrapper->body);
  for (const PayloadLeaf& leaf : leaves) {
    if (leaf.access.read & stage) wrapper->body.push_back(copy_field(build, copy, payload, leaf));
  }
  call->arguments.push_back(build.read(copy));
  for (size_t i = 1; i < wrapper->parameters.size(); ++i) {
    call->arguments.push_back(build.read(wrapper->parameters[i]));
  }
  wrapper->body.push_back(call);
  for (const PayloadLeaf& leaf : leaves) {
    if (leaf.access.write & stage) wrapper->body.push_back(copy_field(build, payload, copy, leaf));
  }
  return wrapper;
}

}  // namespace kaamos::hlsl
