// SPDX-License-Identifier: MIT
#include <utility>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {

bool Parser::starts_function_declarator(size_t index) {
  if (token_at(index).is(Kind::kOperator)) return true;
  if (token_at(index).is(Kind::kColonColon)) ++index;
  if (!is_name(index)) return false;
  size_t i = index + 1;
  for (;;) {
    if (token_at(i).is(Kind::kLess)) {
      const size_t end = behind_template_arguments(i);
      if (end == i) return false;
      i = end;
    }
    if (!token_at(i).is(Kind::kColonColon)) break;
    if (token_at(i + 1).is(Kind::kOperator)) return true;
    if (!is_name(i + 1)) return false;
    i += 2;
  }
  return token_at(i).is(Kind::kLeftParen);
}

void Parser::function(const Prefix& prefix, Modifiers modifiers, const TypeSyntax* type,
                      DeclList& out) {
  FunctionDecl* decl = make<FunctionDecl>(here());
  decl->modifiers = modifiers;
  decl->attributes = prefix.attributes;
  decl->template_parameters = prefix.template_parameters;
  decl->outer_parameters = prefix.outer_parameters;
  decl->is_template = prefix.is_template;
  decl->is_specialization = prefix.is_specialization;
  decl->is_instantiation = prefix.is_instantiation;
  decl->return_type = type;
  const Token* name_token = &token();
  ScopeId qualifier = kNoScope;
  if (!function_name(*decl, &qualifier)) return;
  if (decl->qualifier == nullptr && can_be_name(name_token->kind)) {
    if (decl->is_template) {
      scopes_.declare(scope_of(prefix), name_token->value, {ParsedKind::kFunctionTemplate});
    } else {
      scopes_.declare_value(scope_of(prefix), *name_token);
    }
  }
  // A method's body sees the struct's names, even if the body is outside the struct.
  ScopeId parent = scopes_.current();
  if (qualifier != kNoScope && qualifier != kDependentScope) {
    parent = scopes_.create(parent);
    scopes_.add_base(parent, qualifier);
  }
  InScope inside(*this, scopes_.create(parent));
  const size_t open = pos_;
  if (!expect(Kind::kLeftParen, "'(' after the name of the function")) return;
  std::vector<const ParameterDecl*> found;
  parameters(found);
  expect_list_end(Kind::kRightParen, open, "a parameter");
  recover_behind_paren(open);
  if (panic_) return;
  decl->parameters = list(found);
  // `int f()[2]` returns an array.
  if (at(Kind::kLeftBracket)) decl->return_type = array_bounds(type);
  decl->is_const_method = accept(Kind::kConst);
  decl->annotations = annotations();
  if (panic_) return;
  out.push_back(decl);
  if (accept(Kind::kSemicolon)) return;
  if (!at(Kind::kLeftBrace)) {
    expect(Kind::kLeftBrace, "'{' or ';' after the function's parameters");
    return;
  }
  if (decl->is_instantiation) report(DiagnosticId::kInstantiationBody, here(), {decl->name});
  const Token* outer = std::exchange(function_token_, name_token);
  decl->body = block();
  function_token_ = outer;
}

bool Parser::function_name(FunctionDecl& decl, ScopeId* qualifier_scope) {
  if (at(Kind::kOperator)) {
    decl.name = operator_name();
    return !panic_;
  }
  if (peek(1).is(Kind::kLeftParen)) {
    const Token* name = expect_name("a function", NameKind::kAnyName);
    if (name == nullptr) return false;
    decl.name = name->text;
    return true;
  }
  const QualifiedName* full = qualified_name(false, nullptr, qualifier_scope);
  if (panic_) return false;
  std::span<const NamePart> parts = full->parts;
  decl.location = full->location;
  if (at(Kind::kOperator)) {
    decl.location = here();
    decl.name = operator_name();
    decl.qualifier = full;
    return !panic_;
  }
  decl.name = parts.back().identifier;
  decl.specialized = parts.back().template_arguments;
  if (parts.back().has_template_arguments && !decl.is_specialization) {
    fail(DiagnosticId::kSpecializationHeader, parts.back().location, {decl.name});
    return false;
  }
  if (parts.size() > 1) {
    QualifiedName* qualifier = make<QualifiedName>(parts[parts.size() - 2].location);
    qualifier->is_global = full->is_global;
    qualifier->parts = parts.first(parts.size() - 1);
    decl.qualifier = qualifier;
  }
  return true;
}

