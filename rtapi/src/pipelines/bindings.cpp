// SPDX-License-Identifier: MIT
#include "rtapi/src/pipelines/bindings.h"

#include <optional>

#include "rtapi/src/pipelines/root_signature_impl.h"

namespace rtapi::detail {

namespace {

using shader::BindingDesc;
using shader::BindingSlot;
using shader::BindingType;
using shader::DescriptorAccess;
using shader::DescriptorKind;
using shader::RegisterClass;
using shader::SlotSource;

DescriptorKind kind_of(BindingType type) {
  switch (type) {
    case BindingType::kConstantBuffer:
      return DescriptorKind::kConstantBuffer;
    case BindingType::kRawBuffer:
      return DescriptorKind::kRawBuffer;
    case BindingType::kStructuredBuffer:
      return DescriptorKind::kStructuredBuffer;
    case BindingType::kTypedBuffer:
      return DescriptorKind::kTypedBuffer;
    case BindingType::kTexture:
      return DescriptorKind::kTexture;
    case BindingType::kSampler:
    case BindingType::kComparisonSampler:
      return DescriptorKind::kSampler;
    case BindingType::kAccelerationStructure:
      return DescriptorKind::kAccelerationStructure;
  }
  return DescriptorKind::kNull;
}

std::string describe(const BindingDesc& b) {
  return concat(in_quotes(b.name), " (", register_text(b.register_class, b.register_index, b.space),
                ")");
}

// Finds the range of a signature that contains the binding's first register and is visible.
std::optional<RegisterRange> find(const RootSignature& signature, const BindingDesc& binding,
                                  ShaderVisibility stage) {
  if (!signature) return std::nullopt;
  for (const RegisterRange& r : get_register_ranges(signature.GetDesc())) {
    if (r.register_class == binding.register_class && r.space == binding.space &&
        binding.register_index >= r.first && binding.register_index < r.end &&
        (r.visibility == ShaderVisibility::kAll || r.visibility == stage)) {
      return r;
    }
  }
  return std::nullopt;
}

const DescriptorRange& find_descriptor_range(const RootDescriptorTable& table,
                                             const RegisterRange& range) {
  // Within one table, class, space and first register identify a range: overlapping ranges were
  // refused earlier.
  for (const DescriptorRange& r : table.Ranges) {
    if (r.BaseShaderRegister != range.first || r.RegisterSpace != range.space) continue;
    static constexpr RegisterClass kClasses[] = {
        RegisterClass::kShaderResource, RegisterClass::kUnorderedAccess,
        RegisterClass::kConstantBuffer, RegisterClass::kSampler};
    if (kClasses[static_cast<uint32_t>(r.RangeType) & 3] == range.register_class) return r;
  }
  return table.Ranges.front();
}

Status fill_table(const BindingDesc& binding, const RegisterRange& range,
                  const RootParameter& parameter, const std::string& where, BindingSlot& slot) {
  const DescriptorRange& descriptors = find_descriptor_range(parameter.DescriptorTable, range);
  const uint64_t skipped = uint64_t{binding.register_index} - range.first;
  const uint64_t available = range.end - binding.register_index;
  const bool unbounded = binding.count == shader::kUnbounded;
  if (!unbounded && binding.count > available) {
    return make_error(Id::kBindingMismatch, where, ": resource ", describe(binding), " needs ",
                      binding.count, " registers, but parameter ", range.parameter, " has only ",
                      available, " from there on");
  }
  slot.source = SlotSource::kDescriptorTable;
  slot.descriptor_index =
      static_cast<uint32_t>(descriptors.OffsetInDescriptorsFromTableStart + skipped);
  slot.descriptor_count = binding.count;
  if (unbounded && descriptors.NumDescriptors != kUnboundedDescriptors) {
    slot.descriptor_count = static_cast<uint32_t>(available);
  }
  return {};
}

Status fill_root_descriptor(const BindingDesc& binding, const RegisterRange& range,
                            const std::string& where, BindingSlot& slot) {
  const bool buffer = binding.type == BindingType::kConstantBuffer ||
                      binding.type == BindingType::kRawBuffer ||
                      binding.type == BindingType::kStructuredBuffer ||
                      binding.type == BindingType::kAccelerationStructure;
  // A root descriptor can feed an array without a size: it is the first element.
  const bool sized_array = binding.count != 1 && binding.count != shader::kUnbounded;
  if (!buffer || sized_array) {
    return make_error(Id::kBindingMismatch, where, ": resource ", describe(binding),
                      sized_array ? " is an array" : " is a texture or typed buffer",
                      ", which root descriptor ", range.parameter,
                      " cannot hold; bind it through a descriptor table");
  }
  slot.source = SlotSource::kRootDescriptor;
  if (binding.type == BindingType::kConstantBuffer) slot.size_bytes = binding.size_bytes;
  return {};
}

DescriptorAccess access_of(RegisterClass register_class) {
  switch (register_class) {
    case RegisterClass::kUnorderedAccess:
      return DescriptorAccess::kUnorderedAccess;
    case RegisterClass::kShaderResource:
      return DescriptorAccess::kShaderResource;
    default:
      return DescriptorAccess::kOther;
  }
}

Status fill_slot(const RootSignature& signature, const BindingDesc& binding,
                 const RegisterRange& range, const std::string& where, BindingSlot& slot) {
  slot.kind = kind_of(binding.type);
  slot.access = access_of(binding.register_class);
  if (binding.type == BindingType::kStructuredBuffer || binding.type == BindingType::kTexture) {
    slot.stride_bytes = binding.size_bytes;
  }
  if (range.static_sampler) {
    if (binding.count != 1 && binding.count != shader::kUnbounded) {
      return make_error(Id::kBindingMismatch, where, ": resource ", describe(binding),
                        " is an array of ", binding.count,
                        ", but a static sampler covers a single register; only an array without a "
                        "size may start there");
    }
    slot.source = SlotSource::kStaticSampler;
    slot.static_sampler = &signature.impl()->static_samplers[range.parameter];
    return {};
  }
  slot.local = signature.is_local();
  slot.argument_offset = signature.GetArgumentOffset(range.parameter);
  const RootParameter& parameter = signature.GetDesc().Parameters[range.parameter];
  switch (parameter.ParameterType) {
    case RootParameterType::kDescriptorTable:
      return fill_table(binding, range, parameter, where, slot);
    case RootParameterType::k32BitConstants:
      if (binding.count != 1) {
        return make_error(Id::kBindingMismatch, where, ": resource ", describe(binding),
                          " is an array, which root constants (parameter ", range.parameter,
                          ") cannot hold");
      }
      slot.source = SlotSource::kRootConstants;
      slot.size_bytes = parameter.Constants.Num32BitValues * 4;
      return {};
    default:
      return fill_root_descriptor(binding, range, where, slot);
  }
}

Status check_heap_access(const shader::ExportDesc& code, const RootSignature& global,
                         const std::string& where) {
  const RootSignatureFlags flags = global.GetDesc().Flags;
  if ((code.flags & shader::kExportUsesViewHeap) &&
      !HasAny(flags, RootSignatureFlags::kCbvSrvUavHeapDirectlyIndexed)) {
    return make_error(Id::kBindingMissing, where,
                      ": uses ResourceDescriptorHeap, so its global root signature needs the flag "
                      "kCbvSrvUavHeapDirectlyIndexed");
  }
  if ((code.flags & shader::kExportUsesSamplerHeap) &&
      !HasAny(flags, RootSignatureFlags::kSamplerHeapDirectlyIndexed)) {
    return make_error(Id::kBindingMissing, where,
                      ": uses SamplerDescriptorHeap, so its global root signature needs the flag "
                      "kSamplerHeapDirectlyIndexed");
  }
  return {};
}

}  // namespace

Result<std::vector<BindingSlot>> resolve_bindings(
    const shader::LibraryDesc& library, const shader::ExportDesc& code, const RootSignature& global,
    const RootSignature& local, const std::string& where, ShaderVisibility stage) {
  if (Status s = check_heap_access(code, global, where); !s.ok()) return s.error();
  std::vector<BindingSlot> slots(library.binding_count);
  for (uint32_t i = 0; i < code.binding_count; ++i) {
    const uint32_t index = code.bindings[i];
    const BindingDesc& binding = library.bindings[index];
    const RootSignature* signature = &local;
    auto range = find(local, binding, stage);
    if (!range) {
      signature = &global;
      range = find(global, binding, stage);
    }
    if (!range) {
      return make_error(
          Id::kBindingMissing, where, ": resource ", describe(binding), " of ",
          in_quotes(library.name ? library.name : ""), " is ",
          global && local ? "in neither its global nor its local root signature"
          : global ? "not in its global root signature, or not visible to this stage; it has no "
                     "local one"
          : local  ? "not in its local root signature; it has no global one"
                   : "in no root signature: none is associated with it");
    }
    if (Status s = fill_slot(*signature, binding, *range, where, slots[index]); !s.ok()) {
      return s.error();
    }
  }
  return slots;
}

Status check_root_signatures_disjoint(const RootSignature& global, const RootSignature& local,
                                      const std::string& where) {
  if (!global || !local) return {};
  const auto outer = get_register_ranges(global.GetDesc());
  for (const RegisterRange& a : get_register_ranges(local.GetDesc())) {
    for (const RegisterRange& b : outer) {
      if (!overlap(a, b)) continue;
      return make_error(Id::kRootSignaturesOverlap, where, ": register ",
                        register_text(a.register_class, std::max(a.first, b.first), a.space),
                        " is in its local root signature (",
                        a.static_sampler ? "sampler " : "parameter ", a.parameter,
                        ") and in its global one (", b.static_sampler ? "sampler " : "parameter ",
                        b.parameter, ")");
    }
  }
  return {};
}

}  // namespace rtapi::detail
