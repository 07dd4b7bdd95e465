// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/testing/ast_dumper.h"

namespace kaamos::hlsl {
namespace {

std::string_view subobject_text(SubobjectKind kind) {
  constexpr std::string_view kTexts[] = {
      "StateObjectConfig",          "GlobalRootSignature",
      "LocalRootSignature",         "SubobjectToExportsAssociation",
      "RaytracingShaderConfig",     "RaytracingPipelineConfig",
      "RaytracingPipelineConfig1",  "TriangleHitGroup",
      "ProceduralPrimitiveHitGroup"};
  return kTexts[static_cast<size_t>(kind)];
}

}  // namespace

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
  put(decl.is_interface ? "interface " : decl.is_class ? "class " : "struct ", decl.name);
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
      if (variable.bit_width != nullptr) {
        put(" : ");
        expression(*variable.bit_width);
      }
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
    case DeclKind::kStaticAssert: {
      const auto& assertion = *as<StaticAssertDecl>(&decl);
      put("static_assert \"", assertion.text, "\" ");
      expression(*assertion.condition);
      return end();
    }
  }
}

}  // namespace kaamos::hlsl
