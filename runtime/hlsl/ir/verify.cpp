// SPDX-License-Identifier: MIT
#include "runtime/hlsl/ir/verify.h"

#include <algorithm>
#include <set>

#include "runtime/hlsl/ir/builtin_types.h"
#include "runtime/hlsl/ir/dump.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {
namespace {

using ir::Expr;
using ir::ExprKind;
using ir::Stmt;
using ir::StmtKind;
using ir::Type;
using ir::TypeKind;

bool is_numeric(const Type* type) {
  return type->kind == TypeKind::kScalar || type->kind == TypeKind::kVector ||
         type->kind == TypeKind::kMatrix;
}

size_t components(const Type* type) {
  return type->kind == TypeKind::kScalar   ? 1
         : type->kind == TypeKind::kVector ? type->columns
         : type->kind == TypeKind::kMatrix ? size_t{type->rows} * type->columns
                                           : 0;
}

bool same_shape(const Type* a, const Type* b) {
  return a->kind == b->kind && components(a) == components(b) &&
         (a->kind != TypeKind::kMatrix || a->rows == b->rows);
}

bool is_scalar(const Type* type, ir::Scalar scalar) {
  return type->kind == TypeKind::kScalar && type->scalar == scalar;
}

bool is_index(const Type* type) {
  return is_scalar(type, ir::Scalar::kInt32) || is_scalar(type, ir::Scalar::kUint32);
}

bool is_place_kind(ExprKind kind) {
  return kind == ExprKind::kVariable || kind == ExprKind::kField || kind == ExprKind::kElement ||
         kind == ExprKind::kSwizzle || kind == ExprKind::kMatrixSwizzle;
}

class Verifier {
 public:
  explicit Verifier(const ir::Module& module) : module_(module) {}

  std::string run() {
    for (const ir::Function* function : module_.functions) {
      function_ = function;
      for (const ir::Variable* parameter : function->parameters) declared_.insert(parameter);
      block(function->body);
      done_.insert(function);
      require(function->stages != 0, "is reached by no stage", nullptr);
    }
    function_ = nullptr;
    for (const ir::Variable* global : module_.globals) {
      if (global->initialiser) {
        expr(global->initialiser);
        require(global->initialiser->type == global->type, "initialiser has another type",
                global->initialiser);
      }
    }
    for (const ir::EntryPoint& entry : module_.entry_points) {
      require(done_.count(entry.function) != 0, "entry point is not among the functions", nullptr);
      require(entry.parameters.size() == entry.function->parameters.size(),
              "entry point has other parameters", nullptr);
      std::set<const ir::Function*> seen;
      if (entry.stage == ir::kStageGeometry) vertices(entry, *entry.function, seen);
      for (const uint32_t binding : entry.bindings) {
        require(binding < module_.bindings.size(), "entry point has an unknown binding", nullptr);
      }
    }
    std::set<const ir::Struct*> known;
    for (const ir::Struct* structure : module_.structs) {
      for (const ir::Field& field : structure->fields) {
        const Type* type = field.type;
        while (type->kind == TypeKind::kArray) type = type->element;
        require(type->kind != TypeKind::kStruct || known.count(type->structure) != 0,
                "struct comes before its member's", nullptr);
      }
      known.insert(structure);
    }
    return text_;
  }

 private:
  void require(bool holds, const char* rule, const Expr* at) {
    if (holds || ++failures_ > 5) return;
    text_ += (function_ ? function_->name + ": " : std::string()) + rule;
    if (at) text_ += ": " + dump(*at);
    text_ += "\n";
  }

  void operand_count(const Expr* of, size_t lowest, size_t highest) {
    require(of->operands.size() >= lowest && of->operands.size() <= highest,
            "has a wrong number of operands", of);
  }

  void expr(const Expr* of) {
    if (!of) {
      require(false, "expression is missing", nullptr);
      return;
    }
    if (!checked_.insert(of).second) return;
    require(of->type != nullptr, "expression has no type", nullptr);
    for (const Expr* operand : of->operands) {
      if (!operand) {
        require(false, "operand is missing", nullptr);
        return;
      }
      expr(operand);
    }
    if (!of->type) return;
    shape(of);
  }

