// SPDX-License-Identifier: MIT
//
// The checker's inner state; check.h is what others include. One class, whose parts stand in one
// file per noun: check_types, check_declarations, check_templates, check_overloads, check_bindings,
// check_entry_points, check_subobjects, lower_conversions, lower_places, lower_expressions,
// lower_calls, lower_intrinsics, lower_resources, lower_statements, lower_module.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/hlsl/check/check.h"
#include "runtime/hlsl/check/constants.h"
#include "runtime/hlsl/check/ir_builder.h"
#include "runtime/hlsl/check/layout.h"
#include "runtime/hlsl/check/symbols.h"
#include "runtime/hlsl/check/types.h"
#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

struct PayloadLeaf;

// [name] among them, written in any case; null where there is none.
const Attribute* find_attribute(std::span<const Attribute> attributes, std::string_view name);

using CheckId = DiagnosticId;

class Checker {
 public:
  Checker(const CheckOptions& options, const SourceManager& sources, DiagnosticEngine& diagnostics);
  std::unique_ptr<ir::Module> run(const TranslationUnit& unit);

 private:
  // -- Messages (check.cpp)
  void report(CheckId id, SourceLocation location,
              std::initializer_list<std::string> arguments = {});
  void report_with_notes(CheckId id, SourceLocation location,
                         const std::vector<std::string>& arguments,
                         const std::vector<std::pair<SourceLocation, std::string>>& notes);
  ir::Location locate(SourceLocation location);
  void at(SourceLocation location) { build_.location = locate(location); }
  bool has_errors() const { return has_errors_; }

  // -- Scopes (check_scopes.cpp)
  Scope* make_scope(ScopeKind kind, Scope* parent, std::string_view name = {});
  Symbol* add_symbol(Scope* scope, SymbolKind kind, std::string_view name, SourceLocation location);
  Symbol* find_local(Scope* scope, std::string_view name);
  Symbol* find_in_scope(Scope* scope, std::string_view name, bool check_order);
  Symbol* find_member(StructInfo* structure, std::string_view name);
  Symbol* find(Scope* scope, std::string_view name);
  // Reports what is missing unless `quiet`.
  Symbol* resolve_name(const QualifiedName& name, Scope* scope, bool quiet);
  Scope* scope_of_part(const NamePart& part, Symbol* symbol, Scope* scope);
  std::string similar_name(std::string_view text, Scope* scope, bool with_outer);
  // With a note of what may be meant.
  void report_unknown(CheckId id, SourceLocation location,
                      const std::vector<std::string>& arguments, std::string_view text,
                      Scope* scope, bool with_outer);
  static std::string qualify(const Scope* scope, std::string_view name);
  static std::string spell(const QualifiedName& name);
  const FunctionInfo* enclosing_function() const { return function_; }

  // -- Types (check_types.cpp)
  const Type* resolve_type(const TypeSyntax* syntax, Scope* scope);
  const Type* resolve_named(const TypeSyntax* syntax, Scope* scope);
  const Type* resolve_builtin(const NamePart& part, SourceLocation location, Scope* scope);
  const Type* resolve_ray_query(const NamePart& part, Scope* scope);
  const Type* resolve_resource(const ResourceTraits& traits, const NamePart& part, Scope* scope);
  const Type* resolve_array(const TypeSyntax* syntax, Scope* scope);
  const Type* type_argument(const TemplateArgument& argument, Scope* scope);
  std::optional<int64_t> value_argument(const TemplateArgument& argument, Scope* scope);
  static bool is_const_type(const TypeSyntax* syntax);
  const Type* apply_storage(const Type* type, Modifiers modifiers);
  Scalar scalar_of(ScalarKind kind, SourceLocation location);
  std::optional<int64_t> constant_integer(const Expr* expression, Scope* scope,
                                          std::string_view purpose);

