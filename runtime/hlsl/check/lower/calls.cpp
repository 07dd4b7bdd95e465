// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/calls.h"

#include <algorithm>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/mangle.h"
#include "runtime/hlsl/check/names/signatures.h"
#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {
namespace {

// A whole local variable or parameter. DXC's types of such parameters are no references, so that it
// does not see that they change a constant. [DXC issue 5377]
bool is_constant_struct(const Value& value) {
  const ir::Expr* expr = value.kind == ValueKind::kExpr ? value.expr : nullptr;
  return value.is_const && value.type && value.type->is_struct() && expr &&
         expr->kind == ir::ExprKind::kVariable &&
         (expr->variable->storage == ir::Storage::kLocal ||
          expr->variable->storage == ir::Storage::kParameter);
}

constexpr int kMaxFunctionDepth = 200;

bool names_a_resource(const Value& value) {
  return value.type && value.type->is_resource() && value.kind == ValueKind::kExpr && value.expr &&
         value.expr->kind == ir::ExprKind::kBinding;
}

}  // namespace

Value Calls::lower_call(const CallExpr* expr) {
  if (const auto* member = as<MemberExpr>(expr->callee)) return call_method(member, expr);
  const auto* callee = as<NameExpr>(expr->callee);
  if (!callee) {
    // An object with an operator().
    std::vector<const Expr*> all = {expr->callee};
    all.insert(all.end(), expr->arguments.begin(), expr->arguments.end());
    std::vector<Value> values = lower_.expressions.lower_all(all, true);
    if (values[0].failed()) return error_value();
    const Value object = values[0];
    values.erase(values.begin());
    if (object.type && object.type->is_struct()) {
      if (auto result =
              lower_.operators.overloaded_operator("operator()", object, values, expr->location)) {
        return *result;
      }
    }
    report(CheckId::kNotCallable, expr->location);
    return error_value();
  }
  const QualifiedName& name = *callee->name;
  if (auto result = lower_.hit_objects.call_function(name, expr)) return *result;
  Symbol* symbol = names_.resolve_name(name, body_.scope, true);
  if (symbol &&
      (symbol->kind == SymbolKind::kType || symbol->kind == SymbolKind::kStructTemplate)) {
    const Type* type = symbol->type;
    if (symbol->kind == SymbolKind::kStructTemplate) {
      StructInfo* info = names_.instantiate_struct(symbol->struct_template, name.last(),
                                                   expr->location, body_.scope);
      type = info ? info->type : types_.error();
    }
    return lower_.expressions.lower_construct(type, expr->arguments, expr->location);
  }
  const bool unused = body_.result_unused;
  if (symbol && (symbol->kind == SymbolKind::kVariable || symbol->kind == SymbolKind::kField)) {
    Value object = lower_.expressions.lower(expr->callee);
    if (object.failed()) return object;
    std::vector<Value> values = lower_.expressions.lower_all(expr->arguments, true, true);
    if (object.type && object.type->is_struct()) {
      if (auto result =
              lower_.operators.overloaded_operator("operator()", object, values, expr->location)) {
        return *result;
      }
    }
    report(CheckId::kNotCallable, expr->location);
    return error_value();
  }
  if (!symbol && name.is_simple() && Printing::is_print(name.last().identifier)) {
    return lower_.printing.call(name.last().identifier, expr);
  }
  std::vector<Value> arguments = lower_.expressions.lower_all(expr->arguments, true, true);
  for (const Value& argument : arguments) {
    if (argument.failed()) return error_value();
  }
  body_.result_unused = unused;
  at(expr->location);
  if (symbol && symbol->kind == SymbolKind::kFunctions) {
    const bool is_builtin = name.is_simple() && is_builtin_function(name.last().identifier);
    ConversionCost cost = 0;
    FunctionInfo* function = lower_.overloads.resolve_overload(
        symbol->functions, name.last(), arguments, expr->location, is_builtin, &cost);
    // The built-in functions of the name are candidates too; between equals the source's own wins.
    if (function && is_builtin) {
      const auto built_in = lower_.intrinsics.cost_of_builtin(name.last().identifier, arguments);
      if (built_in && *built_in < cost) function = nullptr;
    }
    if (function) {
      // A method of this object; a static one needs no object.
      if (function->owner && !function->is_static) {
        if (!body_.this_variable) {
          report(CheckId::kMethodWithoutObject, expr->location, {function->qualified});
          return error_value();
        }
        const Value self =
            lower_.places.base_of(lower_.expressions.lower_this(expr->location), function->owner);
        return call(function, &self, std::move(arguments), expr->location);
      }
      return call(function, nullptr, std::move(arguments), expr->location);
    }
    if (!is_builtin) return error_value();
  } else if (symbol) {
    report(CheckId::kNotCallable, expr->location);
    return error_value();
  }
  if (name.parts.size() == 1) {
    if (auto result = lower_.intrinsics.call_builtin(name.last(), arguments, expr->location))
      return *result;
  }
  if (auto result = lower_.vk_names.call_vk(name, arguments, expr->location)) return *result;
  names_.resolve_name(name, body_.scope, false);
  return error_value();
}

