// SPDX-License-Identifier: MIT
// Helpers run the operation among themselves, so that
//   for (;;) if (WaveReadLaneFirst(x) == x) break;
// ends in them too. What is the same in all lanes they get from a lane that is not a helper, if
// there is one: then whole quads stay together in conditions and loops on it, and derivatives there
// are right.
#include "runtime/hlsl/builder/finish/pixel_waves.h"

namespace kaamos::hlsl {

using shader::WaveOp;

namespace {

// Whether all lanes get the same, or usually do.
bool is_same_in_all_lanes(WaveOp op) {
  switch (op) {
    case WaveOp::kAnyTrue:
    case WaveOp::kAllTrue:
    case WaveOp::kBallot:
    case WaveOp::kCountBits:
    case WaveOp::kAllEqual:
    case WaveOp::kReadLaneAt:
    case WaveOp::kReadLaneFirst:
      return true;
    default:
      return op >= WaveOp::kSum && op <= WaveOp::kBitXor;
  }
}

class PixelWave {
 public:
  PixelWave(IrBuilder& build, ir::Block& out) : build_(build), out_(out) {}

  void append(const ir::Stmt* wave, const ir::Expr* takes_part) {
    ir::Stmt* condition = build_.stmt(ir::StmtKind::kIf);
    condition->value = takes_part;
    condition->body.push_back(wave);
    condition->orelse.push_back(operation(wave->wave, wave->operands, wave->result));
    out_.push_back(condition);
    if (is_same_in_all_lanes(wave->wave)) share(wave->result, takes_part);
  }

 private:
  const ir::Stmt* operation(WaveOp op, std::vector<const ir::Expr*> operands,
                            const ir::Variable* result) {
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kWave);
    statement->wave = op;
    statement->operands = std::move(operands);
    statement->result = result;
    return statement;
  }

  const ir::Expr* value_of(WaveOp op, std::vector<const ir::Expr*> operands, const ir::Type* type) {
    ir::Stmt* declaration = build_.stmt(ir::StmtKind::kDeclare);
    declaration->variable = build_.variable({}, type, ir::Storage::kLocal);
    out_.push_back(declaration);
    out_.push_back(operation(op, std::move(operands), declaration->variable));
    return build_.read(declaration->variable);
  }

  // Reads `result` from the first lane that takes part; from the own lane if none does.
  void share(const ir::Variable* result, const ir::Expr* takes_part) {
    const ir::Type* number = build_.scalar_type(Scalar::kUint32);
    const ir::Expr* lanes =
        value_of(WaveOp::kBallot, {takes_part}, build_.vector_type(Scalar::kUint32, 4));
    const ir::Expr* lane = value_of(WaveOp::kLaneIndex, {}, number);
    for (uint8_t word = 4; word-- > 0;) {
      const ir::Expr* bits = build_.swizzle(lanes, {word});
      const ir::Expr* first =
          build_.binary(ir::BinaryOp::kAdd, build_.uint32(32u * word),
                        build_.intrinsic(Intrinsic::firstbitlow, number, {bits}));
      const ir::Expr* any = build_.binary(ir::BinaryOp::kNotEqual, bits, build_.uint32(0));
      lane = build_.conditional(any, first, lane);
    }
    const ir::Expr* shared =
        value_of(WaveOp::kReadLaneAt, {build_.read(result), lane}, result->type);
    ir::Stmt* assignment = build_.stmt(ir::StmtKind::kAssign);
    assignment->place = build_.read(result);
    assignment->value = shared;
    out_.push_back(assignment);
  }

  IrBuilder& build_;
  ir::Block& out_;
};

}  // namespace

bool leaves_out_helpers(WaveOp op) {
  return !shader::is_answered_at_once(op) && !shader::is_quad_operation(op) &&
         !shader::is_derivative(op);
}

void append_pixel_wave(IrBuilder& build, const ir::Stmt* wave, const ir::Expr* takes_part,
                       ir::Block& out) {
  PixelWave(build, out).append(wave, takes_part);
}

}  // namespace kaamos::hlsl