  void shape(const Expr* of) {
    const auto& operands = of->operands;
    const Type* type = of->type;
    switch (of->kind) {
      case ExprKind::kLiteral:
        require(of->literal.size() == components(type) && type->kind != TypeKind::kMatrix,
                "literal has a wrong number of components", of);
        break;
      case ExprKind::kVariable: {
        require(of->variable && of->variable->type == type, "variable has another type", of);
        if (!of->variable) break;
        const bool is_global = of->variable->storage != ir::Storage::kLocal &&
                               of->variable->storage != ir::Storage::kParameter;
        const bool listed = std::find(module_.globals.begin(), module_.globals.end(),
                                      of->variable) != module_.globals.end();
        require(is_global ? listed : declared_.count(of->variable) != 0,
                "variable is used before it is declared", of);
        break;
      }
      case ExprKind::kField:
        operand_count(of, 1, 1);
        require(operands[0]->type->kind == TypeKind::kStruct &&
                    of->index < operands[0]->type->structure->fields.size() &&
                    operands[0]->type->structure->fields[of->index].type == type,
                "field does not fit its struct", of);
        break;
      case ExprKind::kElement:
        operand_count(of, 2, 2);
        require(is_index(operands[1]->type), "index is not a 32-bit integer", of);
        if (operands[0]->type->kind == TypeKind::kArray) {
          require(operands[0]->type->element == type, "element has another type", of);
        } else {
          require(operands[0]->type->kind == TypeKind::kVector ||
                      operands[0]->type->kind == TypeKind::kMatrix,
                  "element of something else", of);
        }
        break;
      case ExprKind::kSwizzle:
      case ExprKind::kMatrixSwizzle: {
        operand_count(of, 1, 1);
        require(of->components.size() == components(type), "swizzle has another size", of);
        const Type* base = operands[0]->type;
        const bool matrix = of->kind == ExprKind::kMatrixSwizzle;
        for (const uint8_t component : of->components) {
          require(matrix ? base->kind == TypeKind::kMatrix && component / 4 < base->rows &&
                               component % 4 < base->columns
                         : component < components(base),
                  "swizzle is out of range", of);
        }
        break;
      }
      case ExprKind::kConvert:
        operand_count(of, 1, 1);
        require(is_numeric(type) && same_shape(type, operands[0]->type) &&
                    type->scalar != operands[0]->type->scalar,
                "conversion changes the shape or nothing", of);
        break;
      case ExprKind::kSplat:
        require(operands.size() == 1 && is_scalar(operands[0]->type, type->scalar),
                "splat of another scalar", of);
        break;
      case ExprKind::kTruncate:
        require(operands.size() == 1 && operands[0]->type->scalar == type->scalar &&
                    components(operands[0]->type) > components(type),
                "truncation to something longer", of);
        break;
      case ExprKind::kConstruct:
        construct(of);
        break;
      case ExprKind::kUnary:
        require(operands.size() == 1 && operands[0]->type == type, "unary changes the type", of);
        break;
      case ExprKind::kBinary:
        require(operands.size() == 2 && operands[0]->type == operands[1]->type &&
                    same_shape(type, operands[0]->type) &&
                    (of->binary >= ir::BinaryOp::kLess ? type->scalar == ir::Scalar::kBool
                                                       : type == operands[0]->type),
                "operands of different types", of);
        break;
      case ExprKind::kSelect:
        require(operands.size() == 3 && operands[1]->type == type && operands[2]->type == type &&
                    operands[0]->type->scalar == ir::Scalar::kBool &&
                    (operands[0]->type->kind == TypeKind::kScalar ||
                     same_shape(operands[0]->type, type)),
                "select of different types", of);
        break;
      case ExprKind::kConditional:
        require(operands.size() == 3 && is_scalar(operands[0]->type, ir::Scalar::kBool) &&
                    operands[1]->type == type && operands[2]->type == type,
                "conditional of different types", of);
        break;
      case ExprKind::kLogicalAnd:
      case ExprKind::kLogicalOr:
        require(operands.size() == 2 && is_scalar(operands[0]->type, ir::Scalar::kBool) &&
                    is_scalar(operands[1]->type, ir::Scalar::kBool),
                "logic on something else than bools", of);
        break;
      case ExprKind::kBinding: {
        const bool known = of->index < module_.bindings.size();
        require(known && module_.bindings[of->index].type == type &&
                    operands.size() == (module_.bindings[of->index].is_array ? 1 : 0),
                "binding is unknown", of);
        break;
      }
      case ExprKind::kPrintBuffer:
        require(operands.empty() && type->kind == TypeKind::kResource &&
                    type->resource == ir::ResourceKind::kRWByteAddressBuffer,
                "print buffer of another type", of);
        break;
      case ExprKind::kHeapResource:
        require(operands.size() == 1 && type->kind == TypeKind::kResource, "heap element", of);
        break;
      case ExprKind::kLoad:
        operand_count(of, 2, 2);
        resource(of, 0);
        require(is_scalar(operands[1]->type, ir::Scalar::kUint32), "offset is not a uint", of);
        break;
      case ExprKind::kLoadElement:
        operand_count(of, 3, 3);
        resource(of, 0);
        require(is_scalar(operands[1]->type, ir::Scalar::kUint32) &&
                    is_scalar(operands[2]->type, ir::Scalar::kUint32),
                "element or offset is not a uint", of);
        break;
      case ExprKind::kTypedLoad:
        operand_count(of, 2, 4);
        resource(of, 0);
        require(operands[0]->type->element == type, "texel has another type", of);
        require(components(operands[1]->type) == traits_of(operands[0]->type->resource).coordinates,
                "location has a wrong size", of);
        break;
      case ExprKind::kSample:
        operand_count(of, 3, 6);
        resource(of, 0);
        require(operands[1]->type->kind == TypeKind::kResource &&
                    is_sampler(operands[1]->type->resource),
                "sampler is none", of);
        break;
      case ExprKind::kQueryValue:
        operand_count(of, 1, 1);
        require(operands[0]->kind == ExprKind::kVariable && operands[0]->type->is_query(),
                "a query's object is not a variable of its type", of);
        break;
      case ExprKind::kDimensions:
        operand_count(of, 1, 2);
        resource(of, 0);
        break;
      case ExprKind::kSameBytes:
        operand_count(of, 1, 1);
        break;
      case ExprKind::kRecordConstant:
        operand_count(of, 2, 2);
        require(
            is_hit_object(operands[0]->type) && is_scalar(operands[1]->type, ir::Scalar::kUint32),
            "a record's constant", of);
        break;
      case ExprKind::kTrianglePositions:
        operand_count(of, 3, 3);
        require(components(operands[0]->type) == 2 &&
                    is_scalar(operands[1]->type, ir::Scalar::kUint32) &&
                    is_scalar(operands[2]->type, ir::Scalar::kUint32),
                "a triangle's positions", of);
        break;
      case ExprKind::kClusterId:
        operand_count(of, 1, 1);
        require(components(operands[0]->type) == 2, "a cluster's ID", of);
        break;
      default:
        break;
    }
  }