  // -- Declarations (check_declarations.cpp, check_structs.cpp)
  void declare_all(std::span<const Decl* const> declarations, Scope* scope);
  void declare(const Decl* declaration, Scope* scope);
  void declare_variable(const VariableDecl* decl, Scope* scope);
  void declare_static(const VariableDecl* decl, const Type* type, Scope* scope);
  void check_initialisers();
  void initialise(VariableInfo* variable);
  void declare_namespace(const NamespaceDecl* decl, Scope* scope);
  void declare_alias(const TypeAliasDecl* decl, Scope* scope);
  void declare_using(const QualifiedName& name, Scope* scope, SourceLocation location);
  void declare_enum(const EnumDecl* decl, Scope* scope);
  void declare_struct(const StructDecl* decl, Scope* scope);
  StructInfo* make_struct(const StructDecl* decl, Scope* parent, const std::string& name);
  void complete_struct(StructInfo* info);
  void declare_member(StructInfo* info, const Decl* member);
  void declare_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner);
  FunctionInfo* make_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner);
  void resolve_signature(FunctionInfo* function);
  FunctionInfo* same_signature(Symbol* symbol, const FunctionInfo& function);
  bool check_variable_type(const Type* type, SourceLocation location, std::string_view name);
  void declare_builtins();

  // -- Templates (check_templates.cpp)
  StructTemplate* template_of(const Symbol* symbol, const NamePart& part);
  StructInfo* instantiate_struct(StructTemplate* structure, const NamePart& part,
                                 SourceLocation location, Scope* scope);
  const Type* instantiate_alias(const TypeAliasDecl* alias, Scope* alias_scope,
                                const NamePart& part, Scope* scope);
  FunctionInfo* instantiate_function(FunctionInfo* function,
                                     std::span<const TemplateArgument> written, Scope* use_scope,
                                     const std::vector<Value>& arguments);
  // Empty where an argument is missing or of the wrong kind.
  bool bind_arguments(std::span<const TemplateParameter> parameters,
                      std::span<const TemplateArgument> written, Scope* use_scope,
                      TemplateValues& values);
  bool complete_arguments(std::span<const TemplateParameter> parameters, Scope* scope,
                          TemplateValues& values);
  Scope* template_scope(std::span<const TemplateParameter> parameters, const TemplateValues& values,
                        Scope* parent);
  std::string template_suffix(const TemplateValues& values);
  bool deduce(const TypeSyntax* syntax, const Type* type,
              std::span<const TemplateParameter> parameters, TemplateValues& values);
  void deduce_value(const Expr* expression, uint64_t value,
                    std::span<const TemplateParameter> parameters, TemplateValues& values);

  // -- Bindings (check_bindings.cpp)
  void declare_binding(const VariableDecl* decl, const Type* type, Scope* scope);
  void declare_buffer(const BufferDecl* decl, Scope* scope);
  void declare_uniform(const VariableDecl* decl, const Type* type, Scope* scope);
  void finish_globals_buffer();
  void apply_register(BindingInfo* binding, const Annotations& annotations);
  void assign_registers();
  void assign_automatic(BindingInfo* binding);
  void check_overlaps();
  const ir::Expr* binding_value(BindingInfo* binding, const ir::Expr* index);

  // -- Conversions (lower_conversions.cpp)
  ConversionRank rank(const Value& value, const Type* to);
  ConversionRank rank(const Type* from, const Type* to);
  Scalar common_scalar(Scalar a, Scalar b);
  // Explicit: what a cast may do beyond an implicit conversion.
  const ir::Expr* convert(const Value& value, const Type* to, SourceLocation location,
                          bool is_explicit = false);
  const ir::Expr* convert_numeric(const ir::Expr* expr, const Type* from, const Type* to);
  bool convertible_numeric(const Type* from, const Type* to, bool is_explicit);
  // Literal types to what they stand for.
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
  const ir::Expr* lower_nested_list(const InitListExpr* list, const Type* type);
  void collect_pieces(const InitListExpr* list, std::vector<Piece>& pieces, int depth);
  const ir::Expr* as_condition(const Value& value, SourceLocation location);

  // -- Places (lower_places.cpp)
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
  Value base_of(const Value& value, StructInfo* base);
  Value element_of(const Value& base, const Value& index, SourceLocation location);
  Value swizzle_of(const Value& base, std::string_view text, SourceLocation location);
  Value matrix_swizzle_of(const Value& base, std::string_view text, SourceLocation location);
  Value component_of(const Value& base, const std::vector<uint8_t>& components);
  Value memory_element(const Value& base, const ir::Expr* index);
  bool require_place(const Value& value, SourceLocation location, std::string_view purpose);
  void freeze(Value& value, size_t* position);
  const ir::Expr* freeze_place(const ir::Expr* expr, size_t* position);
  const ir::Expr* index_value(const Value& value, SourceLocation location);
  static bool is_fixed(const ir::Expr* expr);
  const ir::Expr* frozen(const ir::Expr* expr, size_t* position);
  static bool mentions(const ir::Expr* expr, const ir::Variable* variable);

  // -- Emission
  ir::Block& block() { return *block_; }
  void emit(const ir::Stmt* statement);
  const ir::Variable* temporary(const ir::Expr* value, size_t* position = nullptr);
  ir::Variable* empty_temporary(const ir::Type* type);
  // Simple enough to be repeated; else read from a temporary.
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
  // Of operands of one numeric shape; null where there is none (reported).
  const Type* common_type(const Type* a, const Type* b, SourceLocation location, bool& truncates);
  std::optional<Value> overloaded_operator(std::string_view name, const Value& left,
                                           std::vector<Value> arguments, SourceLocation location);

  // -- Calls (lower_calls.cpp, check_overloads.cpp)
  Value lower_call(const CallExpr* expr);
  Value call_method(const MemberExpr* callee, const CallExpr* call);
  Value call_functions(const std::vector<FunctionInfo*>& candidates, const NamePart& part,
                       const Value* object, std::vector<Value> arguments, SourceLocation location);
  FunctionInfo* resolve_overload(const std::vector<FunctionInfo*>& candidates, const NamePart& part,
                                 const std::vector<Value>& arguments, SourceLocation location,
                                 bool quiet);
  bool is_viable(FunctionInfo* function, const std::vector<Value>& arguments,
                 std::vector<uint32_t>& costs);
  Value call(FunctionInfo* function, const Value* object, std::vector<Value> arguments,
             SourceLocation location);
  std::string describe(const FunctionInfo& function);
  std::string describe(const std::vector<Value>& arguments);
  void lower_function(FunctionInfo* function, SourceLocation use);
  ir::Function* make_ir_function(FunctionInfo* function);

  // -- Intrinsics (lower_intrinsics.cpp, lower_ray_intrinsics.cpp)
  std::optional<Value> call_builtin(const NamePart& part, std::vector<Value>& arguments,
                                    SourceLocation location);
  Value call_maths(const IntrinsicRule& rule, std::vector<Value>& arguments,
                   SourceLocation location);
  Value call_mul(std::vector<Value>& arguments, SourceLocation location);
  Value call_select(std::vector<Value>& arguments, SourceLocation location);
  Value call_and_or(bool is_and, std::vector<Value>& arguments, SourceLocation location);
  std::optional<Value> call_wave(std::string_view name, std::vector<Value>& arguments,
                                 SourceLocation location);
  Value call_with_outputs(std::string_view name, std::vector<Value>& arguments,
                          SourceLocation location);
  Value call_interlocked(const AtomicRule& rule, std::vector<Value>& arguments,
                         SourceLocation location);
  Value emit_atomic(const AtomicRule& rule, ir::Stmt* statement, const Type* type,
                    std::span<Value> arguments, SourceLocation location);
  Value call_trace_ray(std::vector<Value>& arguments, SourceLocation location);
  // lower_ray_query.cpp
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

  // -- Resource methods (lower_resources.cpp, lower_textures.cpp)
  Value call_resource_method(const Value& object, const NamePart& part,
                             std::vector<Value>& arguments, SourceLocation location);
  std::optional<Value> call_raw_method(const Value& object, const NamePart& part,
                                       std::vector<Value>& arguments, SourceLocation location);
  std::optional<Value> call_texture_method(const Value& object, const NamePart& part,
                                           std::vector<Value>& arguments, SourceLocation location);
  Value call_sample(const Value& object, const SampleRule& rule, std::vector<Value>& arguments,
                    SourceLocation location);
  Value call_load(const Value& object, std::vector<Value>& arguments, SourceLocation location);
  Value call_dimensions(const Value& object, std::vector<Value>& arguments,
                        SourceLocation location);
  Value texel(const ir::Expr* resource, const Type* type, const ir::Expr* coordinates,
              const ir::Expr* mip, bool is_const);
  const ir::Expr* to_vector(const Value& value, Scalar scalar, uint32_t size,
                            SourceLocation location);

  // -- Statements (lower_statements.cpp)
  void lower_statement(const Stmt* statement);
  void lower_block(std::span<const Stmt* const> statements);
  void lower_body(const Stmt* statement, ir::Block& target);
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

  // -- Entry points, exports, subobjects
  void find_entry_points();
  void check_entry_point(FunctionInfo* function, uint32_t stage, const std::string& name);
  bool check_ray_parameters(FunctionInfo* function, ir::EntryPoint& entry);
  bool check_compute_parameters(FunctionInfo* function, ir::EntryPoint& entry);
  bool read_thread_group(FunctionInfo* function, ir::EntryPoint& entry);
  uint32_t stage_attribute(FunctionInfo* function);
  std::vector<std::string> export_names(const FunctionInfo* function);
  void add_library_functions();
  void declare_subobject(const SubobjectDecl* decl);

  // -- Payload access qualifiers (check_payloads.cpp, lower_payloads.cpp, check_payload_uses.cpp)
  static bool has_raypayload(const StructInfo& structure);
  void check_payload_struct(StructInfo* info);
  void check_payload_field(FieldInfo& field);
  void check_payload_use(const Type* type, SourceLocation location);
  const ir::Expr* payload_field(const ir::Variable* payload, const PayloadLeaf& leaf);
  void copy_payload_field(const ir::Variable* to, const ir::Variable* from,
                          const PayloadLeaf& leaf);
  void emit_trace(ir::Stmt* statement, const ir::Variable* payload, const Type* type,
                  SourceLocation location);
  void wrap_payload(FunctionInfo* function, ir::EntryPoint& entry);
  void check_payload_uses();
  class PayloadUses;
  struct TracePayload {
    const ir::Variable* variable;
    const StructInfo* structure;
    SourceLocation location;
  };

  // -- The module (lower_module.cpp)
  void finish(ir::Module& module);
  void mark_reachable(FunctionInfo* function, ir::EntryPoint& entry, uint32_t mark,
                      std::set<uint32_t>& globals);
  void collect_structs();
  void collect_struct(const ir::Type* type);
  void collect_structs_of(const ir::Block& body);
  void collect_structs_of(const ir::Expr* expression);
  void warn_skipped();

  // Swaps what a body is lowered into; restores it when it goes.
  struct BodyScope;

  const CheckOptions& options_;
  const SourceManager& sources_;
  DiagnosticEngine& diagnostics_;
  std::unique_ptr<ir::Module> module_;
  TypeTable types_;
  IrBuilder build_;
  size_t error_count_ = 0;  // those of muted attempts too
  bool has_errors_ = false;
  int muted_ = 0;  // inside: messages are dropped, since failing is no error

  std::deque<Scope> scopes_;
  std::deque<Symbol> symbols_;
  std::deque<VariableInfo> variables_;
  std::deque<FunctionInfo> functions_;
  std::deque<StructInfo> structs_;
  std::deque<EnumInfo> enums_;
  std::deque<StructTemplate> struct_templates_;
  std::deque<BindingInfo> bindings_;
  std::unordered_map<const ir::Expr*, BindingInfo*> binding_of_;  // of kBinding
  std::deque<std::string> names_;
  std::unordered_map<const Decl*, const Type*> declared_types_;
  std::unordered_map<const StructInfo*, std::pair<StructTemplate*, TemplateValues>>
      instance_arguments_;
  std::set<std::string> struct_names_;
  Scope* global_ = nullptr;
  uint32_t sequence_ = 0;
  uint32_t file_cache_ = 0;
  std::unordered_map<std::string, uint32_t> files_;

  BindingInfo* globals_buffer_ = nullptr;
  ir::Struct* globals_struct_ = nullptr;
  uint32_t globals_offset_ = 0;
  StructInfo* ray_desc_ = nullptr;
  StructInfo* triangle_attributes_ = nullptr;

  // The body being lowered.
  FunctionInfo* function_ = nullptr;
  ir::Block* block_ = nullptr;
  Scope* scope_ = nullptr;
  const ir::Variable* this_variable_ = nullptr;
  uint32_t visible_ = ~0u;  // symbols of a later sequence are not declared yet
  uint64_t effects_ = 0;
  int loop_depth_ = 0;
  int switch_depth_ = 0;
  int depth_ = 0;           // of nested expressions and statements
  int function_depth_ = 0;  // of functions lowered on the way to others
  int template_depth_ = 0;
  bool result_unused_ = false;
  // What the last kCall gives its result to, until a variable of the source takes its place.
  ir::Variable* call_result_ = nullptr;

  std::vector<FunctionInfo*> all_functions_;      // in declaration order, no templates
  std::vector<FunctionInfo*> lowered_functions_;  // callees before callers
  std::vector<std::pair<FunctionInfo*, size_t>> entries_;
  std::set<const ir::Struct*> collected_structs_;
  std::set<const ir::Expr*> collected_exprs_;
  // An entry point made around one of the source.
  struct Wrapper {
    ir::Function* function;
    FunctionInfo* wrapped;
    uint32_t stage;
  };
  std::vector<Wrapper> wrappers_;
  std::vector<const FunctionInfo*> library_functions_;  // of Module::library_functions
  std::unordered_map<const ir::Struct*, const StructInfo*> payload_structs_;
  // Where the source names a field of a payload struct, and passes one to TraceRay.
  std::unordered_map<const ir::Expr*, SourceLocation> payload_accesses_;
  std::unordered_map<const ir::Stmt*, TracePayload> trace_payloads_;
  std::set<std::string> mangled_names_;
  std::set<std::tuple<uint32_t, uint32_t, std::vector<std::string>>> reported_;
  std::set<std::pair<uint32_t, uint32_t>> reported_uses_;
  // Of the entry point that mark_reachable walks.
  std::set<BindingInfo*> entry_bindings_;
  std::vector<VariableInfo*> entry_globals_;
  ir::Block no_block_;  // for what is lowered outside any body
};

