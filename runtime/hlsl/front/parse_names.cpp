// SPDX-License-Identifier: MIT
// Names, what they mean, and where `<` begins template arguments.
#include <algorithm>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {
namespace {

// Bounds the look-ahead into `a<b<c<...`; nobody nests undeclared names more deeply.
constexpr int kMaxLookAheadDepth = 4;

}  // namespace

ParsedSymbol Parser::find_first_part(size_t index) {
  const auto is_behind = [&](Kind kind) { return index > 0 && tokens_[index - 1].is(kind); };
  const bool is_tag = is_behind(Kind::kStruct) || is_behind(Kind::kClass) ||
                      is_behind(Kind::kEnum) || token_at(index + 1).is(Kind::kColonColon);
  return is_tag ? scopes_.find_tag(token_at(index)) : scopes_.find(token_at(index));
}

Parser::NameLookup Parser::look_up(size_t index) {
  NameLookup result;
  size_t i = index;
  const bool is_global = token_at(i).is(Kind::kColonColon);
  if (is_global) ++i;
  result.end = index;
  if (!is_name(i)) return result;
  result.symbol = is_global ? scopes_.find_in(kGlobalScope, token_at(i)) : find_first_part(i);
  // `::float3`, `::RayDesc`: the built-in names are in the global scope.
  if (is_global && result.symbol.kind == ParsedKind::kUnknown) {
    const ScopeId previous = scopes_.enter(kGlobalScope);
    result.symbol = scopes_.find(token_at(i));
    scopes_.enter(previous);
  }
  for (;;) {
    const size_t name = i++;
    if (begins_template_arguments(i, name, result.symbol, false)) {
      const size_t end = behind_template_arguments(i);
      if (end == i) break;
      i = end;
    }
    result.end = i;
    if (!token_at(i).is(Kind::kColonColon) || !is_name(i + 1)) break;
    ++i;
    const ScopeId scope = result.symbol.scope;
    result.is_dependent = scope == kDependentScope;
    result.symbol = scopes_.find_in(scope, token_at(i));
    if (result.is_dependent) result.symbol.scope = kDependentScope;
  }
  if (result.end == index) result.end = i;
  return result;
}

bool Parser::begins_template_arguments(size_t index, size_t name_index, const ParsedSymbol& symbol,
                                       bool is_member) {
  if (!token_at(index).is(Kind::kLess)) return false;
  if (symbol.is_type()) return symbol.kind == ParsedKind::kType;
  auto is_called = [&](size_t end) {
    const Kind next = token_at(end).kind;
    return end != index && (next == Kind::kLeftParen || next == Kind::kColonColon);
  };
  if (symbol.kind == ParsedKind::kFunctionTemplate) {
    return is_called(behind_template_arguments(index));
  }
  if (symbol.kind == ParsedKind::kValue) return false;
  const bool is_template = is_member && scopes_.is_template_function(token_at(name_index).value);
  if (is_template && is_called(behind_template_arguments(index))) return true;
  if (look_ahead_depth_ >= kMaxLookAheadDepth) return false;
  ++look_ahead_depth_;
  const bool result = is_called(behind_plain_template_arguments(index, !is_template));
  --look_ahead_depth_;
  return result;
}

size_t Parser::behind_template_arguments(size_t index) const {
  size_t depth = 0;
  size_t i = index;
  for (size_t steps = 0; steps < kMaxLookAhead; ++steps) {
    switch (token_at(i).kind) {
      case Kind::kLess:
        ++depth;
        break;
      case Kind::kGreater:
        if (--depth == 0) return i + 1;
        break;
      case Kind::kGreaterGreater:
        if (depth == 1) return i;
        if (depth == 2) return i + 1;
        depth -= 2;
        break;
      case Kind::kGreaterEqual:
      case Kind::kGreaterGreaterEqual:
        if (depth <= 2) return i;
        break;
      case Kind::kLeftParen:
      case Kind::kLeftBracket: {
        const size_t end = behind_closing(i);
        if (end == i) return index;
        i = end;
        continue;
      }
      case Kind::kRightParen:
      case Kind::kRightBracket:
      case Kind::kLeftBrace:
      case Kind::kRightBrace:
      case Kind::kSemicolon:
      case Kind::kAmpAmp:
      case Kind::kPipePipe:
      case Kind::kEndOfFile:
        return index;
      default:
        break;
    }
    ++i;
  }
  return index;
}

