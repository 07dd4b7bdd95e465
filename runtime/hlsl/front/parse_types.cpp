// SPDX-License-Identifier: MIT
#include <algorithm>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {
namespace {

bool is_word(TokenKind kind) {
  return can_begin_type(kind);
}

ScalarKind unsigned_of(ScalarKind kind) {
  switch (kind) {
    case ScalarKind::kInt16:
      return ScalarKind::kUint16;
    case ScalarKind::kInt64:
      return ScalarKind::kUint64;
    case ScalarKind::kMin16Int:
    case ScalarKind::kMin12Int:
      return ScalarKind::kMin16Uint;
    default:
      return ScalarKind::kUint;
  }
}

bool is_signed_integer(const BuiltinName& name) {
  if (name.kind != BuiltinName::kNumeric) return false;
  return name.scalar == ScalarKind::kInt || name.scalar == ScalarKind::kInt16 ||
         name.scalar == ScalarKind::kInt64 || name.scalar == ScalarKind::kMin16Int ||
         name.scalar == ScalarKind::kMin12Int;
}

bool is_scalar_word(std::string_view text) {
  return text == "long" || text == "short" || text == "char" || text == "signed";
}

}  // namespace

const TypeSyntax* Parser::type_specifier(Modifiers& modifiers, DeclList* definitions) {
  parse_modifiers(modifiers);
  TypeSyntax* type = bare_type(definitions);
  while (!panic_ && (at(Kind::kConst) || at(Kind::kVolatile))) {
    add_modifier(modifiers, at(Kind::kConst) ? kModConst : kModVolatile, token());
    advance();
  }
  type->modifiers |= modifiers & kTypeModifiers;
  modifiers &= ~kTypeModifiers;
  const bool is_matrix = type->is_matrix() || (type->name != nullptr && type->name->is_simple() &&
                                               type->name->last().identifier == "matrix");
  if (is_matrix && (type->modifiers & (kModRowMajor | kModColumnMajor)) == 0) {
    type->modifiers |= pack_matrix_modifier();
  } else if (type->name != nullptr) {
    type->pack_matrix = pack_matrix_modifier();
  }
  return type;
}

Modifiers Parser::pack_matrix_modifier() const {
  auto behind =
      std::upper_bound(pack_matrix_.begin(), pack_matrix_.end(), pos_,
                       [](size_t index, const PackMatrix& pragma) { return index < pragma.index; });
  return behind == pack_matrix_.begin() ? 0 : (behind - 1)->modifier;
}

TypeSyntax* Parser::error_type(SourceLocation location) {
  type_scope_ = kNoScope;
  return make<TypeSyntax>(location);
}

TypeSyntax* Parser::bare_type(DeclList* definitions) {
  type_scope_ = kNoScope;
  if (panic_) return error_type(here());
  switch (token().kind) {
    case Kind::kVoid: {
      TypeSyntax* type = make<TypeSyntax>(here());
      type->kind = TypeSyntaxKind::kVoid;
      advance();
      return type;
    }
    case Kind::kUnsigned:
      return unsigned_type();
    case Kind::kStruct:
    case Kind::kClass:
    case Kind::kInterface:
    case Kind::kEnum:
      return definition_type(definitions);
    case Kind::kReservedWord:
      return reserved_type();
    case Kind::kTypename:
      advance();
      break;
    default:
      break;
  }
  if (at_name() || at(Kind::kColonColon)) return named_type();
  fail_here(DiagnosticId::kExpectedType, {describe(token())});
  return error_type(here());
}

TypeSyntax* Parser::numeric_type(const BuiltinName& name) {
  TypeSyntax* type = make<TypeSyntax>(here());
  type->kind = TypeSyntaxKind::kNumeric;
  type->scalar = name.scalar;
  type->rows = name.rows;
  type->columns = name.columns;
  return type;
}

