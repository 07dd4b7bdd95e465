// SPDX-License-Identifier: MIT
//
// The checker's inner state; check.h is what others include. It is one class, split into one file
// per noun: scopes, resolve_types, declarations, structs, templates, specializations, bindings,
// imports, entry_points, graphics_stages, subobjects, payloads, finish. The lowerer handles bodies
// and expressions (lowerer.h).
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

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/builder/finish/payload_uses.h"
#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/check/check.h"
#include "runtime/hlsl/check/layout.h"
#include "runtime/hlsl/check/lowerer.h"
#include "runtime/hlsl/check/symbols.h"
#include "runtime/hlsl/check/types.h"
#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

// The minor version of a target such as lib_6_3; lib_6_x has everything.
uint32_t shader_model_minor(const std::string& target);
// Whether the types and directions agree.
bool have_same_parameters(const FunctionInfo& one, const FunctionInfo& other);
// Finds the attribute with that name, ignoring case; null if there is none.
const Attribute* find_attribute(const FunctionInfo& function, std::string_view name);
const Attribute* find_attribute(std::span<const Attribute> attributes, std::string_view name);

class Checker {
 public:
  Checker(const CheckOptions& options, const SourceManager& sources, DiagnosticEngine& diagnostics);
  std::unique_ptr<ir::Module> run(const TranslationUnit& unit);
  std::unique_ptr<ir::Module> run(const Link& link);

 private:
  friend class Lowerer;

  // -- Messages (check.cpp)
  void report(CheckId id, SourceLocation location,
              std::initializer_list<std::string> arguments = {});
  void report_with_notes(CheckId id, SourceLocation location,
                         const std::vector<std::string>& arguments,
                         const std::vector<std::pair<SourceLocation, std::string>>& notes);
  ir::Location locate(SourceLocation location);
  void at(SourceLocation location) { build_.location = locate(location); }
  bool has_errors() const { return has_errors_; }

  // -- Scopes (scopes.cpp)
  Scope* make_scope(ScopeKind kind, Scope* parent, std::string_view name = {});
  Symbol* add_symbol(Scope* scope, SymbolKind kind, std::string_view name, SourceLocation location);
  Symbol* find_local(Scope* scope, std::string_view name);
  // A struct or enum, whose name a variable or function of the same scope may take over.
  static bool is_tag(const Symbol& symbol);
  // What keeps variables and functions from having the name in this scope.
  Symbol* find_taken(Scope* scope, std::string_view name);
  Symbol* find_in_scope(Scope* scope, std::string_view name, bool check_order);
  Symbol* find_member(StructInfo* structure, std::string_view name);
  Symbol* find(Scope* scope, std::string_view name);
  // Reports what is missing, unless `quiet`.
  Symbol* resolve_name(const QualifiedName& name, Scope* scope, bool quiet);
  Scope* scope_of_part(const NamePart& part, Symbol* symbol, Scope* scope);
  std::string similar_name(std::string_view text, Scope* scope, bool with_outer);
  // Adds a note that suggests what may have been meant.
  void report_unknown(CheckId id, SourceLocation location,
                      const std::vector<std::string>& arguments, std::string_view text,
                      Scope* scope, bool with_outer);
  static std::string qualify(const Scope* scope, std::string_view name);
  static std::string spell(const QualifiedName& name);

  // -- Types (resolve_types.cpp)
  const Type* resolve_type(const TypeSyntax* syntax, Scope* scope);
  const Type* resolve_named(const TypeSyntax* syntax, Scope* scope);
  const Type* resolve_builtin(const NamePart& part, SourceLocation location, Scope* scope);
  const Type* resolve_ray_query(const NamePart& part, Scope* scope);
  const Type* resolve_resource(const ResourceTraits& traits, const NamePart& part, Scope* scope);
  // The type of a variable; `auto` takes that of the initialiser.
  const Type* resolve_variable_type(const VariableDecl* decl, Scope* scope);
  const Type* resolve_array(const TypeSyntax* syntax, Scope* scope);
  const Type* type_argument(const TemplateArgument& argument, Scope* scope);
  std::optional<int64_t> value_argument(const TemplateArgument& argument, Scope* scope,
                                        const Type** type = nullptr);
  static bool is_const_type(const TypeSyntax* syntax);
  const Type* apply_storage(const Type* type, Modifiers modifiers);
  Scalar scalar_of(ScalarKind kind, SourceLocation location);
  // `type` receives the expression's type.
  std::optional<int64_t> constant_integer(const Expr* expression, Scope* scope,
                                          std::string_view purpose, const Type** type = nullptr);

