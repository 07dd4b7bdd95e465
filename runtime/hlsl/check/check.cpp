// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/check.h"

#include <unordered_map>
#include <utility>

#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/builder/finish/long_vectors.h"
#include "runtime/hlsl/check/finish/finish.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/name_parts.h"
#include "runtime/hlsl/check/names/names.h"
#include "runtime/hlsl/check/names/program.h"
#include "runtime/hlsl/check/stages/entry_points.h"
#include "runtime/hlsl/check/stages/exports.h"
#include "runtime/hlsl/check/stages/imports.h"
#include "runtime/hlsl/check/stages/subobjects.h"

namespace kaamos::hlsl {

namespace {

// The rooms together. Bodies reach all others through Names, which this is.
class Checker final : Names {
 public:
  Checker(const CheckOptions& options, const Link* link, const SourceManager& sources,
          DiagnosticEngine& diagnostics)
      : program_(options, link, sources, diagnostics) {
    parts_.on_subobject = [this](const SubobjectDecl* decl) {
      subobjects_.declare_subobject(decl);
    };
    lower_.body.scope = program_.global;
    program_.bench.module.name = options.name;
    program_.bench.module.target = options.target;
  }

  std::unique_ptr<ir::Module> run(const TranslationUnit& unit) {
    parts_.declarations.declare_builtins();
    parts_.declarations.declare_all(unit.declarations, program_.global);
    parts_.bindings.place_globals();
    check_initialisers();
    entry_points_.find_entry_points();
    if (program_.options->target.starts_with("lib")) entry_points_.add_library_functions();
    check_initialisers();
    finish_.run();
    const Messages& messages = program_.bench.messages;
    if (!messages.has_errors()) finish_.check_payload_uses();
    if (!messages.has_errors()) finish_.warn_skipped();
    if (!messages.has_any_errors()) finish_.cover_unreached();
    if (messages.has_any_errors()) return nullptr;
    make_long_vectors_arrays(program_.bench.module, program_.bench.build);
    set_aside_unlinked(program_.bench.module);
    return std::move(program_.bench.made);
  }

  std::unique_ptr<ir::Module> run(const Link& link) {
    parts_.declarations.declare_builtins();
    const auto builtin_symbols = program_.global->symbols;
    for (uint32_t unit = 0; unit < link.units.size(); ++unit) {
      if (unit > 0) {
        program_.global = program_.scopes.make_scope(ScopeKind::kGlobal, nullptr);
        program_.global->unit = unit;
        program_.global->symbols = builtin_symbols;
        program_.unit_scopes.push_back(program_.global);
        parts_.bindings.begin_unit();
      }
      program_.enter_unit(unit);
      lower_.body.scope = program_.global;
      parts_.declarations.declare_all(link.units[unit].tree->declarations, program_.global);
      parts_.bindings.place_globals();
    }
    parts_.bindings.assign_known_registers();
    program_.enter_unit(0);
    lower_.body.scope = program_.global = program_.unit_scopes[0];
    check_initialisers();
    entry_points_.find_entry_points();
    check_initialisers();
    finish_.run();
    if (program_.bench.messages.has_any_errors()) return nullptr;
    make_long_vectors_arrays(program_.bench.module, program_.bench.build);
    return std::move(program_.bench.made);
  }

 private:
  void check_initialisers() {
    // By index, because an initialiser may declare more variables (static locals).
    for (size_t i = 0; i < program_.variables.size(); ++i) {
      VariableInfo& variable = program_.variables[i];
      if (variable.kind == VariableKind::kGlobal) lower_.initialisers.initialise(&variable);
    }
  }

