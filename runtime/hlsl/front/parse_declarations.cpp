// SPDX-License-Identifier: MIT
// Declarations other than functions, structs, enums and templates.
#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {

std::string_view Parser::context_text(Context context) {
  switch (context) {
    case Context::kMember:
      return "a field";
    case Context::kBuffer:
      return "a member of the buffer";
    default:
      return "a variable";
  }
}

void Parser::declarations_until(Kind end, Context context, DeclList& out) {
  while (!at(end) && !at_end()) {
    const size_t begin = pos_;
    if (at(Kind::kRightBrace)) {
      report(DiagnosticId::kUnmatchedClosing, here(), {"'}'", "{"});
      advance();
      continue;
    }
    declaration(context, out);
    if (panic_) recover(begin);
  }
}

void Parser::declaration(Context context, DeclList& out) {
  Nesting nesting(*this);
  if (!nesting.ok) return;
  std::vector<Attribute> found;
  attributes(found);
  if (panic_) return;
  Prefix prefix;
  prefix.context = context;
  prefix.attributes = list(found);
  declaration_with(prefix, out);
}

void Parser::declaration_with(Prefix& prefix, DeclList& out) {
  const bool is_local = prefix.context == Context::kLocal;
  const bool is_global = prefix.context == Context::kGlobal;
  const auto only = [&](bool allowed, std::string_view what) {
    if (!allowed) {
      fail_here(DiagnosticId::kDeclarationNotHere, {what, "in the global scope or a namespace"});
    }
    return allowed;
  };
  switch (token().kind) {
    case Kind::kSemicolon:
    case Kind::kRightBrace:
    case Kind::kEndOfFile:
      reject_attributes(prefix.attributes, "a declaration");
      accept(Kind::kSemicolon);
      return;
    case Kind::kNamespace:
      if (only(is_global, "a namespace")) namespace_declaration(out);
      return;
    case Kind::kCbuffer:
    case Kind::kTbuffer:
      if (only(is_global, "a buffer block")) buffer_declaration(prefix, out);
      return;
    case Kind::kTemplate:
      if (only(!is_local, "a template")) template_declaration(prefix, out);
      return;
    case Kind::kUsing:
      return using_declaration(prefix, out);
    case Kind::kTypedef:
      return typedef_declaration(prefix, out);
    case Kind::kReservedWord:
      if (token().text == "_Static_assert") return static_assertion(prefix, out);
      break;
    default:
      break;
  }
  const bool is_technique =
      is_global && at(Kind::kTechnique) &&
      (peek(1).is(Kind::kLeftBrace) || (is_name(pos_ + 1) && peek(2).is(Kind::kLeftBrace)));
  if (is_technique) {
    report(DiagnosticId::kStateBlockIgnored, here(), {"the technique"});
    while (!at(Kind::kLeftBrace)) advance();
    pos_ = behind_closing(pos_);
    return;
  }
  const bool is_subobject =
      at_name() && is_name(pos_ + 1) && scopes_.find(token()).kind == ParsedKind::kSubobject;
  if (!is_subobject) return simple_declaration(prefix, out);
  if (only(is_global, "a subobject")) subobject_declaration(out);
}

void Parser::simple_declaration(Prefix& prefix, DeclList& out) {
  const size_t begin = pos_;
  if (at(Kind::kOperator) && behind_type(pos_ + 1) != pos_ + 1) {
    fail_here(DiagnosticId::kNoConversionOperator, {});
    return;
  }
  if (prefix.context != Context::kLocal && !starts_declaration(pos_) && !at_name() &&
      !at(Kind::kColonColon)) {
    fail_here(DiagnosticId::kExpectedDeclaration, {describe(token())});
    return;
  }
  Modifiers modifiers = 0;
  struct_prefix_ = &prefix;
  const TypeSyntax* type = type_specifier(modifiers, &out);
  struct_prefix_ = nullptr;
  if (panic_) return;
  const bool is_definition = type->kind == TypeSyntaxKind::kDefinition;
  const Modifiers all_modifiers = modifiers | (type->modifiers & (kModConst | kModVolatile));
  if (accept(Kind::kSemicolon)) {
    if (!is_definition && type->kind != TypeSyntaxKind::kError) {
      report(DiagnosticId::kDeclaresNothing, token_at(begin).location, {});
    }
    return;
  }
  // A missing ';' after a struct: what follows is the next declaration.
  if (is_definition && ((token().flags & Token::kAtLineStart) != 0 || at_end())) {
    expect_semicolon(type->definition->kind == DeclKind::kEnum ? "the enum" : "the struct");
    panic_ = false;
    return;
  }
  reject_declarator_prefix();
  const bool is_member = prefix.context == Context::kMember;
  if (starts_function_declarator(pos_)) {
    check_modifiers(all_modifiers & ~kModConst,
                    is_member ? Declared::kMethod : Declared::kFunction);
    if (prefix.context == Context::kLocal) {
      reject_local_declarator(prefix, modifiers, type, begin);
    } else {
      function(prefix, modifiers, type, out);
    }
    return;
  }
  const bool is_outer_member =
      prefix.context == Context::kGlobal && starts_qualified_declarator(pos_);
  if ((prefix.is_template || prefix.is_specialization) && !is_outer_member) {
    fail_here(DiagnosticId::kTemplateOfWhat, {describe(token())});
    return;
  }
  check_modifiers(all_modifiers, is_member                           ? Declared::kField
                                 : prefix.context == Context::kLocal ? Declared::kLocal
                                                                     : Declared::kGlobal);
  declarators(prefix, modifiers, type, out);
}

