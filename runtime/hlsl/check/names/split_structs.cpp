// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/split_structs.h"

#include <algorithm>

#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/check/names/name_parts.h"

namespace kaamos::hlsl {
namespace {

constexpr size_t kMaxSplitParts = 4096;

uint32_t next_row(uint32_t offset) {
  return (offset + kRowBytes - 1) / kRowBytes * kRowBytes;
}

}  // namespace

// The facts about the variable that are known while its parts are made.
struct SplitStructs::SplitPlan {
  const VariableDecl* decl;
  BindingInfo* buffer;
  ir::Struct* members;  // of the buffer
  BufferMember* member;
  uint32_t end = 0;  // of its memory so far
  // For each class of registers: the one that the next resource gets.
  struct Next {
    const RegisterBinding* written = nullptr;
    uint64_t number = 0;
    bool is_used = false;
  };
  Next next[4] = {};
  const RegisterBinding* space = nullptr;  // a space alone, for all of them
  size_t parts = 0;
};

SplitPart SplitStructs::split_resource(const Type* type, const std::string& name, SplitPlan& plan) {
  SplitPart part{.type = type,
                 .variable = parts_.bindings.make_binding(name, type, plan.decl->location)};
  BindingInfo* binding = part.variable->binding;
  SplitPlan::Next& next = plan.next[binding->register_class];
  const RegisterBinding* written = next.written ? next.written : plan.space;
  if (next.written) {
    binding->has_register = true;
    binding->register_index = static_cast<uint32_t>(next.number);
    next.is_used = true;
    next.number += binding->count;
    if (next.number > (uint64_t{1} << 32)) {
      report(CheckId::kRegisterRange, next.written->location, {name});
    }
  }
  if (written && written->has_space) {
    binding->has_space = true;
    binding->space = written->space;
  }
  return part;
}

SplitPart SplitStructs::split_memory(const Type* type, const std::string& name, SplitPlan& plan) {
  VariableInfo* info = &program_.variables.emplace_back();
  info->kind = VariableKind::kBufferMember;
  info->type = type;
  info->is_const = true;
  info->binding = plan.buffer;
  const uint32_t offset = place_member(type, plan.end, ir::Layout::kConstantBuffer);
  plan.end = std::min(offset + layout_of(type, ir::Layout::kConstantBuffer).size, kMaxLayoutBytes);
  plan.member->parts.push_back({info, plan.members->fields.size(), offset});
  ir::Field& field = plan.members->fields.emplace_back();
  field.name = name;
  field.type = type->ir;
  const Type* element = type;
  while (element->is_array()) element = element->element;
  field.row_major = element->is_matrix() && element->row_major;
  return {.type = type, .variable = info};
}

SplitPart SplitStructs::split(const Type* type, const std::string& name, SplitPlan& plan) {
  SplitPart part{.type = type};
  if (++plan.parts > kMaxSplitParts) return part;
  const Type* element = type;
  while (element->is_array()) element = element->element;
  if (element->is_resource()) {
    if (type->is_array()) plan.end = next_row(plan.end);
    return split_resource(type, name, plan);
  }
  if (!contains_resource(type)) return split_memory(type, name, plan);
  if (type->is_array()) {
    for (uint32_t i = 0; i < type->count && plan.parts <= kMaxSplitParts; ++i) {
      part.parts.push_back(split(type->element, name + "." + std::to_string(i), plan));
    }
    return part;
  }
  plan.end = next_row(plan.end);
  const StructInfo& structure = *type->structure;
  if (structure.base) part.parts.push_back(split(structure.base->type, name, plan));
  for (const FieldInfo& field : structure.fields) {
    if (!field.begins_field()) continue;
    part.parts.push_back(
        split(field.unit ? field.unit : field.type, name + "." + std::string(field.name), plan));
  }
  return part;
}

void SplitStructs::declare_split(const VariableDecl* decl, const Type* type, Scope* scope,
                                 BindingInfo* buffer, ir::Struct* members, BufferMember* member) {
  SplitPlan plan{.decl = decl, .buffer = buffer, .members = members, .member = member};
  for (const RegisterBinding& written : decl->annotations.registers) {
    const size_t register_class = std::string_view("tubs").find(written.register_class);
    if (written.register_class == 0) {
      plan.space = &written;
    } else if (written.register_class == 'c') {
      continue;  // for the memory
    } else if (register_class == std::string_view::npos) {
      report(CheckId::kSplitRegister, written.location,
             {std::string(decl->name), std::string(1, written.register_class)});
    } else if (plan.next[register_class].written) {
      report(CheckId::kTwoRegisters, written.location, {std::string(decl->name)});
    } else {
      plan.next[register_class] = {&written, written.number};
    }
  }
  VariableInfo* info = &program_.variables.emplace_back();
  info->kind = VariableKind::kSplit;
  info->name = decl->name;
  info->type = type;
  info->is_const = true;
  info->split = split(type, Scopes::qualify(scope, decl->name), plan);
  member->size = plan.end;
  if (plan.parts > kMaxSplitParts) {
    report(CheckId::kSplitSize, decl->location, {to_string(type), std::to_string(kMaxSplitParts)});
    info->type = types_.error();
  }
  for (const SplitPlan::Next& next : plan.next) {
    if (!next.written || next.is_used) continue;
    report(CheckId::kSplitRegister, next.written->location,
           {std::string(decl->name), std::string(1, next.written->register_class)});
  }
  scopes_.add_symbol(scope, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
}

}  // namespace kaamos::hlsl