TypeSyntax* Parser::named_type() {
  const bool after_typename = pos_ > 0 && tokens_[pos_ - 1].is(Kind::kTypename);
  const NameLookup name = look_up(pos_);
  if (name.symbol.kind == ParsedKind::kNumericType) {
    accept(Kind::kColonColon);
    TypeSyntax* type = numeric_type(scopes_.builtin(token()));
    advance();
    return type;
  }
  if (!name.is_type() && !name.is_dependent && !after_typename) return unknown_type();
  TypeSyntax* type = make<TypeSyntax>(here());
  type->kind = TypeSyntaxKind::kNamed;
  ParsedSymbol symbol;
  type->name = qualified_name(false, &symbol);
  type->location = type->name->location;
  type_scope_ = after_typename || name.is_dependent ? kDependentScope : symbol.scope;
  return type;
}

TypeSyntax* Parser::unknown_type() {
  const size_t begin = pos_;
  size_t end = look_up(pos_).end;
  if (end == pos_) ++end;
  // `Unknown<float> x`: the arguments belong to the name.
  if (token_at(end).is(Kind::kLess)) {
    const size_t behind = behind_template_arguments(end);
    if (behind != end && is_name(behind)) end = behind;
  }
  const SourceLocation location = here();
  const std::string text = text_between(begin, end);
  const bool reads_on = is_name(end) || token_at(end).is(Kind::kOperator);
  auto message = reads_on ? report(DiagnosticId::kUnknownTypeName, location, {text})
                          : fail(DiagnosticId::kUnknownTypeName, location, {text});
  const std::string similar = similar_type_name(token_at(begin).text, type_names_);
  if (end == begin + 1 && !similar.empty()) {
    message.note(location, "did you mean '" + similar + "'?");
  }
  if (reads_on) pos_ = end;
  return error_type(location);
}

bool Parser::is_unsigned_base(size_t index) {
  if (!is_name(index)) return false;
  const NameLookup name = look_up(index);
  const Kind next = token_at(name.end).kind;
  return name.symbol.kind == ParsedKind::kType && (can_be_name(next) || next == Kind::kRightParen);
}

TypeSyntax* Parser::unsigned_type() {
  const SourceLocation location = here();
  advance();
  BuiltinName name{.kind = BuiltinName::kNumeric, .scalar = ScalarKind::kInt};
  const bool has_base = at_name() && is_signed_integer(scopes_.builtin(token()));
  if (!has_base && is_unsigned_base(pos_)) {
    TypeSyntax* type = named_type();
    type->is_unsigned = true;
    return type;
  }
  if (has_base) name = scopes_.builtin(token());
  name.scalar = unsigned_of(name.scalar);
  TypeSyntax* type = numeric_type(name);
  type->location = location;
  if (has_base) advance();
  return type;
}

TypeSyntax* Parser::reserved_type() {
  const SourceLocation location = here();
  const std::string_view text = token().text;
  if (text == "auto") {
    TypeSyntax* type = make<TypeSyntax>(location);
    type->kind = TypeSyntaxKind::kAuto;
    advance();
    return type;
  }
  if (is_scalar_word(text)) {
    const std::string_view instead = text == "long"    ? "int64_t"
                                     : text == "short" ? "int16_t"
                                                       : "int";
    report(DiagnosticId::kNoSuchScalar, location, {text, instead});
    while (at(Kind::kReservedWord) && is_scalar_word(token().text)) advance();
    if (at_name() && is_signed_integer(scopes_.builtin(token()))) advance();
    return error_type(location);
  }
  if (text == "union") {
    fail(DiagnosticId::kNoUnion, location, {});
  } else {
    fail(DiagnosticId::kReservedWord, location, {text});
  }
  return error_type(location);
}

