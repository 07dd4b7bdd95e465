// SPDX-License-Identifier: MIT
#include <algorithm>

#include "runtime/hlsl/check/checker.h"
#include "runtime/hlsl/front/edit_distance.h"

namespace kaamos::hlsl {
// What an unknown name was probably meant to be; empty if there is no guess.
std::string Checker::similar_name(std::string_view text, Scope* scope, bool with_outer) {
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
      if (symbol->sequence <= visible_) offer(name);
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

void Checker::report_unknown(CheckId id, SourceLocation location,
                             const std::vector<std::string>& arguments, std::string_view text,
                             Scope* scope, bool with_outer) {
  const std::string similar = similar_name(text, scope, with_outer);
  if (similar.empty()) {
    report_with_notes(id, location, arguments, {});
  } else {
    report_with_notes(id, location, arguments, {{location, "did you mean '" + similar + "'?"}});
  }
}

Scope* Checker::make_scope(ScopeKind kind, Scope* parent, std::string_view name) {
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

std::string Checker::qualify(const Scope* scope, std::string_view name) {
  while (scope && scope->kind == ScopeKind::kBlock) scope = scope->parent;
  if (!scope || scope->name.empty()) return std::string(name);
  return scope->name + "::" + std::string(name);
}

std::string Checker::spell(const QualifiedName& name) {
  std::string text = name.is_global ? "::" : "";
  for (const NamePart& part : name.parts) {
    if (&part != name.parts.data()) text += "::";
    text += part.identifier;
  }
  return text;
}

Symbol* Checker::add_symbol(Scope* scope, SymbolKind kind, std::string_view name,
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

bool Checker::is_tag(const Symbol& symbol) {
  return symbol.kind == SymbolKind::kType && symbol.scope;
}

Symbol* Checker::find_taken(Scope* scope, std::string_view name) {
  Symbol* symbol = find_local(scope, name);
  return symbol && is_tag(*symbol) ? nullptr : symbol;
}

Symbol* Checker::find_local(Scope* scope, std::string_view name) {
  const auto found = scope->symbols.find(name);
  return found == scope->symbols.end() ? nullptr : found->second;
}

Symbol* Checker::find_in_scope(Scope* scope, std::string_view name, bool check_order) {
  Symbol* symbol = find_local(scope, name);
  if (symbol && (!check_order || symbol->sequence <= visible_)) return symbol;
  if (symbol && symbol->hidden && symbol->hidden->sequence <= visible_) return symbol->hidden;
  if (scope->structure && scope->structure->base) {
    if (Symbol* inherited = find_member(scope->structure->base, name)) return inherited;
  }
  for (Scope* used : scope->used) {
    Symbol* found = find_local(used, name);
    if (found && (!check_order || found->sequence <= visible_)) return found;
  }
  return nullptr;
}

Symbol* Checker::find_member(StructInfo* structure, std::string_view name) {
  for (StructInfo* info = structure; info; info = info->base) {
    if (Symbol* symbol = find_local(info->scope, name)) return symbol;
  }
  return nullptr;
}

Symbol* Checker::find(Scope* scope, std::string_view name) {
  for (Scope* at_scope = scope; at_scope; at_scope = at_scope->parent) {
    if (Symbol* symbol = find_in_scope(at_scope, name, true)) return symbol;
  }
  return nullptr;
}

// The scope that is named before a `::`.
Scope* Checker::scope_of_part(const NamePart& part, Symbol* symbol, Scope* scope) {
  switch (symbol->kind) {
    case SymbolKind::kNamespace:
      return symbol->scope;
    case SymbolKind::kType:
      if (StructTemplate* own = template_of(symbol, part)) {
        StructInfo* info = instantiate_struct(own, part, part.location, scope);
        return info ? info->scope : nullptr;
      }
      if (symbol->scope) return symbol->scope;
      return symbol->type->is_struct() ? symbol->type->structure->scope : nullptr;
    case SymbolKind::kStructTemplate: {
      StructInfo* info = instantiate_struct(symbol->struct_template, part, part.location, scope);
      return info ? info->scope : nullptr;
    }
    default:
      return symbol->hidden ? scope_of_part(part, symbol->hidden, scope) : nullptr;
  }
}

Symbol* Checker::resolve_name(const QualifiedName& name, Scope* scope, bool quiet) {
  Scope* const global = unit_scopes_[scope->unit];
  Scope* in = name.is_global ? global : nullptr;
  Symbol* symbol = nullptr;
  for (const NamePart& part : name.parts) {
    symbol = in ? find_in_scope(in, part.identifier, in->kind != ScopeKind::kStruct)
                : find(scope, part.identifier);
    if (!symbol) {
      if (!quiet && !in && part.identifier == "dx" && name.parts.size() > 1) {
        report(CheckId::kNeedsShaderModel, name.parts[0].location, {spell(name), "6.9"});
      } else if (!quiet) {
        const std::string where = in && in != global ? " in '" + in->name + "'" : "";
        report_unknown(CheckId::kUndeclared, part.location, {std::string(part.identifier), where},
                       part.identifier, in ? in : scope, in == nullptr);
      }
      return nullptr;
    }
    if (&part == &name.parts.back()) break;
    in = scope_of_part(part, symbol, scope);
    if (!in) {
      if (!quiet) report(CheckId::kNotAScope, part.location, {std::string(part.identifier)});
      return nullptr;
    }
  }
  return symbol;
}

}  // namespace kaamos::hlsl