  void resource(const Expr* of, size_t index) {
    require(of->operands[index]->type->kind == TypeKind::kResource, "operand is not a resource",
            of);
  }

  void construct(const Expr* of) {
    const Type* type = of->type;
    if (is_numeric(type)) {
      size_t count = 0;
      for (const Expr* operand : of->operands) {
        require(operand->type->scalar == type->scalar && operand->type->kind != TypeKind::kMatrix,
                "part has another scalar", of);
        count += components(operand->type);
      }
      require(count == components(type), "parts do not fill it", of);
    } else if (type->kind == TypeKind::kArray) {
      require(of->operands.size() == type->count, "wrong number of elements", of);
      for (const Expr* operand : of->operands) {
        require(operand->type == type->element, "element has another type", of);
      }
    } else {
      require(type->kind == TypeKind::kStruct, "construct of something else", of);
      if (type->kind != TypeKind::kStruct) return;
      const auto& fields = type->structure->fields;
      require(of->operands.size() == fields.size(), "wrong number of fields", of);
      for (size_t i = 0; i < std::min(fields.size(), of->operands.size()); ++i) {
        require(of->operands[i]->type == fields[i].type, "field has another type", of);
      }
    }
  }

  // A place is a chain of selections that ends in a writable variable.
  void place(const Expr* of) {
    expr(of);
    for (const Expr* at = of; at; at = at->operands.empty() ? nullptr : at->operands[0]) {
      require(is_place_kind(at->kind), "is not a place", of);
      if (at->kind == ExprKind::kVariable) {
        require(at->variable->storage != ir::Storage::kConstant, "is constant", of);
        return;
      }
      if (at->kind == ExprKind::kSwizzle || at->kind == ExprKind::kMatrixSwizzle) {
        const std::set<uint8_t> distinct(at->components.begin(), at->components.end());
        require(distinct.size() == at->components.size(), "place repeats a component", of);
      }
    }
  }

