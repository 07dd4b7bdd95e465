// SPDX-License-Identifier: MIT
//
// Prints functions that run several threads at once (wide_plan.h), next to the scalar functions of
// CppEmitter, from which it takes names and the text of uniform expressions: wide.cpp (structs,
// functions, entry points), wide_statements.cpp, wide_expressions.cpp.
//
// In emitted code, a varying value of type T has T's wide type (wide.h); a uniform value has the
// same type as in scalar code. Each function has a mask of the threads that it runs for, which is
// never empty. Under a varying condition, a copy of the mask is narrowed; where lanes join again,
// their masks are united.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "runtime/hlsl/analysis/wide_plan.h"
#include "runtime/hlsl/cpp/emitter.h"

namespace kaamos::hlsl {

class WideEmitter {
 public:
  explicit WideEmitter(CppEmitter& scalar) : out_(scalar) {}

  // Call for each entry point before anything is emitted.
  void plan(const ir::EntryPoint& entry);
  bool any() const;
  // Emits, in namespace u, the functions of the entry points and what they depend on.
  void emit_declarations();
  // Emits the group function of a compute shader that runs wide, or with wave operations its lanes
  // function; returns false if it does not.
  bool emit_group(size_t index);
  // The same for the row function of a ray generation shader.
  bool emit_row(size_t index);
  // The same for the function of a vertex or pixel shader (graphics.cpp).
  bool emit_graphics(size_t index);

 private:
  // wide.cpp
  std::string type(const ir::Type* type);
  void emit_structs();
  void emit_context();
  void emit_function(const WideFunction& function);
  void emit_signature(const WideFunction& function);
  void emit_reachable(const WideFunction& function);
  std::string entry_argument(const ir::EntryPoint& entry, size_t parameter);
  void emit_static_initialisers(const ir::Function& function);

  // wide_statements.cpp
  void block(const ir::Block& body);  // in the current scope
  void scope(const ir::Block& body);  // in braces, with a label for threads that leave it early
  void statement(const ir::Stmt& stmt);
  void declare(const ir::Stmt& stmt);
  void assign(const ir::Stmt& stmt);
  void write(const ir::Expr* place, const std::string& value, bool blends);
  void write_lanes(const ir::Expr* place, const std::string& value);
  void store(const ir::Stmt& stmt);
  void typed_store(const ir::Stmt& stmt);
  void atomic(const ir::Stmt& stmt);
  void trace_ray(const ir::Stmt& stmt);
  void call_function(const ir::Stmt& stmt, bool declares_result);
  void if_(const ir::Stmt& stmt);
  void masked_if(const ir::Stmt& stmt);
  bool masked_leave(const ir::Stmt& stmt);
  void loop(const ir::Stmt& stmt);
  void loop_body(const ir::Stmt& stmt, const std::string& mask);
  void switch_(const ir::Stmt& stmt);
  void masked_switch(const ir::Stmt& stmt);
  void masked_jump(const ir::Stmt& stmt);
  void wave(const ir::Stmt& stmt);
  void return_(const ir::Stmt& stmt);
  std::string declare_mask(const std::string& value);
  void declare_texel_row(const ir::Variable* variable, const ir::Expr* value);

  // wide_expressions.cpp
  std::string value(const ir::Expr* expr);  // wide, even for a uniform expression
  std::string varying(const ir::Expr& expr);
  std::string place(const ir::Expr* expr);
  std::string call(std::string_view function, const std::vector<const ir::Expr*>& arguments);
  std::string intrinsic(const ir::Expr& expr);
  std::string element(const ir::Expr& expr);
  std::string construct(const ir::Expr& expr);
  std::string conditional(const ir::Expr& expr);
  std::string logical(const ir::Expr& expr);
  std::string load(const ir::Expr& expr);
  std::string typed_load(const ir::Expr& expr);
  // In the form that the prelude's load_texels and store_texels take. [wide_memory.h: TexelRow]
  std::string texel_coordinates(const ir::Expr* at);
  std::string texel_row(const ir::Expr* at);
  bool has_texel_row(const ir::Variable* variable) const;
  std::string sample(const ir::Expr& expr);
  std::string dimensions(const ir::Expr& expr);
  // `[&](const ks::lanes& name) { return text; }`, where the text runs under that mask.
  std::string under_mask(const std::function<std::string()>& text);
  // Operands of an access that is done lane by lane: the captures of its lambda, and the text by
  // which one lane refers to each operand.
  struct LaneOperands {
    std::string captures;
    std::unordered_map<const ir::Expr*, std::string> text;
  };
  void add_operand(LaneOperands& operands, const ir::Expr* expr);
  std::string buffer_view(LaneOperands& operands, const std::vector<const ir::Expr*>& accessed,
                          bool element);
  std::string gather(const ir::Expr& expr, const LaneOperands& operands, const std::string& text);
  // The name of a field in a wide struct, which also has members of its own.
  std::string field(const ir::Expr& expr);

  bool is_varying(const ir::Expr* expr) const { return current_->is_varying(expr); }
  const WideFacts& facts(const ir::Stmt& stmt) const { return current_->facts.at(&stmt); }
  void line(std::string_view text) { out_.line(text); }
  void open(std::string_view text) { out_.open(text); }
  void close(std::string_view text) { out_.close(text); }

  CppEmitter& out_;
  WidePlan plan_;
  std::vector<const WideFunction*> entries_;  // by entry point; null: scalar
  bool has_rows_ = false;                     // whether ray generation shaders are among them
  std::unordered_map<const WideFunction*, std::string> names_;
  std::unordered_map<const ir::Struct*, std::string> struct_names_;
  std::unordered_set<const WideFunction*> emitted_;
  std::unordered_map<const ir::Variable*, std::string> texel_rows_;  // names, in this function

  const WideFunction* current_ = nullptr;
  std::string mask_;       // mask that the statement runs under
  std::string restarted_;  // mask of the threads that continue the innermost loop
  std::string gone_;       // mask of the threads that have returned; empty: none do
  std::string result_;     // what they returned
  int skip_label_ = 0;     // number of the label after the innermost scope
  bool skip_used_ = false;
  std::vector<int> loops_;  // labels that `continue` jumps to when all threads do
};

}  // namespace kaamos::hlsl
