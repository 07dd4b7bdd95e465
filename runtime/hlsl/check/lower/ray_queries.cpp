// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/ray_queries.h"

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

// The variable that the value names; reports an error and returns null if it is anything else.
const ir::Expr* RayQueries::query_object(const Value& value, const Type* type) {
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
void RayQueries::lower_local_query(const VariableDecl* decl, const Type* type, VariableInfo* info) {
  lower_.body_rules.check_model("RayQuery", decl->location);
  if (decl->modifiers & kModStatic) {
    report(CheckId::kRayQueryPlace, decl->location, {to_string(type), "static"});
    return;
  }
  const auto* construct = as<ConstructExpr>(decl->initializer);
  const bool is_new = construct && construct->arguments.empty() &&
                      same_type(names_.resolve_type(construct->type, body_.scope), type);
  if (decl->initializer && !is_new) {
    Value value = lower_.expressions.lower(decl->initializer);
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
  body_.emit(node);
}

// `b = a;` before any other use of b, where b is declared: b becomes a second name for a's object.
bool RayQueries::rename_query(const AssignExpr* expr, const Value& value) {
  const auto* name = as<NameExpr>(expr->target);
  Symbol* symbol = name ? names_.resolve_name(*name->name, body_.scope, true) : nullptr;
  if (!symbol || symbol->kind != SymbolKind::kVariable || expr->op) return false;
  VariableInfo* variable = symbol->variable;
  const bool is_here = names_.find_local(body_.scope, name->name->last().identifier) == symbol;
  if (!is_here || variable->references != 1 || !variable->type->is_query()) return false;
  const ir::Expr* object = query_object(value, variable->type);
  if (object) variable->variable = const_cast<ir::Variable*>(object->variable);
  return object != nullptr;
}

Value RayQueries::trace_ray_inline(ir::Stmt* statement, const Type* query,
                                   std::vector<Value>& arguments) {
  const Type* number = types_.scalar(Scalar::kUint32);
  const Type* types[] = {types_.resource(ir::ResourceKind::kAccelerationStructure, nullptr), number,
                         number, names_.ray_desc()};
  for (size_t i = 0; i < 4; ++i) {
    const ir::Expr* operand =
        lower_.conversions.convert(arguments[i], types[i], arguments[i].location);
    if (!operand) return error_value();
    if (i == 1) {  // [DXR: RayQuery TraceRayInline]: the union of both
      operand = build_.binary(ir::BinaryOp::kBitOr, operand, build_.uint32(query->ray_query_flags));
    }
    statement->operands.push_back(operand);
  }
  if (body_.function) body_.function->queries = true;
  statement->query = ir::QueryOp::kTrace;
  body_.emit(statement);
  return rvalue(build_.int32(0), types_.void_type());
}

Value RayQueries::call_query_method(const Value& object, const NamePart& part,
                                    std::vector<Value>& arguments, SourceLocation location) {
  const std::string name(part.identifier);
  const ir::Expr* query = query_object(object, object.type);
  if (!query) return error_value();
  if (const QueryValueRule* rule = find_query_value(name)) {
    if (!lower_.intrinsics.check_count(name, arguments.size(), 0, 0, location))
      return error_value();
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
    if (!lower_.intrinsics.check_count(name, arguments.size(), 4, 4, location))
      return error_value();
    return trace_ray_inline(statement, object.type, arguments);
  }
  if (name == "CommitProceduralPrimitiveHit") {
    if (!lower_.intrinsics.check_count(name, arguments.size(), 1, 1, location))
      return error_value();
    const ir::Expr* t = lower_.conversions.convert(arguments[0], types_.scalar(Scalar::kFloat32),
                                                   arguments[0].location);
    if (!t) return error_value();
    statement->query = ir::QueryOp::kCommitProcedural;
    statement->operands = {t};
    body_.emit(statement);
    return nothing;
  }
  const bool proceeds = name == "Proceed";
  if (!proceeds && name != "Abort" && name != "CommitNonOpaqueTriangleHit") {
    report(CheckId::kNoSuchMethod, location, {to_string(object.type), name});
    return error_value();
  }
  if (!lower_.intrinsics.check_count(name, arguments.size(), 0, 0, location)) return error_value();
  statement->query = proceeds          ? ir::QueryOp::kProceed
                     : name == "Abort" ? ir::QueryOp::kAbort
                                       : ir::QueryOp::kCommitTriangle;
  if (!proceeds) {
    body_.emit(statement);
    return nothing;
  }
  const ir::Variable* result = body_.empty_temporary(types_.boolean()->ir);
  statement->result = result;
  body_.emit(statement);
  return rvalue(build_.read(result), types_.boolean());
}

}  // namespace kaamos::hlsl
