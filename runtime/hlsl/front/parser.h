// SPDX-License-Identifier: MIT
// The recursive-descent parser; only parse() uses it. One class, split into one file per noun:
// parse.cpp (tokens, errors, recovery), parse_names, parse_modifiers, parse_types,
// parse_expressions, parse_primaries, parse_statements, parse_declarations, parse_functions,
// parse_structs, parse_templates, parse_annotations, parse_attributes, parse_subobjects.
//
// Error recovery: the first error in a statement or declaration sets panic_. While it is set,
// nothing more is reported and all loops end; the enclosing list of statements or declarations
// skips to a place where the next one can begin and clears it. So one mistake gives one message,
// and during a panic a function may return any node.
#pragma once

#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/front/parse.h"
#include "runtime/hlsl/front/parse_scopes.h"

namespace kaamos::hlsl {

class Parser {
 public:
  Parser(const TokenList& tokens, AstArena& arena, DiagnosticEngine& diagnostics);
  const TranslationUnit* translation_unit();

 private:
  using Kind = TokenKind;
  using DeclList = std::vector<const Decl*>;

  // Nesting of expressions, statements, structs, namespaces and template arguments together. It
  // bounds the parser's own stack, which grows by about 2 KiB per level.
  static constexpr uint32_t kMaxNesting = 256;
  // Levels of one expression; a sum of n terms has n - 1. It bounds the stack of recursive walks.
  static constexpr uint32_t kMaxHeight = 1024;
  static constexpr uint32_t kMaxElseIf = 1024;
  static constexpr size_t kMaxArrayBounds = 32;
  // The number of tokens to look ahead into template arguments; a parenthesised group counts as
  // one.
  static constexpr size_t kMaxLookAhead = 512;

  struct Nesting {
    explicit Nesting(Parser& parser);
    ~Nesting() { --parser_.depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;
    bool ok = true;  // False if nested too deep, which is then already reported.

   private:
    Parser& parser_;
  };
  struct InScope {
    InScope(Parser& parser, ScopeId scope)
        : parser_(parser), previous_(parser.scopes_.enter(scope)) {}
    ~InScope() { parser_.scopes_.enter(previous_); }
    InScope(const InScope&) = delete;
    InScope& operator=(const InScope&) = delete;

   private:
    Parser& parser_;
    ScopeId previous_;
  };
  // Sets a flag while a part is parsed and restores it afterwards.
  struct Setting {
    Setting(bool& flag, bool value) : flag_(flag), previous_(flag) { flag = value; }
    ~Setting() { flag_ = previous_; }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;

   private:
    bool& flag_;
    bool previous_;
  };

  // ---- parse.cpp: tokens
  const Token& token() const { return tokens_[pos_]; }
  // Past the end there is only the end-of-file token.
  const Token& token_at(size_t index) const {
    return tokens_[index < tokens_.size() ? index : tokens_.size() - 1];
  }
  const Token& peek(size_t ahead) const { return token_at(pos_ + ahead); }
  bool at(Kind kind) const { return token().kind == kind; }
  bool at_end() const { return at(Kind::kEndOfFile); }
  bool at_name() const { return can_be_name(token().kind); }
  bool is_name(size_t index) const { return can_be_name(token_at(index).kind); }
  SourceLocation here() const { return token().location; }
  void advance();
  bool accept(Kind kind);
  // Consumes `>`, or the first half of `>>`, `>=`, `>>=`.
  bool accept_template_end();
  // Consumes the token, or reports an error that says what it should have followed.
  bool expect(Kind kind, std::string_view expected);
  bool expect_semicolon(std::string_view after);
  // Consumes the bracket that closes the one at token `open`.
  bool expect_closing(Kind kind, size_t open, std::string_view after);
  // The same where a ',' would be allowed too.
  bool expect_list_end(Kind kind, size_t open, std::string_view after);
  bool expect_template_end(size_t open);
  // Consumes a name for `what` ("a variable"); null after an error. `kAnyName`: also one of the
  // keywords that can be names.
  enum class NameKind : uint8_t { kIdentifier, kAnyName };
  const Token* expect_name(std::string_view what, NameKind kind = NameKind::kIdentifier);

