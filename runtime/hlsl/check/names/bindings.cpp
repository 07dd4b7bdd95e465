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
  if (element->resource == ir::ResourceKind::kConstantBuffer) {
    binding->size_bytes = layout_of(element->element, ir::Layout::kConstantBuffer).size;
  } else if (has_elements(element->resource)) {
    binding->size_bytes = layout_of(element->element, ir::Layout::kStructured).size;
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
  if (decl->is_texture_buffer) {
    report(CheckId::kUnsupported, decl->location, {"'tbuffer' (texture buffers)"});
  }
  StructInfo* structure = parts_.structs.make_struct(nullptr, scope, std::string(decl->name));
  structure->complete = true;
  BindingInfo* binding = &program_.bindings.emplace_back();
  binding->unit = program_.global->unit;
  binding->name = decl->name;
  binding->place = decl->location.raw;
  binding->automatic_space = program_.options->automatic_space;
  binding->register_class = 2;
  // Set before the members, because the size of an array may (wrongly) name one of them.
  binding->type = types_.resource(ir::ResourceKind::kConstantBuffer, structure->type);
  binding->resource = binding->type->ir;
  apply_register(binding, decl->annotations);
  uint32_t offset = 0;
  for (const Decl* member : decl->members) {
    const auto* variable = as<VariableDecl>(member);
    if (!variable || (variable->modifiers & (kModStatic | kModGroupshared))) {
      parts_.declarations.declare(member, scope);
      continue;
    }
    const Type* type = parts_.resolver.resolve_type(variable->type, scope);
    VariableInfo* info = &program_.variables.emplace_back();
    info->name = variable->name;
    info->type = types_.error();
    info->is_const = true;
    if (scopes_.find_taken(scope, variable->name)) {
      report(CheckId::kRedefinition, variable->location, {std::string(variable->name)});
      continue;
    }
    if (parts_.variables.check_variable_type(type, variable->location, variable->name)) {
      const Type* element = type;
      while (element->is_array()) element = element->element;
      if (element->is_resource()) {
        // DXC takes resources out of the block, too.
        declare_binding(variable, type, scope);
        continue;
      }
      if (contains_resource(type) && !(type->is_array() && type->count == 0)) {
        parts_.split_structs.declare_split(variable, type, scope, binding, structure->ir, &offset);
        continue;
      }
      if (type->is_array() && type->count == 0) {
        report(CheckId::kUnboundedVariable, variable->location, {std::string(variable->name)});
      } else {
        info->kind = VariableKind::kBufferMember;
        info->type = type;
        info->binding = binding;
        info->offset = place_member(type, offset, ir::Layout::kConstantBuffer);
        const LayoutSize size = layout_of(type, ir::Layout::kConstantBuffer);
        ir::Field& field = structure->ir->fields.emplace_back();
        if (const PackOffset* pack = variable->annotations.pack_offset) {
          const uint64_t bytes = uint64_t{pack->register_index} * kRowBytes + pack->component * 4;
          const bool whole_row = type->is_array() || type->is_struct() || type->is_matrix();
          const bool straddles = type->is_numeric() && !type->is_matrix() &&
                                 pack->component * 4 + size.size > kRowBytes;
          if (bytes > kMaxBufferBytes - 4 || straddles || (whole_row && pack->component != 0)) {
            report(CheckId::kPackOffset, pack->location,
                   {std::string(variable->name), to_string(type)});
          } else {
            info->offset = static_cast<uint32_t>(bytes);
            field.packoffset = static_cast<int32_t>(bytes);
          }
        }
        field.name = variable->name;
        field.type = type->ir;
        field.row_major = element->is_matrix() && element->row_major;
        offset = info->offset + size.size;
        binding->size_bytes = std::max(binding->size_bytes, offset);
        if (binding->size_bytes > kMaxBufferBytes) {
          report(CheckId::kBufferSize, variable->location,
                 {std::string(decl->name), std::to_string(binding->size_bytes)});
          offset = 0;
          binding->size_bytes = 0;
        }
      }
    }
    scopes_.add_symbol(scope, SymbolKind::kVariable, variable->name, variable->location)->variable =
        info;
  }
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

// The byte offset of register(cN), which works as packoffset does; -1 without one.
int64_t Bindings::constant_register(const VariableDecl* decl, const Type* type) {
  for (const RegisterBinding& written : decl->annotations.registers) {
    if (written.register_class != 'c') continue;
    const uint64_t bytes = uint64_t{written.number} * kRowBytes;
    if (bytes + layout_of(type, ir::Layout::kConstantBuffer).size <= kMaxBufferBytes) {
      return static_cast<int64_t>(bytes);
    }
    report(CheckId::kPackOffset, written.location, {std::string(decl->name), to_string(type)});
  }
  return -1;
}

void Bindings::note_split_globals(size_t first_variable, size_t first_field) {
  for (size_t i = first_variable; i < program_.variables.size(); ++i) {
    VariableInfo& part = program_.variables[i];
    if (part.kind != VariableKind::kBufferMember || part.binding != globals_buffer_) continue;
    globals_.push_back({&part, first_field++, part.offset % kRowBytes == 0});
  }
}

void Bindings::place_globals() {
  const auto is_written = [](const GlobalMember& member) { return member.written >= 0; };
  if (std::none_of(globals_.begin(), globals_.end(), is_written)) return;
  uint32_t end = 0;
  for (const bool written : {true, false}) {
    for (const GlobalMember& member : globals_) {
      if (is_written(member) != written) continue;
      VariableInfo& variable = *member.variable;
      if (member.begins_row) end = (end + kRowBytes - 1) / kRowBytes * kRowBytes;
      variable.offset = written ? static_cast<uint32_t>(member.written)
                                : place_member(variable.type, end, ir::Layout::kConstantBuffer);
      globals_struct_->fields[member.field].packoffset = static_cast<int32_t>(variable.offset);
      const LayoutSize size = layout_of(variable.type, ir::Layout::kConstantBuffer);
      end = std::max(end, variable.offset + size.size);
    }
  }
  globals_buffer_->size_bytes = end;
  if (end > kMaxBufferBytes) {
    report(CheckId::kBufferSize, {globals_buffer_->place}, {"$Globals", std::to_string(end)});
  }
}

// A global that is neither static nor a resource is a member of the constant buffer $Globals.
void Bindings::declare_uniform(const VariableDecl* decl, const Type* type, Scope* scope) {
  if (type->is_array() && type->count == 0) {
    report(CheckId::kUnboundedVariable, decl->location, {std::string(decl->name)});
    return;
  }
  open_globals_buffer(decl->location);
  if (decl->initializer) {
    report(CheckId::kUniformInitialiser, decl->location, {std::string(decl->name)});
  }
  if (contains_resource(type)) {
    const size_t variables = program_.variables.size();
    const size_t fields = globals_struct_->fields.size();
    parts_.split_structs.declare_split(decl, type, scope, globals_buffer_, globals_struct_,
                                       &globals_offset_);
    return note_split_globals(variables, fields);
  }
  VariableInfo* info = &program_.variables.emplace_back();
  globals_.push_back({info, globals_struct_->fields.size(), false, constant_register(decl, type)});
  info->kind = VariableKind::kBufferMember;
  info->name = decl->name;
  info->type = type;
  info->is_const = true;
  info->binding = globals_buffer_;
  info->offset = place_member(type, globals_offset_, ir::Layout::kConstantBuffer);
  globals_offset_ = info->offset + layout_of(type, ir::Layout::kConstantBuffer).size;
  globals_buffer_->size_bytes = globals_offset_;
  if (globals_offset_ > kMaxBufferBytes) {
    report(CheckId::kBufferSize, decl->location, {"$Globals", std::to_string(globals_offset_)});
    globals_offset_ = 0;
  }
  ir::Field& field = globals_struct_->fields.emplace_back();
  field.name = decl->name;
  field.type = type->ir;
  const Type* element = type;
  while (element->is_array()) element = element->element;
  field.row_major = element->is_matrix() && element->row_major;
  scopes_.add_symbol(scope, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
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
