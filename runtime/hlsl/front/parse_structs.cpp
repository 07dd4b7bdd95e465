// SPDX-License-Identifier: MIT
// Structs, classes, enums.
#include <utility>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {
namespace {

bool is_access_word(const Token& token) {
  return token.is(TokenKind::kReservedWord) &&
         (token.text == "public" || token.text == "private" || token.text == "protected");
}

}  // namespace

const StructDecl* Parser::struct_definition() {
  const Prefix* prefix = std::exchange(struct_prefix_, nullptr);
  StructDecl* decl = make<StructDecl>(here());
  decl->is_class = at(Kind::kClass);
  decl->is_interface = at(Kind::kInterface);
  advance();
  std::vector<Attribute> found;
  ScopeId outer = scopes_.current();
  if (prefix != nullptr) {
    found.assign(prefix->attributes.begin(), prefix->attributes.end());
    decl->is_template = prefix->is_template;
    decl->template_parameters = prefix->template_parameters;
    outer = scope_of(*prefix);
  }
  // DXC accepts them on either side: `struct [raypayload] P`.
  attributes(found);
  decl->attributes = list(found);
  const Token* name = at(Kind::kLeftBrace) || at(Kind::kColon) ? nullptr : expect_name("a struct");
  if (panic_) return nullptr;
  ScopeId scope = scopes_.create(scopes_.current());
  if (name != nullptr) {
    decl->name = name->text;
    decl->location = name->location;
    // A definition after a forward declaration fills the same scope.
    const ParsedSymbol known = scopes_.find_in(outer, *name);
    const bool is_forward =
        known.kind == ParsedKind::kType && known.scope < scope && !decl->is_template;
    if (is_forward && at(Kind::kSemicolon)) scope = known.scope;
    const bool has_list = prefix != nullptr && (prefix->is_template || prefix->is_specialization);
    decl->is_specialization = has_list && at(Kind::kLess);
    if (decl->is_specialization) {
      decl->specialized = template_arguments();
      if (panic_) return nullptr;
      decl->is_instantiation = prefix->is_instantiation;
      if (decl->is_instantiation && !at(Kind::kSemicolon)) {
        report(DiagnosticId::kInstantiationBody, here(), {decl->name});
      }
    } else if (prefix != nullptr && prefix->is_specialization) {
      fail(DiagnosticId::kSpecializationArguments, name->location, {name->text});
      return nullptr;
    } else {
      scopes_.declare(outer, name->value, {ParsedKind::kType, scope});
      type_names_.push_back(name->text);
    }
  }
  type_scope_ = scope;
  if (at(Kind::kSemicolon) && name != nullptr) return decl;
  decl->is_definition = true;
  if (decl->is_interface && at(Kind::kColon)) {
    report(DiagnosticId::kInterfaceBase, here(), {decl->name});
  }
  if (accept(Kind::kColon)) bases(*decl, scope);
  const size_t open = pos_;
  if (panic_ || !expect(Kind::kLeftBrace, "'{' of the struct")) return nullptr;
  {
    InScope inside(*this, scope);
    predeclare_members(scope);
    members(*decl);
  }
  expect_closing(Kind::kRightBrace, open, "the members of the struct");
  type_scope_ = scope;
  return decl;
}

void Parser::bases(StructDecl& decl, ScopeId scope) {
  std::vector<const TypeSyntax*> found;
  do {
    while (is_access_word(token()) || (at(Kind::kReservedWord) && token().text == "virtual")) {
      if (token().text == "virtual") report(DiagnosticId::kNoVirtual, here(), {});
      advance();
    }
    found.push_back(type_without_bounds());
    if (type_scope_ != kNoScope) scopes_.add_base(scope, type_scope_);
  } while (!panic_ && accept(Kind::kComma));
  decl.bases = list(found);
}

// Methods may use a nested type that is declared after them, because their bodies count as being
// after the end of the struct.
void Parser::predeclare_members(ScopeId scope) {
  const auto declare = [&](size_t index) {
    if (!is_name(index)) return;
    scopes_.declare(scope, token_at(index).value, {ParsedKind::kType, kNoScope});
  };
  for (size_t i = pos_; i < tokens_.size(); ++i) {
    switch (tokens_[i].kind) {
      case Kind::kLeftBrace:
        i = behind_closing(i) - 1;
        break;
      case Kind::kRightBrace:
        return;
      case Kind::kStruct:
      case Kind::kClass:
      case Kind::kInterface:
      case Kind::kEnum: {
        size_t name = i + 1;
        if (tokens_[i].is(Kind::kEnum) && (token_at(name).is(Kind::kClass))) ++name;
        const Kind next = token_at(name + 1).kind;
        if (next == Kind::kLeftBrace || next == Kind::kColon) declare(name);
        // The `class` in `enum class` does not declare one.
        i = name;
        break;
      }
      case Kind::kUsing:
        if (token_at(i + 2).is(Kind::kEqual)) declare(i + 1);
        break;
      case Kind::kTypedef:
        while (!token_at(i).is(Kind::kSemicolon) && !token_at(i).is(Kind::kLeftBrace) &&
               !token_at(i).is(Kind::kRightBrace) && i + 1 < tokens_.size()) {
          ++i;
        }
        if (token_at(i).is(Kind::kSemicolon) && is_name(i - 1)) declare(i - 1);
        if (!token_at(i).is(Kind::kSemicolon)) --i;
        break;
      default:
        break;
    }
  }
}