void Parser::declarators(const Prefix& prefix, Modifiers modifiers, const TypeSyntax* type,
                         DeclList& out) {
  std::string_view name;
  do {
    reject_declarator_prefix();
    const VariableDecl* decl = variable(prefix, modifiers, type);
    if (decl == nullptr) return;
    name = decl->name;
    out.push_back(decl);
  } while (!panic_ && accept(Kind::kComma));
  if (!panic_) expect_semicolon("the declaration of '" + std::string(name) + "'");
}

const VariableDecl* Parser::variable(const Prefix& prefix, Modifiers modifiers,
                                     const TypeSyntax* type) {
  if (prefix.context == Context::kMember && at(Kind::kColon)) {
    VariableDecl* padding = make<VariableDecl>(here());
    padding->modifiers = modifiers;
    padding->type = type;
    bit_field(*padding);
    return padding;
  }
  if (prefix.context == Context::kGlobal && starts_qualified_declarator(pos_)) {
    const QualifiedName* qualifier = qualified_name(false);
    if (panic_) return nullptr;
    VariableDecl* member = make<VariableDecl>(qualifier->location);
    QualifiedName* owner =
        make<QualifiedName>(qualifier->parts[qualifier->parts.size() - 2].location);
    owner->is_global = qualifier->is_global;
    owner->parts = qualifier->parts.first(qualifier->parts.size() - 1);
    member->name = qualifier->last().identifier;
    member->modifiers = modifiers;
    member->attributes = prefix.attributes;
    member->qualifier = owner;
    member->template_parameters = prefix.template_parameters;
    member->type = array_bounds(type);
    if (!panic_ && accept(Kind::kEqual)) member->initializer = variable_initializer();
    return member;
  }
  const Token* name = expect_name(context_text(prefix.context), NameKind::kAnyName);
  if (name == nullptr) return nullptr;
  VariableDecl* decl = make<VariableDecl>(name->location);
  decl->name = name->text;
  decl->modifiers = modifiers;
  decl->attributes = prefix.attributes;
  scopes_.declare_value(scopes_.current(), *name);
  decl->type = array_bounds(type);
  if (at(Kind::kLess)) skip_effect_annotation();
  if (panic_) return decl;
  if (prefix.context == Context::kMember && at(Kind::kColon) && begins_bit_width(pos_ + 1)) {
    bit_field(*decl);
    return decl;
  }
  const size_t annotation = pos_ + 1;
  decl->annotations = annotations();
  if (panic_) return decl;
  BinaryOp op = BinaryOp::kAdd;
  const bool goes_on = decl->annotations.semantic != nullptr && pos_ == annotation + 1 &&
                       (at(Kind::kColonColon) || at(Kind::kQuestion) || at(Kind::kLeftParen) ||
                        (!at(Kind::kLess) && !at(Kind::kComma) && precedence_here(&op) > 0));
  if (prefix.context == Context::kMember && goes_on) {
    decl->annotations.semantic = nullptr;
    fail(DiagnosticId::kBitFieldName, token_at(annotation).location,
         {token_at(annotation).text, name->text});
    return decl;
  }
  if (at(Kind::kLess)) skip_effect_annotation();
  if (at(Kind::kLeftBrace) && prefix.context != Context::kMember) {
    report(DiagnosticId::kStateBlockIgnored, here(), {"the state block"});
    pos_ = behind_closing(pos_);
  } else if (accept(Kind::kEqual)) {
    decl->initializer = variable_initializer();
  }
  return decl;
}

