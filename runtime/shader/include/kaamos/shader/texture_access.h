// SPDX-License-Identifier: MIT
//
// Textures and typed buffers: translates HLSL's argument lists to the ABI's structures, and texels
// to HLSL's types. V is the result's type: a scalar or vector of up to four float, int, uint,
// float16, int16 or uint16.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/convert.h"
#include "kaamos/shader/operators.h"
#include "kaamos/shader/texture_view.h"

namespace kaamos::shader {
namespace texture_access {

// The 32-bit type that holds a component of type T in a texel.
template <class T>
using Wide = std::conditional_t<is_float<T>, float,
                                std::conditional_t<std::is_signed_v<T>, int32_t, uint32_t>>;

template <class V>
KAAMOS_INLINE V from_texel(const Texel& texel) {
  using T = scalar_of<V>;
  V value{};
  unroll<shape<V>::count>([&](int i) KAAMOS_INLINE_LAMBDA {
    const auto wide = __builtin_bit_cast(Wide<T>, texel.bits[i]);
    if constexpr (std::is_same_v<T, half>) {
      component(value, i) = to_half_toward_zero(wide);
    } else {
      component(value, i) = op::Convert<T>::apply(wide);
    }
  });
  return value;
}

template <class V>
KAAMOS_INLINE Texel to_texel(const V& value) {
  using T = scalar_of<V>;
  Texel texel = {};
  unroll<shape<V>::count>([&](int i) KAAMOS_INLINE_LAMBDA {
    texel.bits[i] = __builtin_bit_cast(uint32_t, op::Convert<Wide<T>>::apply(component(value, i)));
  });
  return texel;
}

template <class V, class Out>
KAAMOS_INLINE void copy(const V& from, Out* to, int limit) {
  for (int i = 0; i < shape<V>::count && i < limit; ++i) {
    to[i] = op::Convert<Out>::apply(component(from, i));
  }
}

template <class Location, class Offset>
KAAMOS_INLINE SampleArguments arguments(const Descriptor& texture, const Descriptor& sampler,
                                        const Location& location, const Offset& offset) {
  SampleArguments a = {};
  a.texture = &texture;
  a.sampler = &sampler;
  copy(location, a.coordinates, 4);
  copy(offset, a.offset, 3);
  return a;
}

}  // namespace texture_access

// ---------------------------------------------------------------------------------------------
// Sampling. offset is an int scalar or vector of texels.

template <class V, class Location, class Offset = int32_t>
KAAMOS_INLINE V sample_level(const Invocation& invocation, const Descriptor& texture,
                             const Descriptor& sampler, const Location& location, float lod,
                             const Offset& offset = {}) {
  SampleArguments a = texture_access::arguments(texture, sampler, location, offset);
  a.lod = lod;
  return texture_access::from_texel<V>(invocation.dispatch->services->sample_level(a));
}

template <class V, class Location, class Gradient, class Offset = int32_t>
KAAMOS_INLINE V sample_gradient(const Invocation& invocation, const Descriptor& texture,
                                const Descriptor& sampler, const Location& location,
                                const Gradient& ddx, const Gradient& ddy,
                                const Offset& offset = {}) {
  SampleArguments a = texture_access::arguments(texture, sampler, location, offset);
  texture_access::copy(ddx, a.ddx, 3);
  texture_access::copy(ddy, a.ddy, 3);
  return texture_access::from_texel<V>(invocation.dispatch->services->sample_gradient(a));
}

// The level that sample_gradient takes, before the sampler's bias and clamps.
template <class Location, class Gradient>
KAAMOS_INLINE float level_of_detail(const Invocation& invocation, const Descriptor& texture,
                                    const Descriptor& sampler, const Location& location,
                                    const Gradient& ddx, const Gradient& ddy) {
  SampleArguments a = texture_access::arguments(texture, sampler, location, int32_t{});
  texture_access::copy(ddx, a.ddx, 3);
  texture_access::copy(ddy, a.ddy, 3);
  return invocation.dispatch->services->level_of_detail(a);
}

template <class V = float, class Location, class Offset = int32_t>
KAAMOS_INLINE V sample_compare_level(const Invocation& invocation, const Descriptor& texture,
                                     const Descriptor& sampler, const Location& location,
                                     float comparison, float lod, const Offset& offset = {}) {
  SampleArguments a = texture_access::arguments(texture, sampler, location, offset);
  a.comparison = comparison;
  a.lod = lod;
  return splat<V>(
      op::Convert<scalar_of<V>>::apply(invocation.dispatch->services->sample_compare_level(a)));
}

// component: 0 red .. 3 alpha
template <class V, class Location, class Offset = int32_t>
KAAMOS_INLINE V gather(const Invocation& invocation, const Descriptor& texture,
                       const Descriptor& sampler, const Location& location, uint32_t component,
                       const Offset& offset = {}) {
  SampleArguments a = texture_access::arguments(texture, sampler, location, offset);
  a.component = component;
  return texture_access::from_texel<V>(invocation.dispatch->services->gather(a));
}

template <class V, class Location, class Offset = int32_t>
KAAMOS_INLINE V gather_compare(const Invocation& invocation, const Descriptor& texture,
                               const Descriptor& sampler, const Location& location,
                               float comparison, const Offset& offset = {}) {
  SampleArguments a = texture_access::arguments(texture, sampler, location, offset);
  a.comparison = comparison;
  return texture_access::from_texel<V>(invocation.dispatch->services->gather_compare(a));
}

// ---------------------------------------------------------------------------------------------
// Texels. Coordinates are as the ABI wants them: {x, y, z or array element, mip}.

template <class V, class Offset = int32_t>
KAAMOS_INLINE int4 texel_coordinates(const V& at, int32_t mip, const Offset& offset = {}) {
  int32_t moved[3] = {};
  texture_access::copy(offset, moved, 3);
  int4 result = {{0, 0, 0, mip}};
  for (int i = 0; i < shape<V>::count && i < 3; ++i) {
    result.e[i] = op::Add::apply(static_cast<int32_t>(component(at, i)), moved[i]);
  }
  return result;
}
template <class V, class Offset = int32_t>
KAAMOS_INLINE int4 texel_coordinates_1d_array(const V& at, int32_t mip, const Offset& offset = {}) {
  const int4 plain = texel_coordinates(at, mip, offset);
  return {{plain.e[0], 0, plain.e[1], plain.e[3]}};
}

namespace texture_access {

// The DXGI_FORMAT whose texels have the memory layout of a V; 0 if there is none.
template <class V>
constexpr uint32_t direct_format() {
  using T = scalar_of<V>;
  constexpr int kFloat = std::is_same_v<T, float>      ? 0
                         : std::is_same_v<T, uint32_t> ? 1
                         : std::is_same_v<T, int32_t>  ? 2
                                                       : 3;
  constexpr uint32_t kFormats[4][5] = {
      {0, 41, 16, 6, 2}, {0, 42, 17, 7, 3}, {0, 43, 18, 8, 4}, {0, 0, 0, 0, 0}};
  return kFormats[kFloat][shape<V>::count];
}

// Pictures are often stored in fewer bits than shaders read.
inline constexpr uint32_t kR16G16B16A16Float = 10, kR8G8B8A8Unorm = 28, kR16G16Snorm = 37;

// The texel of `bytes` bytes if the texture is stored in that format and can be accessed in place;
// otherwise null. bound.h has the same for a BoundResource.
KAAMOS_INLINE uint8_t* texel_in_place(const Descriptor& texture, const int4& at, uint32_t format,
                                      uint32_t bytes) {
  const auto* view = reinterpret_cast<const TextureView*>(texture.address);
  if (texture.kind != DescriptorKind::kTexture || view == nullptr ||
      view->direct_format != format) {
    return nullptr;
  }
  const TextureMip& mip = view->mips[0];
  const auto x = static_cast<uint32_t>(at.e[0]);
  const auto y = static_cast<uint32_t>(at.e[1]);
  if (x >= mip.width || y >= mip.height || (at.e[2] | at.e[3]) != 0) return nullptr;
  return mip.texels + static_cast<uint64_t>(y) * mip.row_pitch + uint64_t{x} * bytes;
}

// The texel if it can be accessed in memory as it is; otherwise null.
template <class V>
KAAMOS_INLINE uint8_t* direct_texel(const Descriptor& texture, const int4& at) {
  static_assert(sizeof(V) == 4 * shape<V>::count);
  return texel_in_place(texture, at, direct_format<V>(), sizeof(V));
}

// Stored integers and floats as in runtime/shader/texture/format_codec.cpp, whose test compares
// them.
KAAMOS_INLINE float from_snorm16(int16_t stored) {
  const float x = static_cast<float>(stored) / 32767.0f;
  return x < -1.0f ? -1.0f : x;
}
KAAMOS_INLINE int16_t to_snorm16(float x) {
  if (x != x) return 0;
  x = (x < -1.0f ? -1.0f : x > 1.0f ? 1.0f : x) * 32767.0f;
  return static_cast<int16_t>(static_cast<int32_t>(x + (x < 0.0f ? -0.5f : 0.5f)));
}
KAAMOS_INLINE uint8_t to_unorm8(float x) {
  if (!(x > 0.0f)) return 0;
  return x >= 1.0f ? 255 : static_cast<uint8_t>(static_cast<uint32_t>(x * 255.0f + 0.5f));
}

KAAMOS_INLINE bool is_writable(const Descriptor& texture) {
  return reinterpret_cast<const TextureView*>(texture.address)->unordered_access;
}
KAAMOS_INLINE const Descriptor& descriptor_of(const Descriptor& texture) {
  return texture;
}

// Returns whether it read one of the short formats. Texture is a Descriptor or a BoundResource.
template <class Texture, class V>
KAAMOS_INLINE bool load_short(const Texture& texture, const int4& at, V& value) {
  if constexpr (std::is_same_v<scalar_of<V>, float> && shape<V>::count == 2) {
    const uint8_t* texel = texel_in_place(texture, at, kR16G16Snorm, 4);
    if (texel == nullptr) return false;
    int16_t stored[2];
    __builtin_memcpy(stored, texel, sizeof(stored));
    for (int i = 0; i < 2; ++i) component(value, i) = from_snorm16(stored[i]);
    return true;
  }
  if constexpr (std::is_same_v<scalar_of<V>, float> && shape<V>::count == 4) {
    if (const uint8_t* texel = texel_in_place(texture, at, kR8G8B8A8Unorm, 4)) {
      for (int i = 0; i < 4; ++i) component(value, i) = static_cast<float>(texel[i]) / 255.0f;
      return true;
    }
    if (const uint8_t* texel = texel_in_place(texture, at, kR16G16B16A16Float, 8)) {
      half stored[4];
      __builtin_memcpy(stored, texel, sizeof(stored));
      for (int i = 0; i < 4; ++i) component(value, i) = to_float(stored[i]);
      return true;
    }
  }
  return false;
}
template <class Texture, class V>
KAAMOS_INLINE bool store_short(const Texture& texture, const int4& at, const V& value) {
  if constexpr (std::is_same_v<scalar_of<V>, float> && shape<V>::count == 2) {
    uint8_t* texel = texel_in_place(texture, at, kR16G16Snorm, 4);
    if (texel == nullptr || !is_writable(texture)) return false;
    const int16_t stored[2] = {to_snorm16(component(value, 0)), to_snorm16(component(value, 1))};
    __builtin_memcpy(texel, stored, sizeof(stored));
    return true;
  }
  if constexpr (std::is_same_v<scalar_of<V>, float> && shape<V>::count == 4) {
    if (uint8_t* texel = texel_in_place(texture, at, kR8G8B8A8Unorm, 4)) {
      if (!is_writable(texture)) return false;
      for (int i = 0; i < 4; ++i) texel[i] = to_unorm8(component(value, i));
      return true;
    }
    if (uint8_t* texel = texel_in_place(texture, at, kR16G16B16A16Float, 8)) {
      if (!is_writable(texture)) return false;
      uint16_t stored[4];
      for (int i = 0; i < 4; ++i) stored[i] = to_half_toward_zero(component(value, i)).bits;
      __builtin_memcpy(texel, stored, sizeof(stored));
      return true;
    }
  }
  return false;
}

// Out of line: conversions, arrays, and anything out of bounds. Pure, so that a loop need not
// reload other memory after each call.
template <class V, class Texture>
[[gnu::noinline, gnu::pure]] inline V load_converted(const Invocation& invocation,
                                                     const Texture& texture, int4 coordinates) {
  V value{};
  if (invocation.dispatch->direct_texels && load_short(texture, coordinates, value)) return value;
  return from_texel<V>(
      invocation.dispatch->services->load_texel(descriptor_of(texture), coordinates.e));
}
template <class V, class Texture>
[[gnu::noinline]] inline void store_converted(const Invocation& invocation, const Texture& texture,
                                              int4 coordinates, V value) {
  if (invocation.dispatch->direct_texels && store_short(texture, coordinates, value)) return;
  invocation.dispatch->services->store_texel(descriptor_of(texture), coordinates.e,
                                             to_texel(value));
}

}  // namespace texture_access

template <class V>
KAAMOS_INLINE V load_texel(const Invocation& invocation, const Descriptor& texture,
                           const int4& coordinates) {
  if constexpr (texture_access::direct_format<V>() != 0) {
    const uint8_t* texel = invocation.dispatch->direct_texels
                               ? texture_access::direct_texel<V>(texture, coordinates)
                               : nullptr;
    if (texel != nullptr) {
      V value;
      __builtin_memcpy(&value, texel, sizeof(V));
      return value;
    }
  }
  return texture_access::load_converted<V>(invocation, texture, coordinates);
}
template <class V>
KAAMOS_INLINE void store_texel(const Invocation& invocation, const Descriptor& texture,
                               const int4& coordinates, const V& value) {
  if constexpr (texture_access::direct_format<V>() != 0) {
    uint8_t* texel = invocation.dispatch->direct_texels
                         ? texture_access::direct_texel<V>(texture, coordinates)
                         : nullptr;
    if (texel != nullptr &&
        reinterpret_cast<const TextureView*>(texture.address)->unordered_access) {
      __builtin_memcpy(texel, &value, sizeof(V));
      return;
    }
  }
  texture_access::store_converted<V>(invocation, texture, coordinates, value);
}
template <class T>
KAAMOS_INLINE T* texel_address(const Invocation& invocation, const Descriptor& texture,
                               const int4& coordinates) {
  return static_cast<T*>(
      invocation.dispatch->services->texel_address(texture, coordinates.e, sizeof(T)));
}

template <class V>
KAAMOS_INLINE V load_typed(const Invocation& invocation, const Descriptor& buffer,
                           uint32_t element) {
  return texture_access::from_texel<V>(invocation.dispatch->services->load_typed(buffer, element));
}
template <class V>
KAAMOS_INLINE void store_typed(const Invocation& invocation, const Descriptor& buffer,
                               uint32_t element, const V& value) {
  invocation.dispatch->services->store_typed(buffer, element, texture_access::to_texel(value));
}
template <class T>
KAAMOS_INLINE T* typed_address(const Invocation& invocation, const Descriptor& buffer,
                               uint32_t element) {
  return static_cast<T*>(invocation.dispatch->services->typed_address(buffer, element, sizeof(T)));
}

namespace texture_access {

[[gnu::noinline, gnu::pure]] inline uint4 other_dimensions(const Invocation& invocation,
                                                           const Descriptor& descriptor,
                                                           uint32_t mip) {
  const auto clamped = [](uint64_t n) { return n > ~0u ? ~0u : static_cast<uint32_t>(n); };
  switch (descriptor.kind) {
    case DescriptorKind::kRawBuffer:
      return {{clamped(descriptor.size_bytes), 1, 0, 0}};
    case DescriptorKind::kStructuredBuffer: {
      const uint32_t stride = descriptor.stride_bytes;
      return {{stride != 0 ? clamped(descriptor.size_bytes / stride) : 0, stride, 0, 0}};
    }
    case DescriptorKind::kTypedBuffer:
    case DescriptorKind::kTexture: {
      const TextureDimensions d =
          invocation.dispatch->services->texture_dimensions(descriptor, mip);
      return {{d.width, d.height, d.depth_or_elements, d.mip_count}};
    }
    default:
      return {};
  }
}

}  // namespace texture_access

// Textures: {width, height, depth or elements, mips} of the mip. Buffers: {elements or bytes,
// stride, 0, 0}. A root descriptor has no size, so it gives the largest number.
KAAMOS_INLINE uint4 dimensions(const Invocation& invocation, const Descriptor& descriptor,
                               uint32_t mip) {
  if (invocation.dispatch->direct_texels) {
    const TextureView* view = texture_view(descriptor);
    if (view != nullptr && view->dimension == TextureDimension::k2D && mip < view->mip_count) {
      return {{view->mips[mip].width, view->mips[mip].height, view->slice_count, view->mip_count}};
    }
  }
  return texture_access::other_dimensions(invocation, descriptor, mip);
}

}  // namespace kaamos::shader
