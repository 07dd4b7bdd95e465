// SPDX-License-Identifier: MIT
//
// For tests: a texture in a vector with a view of it, and short forms of the services' calls.
#pragma once

#include <algorithm>
#include <bit>
#include <functional>
#include <vector>

#include "kaamos/shader/abi.h"
#include "kaamos/shader/texture_view.h"
#include "runtime/shader/texture/format_codec.h"
#include "runtime/shader/texture/texel_access.h"
#include "runtime/shader/texture/texture_sampling.h"

namespace kaamos::shader {

inline constexpr uint32_t kFormatRgba32Float = 2, kFormatRgba32Uint = 3, kFormatRgba8Unorm = 28,
                          kFormatRgba8Srgb = 29, kFormatR32Float = 41, kFormatR32Uint = 42,
                          kFormatR8Unorm = 61;

inline Texel float_texel(float r, float g = 0, float b = 0, float a = 1) {
  return {{std::bit_cast<uint32_t>(r), std::bit_cast<uint32_t>(g), std::bit_cast<uint32_t>(b),
           std::bit_cast<uint32_t>(a)}};
}
inline float channel(const Texel& texel, int i) {
  return std::bit_cast<float>(texel.bits[i]);
}

// Rows and slices are padded, so that a wrong pitch is noticed.
struct TestTexture {
  std::vector<uint8_t> memory;
  TextureView view;
  Descriptor descriptor;

  using Fill = std::function<Texel(uint32_t x, uint32_t y, uint32_t slice, uint32_t mip)>;

  // `slices`: array elements, cube faces, or depth.
  TestTexture(TextureDimension dimension, uint32_t format, uint32_t width, uint32_t height,
              uint32_t slices, uint32_t mips, const Fill& fill) {
    const bool is_3d = dimension == TextureDimension::k3D;
    const FormatCodec& codec = format_codec(format);
    view.format = format;
    view.dimension = dimension;
    view.unordered_access = true;
    view.mip_count = mips;
    view.slice_count = is_3d ? 1 : slices;
    uint64_t offsets[kMaxTextureMips], size = 64;
    for (uint32_t i = 0; i < mips; ++i) {
      TextureMip& m = view.mips[i];
      m.width = std::max(width >> i, 1u);
      m.height = std::max(height >> i, 1u);
      m.depth = is_3d ? std::max(slices >> i, 1u) : 1;
      m.row_pitch = m.width * codec.bytes + 12;
      m.slice_pitch = uint64_t{m.row_pitch} * m.height + 20;
      offsets[i] = size;
      size += m.slice_pitch * (is_3d ? m.depth : slices);
    }
    memory.assign(size, 0xCD);
    for (uint32_t i = 0; i < mips; ++i) {
      TextureMip& m = view.mips[i];
      m.texels = memory.data() + offsets[i];
      for (uint32_t z = 0; z < (is_3d ? m.depth : slices); ++z) {
        for (uint32_t y = 0; y < m.height; ++y) {
          for (uint32_t x = 0; x < m.width; ++x) {
            codec.encode(m.texels + z * m.slice_pitch + y * m.row_pitch + x * codec.bytes,
                         fill(x, y, z, i));
          }
        }
      }
    }
    descriptor.kind = DescriptorKind::kTexture;
    descriptor.address = reinterpret_cast<uintptr_t>(&view);
  }
  TestTexture(const TestTexture&) = delete;
};

struct TestSampler {
  SamplerState state;
  Descriptor descriptor;

  explicit TestSampler(uint32_t filter, uint32_t address = 1) {
    state.filter = filter;
    for (uint32_t& mode : state.address) mode = address;
    descriptor.kind = DescriptorKind::kSampler;
    descriptor.access = DescriptorAccess::kOther;
    descriptor.address = reinterpret_cast<uintptr_t>(&state);
  }
  TestSampler(const TestSampler&) = delete;
};

inline SampleArguments sample_arguments(const TestTexture& texture, const TestSampler& sampler,
                                        float u, float v = 0, float w = 0, float q = 0) {
  SampleArguments arguments = {};
  arguments.texture = &texture.descriptor;
  arguments.sampler = &sampler.descriptor;
  arguments.coordinates[0] = u;
  arguments.coordinates[1] = v;
  arguments.coordinates[2] = w;
  arguments.coordinates[3] = q;
  return arguments;
}

}  // namespace kaamos::shader
