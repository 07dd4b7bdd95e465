// SPDX-License-Identifier: MIT
#include "ast_dump.h"

#include <cstdio>
#include <utility>

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

std::string_view subobject_text(SubobjectKind kind) {
  constexpr std::string_view kTexts[] = {
      "StateObjectConfig",          "GlobalRootSignature",
      "LocalRootSignature",         "SubobjectToExportsAssociation",
      "RaytracingShaderConfig",     "RaytracingPipelineConfig",
      "RaytracingPipelineConfig1",  "TriangleHitGroup",
      "ProceduralPrimitiveHitGroup"};
  return kTexts[static_cast<size_t>(kind)];
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
    {kModIn, "in"},
    {kModOut, "out"},
    {kModConst, "const"},
    {kModVolatile, "volatile"},
    {kModRowMajor, "row_major"},
    {kModColumnMajor, "column_major"},
    {kModSnorm, "snorm"},
    {kModUnorm, "unorm"},
};

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

// ---- Statements

void Dumper::nested(const Stmt* stmt) {
  ++indent_;
  if (stmt != nullptr) statement(*stmt);
  --indent_;
}

void Dumper::statement(const Stmt& stmt) {
  if (const auto* decls = as<DeclStmt>(&stmt)) return inner_same_level(decls->declarations);
  line();
  attributes(stmt.attributes);
  switch (stmt.kind) {
    case StmtKind::kError:
      put("<error>\n");
      break;
    case StmtKind::kEmpty:
      put(";\n");
      break;
    case StmtKind::kBlock:
      put("block\n");
      for (const Stmt* inner : as<BlockStmt>(&stmt)->statements) nested(inner);
      break;
    case StmtKind::kDecl:
      break;
    case StmtKind::kExpr:
      expression(*as<ExprStmt>(&stmt)->expression);
      end();
      break;
    case StmtKind::kIf: {
      const auto& branch = *as<IfStmt>(&stmt);
      put("if ");
      expression(*branch.condition);
      end();
      nested(branch.then_branch);
      if (branch.else_branch != nullptr) {
        line();
        put("else\n");
        nested(branch.else_branch);
      }
      break;
    }
    case StmtKind::kFor: {
      const auto& loop = *as<ForStmt>(&stmt);
      put("for ");
      if (loop.condition != nullptr) expression(*loop.condition);
      put(" ; ");
      if (loop.step != nullptr) expression(*loop.step);
      end();
      if (loop.init != nullptr) {
        ++indent_;
        line();
        put("init\n");
        nested(loop.init);
        --indent_;
      }
      nested(loop.body);
      break;
    }
    case StmtKind::kWhile:
      put("while ");
      expression(*as<WhileStmt>(&stmt)->condition);
      end();
      nested(as<WhileStmt>(&stmt)->body);
      break;
    case StmtKind::kDo:
      put("do while ");
      expression(*as<DoStmt>(&stmt)->condition);
      end();
      nested(as<DoStmt>(&stmt)->body);
      break;
    case StmtKind::kSwitch: {
      put("switch ");
      expression(*as<SwitchStmt>(&stmt)->condition);
      end();
      for (const SwitchSection& section : as<SwitchStmt>(&stmt)->sections) {
        for (const CaseLabel& label : section.labels) {
          line();
          put(label.value != nullptr ? "case " : "default");
          if (label.value != nullptr) expression(*label.value);
          end();
        }
        for (const Stmt* inner : section.statements) nested(inner);
      }
      break;
    }
    case StmtKind::kBreak:
      put("break\n");
      break;
    case StmtKind::kContinue:
      put("continue\n");
      break;
    case StmtKind::kReturn:
      put("return");
      if (as<ReturnStmt>(&stmt)->value != nullptr) {
        put(" ");
        expression(*as<ReturnStmt>(&stmt)->value);
      }
      end();
      break;
    case StmtKind::kDiscard:
      put("discard\n");
      break;
  }
}

// ---- Declarations

void Dumper::attributes(std::span<const Attribute> attributes) {
  for (const Attribute& attribute : attributes) {
    put(attribute.is_double_bracket ? "[[" : "[");
    if (!attribute.scope.empty()) put(attribute.scope, "::");
    put(attribute.name);
    for (const Expr* argument : attribute.arguments) {
      put(" ");
      expression(*argument);
    }
    put(attribute.is_double_bracket ? "]] " : "] ");
  }
}

void Dumper::annotations(const Annotations& annotations) {
  if (annotations.semantic != nullptr) {
    put(" : ", annotations.semantic->base, "#", std::to_string(annotations.semantic->index));
  }
  for (const RegisterBinding& binding : annotations.registers) {
    put(" : register(");
    if (binding.register_class != 0) {
      put(std::string(1, binding.register_class), std::to_string(binding.number));
    }
    if (binding.has_space) put(" space", std::to_string(binding.space));
    put(")");
  }
  if (annotations.pack_offset != nullptr) {
    put(" : packoffset(", std::to_string(annotations.pack_offset->register_index), " ",
        std::to_string(annotations.pack_offset->component), ")");
  }
  for (const PayloadAccess& access : annotations.payload_access) {
    put(access.is_write ? " : write(" : " : read(");
    std::string_view separator;
    for (const PayloadStage& stage : access.stages) {
      put(separator, stage.name);
      separator = " ";
    }
    put(")");
  }
}