Value Calls::call_method(const MemberExpr* callee, const CallExpr* call_expr) {
  const bool unused = body_.result_unused;
  std::vector<const Expr*> all = {callee->base};
  all.insert(all.end(), call_expr->arguments.begin(), call_expr->arguments.end());
  std::vector<Value> values = lower_.expressions.lower_all(all, true, true);
  values[0].saved = nullptr;  // the object is not passed by value
  body_.result_unused = unused;
  for (const Value& value : values) {
    if (value.failed()) return error_value();
  }
  Value object = values[0];
  std::vector<Value> arguments(values.begin() + 1, values.end());
  const NamePart& part = callee->name->last();
  const SourceLocation location = callee->location;
  at(location);
  if (!object.type) {
    lower_.places.load(object);
    return error_value();
  }
  if (object.type->is_query())
    return lower_.ray_queries.call_query_method(object, part, arguments, location);
  if (object.type->is_hit_object())
    return lower_.hit_objects.call_method(object, part, arguments, location);
  if (object.type->is_stream())
    return lower_.streams.call_method(object, part, arguments, location);
  if (object.type->is_resource()) {
    if (!has_members(object.type->resource)) {
      return lower_.resources.call_resource_method(object, part, arguments, location);
    }
    object = memory(lower_.places.load(object), nullptr, build_.uint32(0), object.type->element,
                    ir::Layout::kConstantBuffer, true);
  }
  if (!object.type->is_struct()) {
    report(CheckId::kNoSuchMethod, location,
           {to_string(object.type), std::string(part.identifier)});
    return error_value();
  }
  StructInfo* structure = object.type->structure;
  if (callee->name->parts.size() > 1) {
    const std::string_view qualifier =
        callee->name->parts[callee->name->parts.size() - 2].identifier;
    for (StructInfo* info = structure; info; info = info->base) {
      if (info->decl && info->decl->name == qualifier) structure = info;
    }
  }
  Symbol* symbol = names_.find_member(structure, part.identifier);
  if (!symbol || symbol->kind != SymbolKind::kFunctions) {
    names_.report_unknown(CheckId::kNoSuchMethod, location,
                          {to_string(object.type), std::string(part.identifier)}, part.identifier,
                          structure->scope, false);
    return error_value();
  }
  return call_functions(symbol->functions, part, &object, std::move(arguments), location);
}

Value Calls::call_functions(const std::vector<FunctionInfo*>& candidates, const NamePart& part,
                            const Value* object, std::vector<Value> arguments,
                            SourceLocation location) {
  FunctionInfo* function =
      lower_.overloads.resolve_overload(candidates, part, arguments, location, false);
  if (!function) return error_value();
  if (!function->owner || function->is_static || !object) {
    return call(function, nullptr, std::move(arguments), location);
  }
  const Value self = lower_.places.base_of(*object, function->owner);
  return call(function, &self, std::move(arguments), location);
}