void Parser::members(StructDecl& decl) {
  DeclList found;
  while (!at(Kind::kRightBrace) && !at_end()) {
    const size_t begin = pos_;
    if (is_access_word(token())) {
      report(DiagnosticId::kAccessSpecifier, here(), {token().text});
      advance();
      expect(Kind::kColon, "':' after the access specifier");
    } else if (!special_member(decl.name)) {
      declaration(Context::kMember, found);
    }
    if (panic_) recover(begin);
  }
  if (decl.is_interface) {
    std::erase_if(found, [&](const Decl* member) { return !is_interface_member(member); });
  }
  decl.members = list(found);
}

bool Parser::special_member(std::string_view struct_name) {
  const bool is_destructor = at(Kind::kTilde) && is_name(pos_ + 1);
  const bool is_constructor = at_name() && !struct_name.empty() && token().text == struct_name &&
                              peek(1).is(Kind::kLeftParen);
  if (!is_destructor && !is_constructor) return false;
  report(DiagnosticId::kNoConstructor, here(),
         {is_destructor ? "destructors" : "constructors", struct_name});
  while (!at(Kind::kLeftBrace) && !at(Kind::kSemicolon) && !at(Kind::kRightBrace) && !at_end()) {
    advance();
  }
  if (at(Kind::kLeftBrace)) pos_ = behind_closing(pos_);
  accept(Kind::kSemicolon);
  return true;
}

const EnumDecl* Parser::enum_definition() {
  const Prefix* prefix = std::exchange(struct_prefix_, nullptr);
  EnumDecl* decl = make<EnumDecl>(here());
  advance();
  decl->is_class = accept(Kind::kClass) || accept(Kind::kStruct);
  if (prefix != nullptr) decl->attributes = prefix->attributes;
  const Token* name = at(Kind::kLeftBrace) || at(Kind::kColon) ? nullptr : expect_name("an enum");
  if (panic_) return nullptr;
  const ScopeId scope = scopes_.create(scopes_.current());
  if (name != nullptr) {
    decl->name = name->text;
    decl->location = name->location;
    scopes_.declare(scopes_.current(), name->value, {ParsedKind::kType, scope});
    type_names_.push_back(name->text);
  }
  if (accept(Kind::kColon)) decl->underlying = type_without_bounds();
  const size_t open = pos_;
  if (panic_ || !expect(Kind::kLeftBrace, "'{' of the enum")) return nullptr;
  enumerators(*decl, scope);
  expect_list_end(Kind::kRightBrace, open, "an enumerator");
  recover_behind_brace(open);
  type_scope_ = scope;
  return decl;
}

void Parser::enumerators(EnumDecl& decl, ScopeId scope) {
  std::vector<Enumerator> found;
  while (!panic_ && !at(Kind::kRightBrace) && !at_end()) {
    const Token* name = expect_name("an enumerator");
    if (name == nullptr) break;
    Enumerator enumerator{.location = name->location, .name = name->text};
    if (accept(Kind::kEqual)) enumerator.value = conditional();
    found.push_back(enumerator);
    scopes_.declare_value(decl.is_class ? scope : scopes_.current(), *name);
    if (!accept(Kind::kComma)) break;
  }
  decl.enumerators = list(found);
}

// Methods without a body. [DXC: CheckInterfaceMember]
bool Parser::is_interface_member(const Decl* member) {
  const auto* method = as<FunctionDecl>(member);
  const std::string_view what = method == nullptr                       ? "a field or a type"
                                : method->body != nullptr               ? "a method with a body"
                                : (method->modifiers & kModStatic) != 0 ? "a static method"
                                : method->name.starts_with("operator")  ? "an operator"
                                                                        : "";
  if (what.empty()) return true;
  report(DiagnosticId::kInterfaceMember, member->location, {what});
  return false;
}

}  // namespace kaamos::hlsl