  void call(const Stmt& of) {
    require(of.function && done_.count(of.function) != 0, "callee does not come first", nullptr);
    if (!of.function) return;
    const auto& parameters = of.function->parameters;
    require(of.arguments.size() == parameters.size(), "wrong number of arguments", nullptr);
    std::set<const ir::Variable*> references;
    for (size_t i = 0; i < std::min(parameters.size(), of.arguments.size()); ++i) {
      const Expr* argument = of.arguments[i];
      require(argument->type == parameters[i]->type, "argument has another type", argument);
      if (parameters[i]->mode == ir::ParameterMode::kIn) continue;
      require(argument->kind == ExprKind::kVariable &&
                  (references.insert(argument->variable).second || argument->type->is_query()),
              "reference is not a variable of its own", argument);
    }
    if (of.result) {
      require(of.result->type == of.function->result && declared_.count(of.result) != 0,
              "result does not fit", nullptr);
    }
    require((!of.function->may_trace || function_->may_trace) &&
                (!of.function->may_call || function_->may_call) &&
                (!of.function->may_end_shader || function_->may_end_shader) &&
                (!of.function->has_barrier || function_->has_barrier) &&
                (!of.function->has_waves || function_->has_waves),
            "caller lacks a fact of its callee", nullptr);
  }

  void block(const ir::Block& statements) {
    for (const Stmt* statement : statements) stmt(*statement);
  }

  void stmt(const Stmt& of) {
    for (const Expr* operand : of.operands) expr(operand);
    for (const Expr* argument : of.arguments) expr(argument);
    if (of.compare) expr(of.compare);
    switch (of.kind) {
      case StmtKind::kDeclare:
        if (of.value) {
          expr(of.value);
          require(of.value->type == of.variable->type, "value has another type", of.value);
        }
        declared_.insert(of.variable);
        break;
      case StmtKind::kAssign:
        place(of.place);
        expr(of.value);
        require(of.place->type == of.value->type, "assignment changes the type", of.value);
        break;
      case StmtKind::kStore:
      case StmtKind::kStoreElement:
      case StmtKind::kTypedStore: {
        expr(of.value);
        const Type* resource = of.operands[0]->type;
        require(resource->kind == TypeKind::kResource && traits_of(resource->resource).is_writable,
                "store into something read-only", of.operands[0]);
        if (of.kind == StmtKind::kTypedStore) {
          require(resource->element == of.value->type, "texel has another type", of.value);
        }
        break;
      }
      case StmtKind::kAtomic:
        expr(of.value);
        if (of.target == ir::AtomicTarget::kPlace) place(of.place);
        require(!of.result || of.result->type == of.value->type, "result has another type",
                of.value);
        break;
      case StmtKind::kCall:
        call(of);
        break;
      case StmtKind::kTraceRay:
        require(of.operands.size() == 7 && function_->may_trace, "TraceRay", nullptr);
        require(of.place && of.place->kind == ExprKind::kVariable, "payload is not a variable",
                of.place);
        expr(of.place);
        require(!of.result || is_hit_object(of.result->type), "TraceRay's result", nullptr);
        break;
      case StmtKind::kInvoke:
        require(
            of.operands.size() == 1 && is_hit_object(of.operands[0]->type) && function_->may_trace,
            "Invoke", nullptr);
        require(of.place && of.place->kind == ExprKind::kVariable, "payload is not a variable",
                of.place);
        expr(of.place);
        break;
      case StmtKind::kCallShader:
        require(of.operands.size() == 1 && function_->may_call, "CallShader", nullptr);
        require(of.place && of.place->kind == ExprKind::kVariable, "data is not a variable",
                of.place);
        expr(of.place);
        break;
      case StmtKind::kReportHit:
        require(of.operands.size() == 3 && function_->may_end_shader, "ReportHit", nullptr);
        break;
      case StmtKind::kQuery: {
        require(of.place && of.place->kind == ExprKind::kVariable && of.place->type->is_query(),
                "a query's object is not a variable of its type", of.place);
        expr(of.place);
        const size_t operands = of.query == ir::QueryOp::kTrace              ? 4
                                : of.query == ir::QueryOp::kCommitProcedural ? 1
                                                                             : 0;
        require(of.operands.size() == operands, "operands of a query", nullptr);
        require(!of.result || of.query == ir::QueryOp::kProceed, "result of a query", nullptr);
        break;
      }
      case StmtKind::kWave:
        wave(of);
        break;
      case StmtKind::kIf:
        expr(of.value);
        require(is_scalar(of.value->type, ir::Scalar::kBool), "condition is not a bool", of.value);
        block(of.body);
        block(of.orelse);
        break;
      case StmtKind::kLoop:
        if (!of.test_at_end) condition(of);
        block(of.body);
        block(of.step);
        if (of.test_at_end) condition(of);
        break;
      case StmtKind::kSwitch:
        expr(of.value);
        for (const ir::SwitchCase& one : of.cases) block(one.body);
        break;
      case StmtKind::kReturn:
        if (of.value) {
          expr(of.value);
          require(of.value->type == function_->result, "returns another type", of.value);
        } else {
          require(function_->result->kind == TypeKind::kVoid, "returns nothing", nullptr);
        }
        break;
      case StmtKind::kBlock:
        block(of.body);
        break;
      case StmtKind::kCover:
        require(of.point < module_.coverage.size(), "unknown point of coverage", nullptr);
        break;
      default:
        break;
    }
  }

