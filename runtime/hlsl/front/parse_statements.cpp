// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {

const BlockStmt* Parser::block() {
  const size_t open = pos_;
  BlockStmt* result = make<BlockStmt>(here());
  advance();
  InScope scope(*this, scopes_.create(scopes_.current()));
  std::vector<const Stmt*> statements;
  statements_until_brace(statements);
  result->statements = list(statements);
  result->end = here();
  expect_closing(Kind::kRightBrace, open, "the statements of the block");
  return result;
}

void Parser::statements_until_brace(std::vector<const Stmt*>& statements) {
  while (!at(Kind::kRightBrace) && !at_end()) {
    const size_t begin = pos_;
    statements.push_back(statement());
    if (panic_) recover(begin);
  }
}

Stmt* Parser::statement() {
  Nesting nesting(*this);
  if (!nesting.ok) return make<ErrorStmt>(here());
  std::vector<Attribute> found;
  attributes(found);
  if (panic_) return make<ErrorStmt>(here());
  const std::span<const Attribute> kept = list(found);
  if (at(Kind::kRightBrace)) {
    reject_attributes(kept, "a statement");
    return make<ErrorStmt>(here());
  }
  if (starts_declaration(pos_)) return declaration_statement(kept);
  Stmt* result = unattributed_statement();
  result->attributes = kept;
  return result;
}

Stmt* Parser::unattributed_statement() {
  const SourceLocation location = here();
  switch (token().kind) {
    case Kind::kLeftBrace:
      return const_cast<BlockStmt*>(block());
    case Kind::kSemicolon:
      advance();
      return make<EmptyStmt>(location);
    case Kind::kIf:
      return if_statement();
    case Kind::kFor:
      return for_statement();
    case Kind::kWhile:
      return while_statement();
    case Kind::kDo:
      return do_statement();
    case Kind::kSwitch:
      return switch_statement();
    case Kind::kReturn:
      return return_statement();
    case Kind::kBreak:
      return jump(make<BreakStmt>(location), "'break'");
    case Kind::kContinue:
      return jump(make<ContinueStmt>(location), "'continue'");
    case Kind::kDiscard:
      return jump(make<DiscardStmt>(location), "'discard'");
    case Kind::kElse:
      report(DiagnosticId::kElseWithoutIf, location, {});
      advance();
      return statement();
    case Kind::kCase:
    case Kind::kDefault:
      report(DiagnosticId::kLabelOutsideSwitch, location, {token().text});
      case_label();
      return make<ErrorStmt>(location);
    case Kind::kReservedWord:
      return reserved_statement();
    default:
      return expression_statement();
  }
}

Stmt* Parser::jump(Stmt* result, std::string_view word) {
  advance();
  expect_semicolon(word);
  return result;
}

// ---- Conditions

Parser::Condition Parser::condition(std::string_view word) {
  const size_t open = pos_;
  if (panic_ || !expect(Kind::kLeftParen, "'(' after " + std::string(word))) return {};
  Condition result = condition_value();
  expect_closing(Kind::kRightParen, open, "the condition");
  recover_behind_paren(open);
  if (result.value == nullptr) result.value = error_expr(here());
  return result;
}

Parser::Condition Parser::condition_value() {
  if (!starts_declaration(pos_)) return {expression(), nullptr};
  Prefix prefix;
  prefix.context = Context::kLocal;
  DeclList definitions;
  Modifiers modifiers = 0;
  const SourceLocation location = here();
  const TypeSyntax* type = type_specifier(modifiers, &definitions);
  reject_declarator_prefix();
  const VariableDecl* declared = variable(prefix, modifiers, type);
  if (declared == nullptr) return {error_expr(location), nullptr};
  definitions.push_back(declared);
  DeclStmt* statement = make<DeclStmt>(location);
  statement->declarations = list(definitions);
  NamePart part{
      .location = declared->location, .identifier = declared->name, .template_arguments = {}};
  QualifiedName* name = make<QualifiedName>(declared->location);
  name->parts = arena_.copy(std::span<const NamePart>(&part, 1));
  NameExpr* value = make<NameExpr>(declared->location);
  value->name = name;
  return {value, statement};
}