void Dumper::template_head(std::span<const TemplateParameter> parameters) {
  put("template<");
  std::string_view separator;
  for (const TemplateParameter& parameter : parameters) {
    put(separator);
    separator = ", ";
    if (parameter.value_type != nullptr) {
      type(*parameter.value_type);
    } else {
      put("typename");
    }
    put(" ", parameter.name);
    if (parameter.default_type != nullptr) {
      put(" = ");
      type(*parameter.default_type);
    }
    if (parameter.default_value != nullptr) {
      put(" = ");
      expression(*parameter.default_value);
    }
  }
  put("> ");
}

void Dumper::inner_same_level(std::span<const Decl* const> declarations) {
  for (const Decl* decl : declarations) declaration(*decl);
}

void Dumper::inner(std::span<const Decl* const> declarations) {
  ++indent_;
  inner_same_level(declarations);
  --indent_;
}

void Dumper::function(const FunctionDecl& decl) {
  if (decl.is_template) template_head(decl.template_parameters);
  put("function ");
  modifiers(decl.modifiers);
  type(*decl.return_type);
  put(" ");
  if (decl.qualifier != nullptr) {
    name(*decl.qualifier);
    put("::");
  }
  put(decl.name, "(");
  std::string_view separator;
  for (const ParameterDecl* parameter : decl.parameters) {
    put(separator);
    separator = ", ";
    attributes(parameter->attributes);
    modifiers(parameter->modifiers);
    type(*parameter->type);
    if (!parameter->name.empty()) put(" ", parameter->name);
    annotations(parameter->annotations);
    if (parameter->default_value != nullptr) {
      put(" = ");
      expression(*parameter->default_value);
    }
  }
  put(decl.is_const_method ? ") const" : ")");
  annotations(decl.annotations);
  end();
  if (decl.body != nullptr) nested(decl.body);
}

void Dumper::structure(const StructDecl& decl) {
  if (decl.is_template) template_head(decl.template_parameters);
  put(decl.is_class ? "class " : "struct ", decl.name);
  std::string_view separator = " : ";
  for (const TypeSyntax* base : decl.bases) {
    put(separator);
    separator = ", ";
    type(*base);
  }
  put(decl.is_definition ? "\n" : ";\n");
  inner(decl.members);
}

void Dumper::declaration(const Decl& decl) {
  line();
  attributes(decl.attributes);
  switch (decl.kind) {
    case DeclKind::kVariable: {
      const auto& variable = *as<VariableDecl>(&decl);
      put("var ");
      modifiers(decl.modifiers);
      type(*variable.type);
      put(" ", decl.name);
      annotations(variable.annotations);
      if (variable.initializer != nullptr) {
        put(" = ");
        expression(*variable.initializer);
      }
      return end();
    }
    case DeclKind::kParameter:
      return put("parameter ", decl.name, "\n");
    case DeclKind::kFunction:
      return function(*as<FunctionDecl>(&decl));
    case DeclKind::kStruct:
      return structure(*as<StructDecl>(&decl));
    case DeclKind::kEnum: {
      const auto& enumeration = *as<EnumDecl>(&decl);
      put(enumeration.is_class ? "enum class " : "enum ", decl.name);
      if (enumeration.underlying != nullptr) {
        put(" : ");
        type(*enumeration.underlying);
      }
      put(" {");
      for (const Enumerator& enumerator : enumeration.enumerators) {
        put(" ", enumerator.name);
        if (enumerator.value != nullptr) {
          put("=");
          expression(*enumerator.value);
        }
      }
      return put(" }\n");
    }
    case DeclKind::kBuffer: {
      const auto& buffer = *as<BufferDecl>(&decl);
      put(buffer.is_texture_buffer ? "tbuffer " : "cbuffer ", decl.name);
      annotations(buffer.annotations);
      end();
      return inner(buffer.members);
    }
    case DeclKind::kNamespace:
      put("namespace ", decl.name, "\n");
      return inner(as<NamespaceDecl>(&decl)->declarations);
    case DeclKind::kTypeAlias: {
      const auto& alias = *as<TypeAliasDecl>(&decl);
      if (alias.is_template) template_head(alias.template_parameters);
      put("alias ", decl.name, " = ");
      type(*alias.type);
      return end();
    }
    case DeclKind::kUsingNamespace:
      put("using namespace ");
      name(*as<UsingNamespaceDecl>(&decl)->target);
      return end();
    case DeclKind::kUsing:
      put("using ");
      name(*as<UsingDecl>(&decl)->target);
      return end();
    case DeclKind::kSubobject: {
      const auto& subobject = *as<SubobjectDecl>(&decl);
      put("subobject ", subobject_text(subobject.subobject_kind), " ", decl.name, " = ");
      operands("", {}, subobject.arguments);
      return end();
    }
  }
}

}  // namespace

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
