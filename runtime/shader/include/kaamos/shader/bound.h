// SPDX-License-Identifier: MIT
//
// Looks bindings up once for many invocations (all threads of a compute group, all invocations of a
// ray shader), since neither root arguments nor descriptors change while a dispatch runs.
#pragma once

#include <new>

#include "kaamos/shader/bindings.h"
#include "kaamos/shader/texture_access.h"
#include "kaamos/shader/views.h"

namespace kaamos::shader {

struct BoundResource {
  Descriptor descriptor;
  // Mip 0 of textures whose texels may be used directly in memory; otherwise there are no texels.
  uint32_t direct_format = 0;
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t row_pitch = 0;
  union {
    uint8_t* texels = nullptr;
    const Descriptor* array;  // for an array in a table of the global root signature: the first
  };
  bool writable = false;
  bool ready = false;   // false: in the shader record, so it may differ between invocations
  bool buffer = false;  // has bytes: see memory::buffer_bytes
  // Structured buffers whose stride is as the HLSL declares: how many elements are complete. An
  // index below it needs no other test. Arrays: how many descriptors are in the heap from `array`
  // on.
  uint32_t elements = 0;
};
static_assert(sizeof(BoundResource) == 64);

KAAMOS_INLINE uint32_t whole_elements(const Descriptor& buffer, uint32_t declared_bytes) {
  if (buffer.kind != DescriptorKind::kStructuredBuffer || buffer.stride_bytes == 0 ||
      buffer.stride_bytes != declared_bytes) {
    return 0;
  }
  const uint64_t count = buffer.size_bytes / buffer.stride_bytes;
  return count < 0xFFFFFFFFu ? static_cast<uint32_t>(count) : 0xFFFFFFFFu;
}

inline void bind_one(const Invocation& invocation, uint32_t slot, uint32_t index,
                     BoundResource& out) {
  out.ready = !invocation.slots[slot].local;
  if (!out.ready) return;
  out.descriptor = resource(invocation, slot, index);
  out.buffer = memory::buffer_bytes(out.descriptor) != 0;
  out.elements = whole_elements(out.descriptor, invocation.slots[slot].stride_bytes);
  if (!invocation.dispatch->direct_texels) return;
  const auto* view = reinterpret_cast<const TextureView*>(out.descriptor.address);
  if (out.descriptor.kind != DescriptorKind::kTexture || view == nullptr ||
      view->direct_format == 0) {
    return;
  }
  const TextureMip& mip = view->mips[0];
  out.direct_format = view->direct_format;
  out.width = mip.width;
  out.height = mip.height;
  out.row_pitch = mip.row_pitch;
  out.texels = mip.texels;
  out.writable = view->unordered_access;
}

// For an array in a descriptor table.
inline void bind_table(const Invocation& invocation, const BindingSlot& slot, BoundResource& out) {
  const DispatchConstants& dispatch = *invocation.dispatch;
  if (dispatch.root_arguments == nullptr || slot.kind == DescriptorKind::kNull) return;
  const bool sampler = slot.kind == DescriptorKind::kSampler;
  const Descriptor* end = sampler ? dispatch.sampler_heap_end : dispatch.view_heap_end;
  const Descriptor* first =
      bindings::heap_slot(bindings::read_address(dispatch.root_arguments + slot.argument_offset) +
                              uint64_t{slot.descriptor_index} * sizeof(Descriptor),
                          sampler ? dispatch.sampler_heap_begin : dispatch.view_heap_begin, end);
  if (first == nullptr) return;
  const auto left = static_cast<uint64_t>(end - first);
  out.array = first;
  out.elements = left < slot.descriptor_count ? static_cast<uint32_t>(left) : slot.descriptor_count;
}

// `used` lists `count` bindings; all others are left unchanged.
[[gnu::noinline]] inline void bind(const Invocation& invocation, const uint32_t* used,
                                   uint32_t count, BoundResource* bound) {
  for (uint32_t i = 0; i < count; ++i) {
    const BindingSlot& slot = invocation.slots[used[i]];
    if (slot.source == SlotSource::kDescriptorTable && slot.descriptor_count != 1) {
      if (!slot.local) bind_table(invocation, slot, bound[used[i]]);
    } else {
      bind_one(invocation, used[i], 0, bound[used[i]]);
    }
  }
}
// Binds the first `count` elements of a binding that is an array.
[[gnu::noinline]] inline void bind_array(const Invocation& invocation, uint32_t slot,
                                         uint32_t count, BoundResource* elements) {
  for (uint32_t i = 0; i < count; ++i) bind_one(invocation, slot, i, elements[i]);
}
// One of them; past the end, one that reads as zeros.
template <uint32_t Count, class I>
KAAMOS_INLINE const BoundResource& bound_element(const BoundResource* elements, I index) {
  static constexpr BoundResource nothing{};
  const auto i = static_cast<uint32_t>(index);
  return i < Count ? elements[i] : nothing;
}

// A ray shader's binding, if it is not an array. [kExportReadsBound]
KAAMOS_INLINE Descriptor bound_resource(const Invocation& invocation, uint32_t slot) {
  const BoundResource& bound = invocation.bound[slot];
  if (bound.ready) [[likely]]
    return bound.descriptor;
  return local_resource(invocation, slot);
}
// Storage for something that is not bound, while one expression uses it. Costs nothing if
// everything is bound.
template <class T>
struct Unbound {
  Unbound() {}
  alignas(T) uint8_t bytes[sizeof(T)];
};
KAAMOS_INLINE const BoundResource& bound_texture(
    const Invocation& invocation, uint32_t slot,
    Unbound<BoundResource>&& unbound = Unbound<BoundResource>()) {
  const BoundResource& bound = invocation.bound[slot];
  if (bound.ready) [[likely]]
    return bound;
  return *new (unbound.bytes) BoundResource{.descriptor = local_resource(invocation, slot)};
}
// An element of a ray shader's binding that is an array.
KAAMOS_INLINE const Descriptor& bound_array_element(
    const Invocation& invocation, uint32_t slot, uint32_t index,
    Unbound<Descriptor>&& unbound = Unbound<Descriptor>()) {
  const BoundResource& bound = invocation.bound[slot];
  const BindingSlot& binding = invocation.slots[slot];
  if (index < bound.elements) [[likely]] {
    const Descriptor& found = bound.array[index];
    if (bindings::is_exactly(found, binding)) [[likely]]
      return found;
  }
  return *new (unbound.bytes) Descriptor(bindings::resolve(invocation, binding, index));
}

KAAMOS_INLINE MemoryView memory_view(const BoundResource& bound) {
  return {bound.descriptor.address, bound.buffer ? bound.descriptor.size_bytes : 0};
}
// Out of line, because elements are rarely past the end or different from the HLSL declaration.
[[gnu::noinline, gnu::cold, gnu::pure]] inline MemoryView other_element(const Descriptor& buffer,
                                                                        uint32_t index) {
  return element_view(buffer, index);
}
// `Bytes` is the size of an element in the HLSL declaration.
template <uint32_t Bytes>
KAAMOS_INLINE MemoryView element_view(const BoundResource& bound, uint32_t index) {
  if (index < bound.elements) [[likely]]
    return {bound.descriptor.address + uint64_t{index} * Bytes, Bytes};
  return other_element(bound.descriptor, index);
}
// Like bound_resource().
KAAMOS_INLINE MemoryView bound_memory_view(const Invocation& invocation, uint32_t slot) {
  const BoundResource& bound = invocation.bound[slot];
  if (bound.ready) [[likely]]
    return memory_view(bound);
  return memory_view(local_resource(invocation, slot));
}
[[gnu::noinline, gnu::cold, gnu::pure]] inline MemoryView other_bound_element(
    const Invocation& invocation, uint32_t slot, uint32_t index) {
  return element_view(bound_resource(invocation, slot), index);
}
template <uint32_t Bytes>
KAAMOS_INLINE MemoryView bound_element_view(const Invocation& invocation, uint32_t slot,
                                            uint32_t index) {
  const BoundResource& bound = invocation.bound[slot];
  if (index < bound.elements) [[likely]]
    return {bound.descriptor.address + uint64_t{index} * Bytes, Bytes};
  return other_bound_element(invocation, slot, index);
}

// Like the one in texture_access for a Descriptor.
KAAMOS_INLINE uint8_t* texel_in_place(const BoundResource& texture, const int4& at, uint32_t format,
                                      uint32_t bytes) {
  const auto x = static_cast<uint32_t>(at.e[0]);
  const auto y = static_cast<uint32_t>(at.e[1]);
  const bool is_direct = texture.direct_format == format && x < texture.width &&
                         y < texture.height && (at.e[2] | at.e[3]) == 0;
  if (!is_direct) return nullptr;
  return texture.texels + static_cast<uint64_t>(y) * texture.row_pitch + uint64_t{x} * bytes;
}
KAAMOS_INLINE bool is_writable(const BoundResource& texture) {
  return texture.writable;
}
KAAMOS_INLINE const Descriptor& descriptor_of(const BoundResource& texture) {
  return texture.descriptor;
}

namespace texture_access {

template <class V>
KAAMOS_INLINE uint8_t* direct_texel(const BoundResource& texture, const int4& at) {
  return texel_in_place(texture, at, direct_format<V>(), sizeof(V));
}

}  // namespace texture_access

template <class V>
KAAMOS_INLINE V load_texel(const Invocation& invocation, const BoundResource& texture,
                           const int4& coordinates) {
  if constexpr (texture_access::direct_format<V>() != 0) {
    if (const uint8_t* texel = texture_access::direct_texel<V>(texture, coordinates)) {
      V value;
      __builtin_memcpy(&value, texel, sizeof(V));
      return value;
    }
  }
  return texture_access::load_converted<V>(invocation, texture, coordinates);
}
template <class V>
KAAMOS_INLINE void store_texel(const Invocation& invocation, const BoundResource& texture,
                               const int4& coordinates, const V& value) {
  if constexpr (texture_access::direct_format<V>() != 0) {
    uint8_t* texel = texture_access::direct_texel<V>(texture, coordinates);
    if (texel != nullptr && texture.writable) {
      __builtin_memcpy(texel, &value, sizeof(V));
      return;
    }
  }
  texture_access::store_converted<V>(invocation, texture, coordinates, value);
}

}  // namespace kaamos::shader
