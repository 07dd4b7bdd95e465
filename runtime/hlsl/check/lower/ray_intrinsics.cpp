// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/ray_intrinsics.h"

#include <algorithm>

#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/builder/payload_access.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {
namespace {

constexpr uint32_t kTraceStages = ir::kStageRayGeneration | ir::kStageClosestHit | ir::kStageMiss;
constexpr uint32_t kCallStages = kTraceStages | ir::kStageCallable;

}  // namespace

Value RayIntrinsics::call_system_value(const SystemValueRule& rule, SourceLocation location) {
  lower_.intrinsics.use_in_stages(rule.name, rule.stages, location);
  const Type* type = types_.numeric(rule.scalar, rule.rows, rule.columns);
  ir::Expr* node = build_.expr(ir::ExprKind::kSystemValue, type->ir);
  node->system_value = rule.value;
  return rvalue(node, type);
}

// The variable that holds a payload, callable data or the like during the call.
const ir::Variable* RayIntrinsics::pass_by_reference(const Value& value, std::string_view what,
                                                     SourceLocation location, bool& copied) {
  if (!value.type || !value.type->is_struct() || contains_resource(value.type) ||
      contains_hit_object(value.type)) {
    report(CheckId::kUserStruct, location,
           {std::string(what), value.type ? to_string(value.type) : "a resource"});
    return nullptr;
  }
  if (contains_long_vector(value.type)) {
    report(CheckId::kLongVectorPlace, location, {std::string(what), to_string(value.type)});
    return nullptr;
  }
  if (!lower_.places.require_place(value, location, what)) return nullptr;
  const bool direct = value.kind == ValueKind::kExpr &&
                      value.expr->kind == ir::ExprKind::kVariable &&
                      (value.expr->variable->storage == ir::Storage::kLocal ||
                       value.expr->variable->storage == ir::Storage::kParameter);
  copied = !direct;
  return direct ? value.expr->variable : body_.temporary(lower_.places.load(value));
}

// Emits the statement with the payload that is passed.
bool RayIntrinsics::pass_payload(ir::Stmt* statement, const Value& given, std::string_view what,
                                 PayloadRoles roles) {
  bool copied = false;
  Value payload = given;
  size_t position = body_.block->size();
  lower_.places.freeze(payload, &position);
  const ir::Variable* variable = pass_by_reference(payload, what, payload.location, copied);
  if (!variable) return false;
  names_.check_payload_use(payload.type, payload.location);
  emit_trace(statement, variable, payload.type, payload.location, roles);
  if (copied) lower_.places.store(payload, build_.read(variable));
  return true;
}

Value RayIntrinsics::call_trace_ray(std::vector<Value>& arguments, SourceLocation location,
                                    bool to_hit_object) {
  if (!lower_.intrinsics.check_count("TraceRay", arguments.size(), 8, 8, location))
    return error_value();
  lower_.intrinsics.use_in_stages("TraceRay", kTraceStages, location);
  if (body_.function) body_.function->traces = true;
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kTraceRay);
  const Type* scene = types_.resource(ir::ResourceKind::kAccelerationStructure, nullptr);
  const Type* number = types_.scalar(Scalar::kUint32);
  const Type* types[] = {scene, number, number, number, number, number, names_.ray_desc()};
  for (size_t i = 0; i < 7; ++i) {
    const ir::Expr* operand =
        lower_.conversions.convert(arguments[i], types[i], arguments[i].location);
    if (!operand) return error_value();
    statement->operands.push_back(operand);
  }
  at(location);
  const Type* type = to_hit_object ? names_.hit_object() : types_.void_type();
  if (to_hit_object) statement->result = body_.empty_temporary(type->ir);
  // What closest-hit and miss shaders would read comes back, for the Invoke to pass it on.
  const PayloadRoles roles =
      to_hit_object ? PayloadRoles{.reads = kPayloadClosestHit | kPayloadMiss} : PayloadRoles{};
  if (!pass_payload(statement, arguments[7], "the payload of TraceRay", roles)) {
    return error_value();
  }
  return rvalue(to_hit_object ? build_.read(statement->result) : build_.int32(0), type);
}

