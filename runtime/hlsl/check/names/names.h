// SPDX-License-Identifier: MIT
//
// Answers what bodies ask about names: the lowerer knows nothing else of how they are declared.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/names/messages.h"
#include "runtime/hlsl/check/names/options.h"
#include "runtime/hlsl/check/names/symbols.h"

namespace kaamos::hlsl {

class Names {
 public:
  virtual ~Names() = default;

  // -- Whose code it is, and what it sees
  struct View {
    const CheckOptions* options = nullptr;
    uint32_t visible = ~0u;  // symbols with a later sequence are not declared yet
  };
  virtual View view() const = 0;
  virtual void set_view(const View& view) = 0;
  // Takes the options of the library that the scope belongs to.
  virtual void enter(const Scope* scope) = 0;
  void see(uint32_t sequence) { set_view({view().options, sequence}); }
  const CheckOptions& options() const { return *view().options; }

  // -- Scopes
  virtual Scope* make_block_scope(Scope* parent) = 0;
  virtual void add_variable(Scope* scope, std::string_view name, SourceLocation location,
                            VariableInfo* variable) = 0;
  virtual Symbol* find_local(Scope* scope, std::string_view name) = 0;
  // Returns what keeps variables and functions from having the name in this scope.
  virtual Symbol* find_taken(Scope* scope, std::string_view name) = 0;
  virtual Symbol* find(Scope* scope, std::string_view name) = 0;
  virtual Symbol* find_member(StructInfo* structure, std::string_view name) = 0;
  // Reports what is missing, unless `quiet`.
  virtual Symbol* resolve_name(const QualifiedName& name, Scope* scope, bool quiet) = 0;
  // Adds a note that suggests what may have been meant.
  virtual void report_unknown(CheckId id, SourceLocation location,
                              const std::vector<std::string>& arguments, std::string_view text,
                              Scope* scope, bool with_outer) = 0;

  // -- Types
  virtual const Type* resolve_type(const TypeSyntax* syntax, Scope* scope) = 0;
  // The type of a variable; `auto` takes that of the initialiser.
  virtual const Type* resolve_variable_type(const VariableDecl* decl, Scope* scope) = 0;
  virtual const Type* type_argument(const TemplateArgument& argument, Scope* scope) = 0;
  // Reports an error and returns false if a variable cannot have it.
  virtual bool check_variable_type(const Type* type, SourceLocation location,
                                   std::string_view name) = 0;
  virtual void check_payload_use(const Type* type, SourceLocation location) = 0;
  virtual const Type* ray_desc() const = 0;
  virtual const Type* hit_object() const = 0;          // not before Shader Model 6.9
  virtual const Type* triangle_positions() const = 0;  // not before Shader Model 6.10

  // -- Declarations
  virtual void declare(const Decl* declaration, Scope* scope) = 0;
  virtual void declare_static(const VariableDecl* decl, const Type* type, Scope* scope) = 0;
  virtual VariableInfo* make_variable() = 0;

  // -- Functions and templates
  virtual StructInfo* instantiate_struct(StructTemplate* structure, const NamePart& part,
                                         SourceLocation location, Scope* scope) = 0;
  // Null if it does not fit the arguments.
  virtual FunctionInfo* instantiate_function(FunctionInfo* function,
                                             std::span<const TemplateArgument> written,
                                             Scope* use_scope,
                                             const std::vector<Value>& arguments) = 0;
  virtual FunctionInfo* copy_function(const FunctionInfo& function) = 0;
  // Returns whether it may be a function of another library, without a body here.
  virtual bool is_importable(const FunctionInfo& function) const = 0;
  virtual void make_import(FunctionInfo* function, SourceLocation use) = 0;
};

}  // namespace kaamos::hlsl
