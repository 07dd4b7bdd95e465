// SPDX-License-Identifier: MIT
//
// Prints functions that run several threads at once (wide_plan.h), beside the scalar ones of
// CppEmitter, whose names and text of uniform expressions it uses: emit_wide.cpp (structs,
// functions, entry points), emit_wide_statements.cpp, emit_wide_expressions.cpp.
//
// In emitted code a varying value of type T is of T's wide type (wide.h), a uniform one is as in
// scalar code. Each function has a mask of the threads it runs for, which is never empty. Under a
// varying condition a copy of the mask is narrowed; where lanes join again, masks are united.
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

  // For each entry point, before all else.
  void plan(const ir::EntryPoint& entry);
  bool any() const;
  // In namespace u: what the functions of the entry points stand on, then these.
  void emit_declarations();
  // The group's function of a compute shader that runs wide; false where it does not.
  bool emit_group(size_t index);
  // The same of a row of a ray generation shader.
  bool emit_row(size_t index);

 private:
  // emit_wide.cpp
  std::string type(const ir::Type* type);
  void emit_structs();
  void emit_context();
  void emit_function(const WideFunction& function);
  void emit_signature(const WideFunction& function);
  void emit_reachable(const WideFunction& function);
  std::string entry_argument(const ir::EntryPoint& entry, size_t parameter);
  void emit_static_initialisers(const ir::Function& function);

  // emit_wide_statements.cpp
  void block(const ir::Block& body);  // in the scope that stands
  void scope(const ir::Block& body);  // in braces, and where those go that leave it early
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
  void return_(const ir::Stmt& stmt);
  std::string declare_mask(const std::string& value);
  void declare_texel_row(const ir::Variable* variable, const ir::Expr* value);

  // emit_wide_expressions.cpp
  std::string value(const ir::Expr* expr);  // wide, of a uniform expression too
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
  // As the prelude's load_texels and store_texels take them. [wide_memory.h: TexelRow]
  std::string texel_coordinates(const ir::Expr* at);
  std::string texel_row(const ir::Expr* at);
  bool has_texel_row(const ir::Variable* variable) const;
  std::string sample(const ir::Expr& expr);
  std::string dimensions(const ir::Expr& expr);
  // `[&](const ks::lanes& name) { return text; }` with the text under that mask.
  std::string under_mask(const std::function<std::string()>& text);
  // Operands of an access that is done lane by lane: each as a capture of a lambda, and as what
  // one lane has of it.
  struct LaneOperands {
    std::string captures;
    std::unordered_map<const ir::Expr*, std::string> text;
  };
  void add_operand(LaneOperands& operands, const ir::Expr* expr);
  std::string buffer_view(LaneOperands& operands, const std::vector<const ir::Expr*>& accessed,
                          bool element);
  std::string gather(const ir::Expr& expr, const LaneOperands& operands, const std::string& text);
  // Name of a member of a wide struct, which also has members of its own.
  std::string field(const ir::Expr& expr);

  bool is_varying(const ir::Expr* expr) const { return current_->is_varying(expr); }
  const WideFacts& facts(const ir::Stmt& stmt) const { return current_->facts.at(&stmt); }
  void line(std::string_view text) { out_.line(text); }
  void open(std::string_view text) { out_.open(text); }
  void close(std::string_view text) { out_.close(text); }

  CppEmitter& out_;
  WidePlan plan_;
  std::vector<const WideFunction*> entries_;  // by entry point; null: scalar
  bool has_rows_ = false;                     // ray generation shaders among them
  std::unordered_map<const WideFunction*, std::string> names_;
  std::unordered_map<const ir::Struct*, std::string> struct_names_;
  std::unordered_set<const WideFunction*> emitted_;
  std::unordered_map<const ir::Variable*, std::string> texel_rows_;  // names, in this function

  const WideFunction* current_ = nullptr;
  std::string mask_;       // name of the mask that the statement runs under
  std::string restarted_;  // of the innermost loop: name of the mask of those that continue
  std::string gone_;       // name of the mask of those that have returned; empty: none do
  std::string result_;     // name of what they returned
  int skip_label_ = 0;     // number of the label behind the innermost scope
  bool skip_used_ = false;
  std::vector<int> loops_;  // numbers of the labels that `continue` of all threads jumps to
};

}  // namespace kaamos::hlsl
