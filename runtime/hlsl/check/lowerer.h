// SPDX-License-Identifier: MIT
//
// From syntax trees of bodies and expressions to IR. The lowerer asks the checker what names and
// types mean; the checker asks it for the values of constants and initialisers, and to lower what
// an entry point reaches. It is one class, split into lower_*.cpp, one file per noun.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/check/symbols.h"
#include "runtime/hlsl/check/types.h"
#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

class Checker;
using CheckId = DiagnosticId;

class Lowerer {
 public:
  explicit Lowerer(Checker& checker);

  // Swaps the state that a body is lowered into, and restores it when it goes out of scope.
  struct BodyScope;

  // -- Conversions (lower_conversions.cpp)
  ConversionRank rank(const Value& value, const Type* to);
  ConversionRank rank(const Type* from, const Type* to);
  // An explicit conversion also allows what only a cast may do.
  const ir::Expr* convert(const Value& value, const Type* to, SourceLocation location,
                          bool is_explicit = false);
  const ir::Expr* convert_numeric(const ir::Expr* expr, const Type* from, const Type* to);
  bool convertible_numeric(const Type* from, const Type* to, bool is_explicit);
  // Replaces literal types by their default types.
  Value settle(Value value);
  const Type* settled(const Type* type);
  struct Piece {
    const ir::Expr* expr;
    const Type* type;
  };
  void split(const Piece& piece, std::vector<Piece>& queue);
  const ir::Expr* take(const Type* type, std::vector<Piece>& queue, bool& failed,
                       SourceLocation location);
  const ir::Expr* build_from_pieces(const Type* type, std::vector<Piece> pieces,
                                    SourceLocation location, bool allow_extra);
  const ir::Expr* lower_init_list(const InitListExpr* list, const Type* type);
  void collect_pieces(const InitListExpr* list, std::vector<Piece>& pieces, int depth);
  const ir::Expr* as_condition(const Value& value, SourceLocation location);

  // -- Places (lower_places.cpp, lower_elements.cpp)
  Value rvalue(const ir::Expr* expr, const Type* type);
  Value place(const ir::Variable* variable, const Type* type, bool is_const);
  Value error_value();
  const ir::Expr* load(const Value& value);
  void store(const Value& target, const ir::Expr* value);
  void store_memory(const Value& target, const ir::Expr* value);
  void store_component(const Value& target, uint32_t component, const ir::Expr* value);
  Value memory(const ir::Expr* resource, const ir::Expr* element, const ir::Expr* offset,
               const Type* type, ir::Layout layout, bool is_const);
  Value field_of(const Value& base, uint32_t index, const Type* type);
  // -- Bit fields (lower_bit_fields.cpp)
  Value bit_field_of(const Value& owner, const FieldInfo& field);
  const ir::Expr* extract_bits(const ir::Expr* unit, const FieldInfo& field);
  const ir::Expr* insert_bits(const ir::Expr* unit, const FieldInfo& field, const ir::Expr* value);
  static Value unit_of(const Value& value);
  bool require_whole_field(const Value& value, SourceLocation location, std::string_view purpose);
  Value base_of(const Value& value, StructInfo* base);
  Value element_of(const Value& base, const Value& index, SourceLocation location);
  Value swizzle_of(const Value& base, std::string_view text, SourceLocation location);
  Value matrix_swizzle_of(const Value& base, std::string_view text, SourceLocation location);
  Value component_of(const Value& base, const std::vector<uint8_t>& components);
  const Type* row_type(const Type* matrix);
  Value memory_element(const Value& base, const ir::Expr* index);
  bool require_place(const Value& value, SourceLocation location, std::string_view purpose);
  void freeze(Value& value, size_t* position);
  const ir::Expr* freeze_place(const ir::Expr* expr, size_t* position);
  const ir::Expr* index_value(const Value& value, SourceLocation location);
  static bool is_fixed(const ir::Expr* expr);
  const ir::Expr* frozen(const ir::Expr* expr, size_t* position);
  static bool mentions(const ir::Expr* expr, const ir::Variable* variable);

