// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/locals.h"

#include <set>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

void Locals::declare_variable(VariableInfo* info) {
  info->variable = build_.variable(std::string(info->name), info->type->ir, ir::Storage::kLocal);
  info->variable->is_const = info->is_const;
}

const ir::Expr* Locals::initial_value(const Expr* initialiser, const Type* type) {
  Value value = lower_.expressions.lower(initialiser);
  return lower_.conversions.convert(value, type, initialiser->location);
}

// Returns whether the value is a temporary that nothing else reads, so that the variable it
// initialises can take its place.
bool Locals::is_result_of_last_call(const ir::Expr* value) const {
  return value && value->kind == ir::ExprKind::kVariable && value->variable == body_.call_result &&
         !body_.block->empty() && body_.block->back()->kind == ir::StmtKind::kCall &&
         body_.block->back()->result == body_.call_result;
}

void Locals::lower_local(const VariableDecl* decl) {
  const Type* type = names_.resolve_variable_type(decl, body_.scope);
  at(decl->location);
  VariableInfo* info = names_.make_variable();
  info->name = decl->name;
  info->type = types_.error();
  info->is_const = is_const_type(decl->type);
  const Type* innermost = type;
  while (innermost->is_array()) innermost = innermost->element;
  const bool is_query_array = type->is_array() && innermost->is_query();
  const bool valid = is_query_array || names_.check_variable_type(type, decl->location, decl->name);
  if (const Symbol* before = names_.find_taken(body_.scope, decl->name)) {
    // [HLSL 2018: the variables of a loop belong to the scope around it]
    const bool hides = before->kind == SymbolKind::kVariable && before->variable->is_loop_variable;
    report(hides ? CheckId::kLoopVariableAgain : CheckId::kRedefinition, decl->location,
           {std::string(decl->name)});
    if (!hides) return;
    body_.scope->symbols.erase(decl->name);
  }
  if (decl->modifiers & kModGroupshared) {
    report(CheckId::kLocalGroupshared, decl->location, {std::string(decl->name)});
    names_.add_variable(body_.scope, decl->name, decl->location, info);
    return;
  }
  if (is_query_array) {
    lower_.ray_queries.lower_local_array(decl, type, info);
    names_.add_variable(body_.scope, decl->name, decl->location, info);
    return;
  }
  if (valid && type->is_query()) {
    lower_.ray_queries.lower_local_query(decl, type, info);
    names_.add_variable(body_.scope, decl->name, decl->location, info);
    return;
  }
  if (decl->modifiers & kModStatic) {
    if (valid) lower_local_static(decl, type);
    return;
  }
  const ir::Expr* value = nullptr;
  const bool is_sized_by_value = valid && type->is_array() && type->count == 0;
  if (is_sized_by_value) {
    const auto* list = as<InitListExpr>(decl->initializer);
    Value whole;
    if (decl->initializer && !list) whole = lower_.expressions.lower(decl->initializer);
    if (!list && !(whole.type && whole.type->is_array() && whole.type->count != 0)) {
      report(CheckId::kUnboundedVariable, decl->location, {std::string(decl->name)});
      names_.add_variable(body_.scope, decl->name, decl->location, info);
      return;
    }
    std::vector<Conversions::Piece> pieces;
    if (list) {
      lower_.conversions.collect_pieces(list, pieces, 0);
    } else if (const ir::Expr* expr = lower_.places.load(whole)) {
      pieces.push_back({expr, whole.type});
    }
    uint64_t count = 0;
    for (const Conversions::Piece& piece : pieces) count += flat_component_count(piece.type);
    const uint64_t element = std::max<uint64_t>(1, flat_component_count(type->element));
    type = types_.array(type->element,
                        static_cast<uint32_t>(std::clamp<uint64_t>(count / element, 1, 1u << 20)));
    value = lower_.conversions.build_from_pieces(type, std::move(pieces),
                                                 decl->initializer->location, false);
  }
  if (valid) info->type = type;
  // The scope of a name begins before its initialiser, as in C: `int x = x;` means the new x, which
  // is zero there.
  names_.add_variable(body_.scope, decl->name, decl->location, info);
  const size_t before = body_.block->size();
  if (valid && decl->initializer && !is_sized_by_value) {
    value = initial_value(decl->initializer, type);
  } else if (decl->initializer && !is_sized_by_value) {
    lower_.expressions.lower(decl->initializer);
  } else if (valid && !decl->initializer && info->is_const) {
    report(CheckId::kConstWithoutValue, decl->location, {std::string(decl->name)});
    if (!contains_resource(type)) value = build_.zero(type->ir);
  }
  if (!valid) return;
  at(decl->location);
  const bool uses_itself = info->variable;
  if (uses_itself) {
    report(CheckId::kOwnInitialiser, decl->location, {std::string(decl->name)});
    ir::Stmt* node = build_.stmt(ir::StmtKind::kDeclare);
    node->variable = info->variable;
    info->variable->is_const = false;
    body_.block->insert(body_.block->begin() + static_cast<ptrdiff_t>(before), node);
    if (value) body_.assign(info->variable, value);
  } else if (is_result_of_last_call(value)) {
    info->variable = body_.call_result;
    info->variable->name = decl->name;
    info->variable->is_const = info->is_const;
    body_.call_result = nullptr;  // now owned by the variable
  } else {
    declare_variable(info);
    ir::Stmt* node = build_.stmt(ir::StmtKind::kDeclare);
    node->variable = info->variable;
    node->value = value;
    body_.emit(node);
    if (!decl->initializer) lower_.body_rules.note_without_value(*info, decl->location);
  }
  // `const uint n = 4; float a[n];`
  const bool is_known = info->is_const && !uses_itself && value &&
                        type->ir->kind == ir::TypeKind::kScalar &&
                        value->kind == ir::ExprKind::kLiteral;
  if (is_known) info->constant = value;
}

// There is one per shader invocation, as if it were declared globally. Its initialiser must not use
// locals.
void Locals::lower_local_static(const VariableDecl* decl, const Type* type) {
  names_.declare_static(decl, type, body_.scope);
  Symbol* symbol = names_.find_local(body_.scope, decl->name);
  if (!symbol || !symbol->variable) return;
  if (symbol->variable->variable) symbol->variable->variable->name = decl->name;
  symbol->variable->sequence = names_.view().visible;
  lower_.initialisers.initialise(symbol->variable);
  const ir::Variable* variable = symbol->variable->variable;
  // The initialiser's own variables are those that it declares.
  std::set<const ir::Variable*> own;
  bool uses_local = false;
  const auto look_at = [&](const ir::Expr& expr) {
    if (expr.kind != ir::ExprKind::kVariable || own.contains(expr.variable)) return;
    uses_local = uses_local || expr.variable->storage == ir::Storage::kLocal ||
                 expr.variable->storage == ir::Storage::kParameter;
  };
  ir::visit(symbol->variable->start_up, look_at, [&](const ir::Stmt& stmt) {
    if (stmt.kind == ir::StmtKind::kDeclare) own.insert(stmt.variable);
  });
  if (variable) ir::visit_expr(variable->initialiser, look_at);
  if (uses_local) report(CheckId::kStaticUsesLocal, decl->location, {std::string(decl->name)});
}

}  // namespace kaamos::hlsl