  // -- Declarations (declarations.cpp, structs.cpp)
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
  const Type* enumerator_type(const Type* before, int64_t value, bool is_fixed);
  void close_enum(const EnumDecl* decl, EnumInfo* info, Scope* inner);
  void declare_struct(const StructDecl* decl, Scope* scope);
  StructInfo* make_struct(const StructDecl* decl, Scope* parent, const std::string& name);
  void complete_struct(StructInfo* info);
  void check_interfaces(StructInfo* info);
  void declare_member(StructInfo* info, const Decl* member);
  void declare_bit_field(StructInfo* info, const VariableDecl* decl, const Type* type);
  void declare_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner);
  FunctionInfo* make_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner);
  void resolve_signature(FunctionInfo* function);
  FunctionInfo* same_signature(Symbol* symbol, const FunctionInfo& function);
  bool check_variable_type(const Type* type, SourceLocation location, std::string_view name);
  void declare_builtins();

  // -- Specializations, and members outside of their structs (specializations.cpp)
  void specialize_struct(const StructDecl* decl, Scope* scope);
  void specialize_function(const FunctionDecl* decl, Scope* scope, StructInfo* owner);
  // The partial specialization that fits best, with its parameters' values; null: the primary.
  const StructDecl* partial_for(StructTemplate* structure, const TemplateValues& values,
                                SourceLocation location, TemplateValues& found);
  bool match_partial(StructTemplate* structure, const StructDecl* partial,
                     const TemplateValues& values, TemplateValues& found);
  StructTemplate* outer_template(const QualifiedName& qualifier, Scope* scope);
  void declare_outer(StructTemplate* structure, const OuterMember& member);
  void apply_outer(StructInfo* info, const TemplateValues& values, const OuterMember& member);
  void define_static(VariableInfo* variable, const VariableDecl* decl, Scope* scope);
  void declare_outer_static(const VariableDecl* decl, Scope* scope);
  FunctionInfo* same_parameters(Symbol* symbol, const FunctionInfo& function);
  static void define(FunctionInfo* function, const FunctionDecl* decl, Scope* scope);

  // -- Templates (templates.cpp)
  StructTemplate* template_of(const Symbol* symbol, const NamePart& part);
  StructInfo* instantiate_struct(StructTemplate* structure, const NamePart& part,
                                 SourceLocation location, Scope* scope);
  const Type* instantiate_alias(const TypeAliasDecl* alias, Scope* alias_scope,
                                const NamePart& part, Scope* scope);
  FunctionInfo* instantiate_function(FunctionInfo* function,
                                     std::span<const TemplateArgument> written, Scope* use_scope,
                                     const std::vector<Value>& arguments);
  // Returns false if an argument is missing or of the wrong kind.
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

  // -- Bindings (bindings.cpp)
  void declare_binding(const VariableDecl* decl, const Type* type, Scope* scope);
  VariableInfo* make_binding(const std::string& name, const Type* type, SourceLocation location);
  void declare_buffer(const BufferDecl* decl, Scope* scope);
  void declare_uniform(const VariableDecl* decl, const Type* type, Scope* scope);
  void open_globals_buffer(SourceLocation location);

  // -- Global structs that hold resources (split_structs.cpp)
  struct SplitPlan;
  void declare_split(const VariableDecl* decl, const Type* type, Scope* scope, BindingInfo* buffer,
                     ir::Struct* members, uint32_t* offset);
  SplitPart split(const Type* type, const std::string& name, SplitPlan& plan);
  SplitPart split_memory(const Type* type, const std::string& name, SplitPlan& plan);
  SplitPart split_resource(const Type* type, const std::string& name, SplitPlan& plan);
  void apply_register(BindingInfo* binding, const Annotations& annotations);
  const ir::Expr* binding_value(BindingInfo* binding, const ir::Expr* index);

  // -- Entry points, exports, subobjects
  void find_entry_points();
  void check_entry_point(FunctionInfo* function, uint32_t stage, const std::string& name);
  // -- Vertex and pixel shaders (graphics_stages.cpp)
  class GraphicsSignature;
  bool check_graphics_signature(FunctionInfo* function, ir::EntryPoint& entry);
  // The static global that says whether a pixel may still write.
  const ir::Variable* live_variable();
  bool check_ray_parameters(FunctionInfo* function, ir::EntryPoint& entry);
  bool check_compute_parameters(FunctionInfo* function, ir::EntryPoint& entry);
  bool read_thread_group(FunctionInfo* function, ir::EntryPoint& entry);
  bool read_wave_size(FunctionInfo* function, ir::EntryPoint& entry);
  static bool has_stage(const FunctionInfo& function);
  uint32_t stage_attribute(FunctionInfo* function);
  std::vector<std::string> export_names(const FunctionInfo* function);
  void add_library_functions();
  void declare_subobject(const SubobjectDecl* decl);

  // -- Payload access qualifiers (payloads.cpp)
  static bool has_raypayload(const StructInfo& structure);
  void check_payload_struct(StructInfo* info);
  void check_payload_field(FieldInfo& field);
  void check_payload_use(const Type* type, SourceLocation location);

  // -- Functions without a body (imports.cpp)
  struct Exported {
    std::string name;
    std::string mangled;
    FunctionInfo* function;
  };
  std::vector<Exported> exported_functions(uint32_t unit);
  void enter_unit(uint32_t unit);
  void reuse_struct(StructInfo* info);
  bool is_importable(const FunctionInfo& function) const;
  FunctionInfo* linked_definition(const FunctionInfo& import);
  bool same_signatures(const FunctionInfo& import, const FunctionInfo& definition,
                       SourceLocation use);
  void make_import(FunctionInfo* function, SourceLocation use);
  void check_initialiser_imports(const VariableInfo& variable);
  void assign_known_registers();

  // -- The module (finish.cpp)
  class Reports;
  void finish();
  void check_payload_uses();
  void warn_skipped();

  const CheckOptions* options_;  // of the unit whose code is being checked
  const Link* link_ = nullptr;   // null: a library by itself
  const SourceManager& sources_;
  DiagnosticEngine& diagnostics_;
  std::unique_ptr<ir::Module> module_;
  IrTypes ir_types_;
  TypeTable types_;
  IrBuilder build_;
  Lowerer lower_;
  size_t error_count_ = 0;  // includes those in muted attempts
  bool has_errors_ = false;
  int muted_ = 0;  // above 0 while something is tried that may fail: messages are dropped

  std::deque<Scope> scopes_;
  std::deque<Symbol> symbols_;
  std::deque<VariableInfo> variables_;
  std::deque<FunctionInfo> functions_;
  std::deque<StructInfo> structs_;
  std::deque<EnumInfo> enums_;
  std::deque<StructTemplate> struct_templates_;
  std::deque<BindingInfo> bindings_;
  std::unordered_map<const ir::Expr*, BindingInfo*> binding_of_;  // for kBinding
  std::deque<std::string> names_;
  std::unordered_map<const Decl*, const Type*> declared_types_;
  std::unordered_map<const StructInfo*, std::pair<StructTemplate*, TemplateValues>>
      instance_arguments_;
  std::set<std::string> struct_names_;
  Scope* global_ = nullptr;  // of the unit that is being declared
  std::vector<Scope*> unit_scopes_;
  std::unordered_map<std::string_view, Symbol*> builtin_symbols_;
  std::unordered_multimap<std::string, const StructInfo*> structs_by_name_;
  uint32_t sequence_ = 0;
  uint32_t file_cache_ = 0;
  std::unordered_map<std::string, uint32_t> files_;

  BindingInfo* globals_buffer_ = nullptr;
  ir::Struct* globals_struct_ = nullptr;
  uint32_t globals_offset_ = 0;
  StructInfo* ray_desc_ = nullptr;
  StructInfo* triangle_attributes_ = nullptr;

  uint32_t visible_ = ~0u;  // symbols with a later sequence are not declared yet
  int template_depth_ = 0;

  std::vector<FunctionInfo*> all_functions_;  // in declaration order, without templates
  ModuleFacts facts_;
  PayloadFacts payloads_;
  std::set<std::tuple<uint32_t, uint32_t, std::vector<std::string>>> reported_;
  std::set<std::pair<uint32_t, uint32_t>> reported_uses_;
};