Value RayIntrinsics::call_invoke(std::vector<Value>& arguments, SourceLocation location) {
  if (body_.function) body_.function->traces = true;
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kInvoke);
  const ir::Expr* hit =
      lower_.conversions.convert(arguments[0], names_.hit_object(), arguments[0].location);
  if (!hit) return error_value();
  statement->operands = {hit};
  at(location);
  // What any-hit shaders have written is passed on.
  if (!pass_payload(statement, arguments[1], "the payload of Invoke", {.writes = kPayloadAnyHit})) {
    return error_value();
  }
  return rvalue(build_.int32(0), types_.void_type());
}

Value RayIntrinsics::call_call_shader(std::vector<Value>& arguments, SourceLocation location) {
  if (!lower_.intrinsics.check_count("CallShader", arguments.size(), 2, 2, location))
    return error_value();
  lower_.intrinsics.use_in_stages("CallShader", kCallStages, location);
  if (body_.function) body_.function->calls_shader = true;
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kCallShader);
  const ir::Expr* index = lower_.conversions.convert(arguments[0], types_.scalar(Scalar::kUint32),
                                                     arguments[0].location);
  if (!index) return error_value();
  statement->operands = {index};
  at(location);
  bool copied = false;
  Value data = arguments[1];
  size_t position = body_.block->size();
  lower_.places.freeze(data, &position);
  const ir::Variable* variable =
      pass_by_reference(data, "the data of CallShader", data.location, copied);
  if (!variable) return error_value();
  statement->place = build_.read(variable);
  body_.emit(statement);
  if (copied) lower_.places.store(data, build_.read(variable));
  return rvalue(build_.int32(0), types_.void_type());
}

Value RayIntrinsics::call_report_hit(std::vector<Value>& arguments, SourceLocation location) {
  if (!lower_.intrinsics.check_count("ReportHit", arguments.size(), 3, 3, location))
    return error_value();
  lower_.intrinsics.use_in_stages("ReportHit", ir::kStageIntersection, location);
  if (body_.function) body_.function->ends_shader = true;
  const Type* attributes = arguments[2].type;
  if (!attributes || !attributes->is_struct() || contains_resource(attributes) ||
      contains_hit_object(attributes)) {
    report(CheckId::kUserStruct, arguments[2].location,
           {"the attributes of ReportHit", attributes ? to_string(attributes) : "a resource"});
    return error_value();
  }
  if (contains_long_vector(attributes)) {
    report(CheckId::kLongVectorPlace, arguments[2].location,
           {"the attributes of ReportHit", to_string(attributes)});
    return error_value();
  }
  if (payload_bytes(attributes) > 32) {
    report(CheckId::kAttributeSize, arguments[2].location,
           {to_string(attributes), std::to_string(payload_bytes(attributes))});
    return error_value();
  }
  if (body_.function) {
    body_.function->reported_bytes =
        std::max(body_.function->reported_bytes, payload_bytes(attributes));
  }
  const ir::Expr* t = lower_.conversions.convert(arguments[0], types_.scalar(Scalar::kFloat32),
                                                 arguments[0].location);
  const ir::Expr* kind = lower_.conversions.convert(arguments[1], types_.scalar(Scalar::kUint32),
                                                    arguments[1].location);
  const ir::Expr* data = lower_.places.load(arguments[2]);
  if (!t || !kind || !data) return error_value();
  at(location);
  if (body_.function) {
    body_.function->reported_type =
        joined_type(body_.function->reported_type, type_hash(data->type));
  }
  const ir::Variable* result = body_.empty_temporary(types_.boolean()->ir);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kReportHit);
  statement->operands = {t, kind, data};
  statement->result = result;
  body_.emit(statement);
  return rvalue(build_.read(result), types_.boolean());
}

void RayIntrinsics::emit_trace(ir::Stmt* statement, const ir::Variable* payload, const Type* type,
                               SourceLocation location, PayloadRoles roles) {
  const StructInfo& structure = *type->structure;
  if (structure.is_payload) {
    bench_.payloads.traces[statement] = {payload, structure.ir, location.raw, roles};
    const PayloadLeaves leaves = as_caller(payload_leaves(structure), roles);
    if (!all_access(leaves, kPayloadCaller)) {
      for (const ir::Stmt* one : trace_with_copy(build_, statement, payload, leaves))
        body_.emit(one);
      return;
    }
  }
  statement->place = build_.read(payload);
  body_.emit(statement);
}

}  // namespace kaamos::hlsl
