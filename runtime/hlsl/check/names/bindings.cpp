// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/bindings.h"

#include <algorithm>

#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/check/names/name_parts.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

void Bindings::apply_register(BindingInfo* binding, const Annotations& annotations) {
  for (const RegisterBinding& written : annotations.registers) {
    if (written.register_class != 0 &&
        written.register_class != kClassLetters[binding->register_class]) {
      report(CheckId::kRegisterClass, written.location,
             {std::string(1, written.register_class) + std::to_string(written.number),
              std::string(1, kClassLetters[binding->register_class]), binding->name});
      continue;
    }
    if (written.register_class != 0) {
      if (binding->has_register) {
        report(CheckId::kTwoRegisters, written.location, {binding->name});
        continue;
      }
      binding->has_register = true;
      binding->register_index = written.number;
      if (uint64_t{written.number} + (binding->count == kUnboundedCount ? 0 : binding->count - 1) >
          0xFFFFFFFFu) {
        report(CheckId::kRegisterRange, written.location, {binding->name});
      }
    }
    if (written.has_space) {
      binding->has_space = true;
      binding->space = written.space;
    }
  }
}

VariableInfo* Bindings::make_binding(const std::string& name, const Type* type,
                                     SourceLocation location) {
  BindingInfo* binding = &program_.bindings.emplace_back();
  binding->unit = program_.global->unit;
  binding->name = name;
  binding->place = location.raw;
  binding->automatic_space = program_.options->automatic_space;
  binding->is_array = type->is_array();
  const Type* element = type;
  for (; element->is_array(); element = element->element) {
    binding->count = element->count == 0
                         ? kUnboundedCount
                         : std::min(kUnboundedCount, binding->count * element->count);
  }
  if (type->is_array() && type->count == 0) binding->count = kUnboundedCount;
  binding->type = element;
  binding->resource = element->ir;
  binding->register_class = traits_of(element->resource).register_class;
  if (has_members(element->resource)) {
    binding->size_bytes = layout_of(element->element, ir::Layout::kConstantBuffer).size;
  } else if (has_elements(element->resource)) {
    constexpr uint32_t kMaxElementBytes = 2048;
    binding->size_bytes = layout_of(element->element, ir::Layout::kStructured).size;
    if (binding->size_bytes > kMaxElementBytes) {
      report(CheckId::kElementSize, location, {name, std::to_string(binding->size_bytes)});
    }
  }
  VariableInfo* info = &program_.variables.emplace_back();
  info->kind = VariableKind::kBinding;
  info->type = type;
  info->is_const = true;
  info->binding = binding;
  return info;
}