  // -- Emission (lower_places.cpp)
  ir::Block& block() { return *block_; }
  void emit(const ir::Stmt* statement);
  const ir::Variable* temporary(const ir::Expr* value, size_t* position = nullptr);
  ir::Variable* empty_temporary(const ir::Type* type);
  // Returns the value itself if it is cheap enough to repeat, else a read of a temporary that holds
  // it.
  const ir::Expr* repeatable(const ir::Expr* value);
  void assign(const ir::Variable* variable, const ir::Expr* value);

  // -- Expressions (lower_expressions.cpp, lower_operators.cpp)
  Value lower(const Expr* expression);
  Value lower_inner(const Expr* expression);
  std::vector<Value> lower_all(std::span<const Expr* const> expressions, bool keep_places,
                               bool save_values = false);
  Value lower_name(const NameExpr* expr);
  Value symbol_value(Symbol* symbol, SourceLocation location);
  Value variable_value(VariableInfo* variable, SourceLocation location);
  Value split_value(const SplitPart& part, SourceLocation location);
  Value lower_this(SourceLocation location);
  Value lower_member(const MemberExpr* expr);
  Value member_of(const Value& base, const QualifiedName& name);
  Value lower_index(const IndexExpr* expr);
  Value index_resource(const Value& base, const Value& index, SourceLocation location);
  Value lower_unary(const UnaryExpr* expr);
  Value lower_increment(const UnaryExpr* expr, const Value& operand);
  Value lower_binary(const BinaryExpr* expr);
  Value lower_logical(const BinaryExpr* expr);
  Value binary_value(BinaryOp op, const Value& left, const Value& right, SourceLocation location);
  Value lower_assign(const AssignExpr* expr);
  Value lower_conditional(const ConditionalExpr* expr);
  Value lower_cast(const CastExpr* expr);
  Value lower_construct(const Type* type, std::span<const Expr* const> arguments,
                        SourceLocation location);
  Value lower_sizeof(const SizeofExpr* expr);
  // The common type of two operands of one numeric shape; reports an error and returns null if
  // there is none.
  const Type* common_type(const Type* a, const Type* b, SourceLocation location, bool& truncates);
  std::optional<Value> overloaded_operator(std::string_view name, const Value& left,
                                           std::vector<Value> arguments, SourceLocation location);

  // -- Calls (lower_calls.cpp, lower_overloads.cpp)
  Value lower_call(const CallExpr* expr);
  Value call_method(const MemberExpr* callee, const CallExpr* call);
  Value call_functions(const std::vector<FunctionInfo*>& candidates, const NamePart& part,
                       const Value* object, std::vector<Value> arguments, SourceLocation location);
  FunctionInfo* resolve_overload(const std::vector<FunctionInfo*>& candidates, const NamePart& part,
                                 const std::vector<Value>& arguments, SourceLocation location,
                                 bool quiet);
  bool is_viable(FunctionInfo* function, const std::vector<Value>& arguments, ConversionCost& cost);
  Value call(FunctionInfo* function, const Value* object, std::vector<Value> arguments,
             SourceLocation location);
  std::string describe(const FunctionInfo& function);
  std::string describe(const std::vector<Value>& arguments);
  void lower_function(FunctionInfo* function, SourceLocation use);
  FunctionInfo* bind_unbounded_arrays(FunctionInfo* function, const std::vector<Value>& arguments);
  void warn_passed_payload(const FunctionInfo& import, const std::vector<Value>& arguments);
  ir::Function* make_ir_function(FunctionInfo* function);

