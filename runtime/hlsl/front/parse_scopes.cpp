// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/parse_scopes.h"

#include <algorithm>

namespace kaamos::hlsl {
namespace {

// The most scopes that one look-up visits through bases and `using namespace`. The limit ends
// cycles, and keeps a web of namespaces that all use each other from taking forever.
constexpr int kMaxVisits = 256;

bool is_word(TokenKind kind) {
  return kind == TokenKind::kIdentifier || is_keyword(kind);
}

}  // namespace

ParseScopes::ParseScopes(const std::vector<Token>& tokens) {
  uint32_t count = 0;
  for (const Token& token : tokens) {
    if (is_word(token.kind)) count = std::max(count, token.value + 1);
  }
  infos_.resize(count);
  scopes_.push_back({kNoScope, {}});
}

ScopeId ParseScopes::create(ScopeId parent) {
  scopes_.push_back({parent, {}});
  return static_cast<ScopeId>(scopes_.size() - 1);
}

ScopeId ParseScopes::enter(ScopeId scope) {
  const ScopeId previous = current_;
  current_ = scope;
  return previous;
}

void ParseScopes::add_base(ScopeId scope, ScopeId base) {
  if (base >= scopes_.size() || base == scope) return;
  std::vector<ScopeId>& linked = scopes_[scope].linked;
  if (std::find(linked.begin(), linked.end(), base) == linked.end()) linked.push_back(base);
}

void ParseScopes::add_using(ScopeId scope, ScopeId target) {
  if (target == kBuiltinScope) {
    scopes_[scope].uses_builtin = true;
    return;
  }
  add_base(scope, target);
}

void ParseScopes::declare(ScopeId scope, uint32_t name, ParsedSymbol symbol) {
  infos_[name].is_recorded = true;
  if (symbol.kind == ParsedKind::kFunctionTemplate) infos_[name].is_template_function = true;
  symbols_[key(scope, name)] = symbol;
}

void ParseScopes::declare_value(ScopeId scope, const Token& name) {
  // A name that has not been a type anywhere so far hides nothing.
  NameInfo& info = infos_[name.value];
  info.is_value = true;
  if (!info.is_recorded && builtin(name).kind == BuiltinName::kNone) return;
  info.is_recorded = true;
  // Overloading a function template leaves it a template.
  ParsedSymbol& symbol = symbols_[key(scope, name.value)];
  if (symbol.kind == ParsedKind::kType) hidden_[key(scope, name.value)] = symbol;
  if (symbol.kind != ParsedKind::kFunctionTemplate) symbol = {ParsedKind::kValue, kNoScope};
}

const BuiltinName& ParseScopes::builtin(const Token& name) {
  NameInfo& info = infos_[name.value];
  if (!info.is_classified) {
    info.is_classified = true;
    info.builtin = find_builtin_name(name.text);
  }
  return info.builtin;
}

ParsedSymbol ParseScopes::find(const Token& name) {
  const BuiltinName& found = builtin(name);
  if (infos_[name.value].is_recorded) {
    for (ScopeId scope = current_; scope != kNoScope; scope = scopes_[scope].parent) {
      int visits = kMaxVisits;
      const ParsedSymbol symbol = find_linked(scope, name.value, visits);
      if (symbol.kind != ParsedKind::kUnknown) return symbol;
    }
  }
  if (found.kind == BuiltinName::kNumeric) return {ParsedKind::kNumericType, kNoScope};
  if (found.kind == BuiltinName::kType) return {ParsedKind::kType, kNoScope};
  if (found.kind == BuiltinName::kNamespace) return {ParsedKind::kNamespace, kBuiltinScope};
  if (found.kind == BuiltinName::kSubobject) return {ParsedKind::kSubobject, kNoScope};
  if (found.kind == BuiltinName::kScopedType) {
    for (ScopeId scope = current_; scope != kNoScope; scope = scopes_[scope].parent) {
      if (scopes_[scope].uses_builtin) return {ParsedKind::kType, kNoScope};
    }
  }
  return {};
}

ParsedSymbol ParseScopes::find_tag(const Token& name) {
  if (infos_[name.value].is_recorded) {
    for (ScopeId scope = current_; scope != kNoScope; scope = scopes_[scope].parent) {
      const auto found = hidden_.find(key(scope, name.value));
      if (found != hidden_.end()) return found->second;
      int visits = kMaxVisits;
      const ParsedSymbol symbol = find_linked(scope, name.value, visits);
      if (symbol.is_type()) return symbol;
    }
  }
  return find(name);
}

ParsedSymbol ParseScopes::find_in(ScopeId scope, const Token& name) {
  if (scope == kBuiltinScope) {
    const bool is_type = builtin(name).kind == BuiltinName::kScopedType;
    return is_type ? ParsedSymbol{ParsedKind::kType, kNoScope} : ParsedSymbol{};
  }
  if (scope >= scopes_.size() || !infos_[name.value].is_recorded) return {};
  int visits = kMaxVisits;
  return find_linked(scope, name.value, visits);
}

ParsedSymbol ParseScopes::find_linked(ScopeId scope, uint32_t name, int& visits) const {
  if (auto found = symbols_.find(key(scope, name)); found != symbols_.end()) return found->second;
  for (ScopeId linked : scopes_[scope].linked) {
    if (--visits <= 0) return {};
    const ParsedSymbol symbol = find_linked(linked, name, visits);
    if (symbol.kind != ParsedKind::kUnknown) return symbol;
  }
  return {};
}

}  // namespace kaamos::hlsl
