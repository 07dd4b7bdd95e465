// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/enums.h"

#include <algorithm>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/names/name_parts.h"

namespace kaamos::hlsl {

// The type of an enumerator before the closing brace, where the previous one has the type `before`
// and this one is one more.
const Type* Enums::enumerator_type(const Type* before, int64_t value, bool is_fixed) {
  if (is_fixed) return before;
  if (before->scalar == Scalar::kInt32 && value > INT32_MAX) return types_.scalar(Scalar::kInt64);
  if (before->scalar == Scalar::kUint32 && value > UINT32_MAX) {
    return types_.scalar(Scalar::kUint64);
  }
  return before;
}

void Enums::declare_enum(const EnumDecl* decl, Scope* scope) {
  EnumInfo* info = &program_.enums.emplace_back();
  info->name = decl->name.empty() ? "enum" : Scopes::qualify(scope, decl->name);
  info->is_class = decl->is_class;
  const bool is_fixed = decl->underlying || decl->is_class;
  if (decl->underlying) {
    const Type* underlying = parts_.resolver.resolve_type(decl->underlying, scope);
    if (underlying->is_scalar() && !is_floating(underlying->scalar)) {
      info->underlying = underlying->scalar;
    } else if (!underlying->is_error()) {
      report(CheckId::kEnumBase, decl->underlying->location, {to_string(underlying)});
    }
  }
  Scope* inner = scopes_.make_scope(ScopeKind::kEnum, scope, decl->name);
  Symbol* name = nullptr;
  if (!decl->name.empty()) {
    if (scopes_.find_local(scope, decl->name)) {
      report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
    }
    name = scopes_.add_symbol(scope, SymbolKind::kType, decl->name, decl->location);
    name->type = types_.scalar(info->underlying);
    name->scope = inner;
  }
  int64_t next = 0;
  // Up to the closing brace an enumerator is a plain number. [C++: dcl.enum]
  const Type* type = types_.scalar(info->underlying);
  for (const Enumerator& enumerator : decl->enumerators) {
    if (enumerator.value) {
      const Type* written = nullptr;
      const auto value = parts_.evaluator.constant_integer(enumerator.value, inner,
                                                           "the value of an enumerator", &written);
      if (value) next = *value;
      if (value && !is_fixed) type = types_.scalar(written->scalar);
    }
    type = enumerator_type(type, next, is_fixed);
    const auto add = [&](Scope* target) {
      if (scopes_.find_local(target, enumerator.name)) {
        report(CheckId::kRedefinition, enumerator.location, {std::string(enumerator.name)});
        return;
      }
      Symbol* symbol =
          scopes_.add_symbol(target, SymbolKind::kConstant, enumerator.name, enumerator.location);
      symbol->type = type;
      symbol->value =
          build_.literal(type->ir, {normalise_bits(static_cast<uint64_t>(next), type->ir->scalar)});
    };
    add(inner);
    next = static_cast<int64_t>(static_cast<uint64_t>(next) + 1);
  }
  close_enum(decl, info, inner);
  const Type* enumeration = types_.enumeration(info);
  program_.declared_types[decl] = enumeration;
  if (name) name->type = enumeration;
  for (const Enumerator& enumerator : decl->enumerators) {
    Symbol* symbol = scopes_.find_local(inner, enumerator.name);
    if (!symbol) continue;
    if (symbol->type != enumeration) {
      symbol->value = build_.literal(
          enumeration->ir, {convert_bits(symbol->value->literal[0], symbol->type->ir->scalar,
                                         enumeration->ir->scalar)});
      symbol->type = enumeration;
    }
    if (decl->is_class) continue;
    if (scopes_.find_local(scope, enumerator.name)) {
      report(CheckId::kRedefinition, enumerator.location, {std::string(enumerator.name)});
      continue;
    }
    Symbol* outer =
        scopes_.add_symbol(scope, SymbolKind::kConstant, enumerator.name, enumerator.location);
    outer->type = enumeration;
    outer->value = symbol->value;
  }
}

// Without a written type an unscoped enum is as small as its values allow, and unsigned if none of
// them is negative.
void Enums::close_enum(const EnumDecl* decl, EnumInfo* info, Scope* inner) {
  if (decl->underlying || decl->is_class) return;
  int64_t least = 0;
  uint64_t most = 0;
  for (const Enumerator& enumerator : decl->enumerators) {
    const Symbol* symbol = scopes_.find_local(inner, enumerator.name);
    if (!symbol) continue;
    const uint64_t bits = symbol->value->literal[0];
    const auto number = static_cast<int64_t>(bits);
    if (is_signed_integer(symbol->type->scalar) && number < 0) {
      least = std::min(least, number);
    } else {
      most = std::max(most, bits);
    }
  }
  if (least < 0) {
    const bool is_short = least >= INT32_MIN && most <= INT32_MAX;
    info->underlying = is_short ? Scalar::kInt32 : Scalar::kInt64;
  } else {
    info->underlying = most <= UINT32_MAX ? Scalar::kUint32 : Scalar::kUint64;
  }
}

}  // namespace kaamos::hlsl