struct Lowerer::BodyScope {
  BodyScope(Lowerer& lowerer, FunctionInfo* function, ir::Block* block, Scope* scope)
      : lowerer_(lowerer),
        function_(lowerer.function_),
        block_(lowerer.block_),
        scope_(lowerer.scope_),
        this_(lowerer.this_variable_),
        visible_(lowerer.checker_.visible_),
        loops_(lowerer.loop_depth_),
        switches_(lowerer.switch_depth_),
        unused_(lowerer.result_unused_),
        location_(lowerer.build_.location),
        options_(lowerer.checker_.options_) {
    lowerer.checker_.enter_unit(scope->unit);
    lowerer.function_ = function;
    lowerer.block_ = block;
    lowerer.scope_ = scope;
    lowerer.this_variable_ = nullptr;
    lowerer.loop_depth_ = lowerer.switch_depth_ = 0;
    lowerer.result_unused_ = false;
  }
  ~BodyScope() {
    lowerer_.function_ = function_;
    lowerer_.block_ = block_;
    lowerer_.scope_ = scope_;
    lowerer_.this_variable_ = this_;
    lowerer_.checker_.visible_ = visible_;
    lowerer_.loop_depth_ = loops_;
    lowerer_.switch_depth_ = switches_;
    lowerer_.result_unused_ = unused_;
    lowerer_.build_.location = location_;
    lowerer_.checker_.options_ = options_;
  }
  BodyScope(const BodyScope&) = delete;
  BodyScope& operator=(const BodyScope&) = delete;

 private:
  Lowerer& lowerer_;
  FunctionInfo* function_;
  ir::Block* block_;
  Scope* scope_;
  const ir::Variable* this_;
  uint32_t visible_;
  int loops_;
  int switches_;
  bool unused_;
  ir::Location location_;
  const CheckOptions* options_;
};

}  // namespace kaamos::hlsl
