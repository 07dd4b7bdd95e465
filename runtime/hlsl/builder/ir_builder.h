// SPDX-License-Identifier: MIT
//
// Makes nodes of the intermediate representation and folds constants on the way.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "runtime/hlsl/builder/ir_types.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

class IrBuilder {
 public:
  IrBuilder(ir::Module& module, IrTypes& types) : module_(module), types_(types) {}

  // Given to every node from now on.
  ir::Location location;

  ir::Expr* expr(ir::ExprKind kind, const ir::Type* type,
                 std::initializer_list<const ir::Expr*> operands = {});
  ir::Stmt* stmt(ir::StmtKind kind);
  ir::Variable* variable(std::string name, const ir::Type* type, ir::Storage storage);

  const ir::Expr* literal(const ir::Type* type, std::vector<uint64_t> values);
  const ir::Expr* uint32(uint64_t value);
  const ir::Expr* int32(int64_t value);
  const ir::Expr* boolean(bool value);
  const ir::Expr* zero(const ir::Type* type);
  const ir::Expr* read(const ir::Variable* variable);
  const ir::Expr* field(const ir::Expr* base, uint32_t index);
  const ir::Expr* element(const ir::Expr* base, const ir::Expr* index);
  // A single component gives a scalar.
  const ir::Expr* swizzle(const ir::Expr* base, std::vector<uint8_t> components);
  const ir::Expr* matrix_swizzle(const ir::Expr* base, std::vector<uint8_t> components);
  const ir::Expr* convert(const ir::Expr* operand, Scalar scalar);
  const ir::Expr* splat(const ir::Expr* operand, const ir::Type* type);
  const ir::Expr* truncate(const ir::Expr* operand, const ir::Type* type);
  const ir::Expr* construct(const ir::Type* type, std::vector<const ir::Expr*> parts);
  const ir::Expr* unary(ir::UnaryOp op, const ir::Expr* operand);
  const ir::Expr* binary(ir::BinaryOp op, const ir::Expr* left, const ir::Expr* right);
  const ir::Expr* conditional(const ir::Expr* condition, const ir::Expr* yes, const ir::Expr* no);
  const ir::Expr* intrinsic(Intrinsic which, const ir::Type* type,
                            std::vector<const ir::Expr*> operands);
  // base + index * scale + constant on uint32 byte offsets.
  const ir::Expr* add(const ir::Expr* base, uint32_t constant);
  const ir::Expr* add_scaled(const ir::Expr* base, const ir::Expr* index, uint32_t scale);

  IrTypes& types() { return types_; }
  const ir::Type* scalar_type(Scalar scalar) { return types_.scalar(scalar); }
  const ir::Type* vector_type(Scalar scalar, size_t size) {
    return types_.vector(scalar, static_cast<uint32_t>(size));
  }

 private:
  const ir::Expr* fold(const ir::Expr* expression);

  ir::Module& module_;
  IrTypes& types_;
  uint32_t next_variable_ = 0;
};

// An empty function that stands for `wrapped` as an entry point: it has no parameters, result or
// body yet.
ir::Function* make_wrapper(ir::Module& module, IrBuilder& build, const ir::Function& wrapped);

}  // namespace kaamos::hlsl
