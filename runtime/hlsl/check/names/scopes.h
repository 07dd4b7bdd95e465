// SPDX-License-Identifier: MIT
//
// Scopes, the symbols in them, and how one is found.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/names/messages.h"
#include "runtime/hlsl/check/names/symbols.h"

namespace kaamos::hlsl {

class Scopes {
 public:
  explicit Scopes(Messages& messages) : messages_(messages) {}

  uint32_t visible = ~0u;  // symbols with a later sequence are not declared yet
  uint32_t next_sequence() { return ++sequence_; }

  Scope* make_scope(ScopeKind kind, Scope* parent, std::string_view name = {});
  Symbol* add_symbol(Scope* scope, SymbolKind kind, std::string_view name, SourceLocation location);
  Symbol* find_local(Scope* scope, std::string_view name);
  // Returns what keeps variables and functions from having the name in this scope.
  Symbol* find_taken(Scope* scope, std::string_view name);
  Symbol* find_in_scope(Scope* scope, std::string_view name, bool check_order);
  Symbol* find_member(StructInfo* structure, std::string_view name);
  Symbol* find(Scope* scope, std::string_view name);
  // Adds a note that suggests what may have been meant.
  void report_unknown(CheckId id, SourceLocation location,
                      const std::vector<std::string>& arguments, std::string_view text,
                      Scope* scope, bool with_outer);
  static std::string qualify(const Scope* scope, std::string_view name);
  static std::string spell(const QualifiedName& name);

 private:
  // A struct or enum, whose name a variable or function of the same scope may take over.
  static bool is_tag(const Symbol& symbol);
  std::string similar_name(std::string_view text, Scope* scope, bool with_outer);

  Messages& messages_;
  std::deque<Scope> scopes_;
  std::deque<Symbol> symbols_;
  uint32_t sequence_ = 0;
};

}  // namespace kaamos::hlsl
