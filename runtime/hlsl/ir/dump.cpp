// SPDX-License-Identifier: MIT
#include "runtime/hlsl/ir/dump.h"

#include <bit>
#include <cstdio>

#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"
#include "runtime/hlsl/ir/operators.h"

namespace kaamos::hlsl {
namespace {

constexpr const char* kScalarNames[] = {"bool",  "int16",  "uint16", "int",   "uint",
                                        "int64", "uint64", "half",   "float", "double"};
constexpr const char* kUnaryNames[] = {"-", "!", "~"};
constexpr const char* kSampleNames[] = {"sample_level", "sample_gradient", "sample_compare_level",
                                        "gather",       "gather_compare",  "level_of_detail"};
constexpr const char* kAtomicNames[] = {
    "add", "and", "or", "xor", "min", "max", "exchange", "compare_exchange", "compare_store"};
constexpr const char* kQueryOpNames[] = {"trace_inline", "proceed", "abort", "commit_triangle",
                                         "commit_procedural"};

constexpr const char* kSystemValueNames[] = {"DispatchRaysIndex",
                                             "DispatchRaysDimensions",
                                             "WorldRayOrigin",
                                             "WorldRayDirection",
                                             "RayTMin",
                                             "RayTCurrent",
                                             "RayFlags",
                                             "InstanceIndex",
                                             "InstanceID",
                                             "GeometryIndex",
                                             "PrimitiveIndex",
                                             "ObjectRayOrigin",
                                             "ObjectRayDirection",
                                             "ObjectToWorld3x4",
                                             "ObjectToWorld4x3",
                                             "WorldToObject3x4",
                                             "WorldToObject4x3",
                                             "HitKind",
                                             "PositionTable"};

std::string name_of_variable(const ir::Variable& variable) {
  return (variable.name.empty() ? "t" : variable.name) + "$" + std::to_string(variable.id);
}

std::string literal_text(uint64_t bits, ir::Scalar scalar) {
  if (scalar == ir::Scalar::kBool) return bits ? "true" : "false";
  if (scalar >= ir::Scalar::kFloat16) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", std::bit_cast<double>(bits));
    return text;
  }
  const bool is_signed =
      scalar == ir::Scalar::kInt16 || scalar == ir::Scalar::kInt32 || scalar == ir::Scalar::kInt64;
  return is_signed ? std::to_string(static_cast<int64_t>(bits)) : std::to_string(bits) + "u";
}

class Dumper {
 public:
  std::string text;

  void list(const std::vector<const ir::Expr*>& expressions) {
    for (size_t i = 0; i < expressions.size(); ++i) {
      if (i > 0) text += ", ";
      expr(expressions[i]);
    }
  }

  void call(const std::string& name, const ir::Expr& of) {
    text += name + "(";
    list(of.operands);
    text += ")";
  }

