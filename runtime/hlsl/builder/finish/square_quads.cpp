// SPDX-License-Identifier: MIT
#include "runtime/hlsl/builder/finish/square_quads.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace kaamos::hlsl {
namespace {

using ir::BinaryOp;
using ir::EntryParameter;

// The ids of one thread, from its place among the lanes of its group.
class ThreadIds {
 public:
  ThreadIds(IrBuilder& build, const uint32_t (&size)[3], ir::Function& wrapper,
            std::vector<EntryParameter>& parameters)
      : build_(build), size_(size), wrapper_(wrapper), parameters_(parameters) {
    const ir::Variable* lane = parameter("lane", 1, EntryParameter::kGroupIndex);
    thread_ = declare("thread", three(), place_of(build_.read(lane)));
  }

  const ir::Expr* value(EntryParameter which) {
    switch (which) {
      case EntryParameter::kDispatchThreadId: {
        const ir::Expr* size = build_.literal(three(), {size_[0], size_[1], size_[2]});
        return build_.binary(BinaryOp::kAdd, build_.binary(BinaryOp::kMultiply, group(), size),
                             build_.read(thread_));
      }
      case EntryParameter::kGroupId:
        return group();
      case EntryParameter::kGroupIndex: {
        const ir::Expr* thread = build_.read(thread_);
        const auto part = [&](uint8_t axis) { return build_.swizzle(thread, {axis}); };
        return build_.add_scaled(part(0), build_.add_scaled(part(1), part(2), size_[1]), size_[0]);
      }
      default:
        return build_.read(thread_);
    }
  }

 private:
  const ir::Type* three() { return build_.vector_type(Scalar::kUint32, 3); }

  const ir::Variable* parameter(std::string name, uint32_t size, EntryParameter source) {
    ir::Variable* variable = build_.variable(
        std::move(name), build_.vector_type(Scalar::kUint32, size), ir::Storage::kParameter);
    wrapper_.parameters.push_back(variable);
    parameters_.push_back(source);
    return variable;
  }

  const ir::Variable* declare(std::string name, const ir::Type* type, const ir::Expr* value) {
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kDeclare);
    statement->variable = build_.variable(std::move(name), type, ir::Storage::kLocal);
    statement->value = value;
    wrapper_.body.push_back(statement);
    return statement->variable;
  }

  // Quads follow each other along X, then Y, then Z, and each has its upper left, upper right,
  // lower left and lower right thread.
  const ir::Expr* place_of(const ir::Expr* lane) {
    const auto number = [&](BinaryOp op, const ir::Expr* left, uint32_t right) {
      return build_.binary(op, left, build_.uint32(right));
    };
    const ir::Type* scalar = build_.scalar_type(Scalar::kUint32);
    const ir::Expr* quad =
        build_.read(declare("quad", scalar, number(BinaryOp::kShiftRight, lane, 2)));
    const ir::Expr* row =
        build_.read(declare("row", scalar, number(BinaryOp::kDivide, quad, size_[0] / 2)));
    const ir::Expr* x = number(BinaryOp::kModulo, quad, size_[0] / 2);
    const ir::Expr* y = number(BinaryOp::kModulo, row, size_[1] / 2);
    const ir::Expr* in_x = number(BinaryOp::kBitAnd, lane, 1);
    const ir::Expr* in_y = number(BinaryOp::kBitAnd, number(BinaryOp::kShiftRight, lane, 1), 1);
    return build_.construct(three(), {build_.add_scaled(in_x, x, 2), build_.add_scaled(in_y, y, 2),
                                      number(BinaryOp::kDivide, row, size_[1] / 2)});
  }

  const ir::Expr* group() {
    if (!group_) group_ = parameter("group", 3, EntryParameter::kGroupId);
    return build_.read(group_);
  }

  IrBuilder& build_;
  const uint32_t (&size_)[3];
  ir::Function& wrapper_;
  std::vector<EntryParameter>& parameters_;
  const ir::Variable* thread_ = nullptr;
  const ir::Variable* group_ = nullptr;
};

}  // namespace

bool reads_quads(const FunctionFacts& function) {
  return !function.quads.empty() || !function.implicit_levels.empty() ||
         std::any_of(function.waves.begin(), function.waves.end(),
                     [](const ir::Stmt* wave) { return shader::is_quad_operation(wave->wave); });
}

bool has_square_quads(const ir::EntryPoint& entry) {
  return entry.stage == ir::kStageCompute && entry.thread_group[0] % 2 == 0 &&
         entry.thread_group[1] % 2 == 0;
}

bool has_quads(const ir::EntryPoint& entry) {
  const bool in_row =
      entry.thread_group[0] % 4 == 0 && entry.thread_group[1] == 1 && entry.thread_group[2] == 1;
  return entry.stage == ir::kStageCompute && (in_row || has_square_quads(entry));
}

void make_quads_square(ir::Module& module, IrBuilder& build, ir::EntryPoint& entry) {
  const ir::Function& inner = *entry.function;
  build.location = inner.location;
  ir::Function* wrapper = make_wrapper(module, build, inner);
  wrapper->mangled = inner.mangled + "#quads";
  wrapper->stages = ir::kStageCompute;
  wrapper->uses_query = inner.uses_query;
  wrapper->has_barrier = inner.has_barrier;
  wrapper->has_waves = inner.has_waves;
  std::vector<EntryParameter> parameters;
  ThreadIds ids(build, entry.thread_group, *wrapper, parameters);
  ir::Stmt* call = build.stmt(ir::StmtKind::kCall);
  call->function = &inner;
  for (const EntryParameter parameter : entry.parameters) {
    call->arguments.push_back(ids.value(parameter));
  }
  wrapper->body.push_back(call);
  entry.function = wrapper;
  entry.parameters = std::move(parameters);
  module.functions.push_back(wrapper);
}

}  // namespace kaamos::hlsl