bool Parser::starts_qualified_declarator(size_t index) {
  if (token_at(index).is(Kind::kColonColon)) ++index;
  if (!is_name(index)) return false;
  size_t i = index + 1;
  if (token_at(i).is(Kind::kLess)) {
    const size_t end = behind_template_arguments(i);
    if (end == i) return false;
    i = end;
  }
  return token_at(i).is(Kind::kColonColon) && is_name(i + 1);
}

// Behind the colon of a bit field stands anything but a name, which is a semantic. [DXC]
bool Parser::begins_bit_width(size_t index) {
  const Token& first = token_at(index);
  if (first.is(Kind::kSizeof) || first.is(Kind::kTrue) || first.is(Kind::kFalse)) return true;
  if (is_keyword(first.kind)) return false;
  return !can_be_name(first.kind) || is_type_keyword(first.text);
}

void Parser::bit_field(VariableDecl& decl) {
  advance();
  decl.bit_width = conditional();
  const bool is_plain =
      (decl.modifiers & kModStatic) == 0 && decl.type->kind != TypeSyntaxKind::kArray;
  if (panic_ || (is_plain && !at(Kind::kColon))) return;
  fail(DiagnosticId::kBitFieldPlace, decl.bit_width->location, {});
}

const Expr* Parser::variable_initializer() {
  const bool is_state = at(Kind::kSamplerState) && peek(1).is(Kind::kLeftBrace);
  if (!is_state) return assignment_value();
  report(DiagnosticId::kStateBlockIgnored, here(), {"'sampler_state'"});
  advance();
  pos_ = behind_closing(pos_);
  return nullptr;
}

// `<string UIName = "Roughness";>`: used by tools in effect files.
void Parser::skip_effect_annotation() {
  const size_t open = pos_;
  report(DiagnosticId::kStateBlockIgnored, here(), {"the effect annotation '<...>'"});
  while (!at(Kind::kGreater) && !at(Kind::kRightBrace) && !at_end()) advance();
  expect_template_end(open);
}

void Parser::namespace_declaration(DeclList& out) {
  Nesting nesting(*this);
  if (!nesting.ok) return;
  const SourceLocation keyword = here();
  advance();
  const Token* name = at(Kind::kLeftBrace) ? nullptr : expect_name("a namespace");
  if (panic_) return;
  NamespaceDecl* decl = make<NamespaceDecl>(name != nullptr ? name->location : keyword);
  ScopeId scope = kNoScope;
  if (name != nullptr) {
    decl->name = name->text;
    const ParsedSymbol known = scopes_.find_in(scopes_.current(), *name);
    scope = known.kind == ParsedKind::kNamespace ? known.scope : scopes_.create(scopes_.current());
    scopes_.declare(scopes_.current(), name->value, {ParsedKind::kNamespace, scope});
  } else {
    // What an unnamed namespace declares is visible in the enclosing scope.
    scope = scopes_.create(scopes_.current());
    scopes_.add_using(scopes_.current(), scope);
  }
  InScope inside(*this, scope);
  DeclList inner;
  if (name != nullptr && at(Kind::kColonColon)) {
    namespace_declaration(inner);
  } else {
    const size_t open = pos_;
    if (!expect(Kind::kLeftBrace, "'{' after the name of the namespace")) return;
    declarations_until(Kind::kRightBrace, Context::kGlobal, inner);
    expect_closing(Kind::kRightBrace, open, "the declarations of the namespace");
  }
  decl->declarations = list(inner);
  out.push_back(decl);
}

void Parser::static_assertion(const Prefix& prefix, DeclList& out) {
  reject_attributes(prefix.attributes, "a static assertion");
  StaticAssertDecl* decl = make<StaticAssertDecl>(here());
  advance();
  const size_t open = pos_;
  if (!expect(Kind::kLeftParen, "'(' of the static assertion")) return;
  decl->condition = conditional();
  if (!panic_ && accept(Kind::kComma)) {
    decl->text = token().text;
    expect(Kind::kStringLiteral, "the text of the static assertion");
  }
  if (panic_) return;
  expect_closing(Kind::kRightParen, open, "the static assertion");
  if (!panic_ && expect_semicolon("the static assertion")) out.push_back(decl);
}

