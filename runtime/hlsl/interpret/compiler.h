// SPDX-License-Identifier: MIT
//
// The pass that turns a module's functions into Code: it numbers variables and temporaries, and
// picks how each expression is evaluated.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "runtime/hlsl/interpret/program.h"

namespace kaamos::hlsl::interpret {

class Compiler {
 public:
  explicit Compiler(Program& program) : program_(program) {}
  void run();

 private:
  // compile.cpp
  void place_globals();
  void function(const ir::Function& function);
  EntryCode entry(const ir::EntryPoint& entry);
  Actions block(const ir::Block& body);
  const Action* action(const ir::Stmt& stmt);
  uint32_t declare(const ir::Variable* variable, bool reference);
  // Reserves room for a value at `end`, advances `end`, and returns the value's offset.
  uint32_t place(Extent extent, uint32_t& end);
  // Returns an extent with bytes 0 and sets the error if the type is too large.
  Extent extent_of(const ir::Type* type);
  uint32_t bytes_of(const ir::Type* type) { return extent_of(type).bytes; }
  std::vector<Move> moves_of(const ir::Type* type, ir::Layout layout, bool row_major);

  // compile_expressions.cpp
  const Node* node(const ir::Expr* expr);
  Node* variable_node(const ir::Variable* variable, const ir::Expr* expr);
  void compile(Node& node);
  void literal(Node& node);
  void element(Node& node);
  void swizzle(Node& node, const ir::Type* base);
  void construct(Node& node);
  void kernel(Node& node, Kernel found);
  void intrinsic(Node& node);
  void gather(Node& node, std::vector<uint8_t> components);
  void in_slot(Node& node, Evaluate evaluate);
  void need_zeros(uint32_t bytes);

  struct Place {
    uint32_t offset = 0;
    bool reference = false;
    const std::byte* data = nullptr;  // constants
  };

  Program& program_;
  std::unordered_map<const ir::Variable*, Place> places_;
  std::unordered_map<const ir::Function*, const Code*> codes_;
  uint32_t variable_bytes_ = 0;                      // of the function so far
  uint32_t temporary_bytes_ = 0;                     // of the statement so far
  uint32_t most_temporary_bytes_ = 0;                // of any statement of the function
  uint32_t callee_stack_bytes_ = 0;                  // of the function so far
  bool reads_hit_kind_ = false;                      // the function so far
  std::unordered_set<const ir::Variable*> statics_;  // touched by the function
};

}  // namespace kaamos::hlsl::interpret
