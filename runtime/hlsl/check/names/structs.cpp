// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/structs.h"

#include <algorithm>

#include "runtime/hlsl/check/names/name_parts.h"
#include "runtime/hlsl/check/names/signatures.h"

namespace kaamos::hlsl {
namespace {

bool same_fields(const ir::Struct& one, const ir::Struct& other) {
  return std::equal(one.fields.begin(), one.fields.end(), other.fields.begin(), other.fields.end(),
                    [](const ir::Field& a, const ir::Field& b) {
                      return a.type == b.type && a.row_major == b.row_major;
                    });
}

}  // namespace

StructInfo* Structs::make_struct(const StructDecl* decl, Scope* parent, const std::string& name) {
  StructInfo* info = &program_.structs.emplace_back();
  info->decl = decl;
  info->name = Scopes::qualify(parent, name);
  info->ir = &bench_.module.struct_pool.emplace_back();
  // Structs in two functions, or from the headers of two libraries, may share a name.
  std::string unique = info->name;
  for (int i = 2; !names_.insert(unique).second; ++i) {
    unique = info->name + "#" + std::to_string(i);
  }
  info->ir->name = unique;
  if (decl) info->ir->location = locate(decl->location);
  info->scope = scopes_.make_scope(ScopeKind::kStruct, parent, name);
  info->scope->structure = info;
  types_.structure(info);
  return info;
}

void Structs::declare_struct(const StructDecl* decl, Scope* scope) {
  Symbol* symbol = decl->name.empty() ? nullptr : scopes_.find_local(scope, decl->name);
  if (decl->is_specialization) return parts_.specializations.specialize_struct(decl, scope);
  if (decl->is_template) {
    if (symbol && symbol->kind == SymbolKind::kStructTemplate) {
      if (!decl->is_definition) return;
      if (symbol->struct_template->decl->is_definition) {
        report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
        return;
      }
      symbol->struct_template->decl = decl;
      return;
    }
    StructTemplate* entry = &program_.struct_templates.emplace_back();
    entry->decl = decl;
    entry->scope = scope;
    entry->name = decl->name;
    scopes_.add_symbol(scope, SymbolKind::kStructTemplate, decl->name, decl->location)
        ->struct_template = entry;
    return;
  }
  StructInfo* info = nullptr;
  if (symbol) {
    const bool is_forward = symbol->kind == SymbolKind::kType && symbol->type->is_struct() &&
                            !symbol->type->structure->complete && symbol->type->structure->decl &&
                            !symbol->type->structure->decl->is_definition;
    const bool repeats =
        symbol->kind == SymbolKind::kType && symbol->type->is_struct() && !decl->is_definition;
    if (repeats) {
      program_.declared_types[decl] = symbol->type;
      return;
    }
    if (!is_forward) {
      report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
      return;
    }
    info = symbol->type->structure;
    info->decl = decl;
  } else {
    const std::string name = decl->name.empty()
                                 ? "anonymous_" + std::to_string(program_.structs.size())
                                 : std::string(decl->name);
    info = make_struct(decl, scope, name);
    if (!decl->name.empty()) {
      symbol = scopes_.add_symbol(scope, SymbolKind::kType, decl->name, decl->location);
      symbol->type = info->type;
      symbol->scope = info->scope;
    }
  }
  program_.declared_types[decl] = info->type;
  if (decl->is_definition) complete_struct(info);
}

void Structs::complete_struct(StructInfo* info) {
  const StructDecl* decl = info->decl;
  if (!decl->name.empty()) {
    Symbol* injected = scopes_.add_symbol(info->scope, SymbolKind::kType, decl->name, {});
    injected->type = info->type;
    injected->scope = info->scope;
  }
  for (const TypeSyntax* base_syntax : decl->bases) {
    const Type* base = parts_.resolver.resolve_type(base_syntax, info->scope->parent);
    if (base->is_error()) continue;
    if (!base->is_struct() || !base->structure->complete || base->structure == info) {
      report(CheckId::kBadBase, base_syntax->location, {to_string(base)});
    } else if (base->structure->decl && base->structure->decl->is_interface) {
      info->interfaces.push_back(base->structure);
    } else if (info->base) {
      report(CheckId::kUnsupported, base_syntax->location, {"more than one base struct"});
    } else {
      info->base = base->structure;
      ir::Field& field = info->ir->fields.emplace_back();
      field.name = "base";
      field.type = base->ir;
    }
  }
  for (const Decl* member : decl->members) declare_member(info, member);
  check_interfaces(info);
  info->complete = true;
  reuse_struct(info);
  parts_.payload_rules.check_payload_struct(info);
}

// A bit field goes into the field before it if that holds bit fields of types of the same size and
// has enough bits left. [Microsoft's C++ ABI, which DXC uses]
void Structs::declare_bit_field(StructInfo* info, const VariableDecl* decl, const Type* type) {
  const std::string name(decl->name.empty() ? "(unnamed)" : decl->name);
  const auto width =
      parts_.evaluator.constant_integer(decl->bit_width, info->scope, "the width of a bit field");
  if (type->is_error() || !width) return;
  if (program_.options->hlsl_version < 2021) {
    report(CheckId::kBitFieldVersion, decl->bit_width->location,
           {name, std::to_string(program_.options->hlsl_version)});
    return;
  }
  if (!(type->is_enum() || (type->is_scalar() && !is_floating(type->scalar)))) {
    report(CheckId::kBitFieldType, decl->location, {name, to_string(type)});
    return;
  }
  const uint32_t unit_bits = scalar_bytes(type->scalar, ScalarStorage::kBuffer) * 8;
  if (*width == 0 && decl->name.empty()) {
    info->open_bits = 0;
    return;
  }
  if (*width < 1 || *width > unit_bits) {
    report(CheckId::kBitFieldWidth, decl->bit_width->location,
           {name, std::to_string(*width), std::to_string(unit_bits), to_string(type)});
    return;
  }
  const auto bits = static_cast<uint8_t>(*width);
  const Type* unit = types_.scalar(unit_bits == 16   ? Scalar::kUint16
                                   : unit_bits == 64 ? Scalar::kUint64
                                                     : Scalar::kUint32);
  const bool joins = info->open_bits >= bits && same_type(info->fields.back().unit, unit);
  if (!joins) {
    ir::Field& ir_field = info->ir->fields.emplace_back();
    ir_field.name = "bits";
    ir_field.type = unit->ir;
    info->open_bits = unit_bits;
  }
  FieldInfo& field = info->fields.emplace_back();
  field.name = decl->name;
  field.type = type;
  field.decl = decl;
  field.index = static_cast<uint32_t>(info->ir->fields.size() - 1);
  field.unit = unit;
  field.bit_offset = static_cast<uint8_t>(unit_bits - info->open_bits);
  field.bit_width = bits;
  info->open_bits -= bits;
  if (decl->name.empty()) return;
  Symbol* symbol = scopes_.add_symbol(info->scope, SymbolKind::kField, decl->name, {});
  symbol->field = static_cast<uint32_t>(info->fields.size() - 1);
}

// `uint a : N;` has the semantic N, as in DXC, even if there is a number of that name.
void Structs::warn_of_width(const VariableDecl* decl, const Type* type, Scope* scope) {
  const Semantic* semantic = decl->annotations.semantic;
  const bool may_be_bits =
      type->is_enum() || (type->is_scalar() && !type->is_error() && !is_floating(type->scalar));
  if (!semantic || !may_be_bits) return;
  const Symbol* symbol = scopes_.find(scope, semantic->text);
  if (!symbol) return;
  const Type* meant = symbol->kind == SymbolKind::kVariable   ? symbol->variable->type
                      : symbol->kind == SymbolKind::kConstant ? symbol->type
                                                              : nullptr;
  const bool is_width = meant && (meant->is_enum() || (meant->is_scalar() && !meant->is_error() &&
                                                       !is_floating(meant->scalar)));
  if (!is_width) return;
  report(CheckId::kSemanticIsValue, semantic->location,
         {std::string(semantic->text), std::string(decl->name), to_string(type)});
}

void Structs::check_interfaces(StructInfo* info) {
  for (StructInfo* interface : info->interfaces) {
    for (const auto& [name, wanted] : interface->scope->symbols) {
      if (wanted->kind != SymbolKind::kFunctions) continue;
      for (const FunctionInfo* method : wanted->functions) {
        const Symbol* own = scopes_.find_member(info, name);
        const auto implements = [&](const FunctionInfo* candidate) {
          return candidate->is_template || have_same_parameters(*candidate, *method);
        };
        if (own && own->kind == SymbolKind::kFunctions &&
            std::any_of(own->functions.begin(), own->functions.end(), implements)) {
          continue;
        }
        report(CheckId::kInterfaceMethod, info->decl->location,
               {info->name, describe(*method), interface->name});
      }
    }
  }
}

void Structs::declare_member(StructInfo* info, const Decl* member) {
  const auto* variable = as<VariableDecl>(member);
  if (const auto* function = as<FunctionDecl>(member)) {
    parts_.functions.declare_function(function, info->scope, info);
    return;
  }
  if (!variable) {
    parts_.declarations.declare(member, info->scope);
    return;
  }
  const Type* type = parts_.resolver.resolve_type(variable->type, info->scope);
  if (!parts_.variables.check_variable_type(type, variable->location, variable->name))
    type = types_.error();
  if (type->is_query()) {
    report(CheckId::kRayQueryPlace, variable->location, {to_string(type), "a member of a struct"});
    type = types_.error();
  }
  if (!variable->name.empty() && scopes_.find_taken(info->scope, variable->name)) {
    report(CheckId::kRedefinition, variable->location, {std::string(variable->name)});
    return;
  }
  if (variable->bit_width) {
    declare_bit_field(info, variable, type);
    return;
  }
  if (variable->modifiers & kModStatic) {
    parts_.variables.declare_static(variable, type, info->scope);
    return;
  }
  if (type->is_array() && type->count == 0) {
    report(CheckId::kUnboundedVariable, variable->location, {std::string(variable->name)});
    type = types_.error();
  }
  if (variable->initializer) {
    report(CheckId::kMemberInitialiser, variable->location, {std::string(variable->name)});
  }
  warn_of_width(variable, type, info->scope);
  if (variable->annotations.pack_offset) {
    report(CheckId::kPackOffsetPlace, variable->annotations.pack_offset->location,
           {std::string(variable->name)});
  }
  info->open_bits = 0;
  FieldInfo& field = info->fields.emplace_back();
  field.name = variable->name;
  field.type = type;
  field.decl = variable;
  field.index = static_cast<uint32_t>(info->ir->fields.size());
  ir::Field& ir_field = info->ir->fields.emplace_back();
  ir_field.name = variable->name;
  // A float stands in for an unknown type, so that the struct stays usable in messages.
  ir_field.type = type->is_error() ? types_.scalar(Scalar::kFloat32)->ir : type->ir;
  const Type* element = type;
  while (element->is_array()) element = element->element;
  ir_field.row_major = element->is_matrix() && element->row_major;
  Symbol* symbol = scopes_.add_symbol(info->scope, SymbolKind::kField, variable->name, {});
  symbol->field = static_cast<uint32_t>(info->fields.size() - 1);
}

// Libraries that are linked often include one header. Its structs are the same type in all of them.
void Structs::reuse_struct(StructInfo* info) {
  if (!program_.link) return;
  const auto [first, last] = by_name_.equal_range(info->name);
  for (auto at = first; at != last; ++at) {
    const StructInfo& other = *at->second;
    if (other.scope->unit == info->scope->unit || !same_fields(*other.ir, *info->ir)) continue;
    types_.share(info, other);
    return;
  }
  by_name_.emplace(info->name, info);
}

}  // namespace kaamos::hlsl