  void expr(const ir::Expr* of) {
    if (!of) {
      text += "<null>";
      return;
    }
    switch (of->kind) {
      case ir::ExprKind::kLiteral:
        if (of->literal.size() > 1) text += dump(*of->type) + "(";
        for (size_t i = 0; i < of->literal.size(); ++i) {
          if (i > 0) text += ", ";
          text += literal_text(of->literal[i], of->type->scalar);
        }
        if (of->literal.size() > 1) text += ")";
        return;
      case ir::ExprKind::kZero:
        text += dump(*of->type) + "{0}";
        return;
      case ir::ExprKind::kVariable:
        text += name_of_variable(*of->variable);
        return;
      case ir::ExprKind::kField:
        expr(of->operands[0]);
        text += "." + of->operands[0]->type->structure->fields[of->index].name;
        return;
      case ir::ExprKind::kElement:
        expr(of->operands[0]);
        text += "[";
        expr(of->operands[1]);
        text += "]";
        return;
      case ir::ExprKind::kSwizzle:
        expr(of->operands[0]);
        text += ".";
        for (const uint8_t component : of->components) text += "xyzw"[component & 3];
        return;
      case ir::ExprKind::kMatrixSwizzle:
        expr(of->operands[0]);
        text += ".";
        for (const uint8_t component : of->components) {
          text += "_m" + std::to_string(component / 4) + std::to_string(component % 4);
        }
        return;
      case ir::ExprKind::kConvert:
        return call(dump(*of->type), *of);
      case ir::ExprKind::kSplat:
        return call("splat_" + dump(*of->type), *of);
      case ir::ExprKind::kTruncate:
        return call("truncate_" + dump(*of->type), *of);
      case ir::ExprKind::kConstruct:
        return call("make_" + dump(*of->type), *of);
      case ir::ExprKind::kUnary:
        text += kUnaryNames[static_cast<size_t>(of->unary)];
        expr(of->operands[0]);
        return;
      case ir::ExprKind::kBinary:
        text += "(";
        expr(of->operands[0]);
        text += std::string(" ") + ir::spelling_of(of->binary).symbol + " ";
        expr(of->operands[1]);
        text += ")";
        return;
      case ir::ExprKind::kSelect:
        return call("select", *of);
      case ir::ExprKind::kConditional:
        return call("conditional", *of);
      case ir::ExprKind::kLogicalAnd:
        return call("logical_and", *of);
      case ir::ExprKind::kLogicalOr:
        return call("logical_or", *of);
      case ir::ExprKind::kIntrinsic:
        return call(std::string(kaamos::hlsl::name_of(of->intrinsic)), *of);
      case ir::ExprKind::kQueryValue:
        text += of->index == 1 ? "committed_" : "query_";
        text += std::to_string(static_cast<int>(of->query_value)) + "(";
        expr(of->operands[0]);
        text += ")";
        return;
      case ir::ExprKind::kSystemValue:
        text += kSystemValueNames[static_cast<size_t>(of->system_value)];
        return;
      case ir::ExprKind::kBinding:
        return call("binding" + std::to_string(of->index), *of);
      case ir::ExprKind::kHeapResource:
        return call("heap", *of);
      case ir::ExprKind::kPrintBuffer:
        return call("print_buffer", *of);
      case ir::ExprKind::kLoad:
        return call(std::string(of->layout == ir::Layout::kConstantBuffer ? "load_cb_" : "load_") +
                        (of->row_major ? "rows_" : "") + dump(*of->type),
                    *of);
      case ir::ExprKind::kLoadElement:
        return call(std::string("load_element_") + (of->row_major ? "rows_" : "") + dump(*of->type),
                    *of);
      case ir::ExprKind::kTypedLoad:
        return call("typed_load_" + dump(*of->type), *of);
      case ir::ExprKind::kSample:
        return call(std::string(kSampleNames[static_cast<size_t>(of->sample)]), *of);
      case ir::ExprKind::kDimensions:
        return call("dimensions", *of);
      case ir::ExprKind::kSameBytes:
        return call("same_bytes_" + dump(*of->type), *of);
      case ir::ExprKind::kRecordConstant:
        return call("record_constant", *of);
      case ir::ExprKind::kTrianglePositions:
        return call("triangle_positions", *of);
      case ir::ExprKind::kClusterId:
        return call("cluster_id", *of);
      case ir::ExprKind::kQuad:
        return call(std::string(wave_function_name(of->wave)), *of);
    }
  }

  void line(const std::string& content) { text += std::string(indent_ * 2, ' ') + content; }

  void block(const ir::Block& statements) {
    text += "{\n";
    ++indent_;
    for (const ir::Stmt* statement : statements) stmt(*statement);
    --indent_;
    line("}");
  }

  void result_prefix(const ir::Stmt& of) {
    line(of.result ? name_of_variable(*of.result) + " = " : "");
  }