  // ---- parse.cpp: errors and recovery
  DiagnosticEngine::Report report(DiagnosticId id, SourceLocation location,
                                  std::initializer_list<std::string_view> arguments);
  // Reports unless in panic, and starts a panic.
  DiagnosticEngine::Report fail(DiagnosticId id, SourceLocation location,
                                std::initializer_list<std::string_view> arguments);
  DiagnosticEngine::Report fail_here(DiagnosticId id,
                                     std::initializer_list<std::string_view> arguments) {
    return fail(id, here(), arguments);
  }
  // The index after the bracket that closes the one at `open`, or the end if none does.
  size_t behind_closing(size_t open) const;
  // Skips to where a statement or declaration can begin; skips at least one token if pos_ is
  // `begin`.
  void recover(size_t begin);
  // After an error between the bracket at token `open` and its `)`: continues after the `)` if it
  // comes before the end of the statement, otherwise stays in panic.
  void recover_behind_paren(size_t open);
  // The same for the `}` that closes the brace at token `open`.
  void recover_behind_brace(size_t open);
  bool starts_new_item(size_t index);

  // ---- Nodes
  template <class T>
  T* make(SourceLocation location) {
    T* node = arena_.make<T>();
    node->location = location;
    return node;
  }
  template <class T>
  std::span<const T> list(const std::vector<T>& items) {
    return arena_.copy(std::span<const T>(items));
  }

  // ---- parse_names.cpp
  // The meaning of the qualified name at a token, found without consuming it.
  struct NameLookup {
    ParsedSymbol symbol;
    size_t end = 0;             // After the name; the starting index if there is no name.
    bool is_dependent = false;  // `T::name`: only known when the template is instantiated.
    bool is_type() const { return symbol.is_type(); }
  };
  NameLookup look_up(size_t index);
  // The meaning of a name that follows no `::`, where it stands.
  ParsedSymbol find_first_part(size_t index);
  // Returns whether the `<` at `index`, after the name at `name_index`, begins template arguments.
  bool begins_template_arguments(size_t index, size_t name_index, const ParsedSymbol& symbol,
                                 bool is_member);
  // The index after the type (modifiers included) that begins at `index`; `index` if there is none.
  size_t behind_type(size_t index);
  // The index after `<...>` at `index`, or `index` if it does not look like such a list. If the
  // list ends with the first half of a `>>`, the index of the `>>`.
  size_t behind_template_arguments(size_t index) const;
  // Whether the token after `unsigned` names the type that becomes unsigned.
  bool is_unsigned_base(size_t index);
  size_t behind_plain_template_arguments(size_t index, bool first_is_type);
  // Parses `::a::b<float>::c`. `is_member`: after a `.`. `container` receives the scope of the last
  // part. `S::operator` ends after the `::`, with `S` as the name.
  const QualifiedName* qualified_name(bool is_member, ParsedSymbol* symbol = nullptr,
                                      ScopeId* container = nullptr);
  std::span<const TemplateArgument> template_arguments();
  TemplateArgument template_argument();

  // ---- parse_modifiers.cpp
  // Adds modifiers to `modifiers` for as long as there are any.
  void parse_modifiers(Modifiers& modifiers);
  Modifiers modifier_at(size_t index) const;
  void add_modifier(Modifiers& modifiers, Modifiers added, const Token& token);
  enum class Declared : uint8_t { kGlobal, kLocal, kField, kParameter, kFunction, kMethod };
  void check_modifiers(Modifiers modifiers, Declared declared);

