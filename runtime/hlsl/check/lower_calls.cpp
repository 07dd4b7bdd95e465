// SPDX-License-Identifier: MIT
// Calls of functions and methods, including copy-in and copy-out.
#include <algorithm>

#include "runtime/hlsl/check/checker.h"
#include "runtime/hlsl/check/mangle.h"

namespace kaamos::hlsl {
namespace {

constexpr int kMaxFunctionDepth = 200;

}  // namespace

Value Lowerer::lower_call(const CallExpr* expr) {
  if (const auto* member = as<MemberExpr>(expr->callee)) return call_method(member, expr);
  const auto* callee = as<NameExpr>(expr->callee);
  if (!callee) {
    // An object with an operator().
    std::vector<const Expr*> all = {expr->callee};
    all.insert(all.end(), expr->arguments.begin(), expr->arguments.end());
    std::vector<Value> values = lower_all(all, true);
    if (values[0].failed()) return error_value();
    const Value object = values[0];
    values.erase(values.begin());
    if (object.type && object.type->is_struct()) {
      if (auto result = overloaded_operator("operator()", object, values, expr->location)) {
        return *result;
      }
    }
    report(CheckId::kNotCallable, expr->location);
    return error_value();
  }
  const QualifiedName& name = *callee->name;
  Symbol* symbol = checker_.resolve_name(name, scope_, true);
  if (symbol &&
      (symbol->kind == SymbolKind::kType || symbol->kind == SymbolKind::kStructTemplate)) {
    const Type* type = symbol->type;
    if (symbol->kind == SymbolKind::kStructTemplate) {
      StructInfo* info =
          checker_.instantiate_struct(symbol->struct_template, name.last(), expr->location, scope_);
      type = info ? info->type : types_.error();
    }
    return lower_construct(type, expr->arguments, expr->location);
  }
  const bool unused = result_unused_;
  if (symbol && (symbol->kind == SymbolKind::kVariable || symbol->kind == SymbolKind::kField)) {
    Value object = lower(expr->callee);
    if (object.failed()) return object;
    std::vector<Value> values = lower_all(expr->arguments, true, true);
    if (object.type && object.type->is_struct()) {
      if (auto result = overloaded_operator("operator()", object, values, expr->location)) {
        return *result;
      }
    }
    report(CheckId::kNotCallable, expr->location);
    return error_value();
  }
  std::vector<Value> arguments = lower_all(expr->arguments, true, true);
  for (const Value& argument : arguments) {
    if (argument.failed()) return error_value();
  }
  result_unused_ = unused;
  at(expr->location);
  if (symbol && symbol->kind == SymbolKind::kFunctions) {
    const bool is_builtin = name.is_simple() && is_builtin_function(name.last().identifier);
    FunctionInfo* function =
        resolve_overload(symbol->functions, name.last(), arguments, expr->location, is_builtin);
    if (function) {
      // A method of this object; a static one needs no object.
      if (function->owner && !function->is_static) {
        if (!this_variable_) {
          report(CheckId::kMethodWithoutObject, expr->location, {function->qualified});
          return error_value();
        }
        const Value self = base_of(lower_this(expr->location), function->owner);
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
    if (auto result = call_builtin(name.last(), arguments, expr->location)) return *result;
  }
  if (auto result = call_vk(name, arguments, expr->location)) return *result;
  checker_.resolve_name(name, scope_, false);
  return error_value();
}

Value Lowerer::call_method(const MemberExpr* callee, const CallExpr* call_expr) {
  const bool unused = result_unused_;
  std::vector<const Expr*> all = {callee->base};
  all.insert(all.end(), call_expr->arguments.begin(), call_expr->arguments.end());
  std::vector<Value> values = lower_all(all, true, true);
  values[0].saved = nullptr;  // the object is not passed by value
  result_unused_ = unused;
  for (const Value& value : values) {
    if (value.failed()) return error_value();
  }
  Value object = values[0];
  std::vector<Value> arguments(values.begin() + 1, values.end());
  const NamePart& part = callee->name->last();
  const SourceLocation location = callee->location;
  at(location);
  if (!object.type) {
    load(object);
    return error_value();
  }
  if (object.type->is_query()) return call_query_method(object, part, arguments, location);
  if (object.type->is_resource()) {
    if (object.type->resource != ir::ResourceKind::kConstantBuffer) {
      return call_resource_method(object, part, arguments, location);
    }
    object = memory(load(object), nullptr, build_.uint32(0), object.type->element,
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
  Symbol* symbol = checker_.find_member(structure, part.identifier);
  if (!symbol || symbol->kind != SymbolKind::kFunctions) {
    checker_.report_unknown(CheckId::kNoSuchMethod, location,
                            {to_string(object.type), std::string(part.identifier)}, part.identifier,
                            structure->scope, false);
    return error_value();
  }
  return call_functions(symbol->functions, part, &object, std::move(arguments), location);
}

Value Lowerer::call_functions(const std::vector<FunctionInfo*>& candidates, const NamePart& part,
                              const Value* object, std::vector<Value> arguments,
                              SourceLocation location) {
  FunctionInfo* function = resolve_overload(candidates, part, arguments, location, false);
  if (!function) return error_value();
  if (!function->owner || function->is_static || !object) {
    return call(function, nullptr, std::move(arguments), location);
  }
  const Value self = base_of(*object, function->owner);
  return call(function, &self, std::move(arguments), location);
}

Value Lowerer::call(FunctionInfo* function, const Value* object, std::vector<Value> arguments,
                    SourceLocation location) {
  const bool unused = result_unused_;
  result_unused_ = false;
  for (size_t i = arguments.size(); i < function->parameters.size(); ++i) {
    // A default argument is looked up in the scope of the function's declaration.
    Scope* scope = scope_;
    scope_ = function->scope;
    arguments.push_back(lower(function->parameters[i].default_value));
    arguments.back().location = location;
    scope_ = scope;
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
  };
  std::vector<CopyOut> copies;

  const auto uses = [&](const ir::Variable* variable, size_t except) {
    for (size_t i = 0; i < arguments.size(); ++i) {
      if (i == except) continue;
      const Value& other = arguments[i];
      if (mentions(other.expr, variable) || mentions(other.offset, variable) ||
          mentions(other.element, variable) || mentions(other.coordinates, variable) ||
          mentions(other.mip, variable)) {
        return true;
      }
    }
    return except != SIZE_MAX && object &&
           (mentions(object->expr, variable) || mentions(object->offset, variable) ||
            mentions(object->element, variable));
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
    size_t position = block().size();
    if (writes_back) freeze(target, &position);
    const ir::Variable* variable = nullptr;
    if (is_in) {
      const ir::Expr* copy = convert(target, type, value.location);
      if (!copy) return false;
      at(location);
      variable = temporary(copy);
    } else {
      variable = empty_temporary(type->ir);
    }
    statement->arguments.push_back(build_.read(variable));
    if (writes_back) copies.push_back({target, variable, type});
    return true;
  };

  if (object) {
    const Type* type = function->owner->type;
    if (function->is_const_method) {
      const ir::Expr* self = load(*object);
      if (!self) return error_value();
      statement->arguments.push_back(self);
    } else {
      const bool writes_back = object->is_place && !object->is_const;
      if (!by_reference(*object, type, true, writes_back, SIZE_MAX)) return error_value();
    }
  }
  for (size_t i = 0; i < arguments.size(); ++i) {
    const ParameterInfo& parameter = function->parameters[i];
    const Value& argument = arguments[i];
    if (parameter.binding) continue;
    if (parameter.type->is_query()) {
      // The parameter is a second name for the same object, whatever its direction. [DXR: RayQuery]
      const ir::Expr* query = query_object(argument, parameter.type);
      if (!query) return error_value();
      statement->arguments.push_back(query);
    } else if (parameter.is_out) {
      const std::string purpose = std::string("an argument of ") +
                                  (parameter.is_in ? "inout" : "out") + " parameter '" +
                                  std::string(parameter.name) + "'";
      if (!require_whole_field(argument, argument.location, purpose) ||
          !require_place(argument, argument.location, purpose)) {
        return error_value();
      }
      if (!by_reference(argument, parameter.type, parameter.is_in, true, i)) return error_value();
    } else {
      const ir::Expr* value = convert(argument, parameter.type, argument.location);
      if (!value) return error_value();
      statement->arguments.push_back(value);
    }
  }
  at(location);
  ir::Variable* result = nullptr;
  if (!function->result->is_void() && !unused) {
    result = empty_temporary(function->result->ir);
    statement->result = result;
  }
  if (function_) function_->callees.push_back(function->linked ? function->linked : function);
  emit(statement);
  call_result_ = result;
  for (const CopyOut& copy : copies) {
    const Value value = rvalue(build_.read(copy.variable), copy.type);
    store(copy.target, convert(value, copy.target.type, location, true));
  }
  if (function->result->is_void() || !result) {
    return rvalue(build_.int32(0),
                  function->result->is_void() || !unused ? types_.void_type() : function->result);
  }
  return rvalue(build_.read(result), function->result);
}

// [DXC: payload qualifiers] The other library's payload may have others.
void Lowerer::warn_passed_payload(const FunctionInfo& import, const std::vector<Value>& arguments) {
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
// for every array that calls pass to it.
FunctionInfo* Lowerer::bind_unbounded_arrays(FunctionInfo* function,
                                             const std::vector<Value>& arguments) {
  std::vector<const BindingInfo*> bindings;
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (!function->parameters[i].is_unbounded()) continue;
    if (arguments[i].kind != ValueKind::kBindings) {
      load(arguments[i]);
      return nullptr;
    }
    bindings.push_back(arguments[i].binding);
  }
  if (bindings.empty() || !function->definition) return function;
  FunctionInfo*& instance = function->bound_instances[bindings];
  if (!instance) {
    instance = &checker_.functions_.emplace_back(*function);
    instance->bound_instances.clear();
    instance->state = FunctionInfo::State::kPending;
    function->state = FunctionInfo::State::kDone;  // only its instances have bodies
    for (size_t i = 0; i < arguments.size(); ++i) {
      ParameterInfo& parameter = instance->parameters[i];
      if (parameter.is_unbounded()) parameter.binding = arguments[i].binding;
    }
  }
  return instance;
}

ir::Function* Lowerer::make_ir_function(FunctionInfo* function) {
  ir::Function* node = &checker_.module_->function_pool.emplace_back();
  node->name = function->qualified;
  node->result = function->result->ir;
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
void Lowerer::lower_function(FunctionInfo* function, SourceLocation use) {
  if (function->state == FunctionInfo::State::kDone) return;
  if (function->state == FunctionInfo::State::kLowering) {
    report(CheckId::kRecursion, use, {function->qualified});
    return;
  }
  if (!function->definition && checker_.is_importable(*function)) {
    checker_.make_import(function, use);
    return;
  }
  if (!function->definition) {
    // There may be a definition elsewhere, later than the template's or method's declaration.
    checker_.report_with_notes(CheckId::kNoBody, use, {describe(*function)},
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
  const int depth = depth_;
  depth_ = 0;
  {
    Scope* scope = checker_.make_scope(ScopeKind::kBlock, function->scope);
    ir::Block body;
    BodyScope saved(*this, function, &body, scope);
    checker_.visible_ = function->body_sequence;
    function->ir = make_ir_function(function);
    size_t index = 0;
    if (function->owner && !function->is_static) {
      this_variable_ = function->ir->parameters[0];
      index = 1;
    }
    for (const ParameterInfo& parameter : function->parameters) {
      ir::Variable* variable = parameter.binding ? nullptr : function->ir->parameters[index++];
      if (parameter.name.empty()) continue;
      if (checker_.find_local(scope, parameter.name)) {
        report(CheckId::kRedefinition, parameter.decl->location, {std::string(parameter.name)});
        continue;
      }
      VariableInfo* info = &checker_.variables_.emplace_back();
      info->name = parameter.name;
      info->type = parameter.type;
      info->is_const = parameter.is_const;
      info->kind = parameter.binding ? VariableKind::kBinding : VariableKind::kLocal;
      info->binding = parameter.binding;
      info->variable = variable;
      checker_.add_symbol(scope, SymbolKind::kVariable, parameter.name, parameter.decl->location)
          ->variable = info;
    }
    lower_block(function->definition->body->statements);
    if (!function->result->is_void() && !ends(body)) {
      report(CheckId::kMissingReturn, function->definition->body->end, {function->qualified});
      at(function->definition->body->end);
      ir::Stmt* end = build_.stmt(ir::StmtKind::kReturn);
      end->value = build_.zero(function->result->ir);
      body.push_back(end);
    }
    function->ir->body = std::move(body);
  }
  depth_ = depth;
  --function_depth_;
  function->state = FunctionInfo::State::kDone;
  lowered_functions_.push_back(function);
}

}  // namespace kaamos::hlsl