  // -- Intrinsics (lower_intrinsics.cpp, lower_atomics.cpp, lower_waves.cpp,
  // lower_ray_intrinsics.cpp)
  std::optional<Value> call_builtin(const NamePart& part, std::vector<Value>& arguments,
                                    SourceLocation location);
  Value call_maths(const IntrinsicRule& rule, std::vector<Value>& arguments,
                   SourceLocation location);
  Value call_mul(std::vector<Value>& arguments, SourceLocation location);
  Value call_select(std::vector<Value>& arguments, SourceLocation location);
  Value select_whole(const std::vector<Value>& arguments, SourceLocation location);
  Value call_and_or(bool is_and, std::vector<Value>& arguments, SourceLocation location);
  std::optional<Value> call_wave(std::string_view name, std::vector<Value>& arguments,
                                 SourceLocation location);
  const Type* wave_operand_type(const WaveRule& rule, const Value& argument);
  const ir::Expr* emit_wave(shader::WaveOp op, std::vector<const ir::Expr*> operands,
                            const Type* type);
  const ir::Expr* emit_wave_of_rows(shader::WaveOp op, const std::vector<const ir::Expr*>& operands,
                                    const Type* from, const Type* type);
  Value call_with_outputs(std::string_view name, std::vector<Value>& arguments,
                          SourceLocation location);
  Value call_interlocked(const AtomicRule& rule, std::vector<Value>& arguments,
                         SourceLocation location);
  // Where a component of a numeric place in memory is, counted from the place.
  static uint32_t component_bytes(const Value& target, uint32_t component);
  Value emit_atomic(const AtomicRule& rule, ir::Stmt* statement, const Type* type,
                    std::span<Value> arguments, SourceLocation location);
  Value call_trace_ray(std::vector<Value>& arguments, SourceLocation location);
  // -- RayQuery (lower_ray_query.cpp)
  Value call_query_method(const Value& object, const NamePart& part, std::vector<Value>& arguments,
                          SourceLocation location);
  Value trace_ray_inline(ir::Stmt* statement, const Type* query, std::vector<Value>& arguments);
  const ir::Expr* query_object(const Value& value, const Type* type);
  void lower_local_query(const VariableDecl* decl, const Type* type, VariableInfo* info);

  Value call_report_hit(std::vector<Value>& arguments, SourceLocation location);
  Value call_call_shader(std::vector<Value>& arguments, SourceLocation location);
  Value call_system_value(const SystemValueRule& rule, SourceLocation location);
  const ir::Variable* pass_by_reference(const Value& value, std::string_view what,
                                        SourceLocation location, bool& copied);
  bool check_count(std::string_view name, size_t given, size_t lowest, size_t highest,
                   SourceLocation location);
  void use_in_stages(std::string_view name, uint32_t stages, SourceLocation location);

  // -- Derivatives and what depends on them, discard (lower_pixels.cpp)
  Value call_pixel_function(std::string_view name, std::vector<Value>& arguments,
                            SourceLocation location);
  const ir::Expr* quad_value(shader::WaveOp op, const ir::Expr* operand);
  Value call_level_of_detail(const Value& object, bool clamped, std::vector<Value>& arguments,
                             SourceLocation location);
  void use_implicit_level(std::string_view name, ir::Expr* sample, SourceLocation location);

  // -- Resource methods (lower_resources.cpp, lower_textures.cpp)
  Value call_resource_method(const Value& object, const NamePart& part,
                             std::vector<Value>& arguments, SourceLocation location);
  std::optional<Value> call_raw_method(const Value& object, const NamePart& part,
                                       std::vector<Value>& arguments, SourceLocation location);
  std::optional<Value> call_texture_method(const Value& object, const NamePart& part,
                                           std::vector<Value>& arguments, SourceLocation location);
  Value call_sample(const Value& object, const SampleRule& rule, std::vector<Value>& arguments,
                    SourceLocation location);
  Value gather_four(const Value& object, const SampleRule& rule, std::vector<Value>& arguments,
                    size_t fixed, SourceLocation location);
  // The result of a load or sample, whose last argument takes the status.
  Value with_status(const Value& result, Value& status);
  Value call_load(const Value& object, std::vector<Value>& arguments, SourceLocation location);
  Value call_dimensions(const Value& object, std::vector<Value>& arguments,
                        SourceLocation location);
  Value texel(const ir::Expr* resource, const Type* type, const ir::Expr* coordinates,
              const ir::Expr* mip, bool is_const);
  const ir::Expr* to_vector(const Value& value, Scalar scalar, uint32_t size,
                            SourceLocation location);
  // -- Texels with components of 64 bits (lower_texels.cpp)
  const ir::Expr* from_texel(const ir::Expr* raw, const Type* type);
  const ir::Expr* to_texel(const ir::Expr* value, const Type* type);