  // ---- parse_types.cpp
  // Modifiers and a type. Those of kTypeModifiers go to the type, the others to `modifiers`.
  // Definitions of structs and enums are appended to `definitions`; if that is null, definitions
  // are an error here.
  const TypeSyntax* type_specifier(Modifiers& modifiers, DeclList* definitions);
  TypeSyntax* bare_type(DeclList* definitions);
  TypeSyntax* named_type();
  TypeSyntax* unknown_type();
  TypeSyntax* numeric_type(const BuiltinName& name);
  TypeSyntax* unsigned_type();
  TypeSyntax* reserved_type();
  TypeSyntax* definition_type(DeclList* definitions);
  TypeSyntax* error_type(SourceLocation location);
  // The matrix order that `#pragma pack_matrix` sets at this point.
  Modifiers pack_matrix_modifier() const;
  // `[2][3]` after a declarator's name.
  const TypeSyntax* array_bounds(const TypeSyntax* element);
  // A type alone, as in a cast: `const float3`, `float[4]`.
  const TypeSyntax* type_name();
  const TypeSyntax* type_without_bounds();
  // Reports and skips a `*`, `&` or `[` between a type and a name.
  void reject_declarator_prefix();
  // The tokens as they would be written, for messages.
  std::string text_between(size_t begin, size_t end) const;

  // ---- parse_expressions.cpp, parse_primaries.cpp
  const Expr* expression();  // Includes comma operators.
  const Expr* assignment();
  const Expr* assignment_value();  // Or an initializer list.
  const Expr* conditional();
  const Expr* binary(int least_precedence);
  int precedence_here(BinaryOp* op) const;
  const Expr* unary();
  const Expr* prefix_unary(UnaryOp op);
  const Expr* cast_or_parentheses();
  const Expr* postfix();
  const Expr* member(const Expr* base);
  const Expr* index(const Expr* base);
  const Expr* primary();
  const Expr* number();
  const Expr* name_or_construct();
  const Expr* construct(const TypeSyntax* type);
  const Expr* size_of();
  const Expr* reserved_expression();
  const Expr* keyword_expression();
  const Expr* init_list();
  std::span<const Expr* const> call_arguments();
  const Expr* error_expr(SourceLocation location) { return make<ErrorExpr>(location); }
  // Sets the height; returns an ErrorExpr if it is too large.
  const Expr* finish(Expr* expr, std::initializer_list<const Expr*> children,
                     std::span<const Expr* const> more = {});

  // ---- parse_statements.cpp
  const BlockStmt* block();
  void statements_until_brace(std::vector<const Stmt*>& statements);
  Stmt* statement();
  Stmt* unattributed_statement();
  Stmt* if_statement();
  Stmt* for_statement();
  Stmt* while_statement();
  Stmt* do_statement();
  Stmt* switch_statement();
  void switch_sections(std::vector<SwitchSection>& sections);
  CaseLabel case_label();
  Stmt* return_statement();
  Stmt* declaration_statement(std::span<const Attribute> attributes);
  Stmt* expression_statement();
  Stmt* reserved_statement();
  Stmt* jump(Stmt* statement, std::string_view word);
  bool starts_declaration(size_t index);
  // The condition between parentheses; `declared` is null if it declares nothing.
  struct Condition {
    const Expr* value = nullptr;
    const Stmt* declared = nullptr;
  };
  Condition condition(std::string_view word);
  Condition condition_value();
  Stmt* body_with(const Condition& condition, Stmt* body);
  Stmt* loop_body_with(const Condition& condition, Stmt* body);

  // ---- parse_declarations.cpp
  enum class Context : uint8_t { kGlobal, kMember, kBuffer, kLocal };
  // Everything that comes before a declaration.
  struct Prefix {
    std::span<const Attribute> attributes;
    std::span<const TemplateParameter> template_parameters;
    std::span<const TemplateParameter> outer_parameters = {};
    bool is_template = false;
    bool is_specialization = false;  // after `template<>`
    bool is_instantiation = false;   // after `template` without a list
    // The scope to declare in; it differs from the current one inside a template's parameter scope.
    ScopeId scope = kNoScope;
    Context context = Context::kGlobal;
  };
  void declarations_until(Kind end, Context context, DeclList& out);
  void declaration(Context context, DeclList& out);
  void declaration_with(Prefix& prefix, DeclList& out);
  void simple_declaration(Prefix& prefix, DeclList& out);
  void declarators(const Prefix& prefix, Modifiers modifiers, const TypeSyntax* type,
                   DeclList& out);
  const VariableDecl* variable(const Prefix& prefix, Modifiers modifiers, const TypeSyntax* type);
  // `S::name` or `S<T>::name` where a declarator begins.
  bool starts_qualified_declarator(size_t index);
  void skip_effect_annotation();
  const Expr* variable_initializer();
  bool begins_bit_width(size_t index);
  void bit_field(VariableDecl& decl);
  void namespace_declaration(DeclList& out);
  void using_declaration(const Prefix& prefix, DeclList& out);
  void static_assertion(const Prefix& prefix, DeclList& out);
  void typedef_declaration(const Prefix& prefix, DeclList& out);
  void buffer_declaration(const Prefix& prefix, DeclList& out);
  void subobject_declaration(DeclList& out);
  ScopeId scope_of(const Prefix& prefix) const {
    return prefix.scope == kNoScope ? scopes_.current() : prefix.scope;
  }
  static std::string_view context_text(Context context);

