// SPDX-License-Identifier: MIT
// Dumps one tree; only dump() uses it. Types and expressions are in ast_dump.cpp, statements and
// declarations in ast_dump_statements.cpp.
#pragma once

#include <initializer_list>
#include <string>

#include "runtime/hlsl/front/ast.h"

namespace kaamos::hlsl {

class Dumper {
 public:
  std::string result;

  void unit(const TranslationUnit& unit) {
    for (const Decl* decl : unit.declarations) declaration(*decl);
  }
  void declaration(const Decl& decl);
  void statement(const Stmt& stmt);
  void expression(const Expr& expr);
  void type(const TypeSyntax& type);

 private:
  template <class... Parts>
  void put(const Parts&... parts) {
    ((result += parts), ...);
  }
  void line() { result.append(2 * indent_, ' '); }
  void end() { result += '\n'; }
  void modifiers(Modifiers modifiers);
  void name(const QualifiedName& name);
  void part(const NamePart& part);
  void attributes(std::span<const Attribute> attributes);
  void annotations(const Annotations& annotations);
  void template_head(std::span<const TemplateParameter> parameters);
  void array(const TypeSyntax& type);
  void operands(std::string_view head, std::initializer_list<const Expr*> items,
                std::span<const Expr* const> more = {});
  void float_literal(double value);
  void nested(const Stmt* stmt);
  void function(const FunctionDecl& decl);
  void structure(const StructDecl& decl);
  void inner_same_level(std::span<const Decl* const> declarations);
  void inner(std::span<const Decl* const> declarations);

  size_t indent_ = 0;
};

}  // namespace kaamos::hlsl
