// SPDX-License-Identifier: MIT
//
// Bindings looked up once for many invocations, since neither root arguments nor descriptors change
// while a dispatch runs: for all threads of a compute group, for all invocations of a ray shader.
#pragma once

#include "kaamos/shader/bindings.h"
#include "kaamos/shader/texture_access.h"
#include "kaamos/shader/views.h"

namespace kaamos::shader {

struct BoundResource {
  Descriptor descriptor;
  // Textures whose texels may be used as they lie in memory, of mip 0; else without texels.
  uint32_t direct_format = 0;
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t row_pitch = 0;
  uint8_t* texels = nullptr;
  bool writable = false;
  bool ready = false;   // false: of the shader record, another one for each invocation
  bool buffer = false;  // has bytes: see memory::buffer_bytes
  // Of structured buffers: the first elements, which are whole. Below it nothing else needs a test.
  uint32_t elements = 0;
};
static_assert(sizeof(BoundResource) == 64);

KAAMOS_INLINE uint32_t whole_elements(const Descriptor& buffer) {
  if (buffer.kind != DescriptorKind::kStructuredBuffer || buffer.stride_bytes == 0) return 0;
  const uint64_t count = buffer.size_bytes / buffer.stride_bytes;
  return count < 0xFFFFFFFFu ? static_cast<uint32_t>(count) : 0xFFFFFFFFu;
}

inline void bind_one(const Invocation& invocation, uint32_t slot, uint32_t index,
                     BoundResource& out) {
  out.ready = !invocation.slots[slot].local;
  if (!out.ready) return;
  out.descriptor = resource(invocation, slot, index);
  out.buffer = memory::buffer_bytes(out.descriptor) != 0;
  out.elements = whole_elements(out.descriptor);
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

// `used`: the bindings that are no arrays, `count` of them. Others are left as they are.
[[gnu::noinline]] inline void bind(const Invocation& invocation, const uint32_t* used,
                                   uint32_t count, BoundResource* bound) {
  for (uint32_t i = 0; i < count; ++i) bind_one(invocation, used[i], 0, bound[used[i]]);
}
// The `count` elements of a binding that is an array.
[[gnu::noinline]] inline void bind_array(const Invocation& invocation, uint32_t slot,
                                         uint32_t count, BoundResource* elements) {
  for (uint32_t i = 0; i < count; ++i) bind_one(invocation, slot, i, elements[i]);
}
// One of them; past the end, what reads as zeros.
template <uint32_t Count, class I>
KAAMOS_INLINE const BoundResource& bound_element(const BoundResource* elements, I index) {
  static constexpr BoundResource nothing;
  const auto i = static_cast<uint32_t>(index);
  return i < Count ? elements[i] : nothing;
}

// A binding that is no array, of a ray shader. [kExportReadsBound]
KAAMOS_INLINE Descriptor bound_resource(const Invocation& invocation, uint32_t slot) {
  const BoundResource& bound = invocation.bound[slot];
  if (bound.ready) [[likely]]
    return bound.descriptor;
  return local_resource(invocation, slot);
}
KAAMOS_INLINE BoundResource bound_texture(const Invocation& invocation, uint32_t slot) {
  if (invocation.bound[slot].ready) [[likely]]
    return invocation.bound[slot];
  BoundResource texture;
  texture.descriptor = local_resource(invocation, slot);
  return texture;
}

KAAMOS_INLINE MemoryView memory_view(const BoundResource& bound) {
  return {bound.descriptor.address, bound.buffer ? bound.descriptor.size_bytes : 0};
}
KAAMOS_INLINE MemoryView element_view(const BoundResource& bound, uint32_t index) {
  const Descriptor& buffer = bound.descriptor;
  if (index < bound.elements) [[likely]] {
    return {buffer.address + uint64_t{index} * buffer.stride_bytes, buffer.stride_bytes};
  }
  return element_view(buffer, index);
}
// As bound_resource().
KAAMOS_INLINE MemoryView bound_memory_view(const Invocation& invocation, uint32_t slot) {
  const BoundResource& bound = invocation.bound[slot];
  if (bound.ready) [[likely]]
    return memory_view(bound);
  return memory_view(local_resource(invocation, slot));
}
KAAMOS_INLINE MemoryView bound_element_view(const Invocation& invocation, uint32_t slot,
                                            uint32_t index) {
  const BoundResource& bound = invocation.bound[slot];
  if (index < bound.elements) [[likely]]
    return element_view(bound, index);
  return element_view(bound_resource(invocation, slot), index);
}

namespace texture_access {

template <class V>
KAAMOS_INLINE uint8_t* direct_texel(const BoundResource& texture, const int4& at) {
  const auto x = static_cast<uint32_t>(at.e[0]);
  const auto y = static_cast<uint32_t>(at.e[1]);
  const bool is_direct = texture.direct_format == direct_format<V>() && x < texture.width &&
                         y < texture.height && at.e[3] == 0;
  if (!is_direct) return nullptr;
  return texture.texels + static_cast<uint64_t>(y) * texture.row_pitch + x * sizeof(V);
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
  return texture_access::load_converted<V>(invocation, texture.descriptor, coordinates);
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
  texture_access::store_converted<V>(invocation, texture.descriptor, coordinates, value);
}

}  // namespace kaamos::shader