  // -- Names
  View view() const override { return {program_.options, program_.scopes.visible}; }
  void set_view(const View& view) override {
    program_.set_options(view.options);
    program_.scopes.visible = view.visible;
  }
  void enter(const Scope* scope) override { program_.enter_unit(scope->unit); }
  Scope* make_block_scope(Scope* parent) override {
    return program_.scopes.make_scope(ScopeKind::kBlock, parent);
  }
  void add_variable(Scope* scope, std::string_view name, SourceLocation location,
                    VariableInfo* variable) override {
    program_.scopes.add_symbol(scope, SymbolKind::kVariable, name, location)->variable = variable;
  }
  Symbol* find_local(Scope* scope, std::string_view name) override {
    return program_.scopes.find_local(scope, name);
  }
  Symbol* find_taken(Scope* scope, std::string_view name) override {
    return program_.scopes.find_taken(scope, name);
  }
  Symbol* find(Scope* scope, std::string_view name) override {
    return program_.scopes.find(scope, name);
  }
  Symbol* find_member(StructInfo* structure, std::string_view name) override {
    return program_.scopes.find_member(structure, name);
  }
  Symbol* resolve_name(const QualifiedName& name, Scope* scope, bool quiet) override {
    return parts_.resolver.resolve_name(name, scope, quiet);
  }
  void report_unknown(CheckId id, SourceLocation location,
                      const std::vector<std::string>& arguments, std::string_view text,
                      Scope* scope, bool with_outer) override {
    program_.scopes.report_unknown(id, location, arguments, text, scope, with_outer);
  }
  const Type* resolve_type(const TypeSyntax* syntax, Scope* scope) override {
    return parts_.resolver.resolve_type(syntax, scope);
  }
  const Type* resolve_variable_type(const VariableDecl* decl, Scope* scope) override {
    return parts_.resolver.resolve_variable_type(decl, scope);
  }
  const Type* type_argument(const TemplateArgument& argument, Scope* scope) override {
    return parts_.resolver.type_argument(argument, scope);
  }
  bool check_variable_type(const Type* type, SourceLocation location,
                           std::string_view name) override {
    return parts_.variables.check_variable_type(type, location, name);
  }
  void check_payload_use(const Type* type, SourceLocation location) override {
    parts_.payload_rules.check_payload_use(type, location);
  }
  const Type* ray_desc() const override { return program_.ray_desc->type; }
  const Type* triangle_positions() const override { return program_.triangle_positions->type; }
  const Type* hit_object() const override { return program_.hit_object->type; }
  void declare(const Decl* declaration, Scope* scope) override {
    parts_.declarations.declare(declaration, scope);
  }
  void declare_static(const VariableDecl* decl, const Type* type, Scope* scope) override {
    parts_.variables.declare_static(decl, type, scope);
  }
  VariableInfo* make_variable() override { return &program_.variables.emplace_back(); }
  StructInfo* instantiate_struct(StructTemplate* structure, const NamePart& part,
                                 SourceLocation location, Scope* scope) override {
    return parts_.templates.instantiate_struct(structure, part, location, scope);
  }
  FunctionInfo* instantiate_function(FunctionInfo* function,
                                     std::span<const TemplateArgument> written, Scope* use_scope,
                                     const std::vector<Value>& arguments) override {
    return parts_.templates.instantiate_function(function, written, use_scope, arguments);
  }
  FunctionInfo* copy_function(const FunctionInfo& function) override {
    return &program_.functions.emplace_back(function);
  }
  bool is_importable(const FunctionInfo& function) const override {
    return imports_.is_importable(function);
  }
  void make_import(FunctionInfo* function, SourceLocation use) override {
    imports_.make_import(function, use);
  }

  Program program_;
  Lowerer lower_{*this, program_.bench};
  NameParts parts_{program_, lower_};
  Exports exports_{program_, lower_};
  Imports imports_{program_, lower_, exports_};
  EntryPoints entry_points_{program_, lower_, exports_};
  Subobjects subobjects_{program_, lower_};
  Finish finish_{program_, lower_};
};

}  // namespace

std::unique_ptr<ir::Module> check_linked(const Link& link, const SourceManager& sources,
                                         DiagnosticEngine& diagnostics) {
  return Checker(link.units[0].options, &link, sources, diagnostics).run(link);
}

std::unique_ptr<ir::Module> check(const TranslationUnit& unit, const CheckOptions& options,
                                  const SourceManager& sources, DiagnosticEngine& diagnostics) {
  return Checker(options, nullptr, sources, diagnostics).run(unit);
}

}  // namespace kaamos::hlsl
