// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/ray_queries.h"

#include <algorithm>

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

void RayQueries::lower_local_array(const VariableDecl* decl, const Type* type, VariableInfo* info) {
  constexpr uint64_t kMostQueries = 64;
  const uint64_t count = flat_component_count(type);
  if (decl->initializer || (decl->modifiers & kModStatic) || type->count == 0 ||
      count > kMostQueries) {
    report(CheckId::kRayQueryPlace, decl->location,
           {to_string(type), "an array that is static, initialised or of more than 64"});
    return;
  }
  const std::function<SplitPart(const Type*)> make = [&](const Type* part) {
    SplitPart result{.type = part};
    for (uint32_t i = 0; part->is_array() && i < part->count; ++i) {
      result.parts.push_back(make(part->element));
    }
    if (part->is_array()) return result;
    lower_.body_rules.check_model("RayQuery", decl->location);
    VariableInfo* one = names_.make_variable();
    one->name = decl->name;
    one->type = part;
    one->variable = build_.variable(std::string(decl->name), part->ir, ir::Storage::kLocal);
    ir::Stmt* node = build_.stmt(ir::StmtKind::kDeclare);
    node->variable = one->variable;
    body_.emit(node);
    result.variable = one;
    return result;
  };
  info->type = type;
  info->kind = VariableKind::kSplit;
  info->split = make(type);
}

bool RayQueries::is_indexed(const Value& value) {
  return value.kind == ValueKind::kSplit && value.offset && value.type && value.type->is_query();
}

Value RayQueries::element_of(const Value& array, const ir::Expr* index) {
  Value result = array;
  result.type = array.type->element;
  uint32_t inner = 1;
  for (const Type* part = result.type; part->is_array(); part = part->element) inner *= part->count;
  const ir::Expr* before = array.offset ? array.offset : build_.uint32(0);
  result.offset = build_.add_scaled(before, build_.convert(index, Scalar::kUint32), inner);
  return result;
}

Value RayQueries::for_each_of(const Value& value, const std::function<Value(const Value&)>& use) {
  std::vector<VariableInfo*> queries;
  const std::function<void(const SplitPart&)> collect = [&](const SplitPart& part) {
    if (part.variable) queries.push_back(part.variable);
    for (const SplitPart& one : part.parts) collect(one);
  };
  collect(*value.split);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kSwitch);
  node->value = build_.convert(value.offset, Scalar::kInt32);
  ir::Block* outer = body_.block;
  const ir::Variable* result = nullptr;
  const Type* type = types_.void_type();
  for (size_t i = 0; i < queries.size(); ++i) {
    ir::SwitchCase one;
    one.labels.push_back(static_cast<int64_t>(i));
    one.is_default = i + 1 == queries.size();
    body_.block = &one.body;
    const Value part = lower_.places.place(queries[i]->variable, queries[i]->type, false);
    const Value outcome = use(part);
    if (outcome.failed()) {
      body_.block = outer;
      return error_value();
    }
    if (!outcome.type->is_void() && !body_.result_unused) {
      if (!result) {
        body_.block = outer;
        type = outcome.type;
        result = body_.empty_temporary(type->ir);
        body_.block = &one.body;
      }
      body_.assign(result, lower_.places.load(outcome));
    }
    body_.emit(build_.stmt(ir::StmtKind::kBreak));
    body_.block = outer;
    node->cases.push_back(std::move(one));
  }
  body_.call_result = nullptr;
  body_.emit(node);
  return result ? rvalue(build_.read(result), type) : rvalue(build_.int32(0), types_.void_type());
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

void RayQueries::return_query(const Value& value, SourceLocation location) {
  FunctionInfo& function = *body_.function;
  const ir::Expr* object = query_object(value, function.result);
  if (!object) return;
  if (function.returned_query && function.returned_query != object->variable) {
    report(CheckId::kRayQueryPlace, location,
           {to_string(function.result), "one of several that a function returns"});
  }
  function.returned_query = object->variable;
}

void RayQueries::pass_returned_query(FunctionInfo& function, ir::Block& body) {
  if (!function.returned_query) return;                                 // an error that is reported
  auto* variable = const_cast<ir::Variable*>(function.returned_query);  // it belongs to the pool
  if (variable->storage == ir::Storage::kParameter) return;
  const auto declared = std::ranges::find_if(body, [&](const ir::Stmt* statement) {
    return statement->kind == ir::StmtKind::kDeclare && statement->variable == variable;
  });
  if (declared == body.end()) {
    report(CheckId::kRayQueryPlace, function.definition->location,
           {to_string(function.result), "returned from a block inside of the function"});
    function.returned_query = nullptr;
    return;
  }
  body.erase(declared);
  variable->storage = ir::Storage::kParameter;
  variable->mode = ir::ParameterMode::kInOut;
  function.ir->parameters.push_back(variable);
}

const ir::Variable* RayQueries::call_result(const FunctionInfo& function, ir::Stmt& call) {
  const auto& parameters = function.ir->parameters;
  const size_t index = static_cast<size_t>(std::ranges::find(parameters, function.returned_query) -
                                           parameters.begin());
  if (index < call.arguments.size()) return call.arguments[index]->variable;
  const ir::Variable* object = build_.variable("query", function.result->ir, ir::Storage::kLocal);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kDeclare);
  node->variable = object;
  body_.emit(node);
  call.arguments.push_back(build_.read(object));
  return object;
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
  if (is_indexed(object)) {
    return for_each_of(object, [&](const Value& one) {
      std::vector<Value> copies = arguments;
      return call_query_method(one, part, copies, location);
    });
  }
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
  if (auto value = lower_.triangle_positions.call_query(name, query, arguments, location)) {
    return *value;
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