// `if (T x = e) ...` becomes `{ T x = e; if (x) ... }`.
Stmt* Parser::body_with(const Condition& condition, Stmt* body) {
  if (condition.declared == nullptr) return body;
  BlockStmt* result = make<BlockStmt>(body->location);
  result->end = body->location;
  result->statements = list(std::vector<const Stmt*>{condition.declared, body});
  return result;
}

// `while (T x = e) body` becomes `while (true) { T x = e; if (x) body else break; }`.
Stmt* Parser::loop_body_with(const Condition& condition, Stmt* body) {
  if (condition.declared == nullptr) return body;
  IfStmt* test = make<IfStmt>(body->location);
  test->condition = condition.value;
  test->then_branch = body;
  test->else_branch = make<BreakStmt>(body->location);
  return body_with(condition, test);
}

// ---- Selection and loops

Stmt* Parser::if_statement() {
  struct Link {
    IfStmt* statement;
    Condition condition;
    std::span<const Attribute> attributes;
  };
  std::vector<Link> links;
  const Stmt* last = nullptr;
  std::span<const Attribute> kept;
  // A chain of `else if` does not count as nesting in the parser; each link has a scope for its
  // condition.
  const ScopeId outer = scopes_.current();
  const uint32_t outer_else_ifs = else_ifs_;
  for (;;) {
    scopes_.enter(scopes_.create(scopes_.current()));
    IfStmt* result = make<IfStmt>(here());
    advance();
    const Condition tested = condition("'if'");
    result->condition = tested.value != nullptr ? tested.value : error_expr(here());
    links.push_back({result, tested, kept});
    result->then_branch = panic_ ? make<ErrorStmt>(here()) : statement();
    if (panic_ || !accept(Kind::kElse)) break;
    std::vector<Attribute> found;
    const bool has_attributes = at(Kind::kLeftBracket);
    if (has_attributes) attributes(found);
    kept = list(found);
    if (!at(Kind::kIf) || ++else_ifs_ > kMaxElseIf) {
      if (at(Kind::kIf)) fail_here(DiagnosticId::kNestedTooDeep, {std::to_string(kMaxElseIf)});
      Stmt* final_branch = panic_ ? make<ErrorStmt>(here()) : statement();
      if (has_attributes) final_branch->attributes = kept;
      last = final_branch;
      break;
    }
  }
  scopes_.enter(outer);
  else_ifs_ = outer_else_ifs;
  Stmt* result = nullptr;
  for (size_t i = links.size(); i-- > 0;) {
    links[i].statement->else_branch = last;
    result = links[i].statement;
    result->attributes = links[i].attributes;
    result = body_with(links[i].condition, result);
    last = result;
  }
  return result;
}

Stmt* Parser::for_statement() {
  ForStmt* result = make<ForStmt>(here());
  InScope scope(*this, scopes_.create(scopes_.current()));
  advance();
  const size_t open = pos_;
  if (!expect(Kind::kLeftParen, "'(' after 'for'")) return make<ErrorStmt>(here());
  if (accept(Kind::kSemicolon)) {
    result->init = nullptr;
  } else if (starts_declaration(pos_)) {
    result->init = declaration_statement({});
  } else {
    ExprStmt* init = make<ExprStmt>(here());
    init->expression = expression();
    result->init = init;
    expect_semicolon("the first part of 'for'");
  }
  Condition tested;
  if (!panic_ && !at(Kind::kSemicolon)) tested = condition_value();
  if (tested.declared == nullptr) result->condition = tested.value;
  expect_semicolon("the condition of 'for'");
  if (!panic_ && !at(Kind::kRightParen)) result->step = expression();
  expect_closing(Kind::kRightParen, open, "the last part of 'for'");
  recover_behind_paren(open);
  if (panic_) return make<ErrorStmt>(here());
  result->body = loop_body_with(tested, statement());
  return result;
}