TypeSyntax* Parser::definition_type(DeclList* definitions) {
  const bool is_enum = at(Kind::kEnum);
  size_t i = pos_ + 1;
  while (token_at(i).is(Kind::kLeftBracket)) {
    const size_t end = behind_closing(i);
    if (end == i) break;
    i = end;
  }
  if (is_enum && (token_at(i).is(Kind::kClass) || token_at(i).is(Kind::kStruct))) ++i;
  size_t behind = is_name(i) ? i + 1 : i;
  // `template<> struct S<int> {`
  const bool may_specialize = struct_prefix_ != nullptr &&
                              (struct_prefix_->is_template || struct_prefix_->is_specialization);
  if (may_specialize && token_at(behind).is(Kind::kLess)) {
    behind = behind_template_arguments(behind);
  }
  const Kind behind_name = token_at(behind).kind;
  const bool is_definition = behind_name == Kind::kLeftBrace || behind_name == Kind::kColon ||
                             behind_name == Kind::kSemicolon || !is_name(i);
  if (!is_definition) {
    // `struct S s` uses S with the keyword.
    advance();
    return named_type();
  }
  if (definitions == nullptr) {
    const SourceLocation location = here();
    report(DiagnosticId::kDeclarationNotHere, location,
           {is_enum ? "an enum" : "a struct", "outside of parameters, casts and arguments"});
    pos_ = is_name(i) ? i + 1 : i;
    if (at(Kind::kLeftBrace)) pos_ = behind_closing(pos_);
    return error_type(location);
  }
  TypeSyntax* type = make<TypeSyntax>(here());
  const Decl* decl = nullptr;
  if (is_enum) {
    decl = enum_definition();
  } else {
    decl = struct_definition();
  }
  if (decl == nullptr) return error_type(type->location);
  definitions->push_back(decl);
  type->kind = TypeSyntaxKind::kDefinition;
  type->definition = decl;
  return type;
}

const TypeSyntax* Parser::array_bounds(const TypeSyntax* element) {
  struct Bound {
    SourceLocation location;
    const Expr* size;
  };
  std::vector<Bound> bounds;
  while (!panic_ && at(Kind::kLeftBracket)) {
    const size_t open = pos_;
    if (bounds.size() == kMaxArrayBounds) {
      fail_here(DiagnosticId::kNestedTooDeep, {std::to_string(kMaxArrayBounds)});
      break;
    }
    advance();
    Setting setting(greater_is_operator_, true);
    const Expr* size = at(Kind::kRightBracket) ? nullptr : assignment();
    if (size != nullptr) pending_height_ = std::max<uint32_t>(pending_height_, size->height) + 1;
    bounds.push_back({token_at(open).location, size});
    expect_closing(Kind::kRightBracket, open, "the size of the array");
  }
  for (size_t i = bounds.size(); i-- > 0;) {
    TypeSyntax* array = make<TypeSyntax>(bounds[i].location);
    array->kind = TypeSyntaxKind::kArray;
    array->element = element;
    array->array_size = bounds[i].size;
    element = array;
  }
  return element;
}

const TypeSyntax* Parser::type_without_bounds() {
  Modifiers modifiers = 0;
  return type_specifier(modifiers, nullptr);
}

const TypeSyntax* Parser::type_name() {
  return array_bounds(type_without_bounds());
}

void Parser::reject_declarator_prefix() {
  if (at(Kind::kStar)) {
    report(DiagnosticId::kNoPointers, here(), {});
    while (at(Kind::kStar) || at(Kind::kConst)) advance();
  } else if (at(Kind::kAmp) || at(Kind::kAmpAmp)) {
    report(DiagnosticId::kNoReferences, here(), {});
    advance();
  } else if (at(Kind::kLeftBracket)) {
    size_t end = pos_;
    while (token_at(end).is(Kind::kLeftBracket) && behind_closing(end) != end) {
      end = behind_closing(end);
    }
    if (!is_name(end)) return;
    report(DiagnosticId::kArrayBoundsBeforeName, here(), {});
    pos_ = end;
  }
}

std::string Parser::text_between(size_t begin, size_t end) const {
  std::string result;
  for (size_t i = begin; i < end && i < tokens_.size(); ++i) {
    const bool glue = i == begin || !is_word(tokens_[i].kind) || !is_word(tokens_[i - 1].kind) ||
                      tokens_[i].is(Kind::kColonColon) || tokens_[i - 1].is(Kind::kColonColon);
    if (!glue) result += ' ';
    result += tokens_[i].text;
    if (tokens_[i].is(Kind::kComma)) result += ' ';
  }
  return result;
}

}  // namespace kaamos::hlsl