  // -- Packed numbers (lower_packed.cpp)
  static bool is_packed_intrinsic(std::string_view name);
  Value call_packed(std::string_view name, std::vector<Value>& arguments, SourceLocation location);
  Value add_uint64(std::vector<Value>& arguments, SourceLocation location);
  Value dot_of_halves(std::vector<Value>& arguments, SourceLocation location);
  Value dot_of_bytes(std::string_view name, std::vector<Value>& arguments, SourceLocation location);

  // -- The namespace vk (lower_vk.cpp)
  static bool is_vk_name(const QualifiedName& name);
  std::optional<Value> vk_constant(const QualifiedName& name);
  std::optional<Value> call_vk(const QualifiedName& name, std::vector<Value>& arguments,
                               SourceLocation location);

  // -- Counters of structured buffers (lower_counters.cpp)
  const ir::Expr* change_counter(const ir::Expr* resource, bool up, SourceLocation location);
  std::optional<Value> call_counter_method(const Value& object, std::string_view name,
                                           std::vector<Value>& arguments, SourceLocation location);

  // -- Multisampled textures (lower_multisampled.cpp)
  Value multisampled_use(const Type* type, SourceLocation location);
  Value index_multisampled(const Value& base, const Value& index, SourceLocation location);
  std::optional<Value> call_multisampled_method(const Value& object, const NamePart& part,
                                                std::vector<Value>& arguments,
                                                SourceLocation location);

  // -- Statements (lower_statements.cpp)
  void lower_statement(const Stmt* statement);
  void lower_loop_head(const Stmt* init);
  void lower_block(std::span<const Stmt* const> statements);
  void lower_body(const Stmt* statement, ir::Block& target);
  void declare_variable(VariableInfo* info);
  void lower_local(const VariableDecl* decl);
  bool is_result_of_last_call(const ir::Expr* value) const;
  void lower_local_static(const VariableDecl* decl, const Type* type);
  void lower_if(const IfStmt* statement);
  static uint32_t unroll_count(const Stmt& loop);
  void lower_loop(const Expr* condition, const Expr* step, const Stmt* body, bool test_at_end,
                  const Stmt& statement);
  void lower_switch(const SwitchStmt* statement);
  void share_section_variables(ir::Stmt* node);
  void lower_return(const ReturnStmt* statement);
  void lower_discarded(const Expr* expression);
  const ir::Expr* initial_value(const Expr* initialiser, const Type* type);
  static bool ends(const ir::Block& block);

  // -- Payload access qualifiers (lower_payloads.cpp)
  void emit_trace(ir::Stmt* statement, const ir::Variable* payload, const Type* type,
                  SourceLocation location);
  void wrap_payload(FunctionInfo* function, ir::EntryPoint& entry);

 private:
  friend class Checker;

  // Forward to the checker's functions with the same names.
  void report(CheckId id, SourceLocation location,
              std::initializer_list<std::string> arguments = {});
  ir::Location locate(SourceLocation location);
  void at(SourceLocation location) { build_.location = locate(location); }
  bool has_errors() const;

  // The body being lowered.
  FunctionInfo* function_ = nullptr;
  ir::Block* block_ = nullptr;
  Scope* scope_ = nullptr;
  const ir::Variable* this_variable_ = nullptr;
  uint64_t effects_ = 0;
  int loop_depth_ = 0;
  int switch_depth_ = 0;
  int depth_ = 0;           // of nested expressions and statements
  int function_depth_ = 0;  // nested lowerings of functions
  bool result_unused_ = false;
  // The variable that receives the last kCall's result, until a variable of the source replaces it.
  ir::Variable* call_result_ = nullptr;

  std::vector<FunctionInfo*> lowered_functions_;  // callees before callers
  std::set<std::string> mangled_names_;
  std::unordered_map<const BindingInfo*, uint8_t> counter_uses_;  // up, down
  ir::Block no_block_;  // takes what is lowered outside any body

  Checker& checker_;
  TypeTable& types_;
  IrBuilder& build_;
};

}  // namespace kaamos::hlsl
