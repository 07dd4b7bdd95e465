// SPDX-License-Identifier: MIT
//
// The checker's knowledge about names (bindings, variables, functions, scopes), and the values that
// expressions evaluate to.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/hlsl/builder/facts.h"
#include "runtime/hlsl/check/names/conversion_costs.h"
#include "runtime/hlsl/check/names/types.h"
#include "runtime/hlsl/front/ast.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct BindingInfo : BindingFacts {
  const Type* type = nullptr;  // of the resource, or of an element of an array of them
};

enum class VariableKind : uint8_t { kLocal, kGlobal, kBufferMember, kBinding, kSplit };

struct FunctionInfo;
struct VariableInfo;

// A global struct that holds resources, or a part of it. Each resource is a binding of its own; the
// rest is memory of a constant buffer.
struct SplitPart {
  const Type* type = nullptr;
  VariableInfo* variable = nullptr;   // a resource, or memory; null: parts
  std::vector<SplitPart> parts = {};  // in the order of ir::Struct::fields, or of the elements
};

// A local one has its ir::Variable once something refers to it.
struct VariableInfo : GlobalFacts {
  VariableKind kind = VariableKind::kLocal;
  std::string_view name;
  const Type* type = nullptr;
  bool is_const = false;
  uint32_t references = 0;             // how often it has been named so far
  bool is_loop_variable = false;       // of a `for` of HLSL 2018, which outlives the loop
  BindingInfo* binding = nullptr;      // kBufferMember, kBinding
  uint32_t offset = 0;                 // kBufferMember
  SplitPart split;                     // kSplit
  const ir::Expr* constant = nullptr;  // kLocal: a const scalar whose value is known
  // kGlobal: the initialiser is lowered at the first use.
  const VariableDecl* decl = nullptr;
  Scope* scope = nullptr;
  uint32_t sequence = 0;
  enum class State : uint8_t { kPending, kRunning, kDone } state = State::kDone;
  std::unique_ptr<FunctionInfo> initialiser_info;  // GlobalFacts::initialiser
};

struct ParameterInfo {
  std::string_view name;
  const Type* type = nullptr;
  bool is_in = true;
  bool is_out = false;
  bool is_const = false;
  const ParameterDecl* decl = nullptr;
  const Expr* default_value = nullptr;
  BindingInfo* binding = nullptr;  // an unbounded array of resources: what the call passes
  bool is_unbounded() const { return type->is_array() && type->count == 0; }
  // `float a[]`, which has the size of what is passed.
  bool is_unsized() const { return is_unbounded() && !contains_resource(type->element); }
};

// An argument of a template: a type, or a value of a scalar type.
struct TemplateValue {
  const Type* type = nullptr;
  const ir::Expr* value = nullptr;
  const Type* value_type = nullptr;    // the parameter's, once known
  const Type* written_type = nullptr;  // of a written value; null: deduced
  bool is_set() const { return type || value; }
};
using TemplateValues = std::vector<TemplateValue>;

// What is read of an input besides its value. All are of the input's type but kInverseW: 1 / w in
// the middle of the pixel and its slopes to the right and down, or 1, 0 and 0 of an input without
// perspective. Slopes are those of the input times 1 / w.
enum class InputFact : size_t {
  kSecondVertex,
  kThirdVertex,
  kMiddle,
  kCentroid,
  kSlopeX,
  kSlopeY,
  kInverseW
};
inline constexpr size_t kInputFacts = 7;

// GetAttributeAtVertex or EvaluateAttribute* of a parameter, or of the part of it that the indices
// lead to; of a matrix, the last one is that of a row, or a column if it is not row_major.
struct InputRead {
  const ir::Variable* parameter = nullptr;
  std::vector<uint32_t> path;
  VariableInfo* facts[kInputFacts] = {};  // static variables that the entry point fills
  SourceLocation location;
  bool of_vertices = false;  // GetAttributeAtVertex
};

struct FunctionInfo : FunctionFacts {
  std::string_view name;
  std::string qualified;
  const FunctionDecl* decl = nullptr;
  const FunctionDecl* definition = nullptr;
  const FunctionDecl* announced = nullptr;  // a template's declaration before its definition
  Scope* scope = nullptr;                   // what its parameters' types and its body can see
  StructInfo* owner = nullptr;
  bool is_static = false;
  bool is_const_method = false;
  bool is_exported = false;
  std::vector<ParameterInfo> parameters;
  const Type* result = nullptr;
  // The local variable or parameter that the function returns, if its result is a RayQuery.
  const ir::Variable* returned_query = nullptr;
  uint32_t sequence = 0;
  uint32_t body_sequence = 0;
  bool signature_failed = false;
  // A type of a stage that is not offered, such as TriangleStream: an error once something uses the
  // function.
  const TypeSyntax* other_stage = nullptr;

