// SPDX-License-Identifier: MIT
//
// The C++ emitter's state, shared by its files: types.cpp (types, literals, memory access of
// structs), expressions.cpp, statements.cpp, emit_cpp.cpp (functions, entry points, tables),
// groups.cpp (compute shaders with barriers), graphics.cpp (vertex and pixel shaders), waves.cpp.
// WideEmitter emits those that run several threads at once.
//
// The emitted unit has the prelude as namespace `ks` and everything that belongs to the library in
// namespace `u`: structs, constants, `u::Context` (one per shader invocation, with the ABI's
// Invocation, static globals and how the shader ended), functions that take a Context, then entry
// functions of the ABI's types and the tables.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "runtime/hlsl/analysis/split_groups.h"
#include "runtime/hlsl/analysis/wave_paths.h"
#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/ir/emitted_names.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct ReachedCalls;
class WideEmitter;

// "0, 2": the components of a swizzle.
std::string component_list(const std::vector<uint8_t>& components);
// The text behind the subscript of a matrix's row, which is a vector even if the IR has a scalar
// there.
inline std::string behind_row(const ir::Type* indexed) {
  const bool has_one_column = indexed->kind == ir::TypeKind::kMatrix && indexed->columns == 1;
  return has_one_column ? "[0]" : "";
}

class CppEmitter {
 public:
  CppEmitter(const ir::Module& module, const EmitCppOptions& options);
  std::string run();

 private:
  friend class WideEmitter;  // prints into the same unit

  void emit_unoptimised();
  void include_experimental();

  // types.cpp
  std::string type(const ir::Type* type);
  void emit_structs();
  void emit_memory_functions();
  std::string memory_read(const ir::Type* type, ir::Layout layout, bool row_major,
                          const std::string& view, const std::string& offset);
  std::string memory_write(const ir::Type* type, ir::Layout layout, bool row_major,
                           const std::string& view, const std::string& offset,
                           const std::string& text);
  static uint64_t bytes_in_place(const ir::Type* type, ir::Layout layout);
  std::string read_function(const ir::Type* structure, ir::Layout layout);
  // Approximate bytes that C++ needs to store a value of the type; close enough for stack sizes.
  uint32_t stack_bytes(const ir::Type* type) const;

  // expressions.cpp
  std::string value(const ir::Expr* expr);
  std::string place(const ir::Expr* expr);  // an lvalue, valid to the left of "="
  std::string literal(const ir::Expr& expr);
  std::string scalar_literal(ir::Scalar scalar, uint64_t bits);
  std::string construct(const ir::Expr& expr);
  std::string unary(const ir::Expr& expr);
  std::string binary(const ir::Expr& expr);
  std::string element(const ir::Expr& expr, bool as_place);
  std::string system_value(const ir::Expr& expr);
  std::string query_value(const ir::Expr& expr);
  std::string binding(const ir::Expr& expr);
  bool is_bound(const ir::Expr& expr) const;
  // Returns whether the binding was looked up beforehand, for a group or for all invocations of a
  // ray shader.
  bool is_looked_up(const ir::Expr& resource) const;
  // `element` is the index into a structured buffer; null for raw and constant buffers. `text`
  // prints the index, and the buffer unless that was looked up.
  using TextOf = std::function<std::string(const ir::Expr*)>;
  std::string buffer_view(const ir::Expr& buffer, const ir::Expr* element, const TextOf& text);
  std::string bound(const ir::Expr& expr);
  std::string texture(const ir::Expr* expr);  // operand of a texel load or store
  std::string load(const ir::Expr& expr);
  // The resource operand of a memory access, wrapped in the check in a checked library; with
  // `result` "_view", it is what is read or written. `element` is null for raw and constant
  // buffers. write: 0 read, 1 write, 2 atomic.
  std::string accessed(const char* result, const ir::Expr* resource, const ir::Expr* element,
                       const ir::Expr* offset, const ir::Type* type, ir::Layout layout,
                       bool row_major, int write, const ir::Location& location);
  // CheckReport::site for the expression, or else for the statement that is being printed.
  std::string site(const ir::Location& location) const;
  std::string typed_load(const ir::Expr& expr);
  // The same for operands that the caller prints.
  std::string sample_text(const ir::Expr& expr, const TextOf& text);
  std::string call(std::string_view function, const std::vector<const ir::Expr*>& arguments);
  std::string variable(const ir::Variable* variable);
  // Texel coordinates in the form that the ABI takes: {x, y, z or array element, mip}.
  std::string texel_coordinates(const ir::Type* resource, const ir::Expr* coordinates,
                                const ir::Expr* mip, const ir::Expr* offset);
  std::string texel_coordinates_text(const ir::Type* resource, const std::string& coordinates,
                                     const std::string& mip, const std::string& offset);