void Bindings::declare_binding(const VariableDecl* decl, const Type* type, Scope* scope) {
  VariableInfo* info = make_binding(Scopes::qualify(scope, decl->name), type, decl->location);
  info->name = decl->name;
  const TypeSyntax* written = decl->type;
  while (written->kind == TypeSyntaxKind::kArray) written = written->element;
  info->binding->is_ordered =
      written->kind == TypeSyntaxKind::kNamed && is_ordered_view(written->name->last().identifier);
  apply_register(info->binding, decl->annotations);
  scopes_.add_symbol(scope, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
}

void Bindings::declare_buffer(const BufferDecl* decl, Scope* scope) {
  const ir::ResourceKind kind = decl->is_texture_buffer ? ir::ResourceKind::kTextureBuffer
                                                        : ir::ResourceKind::kConstantBuffer;
  StructInfo* structure = parts_.structs.make_struct(nullptr, scope, std::string(decl->name));
  structure->complete = true;
  BindingInfo* binding = &program_.bindings.emplace_back();
  binding->unit = program_.global->unit;
  binding->name = decl->name;
  binding->place = decl->location.raw;
  binding->automatic_space = program_.options->automatic_space;
  binding->register_class = traits_of(kind).register_class;
  // Set before the members, because the size of an array may (wrongly) name one of them.
  binding->type = types_.resource(kind, structure->type);
  binding->resource = binding->type->ir;
  apply_register(binding, decl->annotations);
  std::vector<BufferMember> members;
  for (const Decl* member : decl->members) {
    const auto* variable = as<VariableDecl>(member);
    if (!variable || (variable->modifiers & (kModStatic | kModGroupshared))) {
      parts_.declarations.declare(member, scope);
      continue;
    }
    const Type* type = parts_.resolver.resolve_type(variable->type, scope);
    if (scopes_.find_taken(scope, variable->name)) {
      report(CheckId::kRedefinition, variable->location, {std::string(variable->name)});
      continue;
    }
    bool is_valid = parts_.variables.check_variable_type(type, variable->location, variable->name);
    if (is_valid) {
      const Type* element = type;
      while (element->is_array()) element = element->element;
      if (element->is_resource()) {
        // DXC takes resources out of the block, too.
        declare_binding(variable, type, scope);
        continue;
      }
      if (type->is_array() && type->count == 0) {
        report(CheckId::kUnboundedVariable, variable->location, {std::string(variable->name)});
        is_valid = false;
      }
    }
    if (is_valid) {
      members.push_back(make_member(variable, type, scope, binding, structure->ir));
      members.back().written = pack_offset(variable, members.back());
      continue;
    }
    VariableInfo* info = &program_.variables.emplace_back();
    info->name = variable->name;
    info->type = types_.error();
    info->is_const = true;
    scopes_.add_symbol(scope, SymbolKind::kVariable, variable->name, variable->location)->variable =
        info;
  }
  report_overlaps(members);
  place(members, binding, structure->ir);
}

// Only offsets that are written can overlap, and DXC refuses them in a cbuffer.
void Bindings::report_overlaps(const std::vector<BufferMember>& members) {
  for (size_t i = 0; i < members.size(); ++i) {
    const BufferMember& member = members[i];
    if (member.written < 0) continue;
    for (size_t k = 0; k < i; ++k) {
      const BufferMember& other = members[k];
      if (other.written < 0 || member.written >= other.written + other.size ||
          other.written >= member.written + member.size) {
        continue;
      }
      report(CheckId::kPackOverlap, member.location,
             {std::string(member.name), std::string(other.name)});
      break;
    }
  }
}

// The byte offset of packoffset; -1 without one.
int64_t Bindings::pack_offset(const VariableDecl* decl, const BufferMember& member) {
  const PackOffset* pack = decl->annotations.pack_offset;
  if (!pack) return -1;
  const Type* type = member.type;
  const uint64_t bytes = uint64_t{pack->register_index} * kRowBytes + pack->component * 4;
  const bool whole_row = type->is_array() || type->is_struct() || type->is_matrix();
  const bool straddles =
      type->is_numeric() && !type->is_matrix() && pack->component * 4 + member.size > kRowBytes;
  if (bytes <= kMaxBufferBytes - 4 && !straddles && (!whole_row || pack->component == 0)) {
    return static_cast<int64_t>(bytes);
  }
  report(CheckId::kPackOffset, pack->location, {std::string(decl->name), to_string(type)});
  return -1;
}

// Declares the variable and adds its memory to the buffer's struct.
BufferMember Bindings::make_member(const VariableDecl* decl, const Type* type, Scope* scope,
                                   BindingInfo* buffer, ir::Struct* structure) {
  if (contains_hit_object(type)) {
    report(CheckId::kHitObjectPlace, decl->location, {"a constant buffer"});
  }
  BufferMember member{.name = decl->name, .location = decl->location, .type = type};
  if (contains_long_vector(type)) {
    report(CheckId::kLongVectorPlace, decl->location,
           {"constant and texture buffers", to_string(type)});
  }
  if (contains_resource(type)) {
    parts_.split_structs.declare_split(decl, type, scope, buffer, structure, &member);
    return member;
  }
  VariableInfo* info = &program_.variables.emplace_back();
  info->kind = VariableKind::kBufferMember;
  info->name = decl->name;
  info->type = type;
  info->is_const = true;
  info->binding = buffer;
  scopes_.add_symbol(scope, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
  member.size = layout_of(type, ir::Layout::kConstantBuffer).size;
  member.parts.push_back({info, structure->fields.size()});
  ir::Field& field = structure->fields.emplace_back();
  field.name = decl->name;
  field.type = type->ir;
  const Type* element = type;
  while (element->is_array()) element = element->element;
  field.row_major = element->is_matrix() && element->row_major;
  return member;
}

void Bindings::place(const std::vector<BufferMember>& members, BindingInfo* buffer,
                     ir::Struct* structure) {
  const PlacedMembers placed = place_members(members, *structure);
  buffer->size_bytes = placed.size;
  if (!placed.too_far) return;
  report(CheckId::kBufferSize, placed.too_far->location,
         {buffer->name, std::to_string(placed.size)});
}

void Bindings::open_globals_buffer(SourceLocation location) {
  if (globals_buffer_) return;
  StructInfo* structure = parts_.structs.make_struct(nullptr, program_.global, "$Globals");
  structure->complete = true;
  globals_struct_ = structure->ir;
  globals_buffer_ = &program_.bindings.emplace_back();
  globals_buffer_->unit = program_.global->unit;
  program_.facts.globals_buffers.push_back(globals_buffer_);
  globals_buffer_->name = "$Globals";
  globals_buffer_->register_class = 2;
  globals_buffer_->place = location.raw;
  globals_buffer_->automatic_space = program_.options->automatic_space;
  globals_buffer_->type = types_.resource(ir::ResourceKind::kConstantBuffer, structure->type);
  globals_buffer_->resource = globals_buffer_->type->ir;
}

// The byte offset of register(cN), which works as packoffset does; -1 without one. Where a struct
// holds resources, it is also the offset of what else it has, whichever the register's letter, and
// the last register counts. [DXC: CGMSHLSLRuntime::AddConstant]
int64_t Bindings::constant_register(const VariableDecl* decl, const BufferMember& member) {
  const bool is_split = contains_resource(member.type);
  int64_t offset = -1;
  for (const RegisterBinding& written : decl->annotations.registers) {
    const bool counts = is_split ? written.register_class != 0 && !written.has_space
                                 : written.register_class == 'c';
    if (!counts) continue;
    const uint64_t bytes = uint64_t{written.number} * kRowBytes;
    if (bytes + member.size > kMaxBufferBytes) {
      report(CheckId::kPackOffset, written.location,
             {std::string(decl->name), to_string(member.type)});
      return -1;
    }
    offset = static_cast<int64_t>(bytes);
    if (!is_split) break;
  }
  return offset;
}

void Bindings::place_globals() {
  if (globals_buffer_) place(globals_, globals_buffer_, globals_struct_);
}

// A global that is neither static nor a resource is a member of the constant buffer $Globals.
void Bindings::declare_uniform(const VariableDecl* decl, const Type* type, Scope* scope) {
  if (type->is_array() && type->count == 0) {
    report(CheckId::kUnboundedVariable, decl->location, {std::string(decl->name)});
    return;
  }
  open_globals_buffer(decl->location);
  for (const RegisterBinding& written : decl->annotations.registers) {
    if (!written.has_space) continue;
    report(CheckId::kConstantSpace, written.location, {std::string(decl->name)});
  }
  if (decl->initializer) {
    report(CheckId::kUniformInitialiser, decl->location, {std::string(decl->name)});
  }
  globals_.push_back(make_member(decl, type, scope, globals_buffer_, globals_struct_));
  globals_.back().written = constant_register(decl, globals_.back());
}

// A library by itself has given its resources registers, which root signatures rely on.
void Bindings::assign_known_registers() {
  for (BindingInfo& binding : program_.bindings) {
    if (binding.has_register) continue;
    for (const LinkedUnit::Register& known : program_.link->units[binding.unit].registers) {
      if (known.binding != binding.name) continue;
      binding.register_index = known.index;
      binding.space = known.space;
      binding.has_register = binding.has_space = binding.is_automatic = true;
      break;
    }
  }
}

}  // namespace kaamos::hlsl