Value Calls::call(FunctionInfo* function, const Value* object, std::vector<Value> arguments,
                  SourceLocation location) {
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (!RayQueries::is_indexed(arguments[i])) continue;
    return lower_.ray_queries.for_each_of(arguments[i], [&](const Value& one) {
      std::vector<Value> chosen = arguments;
      chosen[i] = one;
      return call(function, object, std::move(chosen), location);
    });
  }
  const bool unused = body_.result_unused;
  body_.result_unused = false;
  const size_t provided = arguments.size();
  for (size_t i = provided; i < function->parameters.size(); ++i) {
    // A default argument is looked up in the scope of the function's declaration.
    Scope* scope = body_.scope;
    body_.scope = function->scope;
    arguments.push_back(lower_.expressions.lower(function->parameters[i].default_value));
    arguments.back().location = location;
    body_.scope = scope;
    if (arguments.back().failed()) return error_value();
  }
  function = bind_unbounded_arrays(function, arguments);
  if (!function) return error_value();
  lower_function(function, location);
  if (!function->ir) return error_value();
  if (function->is_import) warn_passed_payload(*function, arguments);
  at(location);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kCall);
  statement->function = function->ir;
  struct CopyOut {
    Value target;
    const ir::Variable* variable;
    const Type* type;
    const Type* seen;  // what a cast around the target says
  };
  std::vector<CopyOut> copies;

  const auto uses = [&](const ir::Variable* variable, size_t except) {
    for (size_t i = 0; i < arguments.size(); ++i) {
      if (i == except) continue;
      const Value& other = arguments[i];
      if (lower_.places.mentions(other.expr, variable) ||
          lower_.places.mentions(other.offset, variable) ||
          lower_.places.mentions(other.element, variable) ||
          lower_.places.mentions(other.coordinates, variable) ||
          lower_.places.mentions(other.mip, variable)) {
        return true;
      }
    }
    return except != SIZE_MAX && object &&
           (lower_.places.mentions(object->expr, variable) ||
            lower_.places.mentions(object->offset, variable) ||
            lower_.places.mentions(object->element, variable));
  };
  // A whole local variable that occurs only once is passed directly; everything else through a
  // copy.
  const auto by_reference = [&](const Value& value, const Type* type, bool is_in, bool writes_back,
                                size_t index) -> bool {
    const ir::Expr* expr = value.kind == ValueKind::kExpr ? value.expr : nullptr;
    const bool direct = writes_back && expr && expr->kind == ir::ExprKind::kVariable &&
                        (expr->variable->storage == ir::Storage::kLocal ||
                         expr->variable->storage == ir::Storage::kParameter) &&
                        same_type(value.type, type) && !uses(expr->variable, index);
    if (direct) {
      statement->arguments.push_back(expr);
      return true;
    }
    Value target = value;
    size_t position = body_.block->size();
    if (writes_back) lower_.places.freeze(target, &position);
    const ir::Variable* variable = nullptr;
    if (is_in) {
      const ir::Expr* copy = lower_.conversions.convert(target, type, value.location);
      if (!copy) return false;
      at(location);
      variable = body_.temporary(copy);
    } else {
      variable = body_.empty_temporary(type->ir);
    }
    statement->arguments.push_back(build_.read(variable));
    const Value place = target.under_cast ? lower_.places.place_under_cast(target) : target;
    if (writes_back) copies.push_back({place, variable, type, target.type});
    return true;
  };

  if (object) {
    const Type* type = function->owner->type;
    if (function->is_const_method) {
      const ir::Expr* self = lower_.places.load(*object);
      if (!self) return error_value();
      statement->arguments.push_back(self);
    } else {
      const bool writes_back = object->is_place && !object->is_const;
      if (!by_reference(*object, type, true, writes_back, SIZE_MAX)) return error_value();
    }
  }
  for (size_t i = 0; i < arguments.size(); ++i) {
    const ParameterInfo& parameter = function->parameters[i];
    Value& argument = arguments[i];
    if (parameter.binding) continue;
    if (parameter.type->is_query()) {
      // The parameter is a second name for the same object, whatever its direction. [DXR: RayQuery]
      const ir::Expr* query = lower_.ray_queries.query_object(argument, parameter.type);
      if (!query) return error_value();
      statement->arguments.push_back(query);
    } else if (parameter.is_out && i >= provided) {
      // Nothing reads what comes back.
      if (!by_reference(argument, parameter.type, parameter.is_in, false, i)) return error_value();
    } else if (parameter.is_in && parameter.is_out && names_a_resource(argument)) {
      // A resource's name cannot be assigned, but the function may write to the resource.
      if (!by_reference(argument, parameter.type, true, false, i)) return error_value();
    } else if (parameter.is_out) {
      const std::string purpose = std::string("an argument of ") +
                                  (parameter.is_in ? "inout" : "out") + " parameter '" +
                                  std::string(parameter.name) + "'";
      if (is_constant_struct(argument)) {
        report(CheckId::kConstArgument, argument.location, {purpose});
        argument.is_const = false;
      }
      if (!lower_.bit_fields.require_whole_field(argument, argument.location, purpose) ||
          !lower_.places.require_target(argument, argument.location, purpose)) {
        return error_value();
      }
      if (!by_reference(argument, parameter.type, parameter.is_in, true, i)) return error_value();
    } else {
      const ir::Expr* value =
          lower_.conversions.convert(argument, parameter.type, argument.location);
      if (!value) return error_value();
      statement->arguments.push_back(value);
    }
  }
  at(location);
  const bool returns_query = function->result->is_query();
  const ir::Variable* query = nullptr;
  if (returns_query) {
    if (!function->returned_query) return error_value();
    query = lower_.ray_queries.call_result(*function, *statement);
  }
  ir::Variable* result = nullptr;
  if (!function->result->is_void() && !returns_query && !unused) {
    result = body_.empty_temporary(function->result->ir);
    statement->result = result;
  }
  if (body_.function)
    body_.function->callees.push_back(function->linked ? function->linked : function);
  body_.emit(statement);
  body_.call_result = result;
  for (const CopyOut& copy : copies) {
    Value value = rvalue(build_.read(copy.variable), copy.type);
    if (copy.seen != copy.target.type) {
      value = rvalue(lower_.conversions.convert(value, copy.seen, location, true), copy.seen);
    }
    lower_.places.store(copy.target,
                        lower_.conversions.convert(value, copy.target.type, location, true));
  }
  if (query && !unused) return lower_.places.place(query, function->result, false);
  if (function->result->is_void() || !result) {
    return rvalue(build_.int32(0),
                  function->result->is_void() || !unused ? types_.void_type() : function->result);
  }
  return rvalue(build_.read(result), function->result);
}

