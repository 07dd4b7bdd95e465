// SPDX-License-Identifier: MIT
//
// The body that is being lowered: where statements go, and what surrounds them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/check/names/names.h"
#include "runtime/hlsl/check/names/symbols.h"

namespace kaamos::hlsl {

struct Body {
  explicit Body(IrBuilder& build) : build_(build) {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  void emit(const ir::Stmt* statement);
  const ir::Variable* temporary(const ir::Expr* value, size_t* position = nullptr);
  ir::Variable* empty_temporary(const ir::Type* type);
  // Returns the value itself if it is cheap enough to repeat, else a read of a temporary that holds
  // it.
  const ir::Expr* repeatable(const ir::Expr* value);
  void assign(const ir::Variable* variable, const ir::Expr* value);

  FunctionInfo* function = nullptr;  // null outside any
  ir::Block* block = &no_block_;
  Scope* scope = nullptr;
  const ir::Variable* this_variable = nullptr;
  uint64_t effects = 0;  // statements so far that are no declarations
  int loop_depth = 0;
  int switch_depth = 0;
  int dead_depth = 0;  // branches around that a constant condition never takes
  bool result_unused = false;
  // The variable that receives the last kCall's result, until a variable of the source replaces it.
  ir::Variable* call_result = nullptr;

 private:
  ir::Block no_block_;  // takes what is lowered outside any body
  IrBuilder& build_;
};

class Lowerer;

// Swaps the state that a body is lowered into, and restores it when it goes out of scope.
class BodyScope {
 public:
  BodyScope(Lowerer& lowerer, FunctionInfo* function, ir::Block* block, Scope* scope);
  ~BodyScope();
  BodyScope(const BodyScope&) = delete;
  BodyScope& operator=(const BodyScope&) = delete;

 private:
  Body& body_;
  Names& names_;
  IrBuilder& build_;
  FunctionInfo* function_;
  ir::Block* block_;
  Scope* scope_;
  const ir::Variable* this_;
  int loops_;
  int switches_;
  int dead_;
  bool unused_;
  ir::Location location_;
  Names::View view_;
};

}  // namespace kaamos::hlsl
