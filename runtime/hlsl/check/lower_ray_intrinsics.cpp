// SPDX-License-Identifier: MIT
// Intrinsics that only ray tracing shaders have. [DXR: Ray tracing HLSL intrinsics]
#include <algorithm>

#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {
namespace {

constexpr uint32_t kTraceStages = ir::kStageRayGeneration | ir::kStageClosestHit | ir::kStageMiss;
constexpr uint32_t kCallStages = kTraceStages | ir::kStageCallable;

}  // namespace

Value Lowerer::call_system_value(const SystemValueRule& rule, SourceLocation location) {
  use_in_stages(rule.name, rule.stages, location);
  const Type* type = types_.numeric(rule.scalar, rule.rows, rule.columns);
  ir::Expr* node = build_.expr(ir::ExprKind::kSystemValue, type->ir);
  node->system_value = rule.value;
  return rvalue(node, type);
}

// The variable that holds a payload, callable data or the like during the call.
const ir::Variable* Lowerer::pass_by_reference(const Value& value, std::string_view what,
                                               SourceLocation location, bool& copied) {
  if (!value.type || !value.type->is_struct() || contains_resource(value.type)) {
    report(CheckId::kUserStruct, location,
           {std::string(what), value.type ? to_string(value.type) : "a resource"});
    return nullptr;
  }
  if (!require_place(value, location, what)) return nullptr;
  const bool direct = value.kind == ValueKind::kExpr &&
                      value.expr->kind == ir::ExprKind::kVariable &&
                      (value.expr->variable->storage == ir::Storage::kLocal ||
                       value.expr->variable->storage == ir::Storage::kParameter);
  copied = !direct;
  return direct ? value.expr->variable : temporary(load(value));
}

Value Lowerer::call_trace_ray(std::vector<Value>& arguments, SourceLocation location) {
  if (!check_count("TraceRay", arguments.size(), 8, 8, location)) return error_value();
  use_in_stages("TraceRay", kTraceStages, location);
  if (function_) function_->traces = true;
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kTraceRay);
  const Type* scene = types_.resource(ir::ResourceKind::kAccelerationStructure, nullptr);
  const Type* number = types_.scalar(Scalar::kUint32);
  const Type* types[] = {scene, number, number, number, number, number, checker_.ray_desc_->type};
  for (size_t i = 0; i < 7; ++i) {
    const ir::Expr* operand = convert(arguments[i], types[i], arguments[i].location);
    if (!operand) return error_value();
    statement->operands.push_back(operand);
  }
  at(location);
  bool copied = false;
  Value payload = arguments[7];
  size_t position = block().size();
  freeze(payload, &position);
  const ir::Variable* variable =
      pass_by_reference(payload, "the payload of TraceRay", payload.location, copied);
  if (!variable) return error_value();
  checker_.check_payload_use(payload.type, payload.location);
  emit_trace(statement, variable, payload.type, payload.location);
  if (copied) store(payload, build_.read(variable));
  return rvalue(build_.int32(0), types_.void_type());
}

Value Lowerer::call_call_shader(std::vector<Value>& arguments, SourceLocation location) {
  if (!check_count("CallShader", arguments.size(), 2, 2, location)) return error_value();
  use_in_stages("CallShader", kCallStages, location);
  if (function_) function_->calls_shader = true;
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kCallShader);
  const ir::Expr* index =
      convert(arguments[0], types_.scalar(Scalar::kUint32), arguments[0].location);
  if (!index) return error_value();
  statement->operands = {index};
  at(location);
  bool copied = false;
  Value data = arguments[1];
  size_t position = block().size();
  freeze(data, &position);
  const ir::Variable* variable =
      pass_by_reference(data, "the data of CallShader", data.location, copied);
  if (!variable) return error_value();
  statement->place = build_.read(variable);
  emit(statement);
  if (copied) store(data, build_.read(variable));
  return rvalue(build_.int32(0), types_.void_type());
}

Value Lowerer::call_report_hit(std::vector<Value>& arguments, SourceLocation location) {
  if (!check_count("ReportHit", arguments.size(), 3, 3, location)) return error_value();
  use_in_stages("ReportHit", ir::kStageIntersection, location);
  if (function_) function_->ends_shader = true;
  const Type* attributes = arguments[2].type;
  if (!attributes || !attributes->is_struct() || contains_resource(attributes)) {
    report(CheckId::kUserStruct, arguments[2].location,
           {"the attributes of ReportHit", attributes ? to_string(attributes) : "a resource"});
    return error_value();
  }
  if (payload_bytes(attributes) > 32) {
    report(CheckId::kAttributeSize, arguments[2].location,
           {to_string(attributes), std::to_string(payload_bytes(attributes))});
    return error_value();
  }
  if (function_) {
    function_->reported_bytes = std::max(function_->reported_bytes, payload_bytes(attributes));
  }
  const ir::Expr* t = convert(arguments[0], types_.scalar(Scalar::kFloat32), arguments[0].location);
  const ir::Expr* kind =
      convert(arguments[1], types_.scalar(Scalar::kUint32), arguments[1].location);
  const ir::Expr* data = load(arguments[2]);
  if (!t || !kind || !data) return error_value();
  at(location);
  if (function_) {
    function_->reported_type = joined_type(function_->reported_type, type_hash(data->type));
  }
  const ir::Variable* result = empty_temporary(types_.boolean()->ir);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kReportHit);
  statement->operands = {t, kind, data};
  statement->result = result;
  emit(statement);
  return rvalue(build_.read(result), types_.boolean());
}

}  // namespace kaamos::hlsl