struct Checker::BodyScope {
  BodyScope(Checker& checker, FunctionInfo* function, ir::Block* block, Scope* scope)
      : checker_(checker),
        function_(checker.function_),
        block_(checker.block_),
        scope_(checker.scope_),
        this_(checker.this_variable_),
        visible_(checker.visible_),
        loops_(checker.loop_depth_),
        switches_(checker.switch_depth_),
        unused_(checker.result_unused_),
        location_(checker.build_.location) {
    checker.function_ = function;
    checker.block_ = block;
    checker.scope_ = scope;
    checker.this_variable_ = nullptr;
    checker.loop_depth_ = checker.switch_depth_ = 0;
    checker.result_unused_ = false;
  }
  ~BodyScope() {
    checker_.function_ = function_;
    checker_.block_ = block_;
    checker_.scope_ = scope_;
    checker_.this_variable_ = this_;
    checker_.visible_ = visible_;
    checker_.loop_depth_ = loops_;
    checker_.switch_depth_ = switches_;
    checker_.result_unused_ = unused_;
    checker_.build_.location = location_;
  }
  BodyScope(const BodyScope&) = delete;
  BodyScope& operator=(const BodyScope&) = delete;

 private:
  Checker& checker_;
  FunctionInfo* function_;
  ir::Block* block_;
  Scope* scope_;
  const ir::Variable* this_;
  uint32_t visible_;
  int loops_;
  int switches_;
  bool unused_;
  ir::Location location_;
};

}  // namespace kaamos::hlsl
