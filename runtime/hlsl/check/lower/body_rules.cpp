// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/body_rules.h"

#include <algorithm>
#include <set>
#include <string>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/attributes.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {
namespace {

struct Feature {
  std::string_view prefix;
  bool is_whole;  // or else everything that begins with it
  uint32_t minor;
};

// [DirectXShaderCompiler: docs/DXIL.rst, opcodes by shader model]
constexpr Feature kFeatures[] = {
    {"ResourceDescriptorHeap", true, 6},
    {"SamplerDescriptorHeap", true, 6},
    {"RayQuery", true, 5},
    {"GeometryIndex", true, 5},
    {"dot2add", true, 4},
    {"dot4add_", false, 4},
    {"pack_", false, 6},
    {"unpack_", false, 6},
    {"SampleCmpLevel", true, 7},
    {"Barrier", true, 8},
    {"a 64-bit atomic operation", true, 6},
    {"isnormal", true, 9},
    {"InterlockedAdd64", true, 6},
    {"InterlockedAnd64", true, 6},
    {"InterlockedOr64", true, 6},
    {"InterlockedXor64", true, 6},
    {"InterlockedMin64", true, 6},
    {"InterlockedMax64", true, 6},
    {"InterlockedExchange64", true, 6},
    {"InterlockedCompareExchange64", true, 6},
    {"InterlockedCompareStore64", true, 6},
};

bool stores(ir::StmtKind kind) {
  return kind == ir::StmtKind::kStore || kind == ir::StmtKind::kStoreElement ||
         kind == ir::StmtKind::kTypedStore;
}

// The variable that the value is a part of, unchanged but for its type.
const ir::Variable* part_of(const ir::Expr* value) {
  while (value && value->kind != ir::ExprKind::kVariable) {
    const bool is_part =
        value->kind == ir::ExprKind::kField || value->kind == ir::ExprKind::kElement ||
        value->kind == ir::ExprKind::kSwizzle || value->kind == ir::ExprKind::kConvert;
    value = is_part && !value->operands.empty() ? value->operands[0] : nullptr;
  }
  return value ? value->variable : nullptr;
}

bool ends_loop(const ir::Block& block, bool is_inner) {
  return std::any_of(block.begin(), block.end(), [&](const ir::Stmt* statement) {
    switch (statement->kind) {
      case ir::StmtKind::kBreak:
        return !is_inner;
      case ir::StmtKind::kReturn:
      case ir::StmtKind::kIgnoreHit:
      case ir::StmtKind::kAcceptHitAndEndSearch:
        return true;
      // What is called may end the shader.
      case ir::StmtKind::kCall:
      case ir::StmtKind::kReportHit:
        return true;
      default:
        break;
    }
    const bool inside = is_inner || statement->kind == ir::StmtKind::kLoop ||
                        statement->kind == ir::StmtKind::kSwitch;
    for (const ir::Block* inner :
         {&statement->prelude, &statement->body, &statement->orelse, &statement->step}) {
      if (ends_loop(*inner, inside)) return true;
    }
    return std::any_of(statement->cases.begin(), statement->cases.end(),
                       [&](const ir::SwitchCase& one) { return ends_loop(one.body, inside); });
  });
}

}  // namespace

void BodyRules::note_without_value(const VariableInfo& variable, SourceLocation location) {
  if (!body_.function || contains_resource(variable.type)) return;
  if (flat_component_count(variable.type) == 0) return;
  noted_[body_.function].push_back({variable.variable, variable.name, location});
}

