// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/scopes.h"

#include <algorithm>

#include "runtime/hlsl/front/edit_distance.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

// Returns what an unknown name was probably meant to be; empty if there is no guess.
std::string Scopes::similar_name(std::string_view text, Scope* scope, bool with_outer) {
  if (text.size() > 64) return {};
  size_t best = (text.size() <= 4 ? 1 : 2) + 1;
  std::string_view result;
  const auto offer = [&](std::string_view candidate) {
    const size_t found = edit_distance(text, candidate, best);
    // Ties go to the alphabetically first, so that the result does not depend on hash table order.
    const bool is_better = found < best || (found == best && candidate < result);
    if (!is_better) return;
    best = found;
    result = candidate;
  };
  for (Scope* at = scope; at; at = with_outer ? at->parent : nullptr) {
    for (const auto& [name, symbol] : at->symbols) {
      if (symbol->sequence <= visible) offer(name);
    }
    if (at->structure && at->structure->base) {
      for (const auto& [name, symbol] : at->structure->base->scope->symbols) offer(name);
    }
  }
  if (with_outer) {
    for (const std::string_view name : builtin_function_names()) offer(name);
  }
  return std::string(result);
}

void Scopes::report_unknown(CheckId id, SourceLocation location,
                            const std::vector<std::string>& arguments, std::string_view text,
                            Scope* scope, bool with_outer) {
  const std::string similar = similar_name(text, scope, with_outer);
  if (similar.empty()) {
    messages_.report_with_notes(id, location, arguments, {});
  } else {
    messages_.report_with_notes(id, location, arguments,
                                {{location, "did you mean '" + similar + "'?"}});
  }
}

Scope* Scopes::make_scope(ScopeKind kind, Scope* parent, std::string_view name) {
  Scope* scope = &scopes_.emplace_back();
  scope->kind = kind;
  scope->parent = parent;
  if (parent) scope->unit = parent->unit;
  if (kind == ScopeKind::kBlock) return scope;
  scope->name = name.empty() && parent ? parent->name
                : parent               ? qualify(parent, name)
                                       : std::string(name);
  return scope;
}

std::string Scopes::qualify(const Scope* scope, std::string_view name) {
  while (scope && scope->kind == ScopeKind::kBlock) scope = scope->parent;
  if (!scope || scope->name.empty()) return std::string(name);
  return scope->name + "::" + std::string(name);
}

std::string Scopes::spell(const QualifiedName& name) {
  std::string text = name.is_global ? "::" : "";
  for (const NamePart& part : name.parts) {
    if (&part != name.parts.data()) text += "::";
    text += part.identifier;
  }
  return text;
}

Symbol* Scopes::add_symbol(Scope* scope, SymbolKind kind, std::string_view name,
                           SourceLocation location) {
  Symbol* symbol = &symbols_.emplace_back();
  symbol->kind = kind;
  symbol->name = name;
  symbol->location = location;
  const bool ordered = scope->kind == ScopeKind::kGlobal || scope->kind == ScopeKind::kNamespace;
  symbol->sequence = ordered && location.is_valid() ? ++sequence_ : 0;
  if (name.empty()) return symbol;
  Symbol*& entry = scope->symbols[name];
  if (entry && is_tag(*entry) && kind != SymbolKind::kType) symbol->hidden = entry;
  entry = symbol;
  return symbol;
}

bool Scopes::is_tag(const Symbol& symbol) {
  return symbol.kind == SymbolKind::kType && symbol.scope;
}

Symbol* Scopes::find_taken(Scope* scope, std::string_view name) {
  Symbol* symbol = find_local(scope, name);
  return symbol && is_tag(*symbol) ? nullptr : symbol;
}

Symbol* Scopes::find_local(Scope* scope, std::string_view name) {
  const auto found = scope->symbols.find(name);
  return found == scope->symbols.end() ? nullptr : found->second;
}

Symbol* Scopes::find_in_scope(Scope* scope, std::string_view name, bool check_order) {
  Symbol* symbol = find_local(scope, name);
  if (symbol && (!check_order || symbol->sequence <= visible)) return symbol;
  if (symbol && symbol->hidden && symbol->hidden->sequence <= visible) return symbol->hidden;
  if (scope->structure && scope->structure->base) {
    if (Symbol* inherited = find_member(scope->structure->base, name)) return inherited;
  }
  for (Scope* used : scope->used) {
    Symbol* found = find_local(used, name);
    if (found && (!check_order || found->sequence <= visible)) return found;
  }
  return nullptr;
}

Symbol* Scopes::find_member(StructInfo* structure, std::string_view name) {
  for (StructInfo* info = structure; info; info = info->base) {
    if (Symbol* symbol = find_local(info->scope, name)) return symbol;
  }
  return nullptr;
}

Symbol* Scopes::find(Scope* scope, std::string_view name) {
  for (Scope* at_scope = scope; at_scope; at_scope = at_scope->parent) {
    if (Symbol* symbol = find_in_scope(at_scope, name, true)) return symbol;
  }
  return nullptr;
}

}  // namespace kaamos::hlsl