// [DXC: payload qualifiers] The other library's payload may have others.
void Calls::warn_passed_payload(const FunctionInfo& import, const std::vector<Value>& arguments) {
  for (size_t i = 0; i < arguments.size(); ++i) {
    const Type* type = import.parameters[i].type;
    const ir::Expr* expr = arguments[i].expr;
    const bool is_own = arguments[i].kind == ValueKind::kExpr && expr &&
                        expr->kind == ir::ExprKind::kVariable &&
                        expr->variable->storage == ir::Storage::kParameter;
    if (is_own && import.parameters[i].is_out && type->is_struct() && type->structure->is_payload) {
      report(CheckId::kImportPayload, arguments[i].location, {import.qualified});
    }
  }
}

// An unbounded array has no value that could be passed: a function that takes one is lowered again
// for every array that calls pass to it, and one that takes `float a[]` for every size.
FunctionInfo* Calls::bind_unbounded_arrays(FunctionInfo* function,
                                           const std::vector<Value>& arguments) {
  std::vector<const void*> bindings;
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (!function->parameters[i].is_unbounded()) continue;
    if (function->parameters[i].is_unsized()) {
      bindings.push_back(arguments[i].type->canonical);
      continue;
    }
    const Value& array = arguments[i];
    const auto first = array.kind == ValueKind::kBindings ? evaluate(array.offset) : std::nullopt;
    if (!first || (*first)[0] != 0) {
      report(CheckId::kUnsupported, array.location,
             {"an array of resources that is not a whole global one, for '" +
              std::string(function->parameters[i].name) + "'"});
      return nullptr;
    }
    bindings.push_back(arguments[i].binding);
  }
  if (bindings.empty() || !function->definition) return function;
  FunctionInfo*& instance = function->bound_instances[bindings];
  if (!instance) {
    instance = names_.copy_function(*function);
    instance->bound_instances.clear();
    instance->state = FunctionInfo::State::kPending;
    function->state = FunctionInfo::State::kDone;  // only its instances have bodies
    for (size_t i = 0; i < arguments.size(); ++i) {
      ParameterInfo& parameter = instance->parameters[i];
      if (parameter.is_unsized()) {
        parameter.type = types_.array(parameter.type->element, arguments[i].type->count);
      } else if (parameter.is_unbounded()) {
        parameter.binding = arguments[i].binding;
      }
    }
  }
  return instance;
}

