// SPDX-License-Identifier: MIT
// Records what the parser needs to know about names while it parses: which are types, templates and
// namespaces, and in which scope. Variables and functions are recorded only if they hide a type.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "runtime/hlsl/front/parse_builtin_names.h"
#include "runtime/hlsl/front/token.h"

namespace kaamos::hlsl {

enum class ParsedKind : uint8_t {
  kUnknown,  // Not declared as anything the parser records; usually a value.
  kValue,
  kFunctionTemplate,
  kNamespace,
  kSubobject,
  kType,  // This kind and all after it are types.
  kNumericType,
  kTypeParameter,
};

using ScopeId = uint32_t;
inline constexpr ScopeId kGlobalScope = 0;
inline constexpr ScopeId kNoScope = 0xFFFFFFFFu;
// The members of a type that is not known before a template is instantiated.
inline constexpr ScopeId kDependentScope = 0xFFFFFFFEu;
// `dx::`, whose types are built in.
inline constexpr ScopeId kBuiltinScope = 0xFFFFFFFDu;

struct ParsedSymbol {
  ParsedKind kind = ParsedKind::kUnknown;
  ScopeId scope = kNoScope;  // What `name::` looks into.

  bool is_type() const { return kind >= ParsedKind::kType; }
};

class ParseScopes {
 public:
  explicit ParseScopes(const std::vector<Token>& tokens);

  ScopeId current() const { return current_; }
  ScopeId create(ScopeId parent);
  // Enters `scope`; returns the scope to go back to.
  ScopeId enter(ScopeId scope);
  void add_base(ScopeId scope, ScopeId base);
  void add_using(ScopeId scope, ScopeId target);

  void declare(ScopeId scope, uint32_t name, ParsedSymbol symbol);
  // A variable, parameter, function or enumerator.
  void declare_value(ScopeId scope, const Token& name);
  ParsedSymbol find(const Token& name);
  ParsedSymbol find_in(ScopeId scope, const Token& name);
  // Behind `struct` or `enum` and before `::`: values of the same name and scope are not seen.
  ParsedSymbol find_tag(const Token& name);
  // Is there a function template called `name` in any scope? Decides `x.name<` when the type of x
  // is unknown.
  bool is_template_function(uint32_t name) const { return infos_[name].is_template_function; }
  // Was it ever declared as a variable, parameter, function or enumerator?
  bool is_known_value(const Token& name) const { return infos_[name.value].is_value; }
  const BuiltinName& builtin(const Token& name);

 private:
  struct Scope {
    ScopeId parent;
    std::vector<ScopeId> linked;  // Base structs and namespaces of `using namespace`.
    bool uses_builtin = false;    // `using namespace dx`
  };
  struct NameInfo {
    bool is_recorded = false;  // Declared in some scope.
    bool is_value = false;
    bool is_classified = false;
    bool is_template_function = false;
    BuiltinName builtin;
  };
  static uint64_t key(ScopeId scope, uint32_t name) { return uint64_t{scope} << 32 | name; }
  ParsedSymbol find_linked(ScopeId scope, uint32_t name, int& visits) const;

  std::vector<Scope> scopes_;
  std::vector<NameInfo> infos_;  // By Token::value.
  std::unordered_map<uint64_t, ParsedSymbol> symbols_;
  std::unordered_map<uint64_t, ParsedSymbol>
      hidden_;  // Structs and enums, by values of their name.
  ScopeId current_ = kGlobalScope;
};

}  // namespace kaamos::hlsl