  bool is_template = false;
  std::unordered_map<std::string, FunctionInfo*> instances;
  // One for each combination of unbounded arrays, or types of arrays, that calls pass.
  std::map<std::vector<const void*>, FunctionInfo*> bound_instances;
  std::string template_suffix;  // "<float>" for an instance
  TemplateValues template_values;

  enum class State : uint8_t { kPending, kLowering, kDone } state = State::kPending;
  FunctionInfo* linked = nullptr;  // without a body: its definition in another library

  std::vector<InputRead> input_reads;
  bool is_pixel_entry = false;
};

enum class SymbolKind : uint8_t {
  kVariable,
  kField,  // a field of the enclosing struct, reached through `this`
  kFunctions,
  kType,
  kNamespace,
  kStructTemplate,
  kAliasTemplate,
  kConstant,  // enumerator, template value argument, built-in constant
};

// A function or static member that is defined outside of its struct template.
struct OuterMember {
  const FunctionDecl* function = nullptr;
  const VariableDecl* variable = nullptr;
  std::span<const TemplateParameter> parameters = {};  // the struct's, by the names used there
};

struct StructTemplate {
  const StructDecl* decl = nullptr;
  std::vector<const StructDecl*> partials;  // partial specializations
  std::vector<OuterMember> members;
  Scope* scope = nullptr;
  std::string name;
  std::unordered_map<std::string, StructInfo*> instances;
};

struct Symbol {
  SymbolKind kind = SymbolKind::kVariable;
  std::string_view name;
  SourceLocation location;
  uint32_t sequence = 0;  // 0: visible everywhere in its scope
  VariableInfo* variable = nullptr;
  std::vector<FunctionInfo*> functions;
  const Type* type = nullptr;       // kType, kConstant
  bool lacks_matrix_order = false;  // an alias for a matrix without row_major or column_major
  Scope* scope = nullptr;           // kNamespace; kType: the members of a struct or enum
  StructTemplate* struct_template = nullptr;
  const TypeAliasDecl* alias = nullptr;
  const ir::Expr* value = nullptr;  // kConstant
  uint32_t field = 0;               // kField: position in StructInfo::fields
  Symbol* hidden = nullptr;  // the struct or enum of the same name and scope [C++: class.name]
};

enum class ScopeKind : uint8_t { kGlobal, kNamespace, kStruct, kEnum, kTemplate, kBlock };

struct Scope {
  ScopeKind kind = ScopeKind::kBlock;
  Scope* parent = nullptr;
  uint32_t unit = 0;  // which of the libraries that are linked
  std::string name;   // qualified, without a trailing ::
  StructInfo* structure = nullptr;
  std::unordered_map<std::string_view, Symbol*> symbols;
  std::vector<Scope*> used;  // using namespace
};

enum class ValueKind : uint8_t {
  kError,
  kExpr,      // expr: a value, or a place in a variable
  kMemory,    // in a buffer: expr is the resource, offset the byte offset
  kTyped,     // a texel: expr is the resource, coordinates its location
  kBindings,  // array of resources, partly indexed: binding; offset is the flat index so far
  kHeap,      // ResourceDescriptorHeap, SamplerDescriptorHeap, or an element of one until its
              // type is known: offset is the index
  kSplit,     // split, of which no part has been chosen yet
  kMips,      // texture.mips, texture.mips[level] (offset); .sample of a multisampled texture
  kInitList,  // init_list, which takes the type of its target
};

// The outcome of lowering an expression. Nothing is read from memory until load().
struct Value {
  ValueKind kind = ValueKind::kError;
  const Type* type = nullptr;
  bool is_place = false;
  bool is_const = false;
  const ir::Expr* expr = nullptr;
  // kMemory: structured buffers' element index. kTyped: a component known at run time only.
  const ir::Expr* element = nullptr;
  const ir::Expr* offset = nullptr;
  const ir::Expr* coordinates = nullptr;
  const ir::Expr* mip = nullptr;
  ir::Layout layout = ir::Layout::kStructured;
  uint32_t component_stride = 0;  // kMemory: bytes, for a vector that is not contiguous
  // kMemory, kTyped: a swizzle of `whole` that has not been applied yet.
  std::vector<uint8_t> components;
  const Type* whole = nullptr;
  BindingInfo* binding = nullptr;
  const SplitPart* split = nullptr;
  const FieldInfo* bits = nullptr;  // a bit field of the place, which has the type of its unit
  bool is_sampler_heap = false;
  const InitListExpr* init_list = nullptr;
  // What a cast of numbers was applied to, if that is a place: it is written through the cast.
  std::shared_ptr<const Value> under_cast;
  // The value that the place held when it was evaluated, if a later argument may have changed it.
  const ir::Expr* saved = nullptr;
  SourceLocation location;

  bool failed() const { return kind == ValueKind::kError; }
};

// Returns whether a type says `const` anywhere.
bool is_const_type(const TypeSyntax* syntax);

struct ConversionRank {
  bool possible = false;
  ConversionCost cost = 0;  // lower is better
};

}  // namespace kaamos::hlsl