  void stmt(const ir::Stmt& of) {
    switch (of.kind) {
      case ir::StmtKind::kBlock:
        line("");
        block(of.body);
        break;
      case ir::StmtKind::kDeclare:
        line(dump(*of.variable->type) + " " + name_of_variable(*of.variable));
        if (of.value) {
          text += " = ";
          expr(of.value);
        }
        break;
      case ir::StmtKind::kAssign:
        line("");
        expr(of.place);
        text += " = ";
        expr(of.value);
        break;
      case ir::StmtKind::kStore:
      case ir::StmtKind::kStoreElement:
      case ir::StmtKind::kTypedStore:
        line(of.kind == ir::StmtKind::kStore          ? "store("
             : of.kind == ir::StmtKind::kStoreElement ? "store_element("
                                                      : "typed_store(");
        list(of.operands);
        text += ") = ";
        expr(of.value);
        break;
      case ir::StmtKind::kAtomic:
        result_prefix(of);
        text += std::string("atomic_") + kAtomicNames[static_cast<size_t>(of.atomic)] + "(";
        if (of.place) expr(of.place);
        list(of.operands);
        if (of.compare) {
          text += "; ";
          expr(of.compare);
        }
        text += "; ";
        expr(of.value);
        text += ")";
        break;
      case ir::StmtKind::kCall:
        result_prefix(of);
        text += of.function->name + "(";
        list(of.arguments);
        text += ")";
        break;
      case ir::StmtKind::kTraceRay:
      case ir::StmtKind::kInvoke:
      case ir::StmtKind::kCallShader:
        result_prefix(of);
        text += of.kind == ir::StmtKind::kTraceRay ? "trace_ray("
                : of.kind == ir::StmtKind::kInvoke ? "invoke("
                                                   : "call_shader(";
        list(of.operands);
        text += ", inout ";
        expr(of.place);
        text += ")";
        break;
      case ir::StmtKind::kReportHit:
        result_prefix(of);
        text += "report_hit(";
        list(of.operands);
        text += ")";
        break;
      case ir::StmtKind::kQuery:
        result_prefix(of);
        text += kQueryOpNames[static_cast<size_t>(of.query)];
        text += "(";
        expr(of.place);
        if (!of.operands.empty()) text += ", ";
        list(of.operands);
        text += ")";
        break;
      case ir::StmtKind::kWave:
        result_prefix(of);
        text += std::string(wave_function_name(of.wave)) + "(";
        list(of.operands);
        text += ")";
        break;
      case ir::StmtKind::kIgnoreHit:
        line("ignore_hit");
        break;
      case ir::StmtKind::kAcceptHitAndEndSearch:
        line("accept_hit_and_end_search");
        break;
      case ir::StmtKind::kDiscard:
        line("discard");
        break;
      case ir::StmtKind::kEmitVertex:
        text += "emit_vertex(";
        list(of.operands);
        text += ")";
        break;
      case ir::StmtKind::kCutStrip:
        line("cut_strip");
        break;
      case ir::StmtKind::kCover:
        line("cover " + std::to_string(of.point));
        break;
      case ir::StmtKind::kRemoveDevice:
        line("remove_device " + std::to_string(static_cast<int>(of.removal)));
        break;
      case ir::StmtKind::kDebugBreak:
        line("debug_break");
        break;
      case ir::StmtKind::kIf:
        line("if ");
        expr(of.value);
        text += " ";
        block(of.body);
        if (!of.orelse.empty()) {
          text += " else ";
          block(of.orelse);
        }
        break;
      case ir::StmtKind::kLoop:
        line(of.test_at_end ? "loop_test_at_end " : "loop ");
        if (!of.prelude.empty()) {
          text += "prelude ";
          block(of.prelude);
          text += " ";
        }
        if (of.value) {
          text += "while ";
          expr(of.value);
          text += " ";
        }
        block(of.body);
        if (!of.step.empty()) {
          text += " step ";
          block(of.step);
        }
        break;
      case ir::StmtKind::kSwitch:
        line("switch ");
        expr(of.value);
        text += " {\n";
        for (const ir::SwitchCase& one : of.cases) {
          line("case");
          for (const int64_t label : one.labels) text += " " + std::to_string(label);
          if (one.is_default) text += " default";
          text += " ";
          block(one.body);
          text += "\n";
        }
        line("}");
        break;
      case ir::StmtKind::kBreak:
        line("break");
        break;
      case ir::StmtKind::kContinue:
        line("continue");
        break;
      case ir::StmtKind::kReturn:
        line("return");
        if (of.value) {
          text += " ";
          expr(of.value);
        }
        break;
      case ir::StmtKind::kBarrier:
        line("barrier " + std::to_string(of.barrier));
        break;
    }
    text += "\n";
  }

 private:
  size_t indent_ = 0;
};

}  // namespace