  // statements.cpp
  void block(const ir::Block& body);
  void statement(const ir::Stmt& stmt);
  void begin_statement(const ir::Stmt& stmt);
  const std::string& name_local(const ir::Variable* variable);  // called where it is declared
  void declare(const ir::Stmt& stmt);
  bool declare_in_place(const ir::Stmt& stmt);
  void assign(const ir::Expr* target, const std::string& value);
  void store(const ir::Stmt& stmt);
  std::string atomic_text(const ir::Stmt& stmt, const TextOf& text);
  void call_function(const ir::Stmt& stmt, bool declares_result);
  void invoke(const ir::Stmt& stmt);
  void trace_ray(const ir::Stmt& stmt);
  void report_hit(const ir::Stmt& stmt);
  void query(const ir::Stmt& stmt);
  void loop(const ir::Stmt& stmt);
  void switch_(const ir::Stmt& stmt);
  void payload_check(const ir::EntryPoint& entry);
  void end_shader();  // returns from the function with any value

  // waves.cpp
  // The number of words of the path, counted from its start, that come before the statement's,
  // plus `more`.
  std::string wave_depth(const ir::Stmt& stmt, uint32_t more) const;
  void enter_wave_path(const ir::Stmt& stmt);
  // Nothing for calls and loops that reach no wave operation.
  void enter_wave_call(const ir::Stmt& stmt);
  void leave_wave_call(const ir::Stmt& stmt);
  void enter_wave_loop(const ir::Stmt& stmt);
  void begin_wave_iteration(const ir::Stmt& stmt);
  std::string wave_operation(const ir::Stmt& stmt) const;
  void wave(const ir::Stmt& stmt);
  // The text that follows `thread` in a ComputeDesc.
  static std::string wave_facts(const ir::EntryPoint& entry, const std::string& lanes = "nullptr");

  // emit_cpp.cpp
  void emit_constants();
  void emit_context();
  void emit_functions();
  void emit_signature(const ir::Function& function);
  void emit_function(const ir::Function& function);
  void emit_entry(size_t index);
  bool emit_row(size_t index);  // ExportDesc::row; false if there is none
  void emit_bound(const ir::EntryPoint& entry);
  void emit_compute_entry(size_t index);
  void emit_static_initialisers(const ir::Function& function);
  void emit_calls(size_t index, const ReachedCalls& calls);
  std::string emit_list(const std::string& name, const std::vector<uint32_t>& list);
  void emit_unlinked(const ir::EntryPoint& e, const std::string& bindings,
                     const std::string& imports);
  void emit_tables();
  void emit_coverage();
  std::string entry_argument(const ir::EntryPoint& entry, size_t parameter);
  std::string entry_arguments(const ir::EntryPoint& entry);
  void collect_parameters_by_reference();
  void collect_static_use();
  void look_up_once(const ir::Function& function);

  // graphics.cpp: vertex and pixel shaders
  void emit_signature_elements(const std::string& name,
                               const std::vector<ir::SignatureElement>& elements);
  void emit_graphics_desc(size_t index, const std::string& functions);
  void emit_graphics_lane(const ir::EntryPoint& entry);
  void emit_graphics_entry(size_t index);
  void emit_geometry_entry(size_t index);