void BodyRules::check_variables(const FunctionInfo& function) {
  std::set<const ir::Variable*> written;
  std::set<const ir::Variable*> read;
  std::set<const ir::Variable*> stored;
  const auto reads = [&](const ir::Expr* expr) {
    ir::visit_expr(expr, [&](const ir::Expr& one) {
      if (one.kind == ir::ExprKind::kVariable) read.insert(one.variable);
    });
  };
  ir::visit(
      function.ir->body, [](const ir::Expr&) {},
      [&](const ir::Stmt& statement) {
        const bool has_no_value = statement.kind == ir::StmtKind::kDeclare && !statement.value;
        if (!has_no_value) {
          ir::visit_written(statement, [&](const ir::Variable* variable, const ir::Expr*) {
            written.insert(variable);
          });
        }
        for (const ir::Expr* expr : {statement.value, statement.compare}) reads(expr);
        if (stores(statement.kind)) stored.insert(part_of(statement.value));
        for (const ir::Expr* expr : statement.operands) reads(expr);
        for (size_t i = 0; i < statement.arguments.size(); ++i) {
          // A method that reads no field may have any object.
          const ir::Variable& parameter = *statement.function->parameters[i];
          if (parameter.mode == ir::ParameterMode::kIn && parameter.name != "this") {
            reads(statement.arguments[i]);
          }
        }
      });
  if (const auto found = noted_.find(&function); found != noted_.end()) {
    for (const Noted& one : found->second) {
      if (read.contains(one.variable) && !written.contains(one.variable)) {
        report(stored.contains(one.variable) ? CheckId::kUndefinedStored : CheckId::kUninitialised,
               one.location, {std::string(one.name)});
      }
    }
  }
  size_t index = function.ir->parameters.size() - 1;
  for (auto at = function.parameters.rbegin(); at != function.parameters.rend(); ++at) {
    if (at->binding) continue;
    const ir::Variable* variable = function.ir->parameters[index--];
    const bool is_unwritten = at->is_out && !at->is_in && !at->name.empty() &&
                              flat_component_count(at->type) != 0 && !written.contains(variable);
    if (is_unwritten) report(CheckId::kOutUnwritten, at->decl->location, {std::string(at->name)});
  }
}

void BodyRules::check_loop(const ir::Stmt& loop, SourceLocation location) {
  if (loop.value || ends_loop(loop.prelude, false) || ends_loop(loop.body, false)) return;
  report(CheckId::kEndlessLoop, location);
}

void BodyRules::check_unroll(const ir::Stmt& loop, SourceLocation location) {
  if (!loop.value || !loop.prelude.empty() || loop.value->kind != ir::ExprKind::kBinary) return;
  bool loads = false;
  ir::visit_expr(loop.value, [&](const ir::Expr& one) {
    const bool is_input = one.kind == ir::ExprKind::kVariable &&
                          one.variable->storage == ir::Storage::kParameter && is_entry_point();
    loads = loads || is_input || one.kind == ir::ExprKind::kLoad ||
            one.kind == ir::ExprKind::kLoadElement || one.kind == ir::ExprKind::kTypedLoad;
  });
  if (loads) report(CheckId::kUnrollCount, location);
}

bool BodyRules::is_entry_point() const {
  const FunctionInfo* function = body_.function;
  if (!function || function->owner) return false;
  const CheckOptions& options = names_.options();
  return options.target.starts_with("lib_") ? find_attribute(*function, "shader") != nullptr
                                            : function->name == options.entry_point;
}

void BodyRules::check_model(std::string_view name, SourceLocation location) {
  const std::string& target = names_.options().target;
  const uint32_t minor = shader_model_minor(target);
  for (const Feature& one : kFeatures) {
    const bool is_meant = one.is_whole ? name == one.prefix : name.starts_with(one.prefix);
    if (!is_meant || one.minor <= minor) continue;
    report(CheckId::kNeedsModel, location,
           {std::string(name), "6." + std::to_string(one.minor), target});
  }
}

bool BodyRules::has_return(const ir::Block& block) {
  bool result = false;
  ir::visit(
      block, [](const ir::Expr&) {},
      [&](const ir::Stmt& statement) {
        result = result || statement.kind == ir::StmtKind::kReturn ||
                 statement.kind == ir::StmtKind::kIgnoreHit ||
                 statement.kind == ir::StmtKind::kAcceptHitAndEndSearch;
      });
  return result;
}

void BodyRules::check_divisor(ir::BinaryOp op, const ir::Expr* right, SourceLocation location) {
  const bool divides = op == ir::BinaryOp::kDivide || op == ir::BinaryOp::kModulo;
  if (!divides || is_floating(right->type->scalar)) return;
  const auto bits = evaluate(right);
  if (bits && std::find(bits->begin(), bits->end(), 0u) != bits->end()) {
    report(CheckId::kConstantDivision, location);
  }
}

}  // namespace kaamos::hlsl