std::string_view Parser::operator_name() {
  advance();
  const Token& op = token();
  const auto pair = [&](Kind close, std::string_view name) {
    advance();
    expect(close, "'" + std::string(token_kind_text(close)) + "'");
    return name;
  };
  switch (op.kind) {
    case Kind::kLeftParen:
      return pair(Kind::kRightParen, "operator()");
    case Kind::kLeftBracket:
      return pair(Kind::kRightBracket, "operator[]");
    case Kind::kPlus:
    case Kind::kPlusPlus:
    case Kind::kPlusEqual:
    case Kind::kMinus:
    case Kind::kMinusMinus:
    case Kind::kMinusEqual:
    case Kind::kStar:
    case Kind::kStarEqual:
    case Kind::kSlash:
    case Kind::kSlashEqual:
    case Kind::kPercent:
    case Kind::kPercentEqual:
    case Kind::kLess:
    case Kind::kLessEqual:
    case Kind::kLessLess:
    case Kind::kLessLessEqual:
    case Kind::kGreater:
    case Kind::kGreaterEqual:
    case Kind::kGreaterGreater:
    case Kind::kGreaterGreaterEqual:
    case Kind::kEqual:
    case Kind::kEqualEqual:
    case Kind::kExclaim:
    case Kind::kExclaimEqual:
    case Kind::kTilde:
    case Kind::kAmp:
    case Kind::kAmpAmp:
    case Kind::kAmpEqual:
    case Kind::kPipe:
    case Kind::kPipePipe:
    case Kind::kPipeEqual:
    case Kind::kCaret:
    case Kind::kCaretEqual:
    case Kind::kComma: {
      advance();
      return arena_.copy("operator" + std::string(token_kind_text(op.kind)));
    }
    default:
      fail_here(DiagnosticId::kNotOverloadable, {describe(op)});
      return "operator";
  }
}

void Parser::parameters(std::vector<const ParameterDecl*>& out) {
  if (at(Kind::kRightParen)) return;
  if (at(Kind::kVoid) && peek(1).is(Kind::kRightParen)) {
    advance();
    return;
  }
  do {
    if (at(Kind::kEllipsis)) {
      fail_here(DiagnosticId::kNoVariadic, {"parameters"});
      return;
    }
    out.push_back(parameter());
  } while (!panic_ && accept(Kind::kComma));
}

const ParameterDecl* Parser::parameter() {
  ParameterDecl* decl = make<ParameterDecl>(here());
  std::vector<Attribute> found;
  attributes(found);
  decl->attributes = list(found);
  const TypeSyntax* type = type_specifier(decl->modifiers, nullptr);
  decl->type = type;
  if (panic_) return decl;
  check_modifiers(decl->modifiers | (type->modifiers & kModVolatile), Declared::kParameter);
  reject_declarator_prefix();
  const bool is_unnamed = at(Kind::kComma) || at(Kind::kRightParen) || at(Kind::kColon) ||
                          at(Kind::kEqual) || at(Kind::kLeftBracket);
  if (at(Kind::kEllipsis)) {
    fail_here(DiagnosticId::kNoVariadic, {"parameters"});
    return decl;
  }
  if (!is_unnamed) {
    const Token* name = expect_name("a parameter", NameKind::kAnyName);
    if (name == nullptr) return decl;
    decl->name = name->text;
    decl->location = name->location;
    scopes_.declare_value(scopes_.current(), *name);
  }
  decl->type = array_bounds(type);
  if (panic_) return decl;
  decl->annotations = annotations();
  if (!panic_ && accept(Kind::kEqual)) decl->default_value = assignment_value();
  return decl;
}

void Parser::reject_local_declarator(const Prefix& prefix, Modifiers modifiers,
                                     const TypeSyntax* type, size_t type_begin) {
  const Token& name = token();
  const size_t open = pos_ + 1;
  size_t end = token_at(open).is(Kind::kLeftParen) ? behind_closing(open) : open;
  if (token_at(end).is(Kind::kColon)) end += 2;
  const bool is_function = token_at(end).is(Kind::kLeftBrace) || !is_name(pos_) ||
                           !token_at(open).is(Kind::kLeftParen) ||
                           behind_type(open + 1) != open + 1 ||
                           token_at(open + 1).is(Kind::kRightParen);
  if (!is_function) {
    report(DiagnosticId::kNoConstructorCall, name.location,
           {text_between(type_begin, pos_), name.text});
    scopes_.declare_value(scopes_.current(), name);
    advance();
    call_arguments();
    if (!panic_) expect_semicolon("the declaration of '" + std::string(name.text) + "'");
    return;
  }
  auto message = report(DiagnosticId::kFunctionInsideFunction, name.location, {name.text});
  if (function_token_ != nullptr) {
    message.note(function_token_->location,
                 "function '" + std::string(function_token_->text) + "' begins here");
  }
  // Parsed to find errors in it and to keep the braces matched, but left out of the tree.
  DeclList dropped;
  function(prefix, modifiers, type, dropped);
}

}  // namespace kaamos::hlsl