  // groups.cpp: compute shaders that are cut at their barriers
  bool emit_split_group(size_t index);  // false: it must run on fibers
  void emit_group_body(const ir::EntryPoint& entry, const GroupPlan& plan);
  void emit_group_variables(const ir::EntryPoint& entry, const GroupPlan& plan);
  void emit_piece_start(const ir::EntryPoint& entry);
  void emit_piece_end();
  void emit_first_piece(const ir::EntryPoint& entry, const GroupPlan& plan);
  void emit_threads(const ir::EntryPoint& entry, const GroupPlan& plan, const Region& region);
  void emit_regions(const ir::EntryPoint& entry, const GroupPlan& plan,
                    const std::vector<Region>& regions);
  void emit_region_loop(const ir::EntryPoint& entry, const GroupPlan& plan, const Region& region);
  uint64_t kept_bytes(const ir::EntryPoint& entry, const GroupPlan& plan) const;

  // The output.
  void line(std::string_view text) {
    out_.append(static_cast<size_t>(indent_) * 2, ' ');
    out_ += text;
    out_ += '\n';
  }
  void open(std::string_view text) {
    line(text);
    ++indent_;
  }
  void close(std::string_view text) {
    --indent_;
    line(text);
  }
  void at(const ir::Location& location);
  void at_generated();

  const ir::Module& module_;
  const EmitCppOptions& options_;
  WavePaths wave_paths_;
  uint32_t wave_words_ = 0;       // of the longest path
  bool has_geometry_ = false;     // any geometry shader
  bool binds_per_group_ = false;  // compute shaders only: bound.h
  bool reads_bound_ = false;      // Invocation::bound
  std::vector<bool> has_row_;     // by entry point: ExportDesc::row
  // The indices in `bound` at which the elements of each array start, after everything that is not
  // an array; 0 if they are not there.
  std::vector<uint32_t> bound_elements_;
  uint32_t bound_count_ = 0;
  std::string out_;
  int indent_ = 0;

  NameSet global_names_;  // namespace u
  std::unordered_map<const ir::Struct*, std::string> struct_names_;
  std::unordered_map<const ir::Struct*, std::vector<std::string>> field_names_;
  std::unordered_map<const ir::Function*, std::string> function_names_;
  std::unordered_map<const ir::Variable*, std::string> variable_names_;
  ScopedNames local_names_;
  // Static globals that a function and everything it calls can touch, in the module's order.
  std::unordered_map<const ir::Function*, std::unordered_set<const ir::Variable*>> statics_;
  std::unordered_map<const ir::Function*, uint32_t> stack_;
  std::unordered_set<const ir::Function*> hit_kind_readers_;  // and their callers
  // By binding: what the running function has looked up once for all its uses.
  std::unordered_map<uint32_t, std::string> resources_found_;  // ks::Descriptor
  std::unordered_map<uint32_t, std::string> views_found_;      // ks::MemoryView
  // Parameters of several words that no statement writes; they are passed by reference.
  std::unordered_set<const ir::Variable*> by_reference_;
  const ir::Function* current_ = nullptr;
  ir::Location statement_location_;
  // The enclosing loops, innermost last: the number of the label that `continue` jumps to.
  std::vector<int> loops_;
  std::unordered_set<int> used_labels_;
  int next_label_ = 0;
  // While a split group is emitted: the variables that are declared outside its pieces, and what
  // `return` turns into.
  std::unordered_set<const ir::Variable*> placed_;
  std::string return_text_ = "return;";
};

// Returns whether the statements i and i + 1 are `T x;` and `x = f();`.
bool begins_with_call(const ir::Block& body, size_t i);
// Returns whether KAAMOS_UNROLL applies to this loop.
bool is_unrolled(const ir::Stmt& loop);
// The C++ name in code that sees the prelude as `ks`: "int32_t", "ks::half".
const char* scalar_name(ir::Scalar scalar);
// Quoted for C and C++.
std::string quote(std::string_view text);
// The array `source`, with the text that the library carries.
std::string source_table(const ir::Module& module);

}  // namespace kaamos::hlsl