  // ---- parse_functions.cpp
  void function(const Prefix& prefix, Modifiers modifiers, const TypeSyntax* type, DeclList& out);
  bool function_name(FunctionDecl& decl, ScopeId* qualifier_scope);
  std::string_view operator_name();
  void parameters(std::vector<const ParameterDecl*>& out);
  const ParameterDecl* parameter();
  bool starts_function_declarator(size_t index);
  // `Type name(` inside a function: neither a function nor a constructor call is allowed here.
  void reject_local_declarator(const Prefix& prefix, Modifiers modifiers, const TypeSyntax* type,
                               size_t type_begin);

  // ---- parse_structs.cpp
  const StructDecl* struct_definition();
  const EnumDecl* enum_definition();
  void bases(StructDecl& decl, ScopeId scope);
  void members(StructDecl& decl);
  bool special_member(std::string_view struct_name);
  void predeclare_members(ScopeId scope);
  void enumerators(EnumDecl& decl, ScopeId scope);
  bool is_interface_member(const Decl* member);

  // ---- parse_templates.cpp
  void template_declaration(Prefix& prefix, DeclList& out);
  void template_parameters(std::vector<TemplateParameter>& out);
  TemplateParameter template_parameter();

  // ---- parse_attributes.cpp, parse_annotations.cpp
  void attributes(std::vector<Attribute>& out);
  Attribute attribute(bool is_double);
  bool at_attribute() const { return at(Kind::kLeftBracket); }
  void reject_attributes(std::span<const Attribute> found, std::string_view before);
  Annotations annotations();
  void one_annotation(Annotations& result, std::vector<RegisterBinding>& registers,
                      std::vector<PayloadAccess>& payload);
  void semantic(Annotations& result);
  void register_binding(std::vector<RegisterBinding>& out);
  uint32_t element_offset();
  void pack_offset(Annotations& result);
  void payload_access(std::vector<PayloadAccess>& out);
  bool parse_number(std::string_view digits, uint32_t* value, const Token& token);

  std::vector<Token> tokens_;  // Without pragmas; `>>` is split in place.
  struct PackMatrix {
    size_t index;  // The first token that it applies to.
    Modifiers modifier;
  };
  std::vector<PackMatrix> pack_matrix_;
  const TokenList& source_;
  AstArena& arena_;
  DiagnosticEngine& diagnostics_;
  ParseScopes scopes_;
  size_t pos_ = 0;
  uint32_t depth_ = 0;
  bool panic_ = false;
  bool greater_is_operator_ = true;  // False directly inside template arguments.
  // Height of the expressions in types and template arguments, added to the next expression made.
  uint32_t pending_height_ = 0;
  uint32_t else_ifs_ = 0;                  // Length of the enclosing `else if` chains.
  ScopeId type_scope_ = kNoScope;          // The members of the type that was parsed last.
  const Prefix* struct_prefix_ = nullptr;  // For a struct or enum that may come next.
  const Token* function_token_ = nullptr;  // The name of the enclosing function.
  int look_ahead_depth_ = 0;
  const Token* modifier_words_[kModifierCount] = {};  // Where each was written last.
  std::vector<uint32_t> refused_names_;  // Keywords that were declared as names (Token::value).
  std::set<std::string_view> vk_attributes_;  // those that are already reported
  std::vector<std::string_view> type_names_;  // All types declared so far, for suggestions.
};

}  // namespace kaamos::hlsl