Stmt* Parser::while_statement() {
  WhileStmt* result = make<WhileStmt>(here());
  InScope scope(*this, scopes_.create(scopes_.current()));
  advance();
  const Condition tested = condition("'while'");
  if (panic_) return make<ErrorStmt>(here());
  result->condition = tested.value;
  if (tested.declared != nullptr) {
    BoolLiteralExpr* always = make<BoolLiteralExpr>(result->location);
    always->value = true;
    result->condition = always;
  }
  result->body = loop_body_with(tested, statement());
  return result;
}

Stmt* Parser::do_statement() {
  DoStmt* result = make<DoStmt>(here());
  advance();
  result->body = statement();
  if (panic_ || !expect(Kind::kWhile, "'while' after the body of 'do'")) {
    return make<ErrorStmt>(result->location);
  }
  const size_t open = pos_;
  if (expect(Kind::kLeftParen, "'(' after 'while'")) {
    result->condition = expression();
    expect_closing(Kind::kRightParen, open, "the condition");
    recover_behind_paren(open);
  }
  expect_semicolon("'do ... while (...)'");
  if (result->condition == nullptr) result->condition = error_expr(result->location);
  return result;
}

Stmt* Parser::switch_statement() {
  SwitchStmt* result = make<SwitchStmt>(here());
  InScope scope(*this, scopes_.create(scopes_.current()));
  advance();
  const Condition tested = condition("'switch'");
  const size_t open = pos_;
  if (panic_ || !expect(Kind::kLeftBrace, "'{' after 'switch (...)'")) {
    return make<ErrorStmt>(result->location);
  }
  result->condition = tested.value;
  InScope inner(*this, scopes_.create(scopes_.current()));
  std::vector<SwitchSection> sections;
  switch_sections(sections);
  expect_closing(Kind::kRightBrace, open, "the statements of the switch");
  result->sections = list(sections);
  return body_with(tested, result);
}

void Parser::switch_sections(std::vector<SwitchSection>& sections) {
  bool is_reported = false;
  while (!at(Kind::kRightBrace) && !at_end()) {
    const size_t begin = pos_;
    SwitchSection section{.labels = {}, .statements = {}};
    std::vector<CaseLabel> labels;
    while (!panic_ && (at(Kind::kCase) || at(Kind::kDefault))) labels.push_back(case_label());
    if (panic_) recover(begin);
    if (labels.empty() && !is_reported && sections.empty()) {
      is_reported = true;
      report(DiagnosticId::kStatementBeforeLabel, here(), {describe(token())});
    }
    std::vector<const Stmt*> statements;
    while (!at(Kind::kRightBrace) && !at_end() && !at(Kind::kCase) && !at(Kind::kDefault)) {
      const size_t statement_begin = pos_;
      statements.push_back(statement());
      if (panic_) recover(statement_begin);
    }
    section.labels = list(labels);
    section.statements = list(statements);
    if (!labels.empty()) sections.push_back(section);
  }
}

CaseLabel Parser::case_label() {
  CaseLabel label{.location = here()};
  const bool is_case = at(Kind::kCase);
  advance();
  if (is_case) label.value = conditional();
  if (!panic_) expect(Kind::kColon, is_case ? "':' after the case label" : "':' after 'default'");
  return label;
}

// ---- Other statements

Stmt* Parser::return_statement() {
  ReturnStmt* result = make<ReturnStmt>(here());
  advance();
  if (accept(Kind::kSemicolon)) return result;
  result->value = at(Kind::kLeftBrace) ? init_list() : expression();
  expect_semicolon("the returned value");
  return result;
}

