// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/signatures.h"

#include <algorithm>

namespace kaamos::hlsl {

bool have_same_parameters(const FunctionInfo& one, const FunctionInfo& other) {
  return std::equal(one.parameters.begin(), one.parameters.end(), other.parameters.begin(),
                    other.parameters.end(), [](const ParameterInfo& a, const ParameterInfo& b) {
                      return same_type(a.type, b.type) && a.is_out == b.is_out &&
                             a.is_in == b.is_in;
                    });
}

namespace {

// Compares what two templates say, whatever they call their parameters.
class WrittenAlike {
 public:
  WrittenAlike(const FunctionDecl& one, const FunctionDecl& other) : one_(one), other_(other) {}

  bool holds() const {
    const auto& a = one_;
    const auto& b = other_;
    return std::equal(a.template_parameters.begin(), a.template_parameters.end(),
                      b.template_parameters.begin(), b.template_parameters.end(),
                      [&](const TemplateParameter& x, const TemplateParameter& y) {
                        return types(x.value_type, y.value_type);
                      }) &&
           types(a.return_type, b.return_type) &&
           std::equal(a.parameters.begin(), a.parameters.end(), b.parameters.begin(),
                      b.parameters.end(), [&](const ParameterDecl* x, const ParameterDecl* y) {
                        constexpr Modifiers kDirection = kModIn | kModOut;
                        return (x->modifiers & kDirection) == (y->modifiers & kDirection) &&
                               types(x->type, y->type);
                      });
  }

 private:
  static size_t index_of(const FunctionDecl& decl, std::string_view name) {
    const auto found =
        std::find_if(decl.template_parameters.begin(), decl.template_parameters.end(),
                     [&](const TemplateParameter& one) { return one.name == name; });
    return static_cast<size_t>(found - decl.template_parameters.begin());
  }

  bool names(const QualifiedName& a, const QualifiedName& b) const {
    if (a.is_simple() && b.is_simple()) {
      const size_t i = index_of(one_, a.last().identifier);
      const size_t j = index_of(other_, b.last().identifier);
      const size_t count = one_.template_parameters.size();
      if (i != count || j != count) return i == j;
    }
    return a.is_global == b.is_global &&
           std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                      [&](const NamePart& x, const NamePart& y) {
                        const auto p = x.template_arguments;
                        const auto q = y.template_arguments;
                        return x.identifier == y.identifier &&
                               std::equal(
                                   p.begin(), p.end(), q.begin(), q.end(),
                                   [&](const TemplateArgument& s, const TemplateArgument& t) {
                                     return types(s.type, t.type) && values(s.value, t.value);
                                   });
                      });
  }

  // Compares names and numbers; other expressions count as different.
  bool values(const Expr* a, const Expr* b) const {
    if (!a || !b) return a == b;
    if (const auto* x = as<NameExpr>(a), *y = as<NameExpr>(b); x && y)
      return names(*x->name, *y->name);
    const auto *x = as<IntLiteralExpr>(a), *y = as<IntLiteralExpr>(b);
    return x && y && x->value == y->value;
  }

  bool types(const TypeSyntax* a, const TypeSyntax* b) const {
    if (!a || !b) return a == b;
    constexpr Modifiers kOfTheType = kModRowMajor | kModColumnMajor | kModSnorm | kModUnorm;
    if (a->kind != b->kind || a->is_unsigned != b->is_unsigned ||
        (a->modifiers & kOfTheType) != (b->modifiers & kOfTheType)) {
      return false;
    }
    switch (a->kind) {
      case TypeSyntaxKind::kVoid:
        return true;
      case TypeSyntaxKind::kNumeric:
        return a->scalar == b->scalar && a->rows == b->rows && a->columns == b->columns;
      case TypeSyntaxKind::kNamed:
        return names(*a->name, *b->name);
      case TypeSyntaxKind::kArray:
        return types(a->element, b->element) && values(a->array_size, b->array_size);
      default:
        return false;
    }
  }

  const FunctionDecl& one_;
  const FunctionDecl& other_;
};

}  // namespace

bool are_written_alike(const FunctionDecl& one, const FunctionDecl& other) {
  return WrittenAlike(one, other).holds();
}

std::string describe(const FunctionInfo& function) {
  std::string text = function.result ? to_string(function.result) + " " : "";
  text += function.qualified + "(";
  if (function.is_template) return text + "..)";
  for (size_t i = 0; i < function.parameters.size(); ++i) {
    const ParameterInfo& parameter = function.parameters[i];
    if (i > 0) text += ", ";
    if (parameter.is_out) text += parameter.is_in ? "inout " : "out ";
    text += to_string(parameter.type);
  }
  return text + ")";
}

}  // namespace kaamos::hlsl