size_t Parser::behind_plain_template_arguments(size_t index, bool first_is_type) {
  size_t i = index + 1;
  for (bool is_first = true;; is_first = false) {
    const size_t type_end = behind_type(i);
    if (type_end != i) {
      i = type_end;
    } else if (is_first && first_is_type) {
      return index;
    } else if (is_name(i)) {
      i = look_up(i).end;
    } else if (token_at(i).is(Kind::kIntLiteral) || token_at(i).is(Kind::kTrue) ||
               token_at(i).is(Kind::kFalse)) {
      ++i;
    } else {
      return index;
    }
    // If it is `>>`, its first half closed an inner list.
    if (token_at(i).is(Kind::kGreater) || token_at(i).is(Kind::kGreaterGreater)) return i + 1;
    if (!token_at(i).is(Kind::kComma) || i > index + kMaxLookAhead) return index;
    ++i;
  }
}

size_t Parser::behind_type(size_t index) {
  size_t i = index;
  while (modifier_at(i) != 0) ++i;
  switch (token_at(i).kind) {
    case Kind::kVoid:
      return i + 1;
    case Kind::kUnsigned: {
      const bool has_base =
          is_name(i + 1) && scopes_.builtin(token_at(i + 1)).kind == BuiltinName::kNumeric;
      if (!has_base && is_unsigned_base(i + 1)) return look_up(i + 1).end;
      return has_base ? i + 2 : i + 1;
    }
    case Kind::kStruct:
    case Kind::kClass:
    case Kind::kInterface:
    case Kind::kEnum:
      return is_name(i + 1) ? look_up(i + 1).end : index;
    case Kind::kTypename:
      return look_up(i + 1).end;
    default:
      break;
  }
  const NameLookup name = look_up(i);
  if (!name.is_type()) return index;
  i = name.end;
  while (token_at(i).is(Kind::kConst) || token_at(i).is(Kind::kVolatile)) ++i;
  return i;
}

const QualifiedName* Parser::qualified_name(bool is_member, ParsedSymbol* symbol,
                                            ScopeId* container) {
  QualifiedName* result = make<QualifiedName>(here());
  std::vector<NamePart> parts;
  ParsedSymbol current;
  ScopeId scope = kNoScope;
  if (at(Kind::kColonColon)) {
    result->is_global = true;
    scope = kGlobalScope;
    advance();
  }
  for (;;) {
    if (!at_name()) {
      fail_here(DiagnosticId::kExpectedName, {"a member", describe(token())});
      break;
    }
    const Token& name = token();
    const bool is_scoped = !parts.empty() || result->is_global;
    if (is_scoped && container == nullptr && !at(Kind::kIdentifier)) {
      fail_here(DiagnosticId::kKeywordAsName, {name.text, "a member behind '::'"});
      break;
    }
    if (is_scoped) {
      current = scopes_.find_in(scope, name);
      if (current.kind == ParsedKind::kUnknown && parts.empty()) current = scopes_.find(name);
    } else if (!is_member) {
      current = find_first_part(pos_);
    }
    NamePart part{.location = name.location, .identifier = name.text, .template_arguments = {}};
    const size_t name_index = pos_;
    advance();
    if (begins_template_arguments(pos_, name_index, current, is_member)) {
      part.has_template_arguments = true;
      part.template_arguments = template_arguments();
    }
    parts.push_back(part);
    if (panic_ || !at(Kind::kColonColon)) break;
    if (container != nullptr) *container = current.scope;
    scope = current.scope;
    advance();
    if (at(Kind::kOperator)) break;
  }
  if (parts.empty())
    parts.push_back({.location = here(), .identifier = "", .template_arguments = {}});
  result->location = parts.back().location;
  result->parts = list(parts);
  if (symbol != nullptr) *symbol = current;
  return result;
}

std::span<const TemplateArgument> Parser::template_arguments() {
  const size_t open = pos_;
  advance();
  std::vector<TemplateArgument> result;
  Nesting nesting(*this);
  if (!nesting.ok) return {};
  if (accept_template_end()) return {};
  do {
    result.push_back(template_argument());
  } while (!panic_ && accept(Kind::kComma));
  expect_template_end(open);
  return list(result);
}

TemplateArgument Parser::template_argument() {
  TemplateArgument result{.location = here()};
  const size_t end = behind_type(pos_);
  // `float(3)` and `T::count` are values.
  if (end != pos_ && !token_at(end).is(Kind::kLeftParen)) {
    result.type = type_name();
  } else {
    Setting setting(greater_is_operator_, false);
    result.value = conditional();
    pending_height_ = std::max<uint32_t>(pending_height_, result.value->height) + 1;
  }
  return result;
}

}  // namespace kaamos::hlsl
