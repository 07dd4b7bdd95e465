// SPDX-License-Identifier: MIT
//
// From an HLSL resource variable to its descriptor: root arguments, descriptor tables, heaps.
// Whatever is unbound, out of bounds or of the wrong kind becomes the null descriptor, which reads
// as zeros.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/half.h"

namespace kaamos::shader {
namespace bindings {

// Unaligned arguments are fine here, because an application may put a shader record anywhere.
KAAMOS_INLINE uint64_t read_address(const uint8_t* argument) {
  uint64_t address;
  __builtin_memcpy(&address, argument, sizeof(address));
  return address;
}

// `shape`: of a texture as it is declared, or 0.
constexpr bool matches(const Descriptor& descriptor, DescriptorKind kind, DescriptorAccess access,
                       uint32_t shape) {
  if (kind == DescriptorKind::kNull) return true;  // the slot does not know
  if (descriptor.kind != kind) return false;
  if (kind == DescriptorKind::kTexture && !fits_shape(descriptor.stride_bytes, shape)) return false;
  const bool has_access = kind != DescriptorKind::kConstantBuffer &&
                          kind != DescriptorKind::kSampler &&
                          kind != DescriptorKind::kAccelerationStructure;
  return !has_access || access == DescriptorAccess::kOther || view_access(descriptor) == access;
}

// Returns whether it is what the declaration says in every respect, as most are. The access is
// always exact for what shaders read most.
KAAMOS_INLINE bool is_exactly(const Descriptor& found, const BindingSlot& slot) {
  return found.kind == slot.kind && found.access == slot.access &&
         (found.kind != DescriptorKind::kTexture || found.stride_bytes == slot.stride_bytes);
}

// The heap slot at `address`, or null if no slot of [begin, end) starts there. Addresses are
// compared as integers, because a handle in a record can be anything.
KAAMOS_INLINE const Descriptor* heap_slot(uint64_t address, const Descriptor* begin,
                                          const Descriptor* end) {
  const uint64_t first = reinterpret_cast<uintptr_t>(begin);
  const uint64_t last = reinterpret_cast<uintptr_t>(end);
  if (address < first || address >= last || (address - first) % sizeof(Descriptor) != 0) {
    return nullptr;
  }
  return begin + (address - first) / sizeof(Descriptor);
}

KAAMOS_INLINE Descriptor from_table(const DispatchConstants& dispatch, const BindingSlot& slot,
                                    const uint8_t* argument, uint32_t index) {
  if (index >= slot.descriptor_count && slot.descriptor_count != kUnbounded) return {};
  const uint64_t first = static_cast<uint64_t>(slot.descriptor_index) + index;
  const uint64_t address = read_address(argument) + first * sizeof(Descriptor);
  const bool sampler = slot.kind == DescriptorKind::kSampler;
  const Descriptor* found = nullptr;
  if (!sampler) found = heap_slot(address, dispatch.view_heap_begin, dispatch.view_heap_end);
  if (sampler || (found == nullptr && slot.kind == DescriptorKind::kNull)) {
    found = heap_slot(address, dispatch.sampler_heap_begin, dispatch.sampler_heap_end);
  }
  return found != nullptr && matches(*found, slot.kind, slot.access, slot.stride_bytes)
             ? *found
             : Descriptor{};
}

KAAMOS_INLINE const uint8_t* arguments_of(const Invocation& invocation, const BindingSlot& slot) {
  return slot.local ? invocation.local_arguments : invocation.dispatch->root_arguments;
}

KAAMOS_INLINE Descriptor from_root(const BindingSlot& slot, const uint8_t* arguments) {
  const uint64_t address =
      arguments != nullptr ? read_address(arguments + slot.argument_offset) : 0;
  if (address == 0) [[unlikely]]
    return {};
  Descriptor result;
  result.kind = slot.kind;
  result.access = slot.access;
  result.stride_bytes = slot.stride_bytes;
  result.address = address;
  result.size_bytes = ~uint64_t{0};  // a root descriptor is unbounded [D3D12]
  return result;
}

KAAMOS_INLINE Descriptor root_constants(const BindingSlot& slot, const uint8_t* arguments) {
  Descriptor result;
  result.kind = DescriptorKind::kConstantBuffer;
  result.access = DescriptorAccess::kOther;
  result.address = reinterpret_cast<uintptr_t>(arguments + slot.argument_offset);
  result.size_bytes = slot.size_bytes;
  return result;
}

// Out of line, because its code would keep the compiler from inlining a shader's functions. Pure,
// so that a loop need not reload other memory after each call.
[[gnu::noinline, gnu::pure]] inline Descriptor resolve(const Invocation& invocation,
                                                       const BindingSlot& slot, uint32_t index) {
  if (slot.source == SlotSource::kUnbound) return {};
  if (slot.source == SlotSource::kStaticSampler) {
    return slot.static_sampler != nullptr ? *slot.static_sampler : Descriptor{};  // for any index
  }
  const uint8_t* arguments = arguments_of(invocation, slot);
  if (arguments == nullptr) return {};
  if (slot.source == SlotSource::kDescriptorTable) {
    return from_table(*invocation.dispatch, slot, arguments + slot.argument_offset, index);
  }
  if (index != 0) return {};  // root parameters are never arrays
  if (slot.source == SlotSource::kRootDescriptor) return from_root(slot, arguments);
  return root_constants(slot, arguments);
}

// The common case of from_table(): one descriptor in a global table, of the kind that the slot
// wants. Otherwise null.
KAAMOS_INLINE const Descriptor* from_global_table(const Invocation& invocation,
                                                  const BindingSlot& slot) {
  const DispatchConstants& dispatch = *invocation.dispatch;
  if (slot.source != SlotSource::kDescriptorTable || slot.local || slot.descriptor_count == 0 ||
      dispatch.root_arguments == nullptr) {
    return nullptr;
  }
  const uint64_t address = read_address(dispatch.root_arguments + slot.argument_offset) +
                           uint64_t{slot.descriptor_index} * sizeof(Descriptor);
  const uint64_t first = reinterpret_cast<uintptr_t>(dispatch.view_heap_begin);
  const uint64_t last = reinterpret_cast<uintptr_t>(dispatch.view_heap_end);
  const uint64_t at = address - first;
  if (at >= last - first || at % sizeof(Descriptor) != 0) return nullptr;
  const auto* found = dispatch.view_heap_begin + at / sizeof(Descriptor);
  return is_exactly(*found, slot) ? found : nullptr;
}

}  // namespace bindings

// The resource of binding `slot` of the running export; index is 0 unless the binding is an array.
KAAMOS_INLINE Descriptor resource(const Invocation& invocation, uint32_t slot, uint32_t index = 0) {
  const BindingSlot& binding = invocation.slots[slot];
  // Inline, because shaders read these most; the other kinds are handled out of line.
  if (index == 0) {
    if (const Descriptor* found = bindings::from_global_table(invocation, binding)) return *found;
    const uint8_t* arguments = invocation.dispatch->root_arguments;
    if (binding.source == SlotSource::kRootConstants && !binding.local && arguments != nullptr) {
      return bindings::root_constants(binding, arguments);
    }
  }
  if (binding.source == SlotSource::kRootDescriptor && index == 0) {
    return bindings::from_root(binding, bindings::arguments_of(invocation, binding));
  }
  return bindings::resolve(invocation, binding, index);
}

// The same, with index 0, for a binding in the shader record.
KAAMOS_INLINE Descriptor local_resource(const Invocation& invocation, uint32_t slot) {
  const BindingSlot& binding = invocation.slots[slot];
  const uint8_t* arguments = invocation.local_arguments;
  if (binding.source == SlotSource::kRootDescriptor) return bindings::from_root(binding, arguments);
  if (binding.source == SlotSource::kRootConstants && arguments != nullptr) {
    return bindings::root_constants(binding, arguments);
  }
  return bindings::resolve(invocation, binding, 0);
}

// ResourceDescriptorHeap[index], SamplerDescriptorHeap[index]
KAAMOS_INLINE Descriptor heap_resource(const Invocation& invocation, uint32_t index, bool sampler) {
  const DispatchConstants& dispatch = *invocation.dispatch;
  const Descriptor* begin = sampler ? dispatch.sampler_heap_begin : dispatch.view_heap_begin;
  const Descriptor* end = sampler ? dispatch.sampler_heap_end : dispatch.view_heap_end;
  return index < static_cast<uint64_t>(end - begin) ? begin[index] : Descriptor{};
}
// The same for a texture, declared as `shape`.
KAAMOS_INLINE Descriptor heap_texture(const Invocation& invocation, uint32_t index,
                                      uint32_t shape) {
  const Descriptor found = heap_resource(invocation, index, false);
  const bool other =
      found.kind == DescriptorKind::kTexture && !fits_shape(found.stride_bytes, shape);
  return other ? Descriptor{} : found;
}

}  // namespace kaamos::shader
