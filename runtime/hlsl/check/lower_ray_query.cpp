// SPDX-License-Identifier: MIT
// RayQuery: inline ray tracing in any stage. [DXR: RayQuery]
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {

// The variable that the value names; reports an error and returns null if it is anything else.
const ir::Expr* Lowerer::query_object(const Value& value, const Type* type) {
  if (value.failed()) return nullptr;
  const bool is_object = value.type && value.type->is_query() && value.kind == ValueKind::kExpr &&
                         value.expr && value.expr->kind == ir::ExprKind::kVariable;
  if (!is_object) {
    report(CheckId::kRayQueryCopy, value.location, {to_string(type)});
    return nullptr;
  }
  if (!same_type(value.type, type)) {  // the flags must match too
    report(CheckId::kConversion, value.location, {to_string(value.type), to_string(type)});
    return nullptr;
  }
  return value.expr;
}

// With an initialiser, the variable becomes a second name for that object. [DXR: RayQuery]
void Lowerer::lower_local_query(const VariableDecl* decl, const Type* type, VariableInfo* info) {
  if (decl->modifiers & kModStatic) {
    report(CheckId::kRayQueryPlace, decl->location, {to_string(type), "static"});
    return;
  }
  if (decl->initializer) {
    Value value = lower(decl->initializer);
    value.location = decl->initializer->location;
    const ir::Expr* object = query_object(value, type);
    if (!object) return;
    info->type = type;
    info->variable = const_cast<ir::Variable*>(object->variable);  // it belongs to the pool
    return;
  }
  info->type = type;
  info->is_const = false;
  info->variable = build_.variable(std::string(decl->name), type->ir, ir::Storage::kLocal);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kDeclare);
  node->variable = info->variable;
  emit(node);
}

Value Lowerer::trace_ray_inline(ir::Stmt* statement, const Type* query,
                                std::vector<Value>& arguments) {
  const Type* number = types_.scalar(Scalar::kUint32);
  const Type* types[] = {types_.resource(ir::ResourceKind::kAccelerationStructure, nullptr), number,
                         number, checker_.ray_desc_->type};
  for (size_t i = 0; i < 4; ++i) {
    const ir::Expr* operand = convert(arguments[i], types[i], arguments[i].location);
    if (!operand) return error_value();
    if (i == 1) {  // [DXR: RayQuery TraceRayInline]: the union of both
      operand = build_.binary(ir::BinaryOp::kBitOr, operand, build_.uint32(query->ray_query_flags));
    }
    statement->operands.push_back(operand);
  }
  if (function_) function_->queries = true;
  statement->query = ir::QueryOp::kTrace;
  emit(statement);
  return rvalue(build_.int32(0), types_.void_type());
}

Value Lowerer::call_query_method(const Value& object, const NamePart& part,
                                 std::vector<Value>& arguments, SourceLocation location) {
  const std::string name(part.identifier);
  const ir::Expr* query = query_object(object, object.type);
  if (!query) return error_value();
  if (const QueryValueRule* rule = find_query_value(name)) {
    if (!check_count(name, arguments.size(), 0, 0, location)) return error_value();
    const Type* type = types_.numeric(rule->scalar, rule->rows, rule->columns);
    ir::Expr* node = build_.expr(ir::ExprKind::kQueryValue, type->ir, {query});
    node->query_value = rule->value;
    node->index = rule->of_committed ? 1 : 0;
    return rvalue(node, type);
  }
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kQuery);
  statement->place = query;
  const Value nothing = rvalue(build_.int32(0), types_.void_type());
  if (name == "TraceRayInline") {
    if (!check_count(name, arguments.size(), 4, 4, location)) return error_value();
    return trace_ray_inline(statement, object.type, arguments);
  }
  if (name == "CommitProceduralPrimitiveHit") {
    if (!check_count(name, arguments.size(), 1, 1, location)) return error_value();
    const ir::Expr* t =
        convert(arguments[0], types_.scalar(Scalar::kFloat32), arguments[0].location);
    if (!t) return error_value();
    statement->query = ir::QueryOp::kCommitProcedural;
    statement->operands = {t};
    emit(statement);
    return nothing;
  }
  const bool proceeds = name == "Proceed";
  if (!proceeds && name != "Abort" && name != "CommitNonOpaqueTriangleHit") {
    report(CheckId::kNoSuchMethod, location, {to_string(object.type), name});
    return error_value();
  }
  if (!check_count(name, arguments.size(), 0, 0, location)) return error_value();
  statement->query = proceeds          ? ir::QueryOp::kProceed
                     : name == "Abort" ? ir::QueryOp::kAbort
                                       : ir::QueryOp::kCommitTriangle;
  if (!proceeds) {
    emit(statement);
    return nothing;
  }
  const ir::Variable* result = empty_temporary(types_.boolean()->ir);
  statement->result = result;
  emit(statement);
  return rvalue(build_.read(result), types_.boolean());
}

}  // namespace kaamos::hlsl