ir::Function* Calls::make_ir_function(FunctionInfo* function) {
  ir::Function* node = &bench_.module.function_pool.emplace_back();
  node->name = function->qualified;
  const bool returns_query = function->result->is_query();
  node->result = returns_query ? types_.void_type()->ir : function->result->ir;
  node->location = locate((function->definition ? function->definition : function->decl)->location);
  if (function->definition) node->end_location = locate(function->definition->body->end);
  if (function->owner && !function->is_static) {
    ir::Variable* self =
        build_.variable("this", function->owner->type->ir, ir::Storage::kParameter);
    self->mode = function->is_const_method ? ir::ParameterMode::kIn : ir::ParameterMode::kInOut;
    node->parameters.push_back(self);
  }
  for (const ParameterInfo& parameter : function->parameters) {
    if (parameter.binding) continue;
    if (parameter.decl) at(parameter.decl->location);
    ir::Variable* variable =
        build_.variable(std::string(parameter.name), parameter.type->ir, ir::Storage::kParameter);
    variable->mode = parameter.type->is_query() ? ir::ParameterMode::kInOut
                     : !parameter.is_out        ? ir::ParameterMode::kIn
                     : parameter.is_in          ? ir::ParameterMode::kInOut
                                                : ir::ParameterMode::kOut;
    node->parameters.push_back(variable);
  }
  node->mangled = mangle(*function);
  // Two functions may differ only in what the mangled name leaves out (const methods, template
  // values).
  for (int i = 2; !mangled_names_.insert(node->mangled).second; ++i) {
    node->mangled = mangle(*function) + "#" + std::to_string(i);
  }
  return node;
}

// Lowers a body when the first call needs it, so that callees end up before their callers.
void Calls::lower_function(FunctionInfo* function, SourceLocation use) {
  if (function->state == FunctionInfo::State::kDone) return;
  if (function->state == FunctionInfo::State::kLowering) {
    report(CheckId::kRecursion, use, {function->qualified});
    return;
  }
  const bool is_importable = names_.is_importable(*function) && !function->result->is_query();
  if (!function->definition && is_importable) {
    names_.make_import(function, use);
    return;
  }
  if (!function->definition) {
    // There may be a definition elsewhere, later than the template's or method's declaration.
    messages_.report_with_notes(CheckId::kNoBody, use, {describe(*function)},
                                {{function->decl->location, "declared here"}});
    return;
  }
  if (function->signature_failed) return;
  if (function_depth_ >= kMaxFunctionDepth) {
    report(CheckId::kCallDepth, use, {function->qualified, std::to_string(kMaxFunctionDepth)});
    return;
  }
  function->state = FunctionInfo::State::kLowering;
  ++function_depth_;
  const int depth = bench_.depth;
  bench_.depth = 0;
  {
    Scope* scope = names_.make_block_scope(function->scope);
    ir::Block body;
    BodyScope saved(lower_, function, &body, scope);
    names_.see(function->body_sequence);
    function->ir = make_ir_function(function);
    size_t index = 0;
    if (function->owner && !function->is_static) {
      body_.this_variable = function->ir->parameters[0];
      index = 1;
    }
    for (const ParameterInfo& parameter : function->parameters) {
      ir::Variable* variable = parameter.binding ? nullptr : function->ir->parameters[index++];
      if (parameter.name.empty()) continue;
      if (names_.find_local(scope, parameter.name)) {
        report(CheckId::kRedefinition, parameter.decl->location, {std::string(parameter.name)});
        continue;
      }
      VariableInfo* info = names_.make_variable();
      info->name = parameter.name;
      info->type = parameter.type;
      info->is_const = parameter.is_const;
      info->kind = parameter.binding ? VariableKind::kBinding : VariableKind::kLocal;
      info->binding = parameter.binding;
      info->variable = variable;
      names_.add_variable(scope, parameter.name, parameter.decl->location, info);
    }
    lower_.coverage.line(function->definition->location);
    lower_.statements.lower_block(function->definition->body->statements);
    if (!function->result->is_void() && !lower_.statements.ends(body)) {
      report(BodyRules::has_return(body) ? CheckId::kMissingReturn : CheckId::kNeverReturns,
             function->definition->body->end, {function->qualified});
      at(function->definition->body->end);
      ir::Stmt* end = build_.stmt(ir::StmtKind::kReturn);
      if (!function->result->is_query()) end->value = build_.zero(function->result->ir);
      body.push_back(end);
    }
    if (function->result->is_query()) lower_.ray_queries.pass_returned_query(*function, body);
    function->ir->body = std::move(body);
    lower_.body_rules.check_variables(*function);
  }
  bench_.depth = depth;
  --function_depth_;
  function->state = FunctionInfo::State::kDone;
  lowered.push_back(function);
}

}  // namespace kaamos::hlsl