std::string dump(const ir::Type& type) {
  switch (type.kind) {
    case ir::TypeKind::kVoid:
      return "void";
    case ir::TypeKind::kScalar:
      return kScalarNames[static_cast<size_t>(type.scalar)];
    case ir::TypeKind::kVector:
      return kScalarNames[static_cast<size_t>(type.scalar)] + std::to_string(type.columns);
    case ir::TypeKind::kMatrix:
      return kScalarNames[static_cast<size_t>(type.scalar)] + std::to_string(type.rows) + "x" +
             std::to_string(type.columns);
    case ir::TypeKind::kArray:
      return dump(*type.element) + "[" + std::to_string(type.count) + "]";
    case ir::TypeKind::kStruct:
      return type.structure->name;
    case ir::TypeKind::kResource:
      return std::string(resource_name(type.resource)) +
             (type.element ? "<" + dump(*type.element) + ">" : "");
  }
  return {};
}

std::string dump(const ir::Expr& expression) {
  Dumper dumper;
  dumper.expr(&expression);
  return dumper.text;
}

std::string dump(const ir::Function& function) {
  static constexpr const char* kModes[] = {"", "inout ", "out "};
  Dumper dumper;
  dumper.text = dump(*function.result) + " " + function.name + "(";
  for (size_t i = 0; i < function.parameters.size(); ++i) {
    const ir::Variable& parameter = *function.parameters[i];
    if (i > 0) dumper.text += ", ";
    dumper.text += kModes[static_cast<size_t>(parameter.mode)] + dump(*parameter.type) + " " +
                   name_of_variable(parameter);
  }
  dumper.text += ")";
  if (function.may_trace) dumper.text += " may_trace";
  if (function.may_call) dumper.text += " may_call";
  if (function.may_end_shader) dumper.text += " may_end_shader";
  if (function.has_barrier) dumper.text += " has_barrier";
  if (function.has_waves) dumper.text += " has_waves";
  dumper.text += " ";
  dumper.block(function.body);
  return dumper.text + "\n";
}

std::string dump(const ir::Module& module) {
  std::string text = "module " + module.name + " " + module.target + "\n";
  for (const ir::Struct* structure : module.structs) {
    text += "struct " + structure->name + " {";
    for (const ir::Field& field : structure->fields) {
      text += " " + dump(*field.type) + " " + field.name + ";";
    }
    text += " }\n";
  }
  for (const ir::Binding& binding : module.bindings) {
    text += "binding " + binding.name + " " + dump(*binding.type) + " " +
            "tubs"[binding.register_class & 3] + std::to_string(binding.register_index) + " space" +
            std::to_string(binding.space) + " count " + std::to_string(binding.count) +
            (binding.automatic ? " automatic" : "") + " bytes " +
            std::to_string(binding.size_bytes) + "\n";
  }
  for (const ir::Variable* global : module.globals) {
    text += "global " + dump(*global->type) + " " + name_of_variable(*global);
    if (global->initialiser) text += " = " + dump(*global->initialiser);
    text += "\n";
  }
  for (const ir::Function* function : module.functions) text += dump(*function);
  for (const ir::EntryPoint& entry : module.entry_points) {
    text += "entry " + entry.name + " " + std::string(stage_name(entry.stage)) + " payload " +
            std::to_string(entry.payload_bytes) + " attributes " +
            std::to_string(entry.attribute_bytes) + " bindings";
    for (const uint32_t binding : entry.bindings) text += " " + std::to_string(binding);
    text += "\n";
  }
  for (const ir::Print& print : module.prints) {
    text += std::string(print.is_error ? "errorf" : "printf") + " (" + print.arguments + ") " +
            print.format + "\n";
  }
  for (const ir::Import& import : module.imports) text += "import " + import.signature + "\n";
  for (const ir::EntryPoint& entry : module.unlinked_entry_points) {
    text += "unlinked entry " + entry.name + " " + std::string(stage_name(entry.stage)) +
            " payload " + std::to_string(entry.payload_bytes) + " attributes " +
            std::to_string(entry.attribute_bytes) + " imports";
    for (const uint32_t import : entry.imports) text += " " + std::to_string(import);
    text += "\n";
  }
  for (const ir::LibraryFunction& function : module.library_functions) {
    text += "library function " + function.name + "\n";
  }
  return text;
}

}  // namespace kaamos::hlsl
