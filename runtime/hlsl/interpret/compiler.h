// SPDX-License-Identifier: MIT
//
// The pass that turns functions of a module into Code: numbers variables and temporaries, picks how
// each expression evaluates.
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
  // interpret_compile.cpp
  void place_globals();
  void function(const ir::Function& function);
  EntryCode entry(const ir::EntryPoint& entry);
  Actions block(const ir::Block& body);
  const Action* action(const ir::Stmt& stmt);
  uint32_t declare(const ir::Variable* variable, bool reference);
  // Room for a value behind `end`, which moves; its offset.
  uint32_t place(Extent extent, uint32_t& end);
  // With bytes 0 and an error where the type is too large.
  Extent extent_of(const ir::Type* type);
  uint32_t bytes_of(const ir::Type* type) { return extent_of(type).bytes; }
  std::vector<Move> moves_of(const ir::Type* type, ir::Layout layout, bool row_major);

  // interpret_compile_expressions.cpp
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
  std::unordered_set<const ir::Variable*> statics_;  // that the function touches
};

}  // namespace kaamos::hlsl::interpret