  // Each vertex that a geometry shader emits has its outputs.
  void vertices(const ir::EntryPoint& entry, const ir::Function& function,
                std::set<const ir::Function*>& seen) {
    if (!seen.insert(&function).second) return;
    ir::visit(
        function.body, [](const Expr&) {},
        [&](const Stmt& stmt) {
          if (stmt.kind == StmtKind::kCall) vertices(entry, *stmt.function, seen);
          require(
              stmt.kind != StmtKind::kEmitVertex || stmt.operands.size() == entry.outputs.size(),
              "a vertex has other outputs", nullptr);
        });
  }

  bool is_hit_object(const Type* type) const {
    return type->kind == TypeKind::kStruct && type->structure == module_.hit_object;
  }

  void wave(const Stmt& of) {
    using shader::WaveOp;
    require(function_->has_waves && of.result && declared_.count(of.result) != 0, "wave operation",
            nullptr);
    const size_t operands = shader::has_lane_operand(of.wave) || shader::has_mask_operand(of.wave)
                                ? 2
                            : of.wave <= WaveOp::kIsFirstLane ? 0
                                                              : 1;
    require(of.operands.size() == operands, "operands of a wave operation", nullptr);
    if (!of.result || of.operands.size() != operands) return;
    const Type* result = of.result->type;
    if (of.wave == WaveOp::kAllEqual) {
      require(same_shape(result, of.operands[0]->type), "result of a wave operation", nullptr);
    } else if (shader::gives_bool(of.wave)) {
      require(is_scalar(result, ir::Scalar::kBool), "result of a wave operation", nullptr);
    } else if (shader::gives_number(of.wave)) {
      require(is_scalar(result, ir::Scalar::kUint32), "result of a wave operation", nullptr);
    } else if (!shader::gives_mask(of.wave)) {
      require(result == of.operands[0]->type, "result of a wave operation", nullptr);
    }
  }

  void condition(const Stmt& of) {
    block(of.prelude);
    if (!of.value) return;
    expr(of.value);
    require(is_scalar(of.value->type, ir::Scalar::kBool), "condition is not a bool", of.value);
  }

  const ir::Module& module_;
  const ir::Function* function_ = nullptr;
  std::set<const ir::Function*> done_;
  std::set<const ir::Variable*> declared_;
  std::set<const Expr*> checked_;
  std::string text_;
  int failures_ = 0;
};

}  // namespace

std::string verify(const ir::Module& module) {
  return Verifier(module).run();
}

}  // namespace kaamos::hlsl
