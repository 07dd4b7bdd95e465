// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/testing/ast_dump.h"

#include <cstdio>
#include <utility>

#include "runtime/hlsl/front/testing/ast_dumper.h"

namespace kaamos::hlsl {
namespace {

std::string_view binary_text(BinaryOp op) {
  constexpr std::string_view kTexts[] = {"*",  "/",  "%",  "+", "-", "<<", ">>", "<",  ">", "<=",
                                         ">=", "==", "!=", "&", "^", "|",  "&&", "||", ","};
  return kTexts[static_cast<size_t>(op)];
}

std::string_view unary_text(UnaryOp op) {
  constexpr std::string_view kTexts[] = {"+", "-", "!", "~", "++", "--", "post++", "post--"};
  return kTexts[static_cast<size_t>(op)];
}

std::string_view scalar_text(ScalarKind kind) {
  constexpr std::string_view kTexts[] = {"bool",       "int",      "uint",     "half",
                                         "float",      "double",   "int16_t",  "uint16_t",
                                         "float16_t",  "int64_t",  "uint64_t", "min10float",
                                         "min16float", "min12int", "min16int", "min16uint"};
  return kTexts[static_cast<size_t>(kind)];
}

std::string_view suffix_text(LiteralSuffix suffix) {
  constexpr std::string_view kTexts[] = {"", "u", "l", "ul", "f", "h"};
  return kTexts[static_cast<size_t>(suffix)];
}

struct ModifierText {
  Modifiers modifier;
  std::string_view text;
};

constexpr ModifierText kModifierTexts[] = {
    {kModStatic, "static"},
    {kModExtern, "extern"},
    {kModUniform, "uniform"},
    {kModGroupshared, "groupshared"},
    {kModPrecise, "precise"},
    {kModGloballyCoherent, "globallycoherent"},
    {kModInline, "inline"},
    {kModExport, "export"},
    {kModNoInterpolation, "nointerpolation"},
    {kModLinear, "linear"},
    {kModCentroid, "centroid"},
    {kModNoPerspective, "noperspective"},
    {kModSample, "sample"},
    {kModShared, "shared"},
    {kModCenter, "center"},
    {kModReorderCoherent, "reordercoherent"},
    {kModPoint, "point"},
    {kModLine, "line"},
    {kModLineAdj, "lineadj"},
    {kModTriangle, "triangle"},
    {kModTriangleAdj, "triangleadj"},
    {kModMesh, "mesh_output"},
    {kModIn, "in"},
    {kModOut, "out"},
    {kModConst, "const"},
    {kModVolatile, "volatile"},
    {kModRowMajor, "row_major"},
    {kModColumnMajor, "column_major"},
    {kModSnorm, "snorm"},
    {kModUnorm, "unorm"},
};

}  // namespace

// ---- Names and types

void Dumper::modifiers(Modifiers modifiers) {
  for (const ModifierText& entry : kModifierTexts) {
    if (modifiers & entry.modifier) put(entry.text, " ");
  }
}

void Dumper::part(const NamePart& part) {
  put(part.identifier);
  if (!part.has_template_arguments) return;
  put("<");
  for (size_t i = 0; i < part.template_arguments.size(); ++i) {
    if (i != 0) put(", ");
    const TemplateArgument& argument = part.template_arguments[i];
    if (argument.type != nullptr) {
      type(*argument.type);
    } else if (argument.value != nullptr) {
      put("=");
      expression(*argument.value);
    }
  }
  put(">");
}

void Dumper::name(const QualifiedName& name) {
  if (name.is_global) put("::");
  for (size_t i = 0; i < name.parts.size(); ++i) {
    if (i != 0) put("::");
    part(name.parts[i]);
  }
}

void Dumper::array(const TypeSyntax& array_type) {
  const TypeSyntax* element = &array_type;
  while (element->kind == TypeSyntaxKind::kArray) element = element->element;
  type(*element);
  for (element = &array_type; element->kind == TypeSyntaxKind::kArray; element = element->element) {
    put("[");
    if (element->array_size != nullptr) expression(*element->array_size);
    put("]");
  }
}

void Dumper::type(const TypeSyntax& type) {
  if (type.kind == TypeSyntaxKind::kArray) return array(type);
  modifiers(type.modifiers);
  switch (type.kind) {
    case TypeSyntaxKind::kError:
      put("<error>");
      break;
    case TypeSyntaxKind::kVoid:
      put("void");
      break;
    case TypeSyntaxKind::kNumeric:
      put(scalar_text(type.scalar));
      if (type.rows != 0) put(std::to_string(type.rows), "x");
      if (type.columns != 0) put(std::to_string(type.columns));
      break;
    case TypeSyntaxKind::kNamed:
      name(*type.name);
      break;
    case TypeSyntaxKind::kDefinition:
      put(type.definition->kind == DeclKind::kEnum ? "enum" : "struct", "{", type.definition->name,
          "}");
      break;
    case TypeSyntaxKind::kAuto:
      put("auto");
      break;
    case TypeSyntaxKind::kArray:
      break;
  }
}

// ---- Expressions

void Dumper::operands(std::string_view head, std::initializer_list<const Expr*> items,
                      std::span<const Expr* const> more) {
  put("(", head);
  auto one = [&](const Expr* item) {
    put(" ");
    if (item != nullptr) expression(*item);
  };
  for (const Expr* item : items) one(item);
  for (const Expr* item : more) one(item);
  put(")");
}

void Dumper::float_literal(double value) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.9g", value);
  std::string written = text;
  if (written.find_first_of(".en") == std::string::npos) written += ".0";
  put(written);
}