void Parser::using_declaration(const Prefix& prefix, DeclList& out) {
  const SourceLocation keyword = here();
  advance();
  if (accept(Kind::kNamespace)) {
    UsingNamespaceDecl* decl = make<UsingNamespaceDecl>(keyword);
    const NameLookup target = look_up(pos_);
    decl->target = qualified_name(false);
    decl->location = decl->target->location;
    if (target.symbol.kind == ParsedKind::kNamespace) {
      scopes_.add_using(scopes_.current(), target.symbol.scope);
    }
    if (expect_semicolon("the name of the namespace")) out.push_back(decl);
    return;
  }
  if (peek(1).is(Kind::kEqual)) {
    const Token* name = expect_name("a type");
    if (name == nullptr) return;
    advance();
    TypeAliasDecl* decl = make<TypeAliasDecl>(name->location);
    decl->name = name->text;
    decl->is_template = prefix.is_template;
    decl->template_parameters = prefix.template_parameters;
    decl->attributes = prefix.attributes;
    Modifiers modifiers = 0;
    const TypeSyntax* type = type_specifier(modifiers, &out);
    const ScopeId members = type_scope_;
    reject_declarator_prefix();
    decl->type = array_bounds(type);
    scopes_.declare(scope_of(prefix), name->value, {ParsedKind::kType, members});
    type_names_.push_back(name->text);
    if (expect_semicolon("the type")) out.push_back(decl);
    return;
  }
  UsingDecl* decl = make<UsingDecl>(keyword);
  const NameLookup target = look_up(pos_);
  const size_t last = target.end > pos_ ? target.end - 1 : pos_;
  if (target.symbol.kind != ParsedKind::kUnknown) {
    scopes_.declare(scopes_.current(), token_at(last).value, target.symbol);
  }
  decl->target = qualified_name(false);
  decl->location = decl->target->location;
  decl->name = decl->target->last().identifier;
  if (expect_semicolon("the name")) out.push_back(decl);
}

void Parser::typedef_declaration(const Prefix& prefix, DeclList& out) {
  advance();
  Modifiers modifiers = 0;
  const TypeSyntax* type = type_specifier(modifiers, &out);
  const ScopeId members = type_scope_;
  do {
    reject_declarator_prefix();
    const Token* name = expect_name("a type", NameKind::kAnyName);
    if (name == nullptr) return;
    TypeAliasDecl* decl = make<TypeAliasDecl>(name->location);
    decl->name = name->text;
    decl->modifiers = modifiers;
    decl->attributes = prefix.attributes;
    decl->type = array_bounds(type);
    scopes_.declare(scopes_.current(), name->value, {ParsedKind::kType, members});
    type_names_.push_back(name->text);
    out.push_back(decl);
  } while (!panic_ && accept(Kind::kComma));
  if (!panic_) expect_semicolon("the typedef");
}

void Parser::buffer_declaration(const Prefix& prefix, DeclList& out) {
  BufferDecl* decl = make<BufferDecl>(here());
  decl->is_texture_buffer = at(Kind::kTbuffer);
  advance();
  if (!at(Kind::kColon) && !at(Kind::kLeftBrace)) {
    const Token* name = expect_name("a buffer");
    if (name == nullptr) return;
    decl->location = name->location;
    decl->name = name->text;
  }
  decl->attributes = prefix.attributes;
  decl->annotations = annotations();
  const size_t open = pos_;
  if (panic_ || !expect(Kind::kLeftBrace, "'{' of the buffer block")) return;
  DeclList members;
  declarations_until(Kind::kRightBrace, Context::kBuffer, members);
  expect_closing(Kind::kRightBrace, open, "the members of the buffer");
  decl->members = list(members);
  out.push_back(decl);
}

void Parser::subobject_declaration(DeclList& out) {
  const SubobjectKind kind = scopes_.builtin(token()).subobject;
  advance();
  const Token* name = expect_name("a subobject");
  if (name == nullptr) return;
  SubobjectDecl* decl = make<SubobjectDecl>(name->location);
  decl->name = name->text;
  decl->subobject_kind = kind;
  if (!at(Kind::kEqual) || !peek(1).is(Kind::kLeftBrace)) {
    const size_t found = at(Kind::kEqual) ? pos_ + 1 : pos_;
    fail(DiagnosticId::kSubobjectInitializer, token_at(found).location,
         {name->text, describe(token_at(found))});
    return;
  }
  advance();
  if (const auto* arguments = as<InitListExpr>(init_list())) decl->arguments = arguments->elements;
  if (!panic_) expect_semicolon("the subobject '" + std::string(name->text) + "'");
  out.push_back(decl);
}

}  // namespace kaamos::hlsl
