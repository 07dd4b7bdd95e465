// SPDX-License-Identifier: MIT
//
// Statements.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Statements : LowerPart {
 public:
  using LowerPart::LowerPart;

  void lower_block(std::span<const Stmt* const> statements);
  void lower_discarded(const Expr* expression);
  static bool ends(const ir::Block& block);

 private:
  void lower_statement(const Stmt* statement);
  void lower_body(const Stmt* statement, ir::Block& target);
  void lower_loop_head(const Stmt* init);
  void lower_if(const IfStmt* statement);
  void lower_loop(const Expr* condition, const Expr* step, const Stmt* body, bool test_at_end,
                  const Stmt& statement);
  void lower_switch(const SwitchStmt* statement);
  void share_section_variables(ir::Stmt* node);
  void lower_return(const ReturnStmt* statement);
  std::optional<uint32_t> most_turns(const Stmt& loop);
};

}  // namespace kaamos::hlsl