void Dumper::expression(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::kError:
      return put("<error>");
    case ExprKind::kIntLiteral: {
      const auto& literal = *as<IntLiteralExpr>(&expr);
      return put(std::to_string(literal.value), suffix_text(literal.suffix));
    }
    case ExprKind::kFloatLiteral: {
      const auto& literal = *as<FloatLiteralExpr>(&expr);
      float_literal(literal.value);
      return put(suffix_text(literal.suffix));
    }
    case ExprKind::kBoolLiteral:
      return put(as<BoolLiteralExpr>(&expr)->value ? "true" : "false");
    case ExprKind::kStringLiteral:
      return put("\"", as<StringLiteralExpr>(&expr)->value, "\"");
    case ExprKind::kName:
      return name(*as<NameExpr>(&expr)->name);
    case ExprKind::kThis:
      return put("this");
    case ExprKind::kMember: {
      const auto& member = *as<MemberExpr>(&expr);
      put("(. ");
      expression(*member.base);
      put(" ");
      name(*member.name);
      return put(")");
    }
    case ExprKind::kIndex: {
      const auto& index = *as<IndexExpr>(&expr);
      return operands("[]", {index.base, index.index});
    }
    case ExprKind::kCall: {
      const auto& call = *as<CallExpr>(&expr);
      return operands("call", {call.callee}, call.arguments);
    }
    case ExprKind::kConstruct: {
      const auto& construct = *as<ConstructExpr>(&expr);
      put("(new ");
      type(*construct.type);
      for (const Expr* argument : construct.arguments) {
        put(" ");
        expression(*argument);
      }
      return put(")");
    }
    case ExprKind::kCast: {
      const auto& cast = *as<CastExpr>(&expr);
      put("(cast ");
      type(*cast.type);
      put(" ");
      expression(*cast.operand);
      return put(")");
    }
    case ExprKind::kInitList: {
      put("{");
      std::string_view separator;
      for (const Expr* element : as<InitListExpr>(&expr)->elements) {
        put(separator);
        expression(*element);
        separator = ", ";
      }
      return put("}");
    }
    case ExprKind::kUnary: {
      const auto& unary = *as<UnaryExpr>(&expr);
      return operands(unary_text(unary.op), {unary.operand});
    }
    case ExprKind::kBinary: {
      const auto& binary = *as<BinaryExpr>(&expr);
      return operands(binary_text(binary.op), {binary.left, binary.right});
    }
    case ExprKind::kAssign: {
      const auto& assign = *as<AssignExpr>(&expr);
      const std::string op = std::string(assign.op ? binary_text(*assign.op) : "") + "=";
      return operands(op, {assign.target, assign.value});
    }
    case ExprKind::kConditional: {
      const auto& conditional = *as<ConditionalExpr>(&expr);
      return operands("?", {conditional.condition, conditional.if_true, conditional.if_false});
    }
    case ExprKind::kSizeof: {
      const auto& size = *as<SizeofExpr>(&expr);
      put("(sizeof ");
      if (size.type != nullptr) {
        type(*size.type);
      } else {
        expression(*size.operand);
      }
      return put(")");
    }
  }
}

std::string dump(const TranslationUnit& unit) {
  Dumper dumper;
  dumper.unit(unit);
  return std::move(dumper.result);
}

std::string dump(const Decl& decl) {
  Dumper dumper;
  dumper.declaration(decl);
  return std::move(dumper.result);
}

std::string dump(const Stmt& stmt) {
  Dumper dumper;
  dumper.statement(stmt);
  return std::move(dumper.result);
}

std::string dump(const Expr& expr) {
  Dumper dumper;
  dumper.expression(expr);
  return std::move(dumper.result);
}

std::string dump(const TypeSyntax& type) {
  Dumper dumper;
  dumper.type(type);
  return std::move(dumper.result);
}

}  // namespace kaamos::hlsl