Stmt* Parser::expression_statement() {
  if (at_name() && peek(1).is(Kind::kColon)) {
    report(DiagnosticId::kNoLabels, here(), {});
    advance();
    advance();
    return make<ErrorStmt>(here());
  }
  ExprStmt* result = make<ExprStmt>(here());
  result->expression = expression();
  expect_semicolon("the expression");
  return result;
}

Stmt* Parser::reserved_statement() {
  const std::string_view word = token().text;
  if (word == "goto") {
    fail_here(DiagnosticId::kNoGoto, {});
    return make<ErrorStmt>(here());
  }
  if (word == "try" || word == "catch") {
    const SourceLocation location = here();
    // One message for `try {} catch (...) {}`; errors inside the blocks are still reported.
    if (word == "try") report(DiagnosticId::kNoExceptions, location, {word});
    advance();
    if (at(Kind::kLeftParen)) pos_ = behind_closing(pos_);
    if (at(Kind::kLeftBrace)) block();
    return make<ErrorStmt>(location);
  }
  return expression_statement();
}

Stmt* Parser::declaration_statement(std::span<const Attribute> kept) {
  DeclStmt* result = make<DeclStmt>(here());
  DeclList declarations;
  Prefix prefix;
  prefix.attributes = kept;
  prefix.context = Context::kLocal;
  declaration_with(prefix, declarations);
  result->declarations = list(declarations);
  return result;
}

bool Parser::starts_declaration(size_t index) {
  switch (token_at(index).kind) {
    case Kind::kStruct:
    case Kind::kClass:
    case Kind::kEnum:
    case Kind::kTypedef:
    case Kind::kUsing:
    case Kind::kTemplate:
    case Kind::kNamespace:
    case Kind::kCbuffer:
    case Kind::kTbuffer:
    case Kind::kInterface:
      return true;
    case Kind::kVoid:
    case Kind::kUnsigned:
    case Kind::kTypename:
      return !token_at(behind_type(index)).is(Kind::kLeftParen);
    case Kind::kReservedWord: {
      const std::string_view word = token_at(index).text;
      return word == "auto" || word == "union" || word == "long" || word == "short" ||
             word == "char" || word == "signed" || word == "virtual" || word == "explicit" ||
             word == "friend" || word == "mutable" || word == "_Static_assert";
    }
    default:
      break;
  }
  if (modifier_at(index) != 0) return true;
  const NameLookup name = look_up(index);
  if (name.end == index) return false;
  const Token& next = token_at(name.end);
  if (name.is_type()) {
    switch (next.kind) {
      case Kind::kConst:
      case Kind::kVolatile:
      case Kind::kOperator:
      case Kind::kStar:
      case Kind::kAmp:
      case Kind::kSemicolon:
      case Kind::kComma:
      case Kind::kEqual:
        return true;
      case Kind::kLeftBracket: {
        const size_t end = behind_closing(name.end);
        return end != name.end && is_name(end);
      }
      default:
        // A keyword here is meant as a name, and the declaration says that it cannot be one.
        return can_begin_type(next.kind) && !next.is(Kind::kColonColon);
    }
  }
  if (name.symbol.kind == ParsedKind::kSubobject) return can_be_name(next.kind);
  if (name.is_dependent) return can_be_name(next.kind);
  const bool same_line = (next.flags & Token::kAtLineStart) == 0;
  // Two names in a row: either an unknown type, or a missing operator or ';'.
  if (name.symbol.kind == ParsedKind::kUnknown && same_line &&
      !scopes_.is_known_value(token_at(name.end - 1))) {
    if (can_be_name(next.kind)) return true;
    // `Unknown<float> x;`
    if (next.is(Kind::kLess)) {
      const size_t end = behind_plain_template_arguments(name.end, true);
      return end != name.end && is_name(end);
    }
  }
  return false;
}

}  // namespace kaamos::hlsl
