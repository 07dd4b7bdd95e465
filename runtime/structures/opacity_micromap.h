// SPDX-License-Identifier: MIT
//
// Opacity micromaps: what an array holds once it is built, and the opacity of a point of a
// triangle. [DXR: Opacity micromaps]
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace kaamos::runtime {

// D3D12_RAYTRACING_OPACITY_MICROMAP_STATE.
enum class MicromapState : uint8_t {
  kTransparent = 0,
  kOpaque = 1,
  kUnknownTransparent = 2,
  kUnknownOpaque = 3,
  kOfGeometry = 4,  // there is none: the geometry's own opacity counts
};
// What it is where only two states count. [DXR: RAY_FLAG_FORCE_OMM_2_STATE]
constexpr MicromapState as_two_states(MicromapState state) {
  return static_cast<MicromapState>(static_cast<uint8_t>(state) & 1);
}

// D3D12_RAYTRACING_OPACITY_MICROMAP_FORMAT.
enum class MicromapFormat : uint16_t { kTwoStates = 1, kFourStates = 2 };

inline constexpr uint32_t kMaxSubdivisionLevel = 12;

// D3D12_RAYTRACING_OPACITY_MICROMAP_SPECIAL_INDEX.
enum class SpecialIndex : int32_t {
  kFullyTransparent = -1,
  kFullyOpaque = -2,
  kFullyUnknownTransparent = -3,
  kFullyUnknownOpaque = -4,
  kClusterSkip = -5,
};

// D3D12_RAYTRACING_OPACITY_MICROMAP_DESC as it lies in GPU memory.
struct MicromapDesc {
  uint32_t byte_offset = 0;
  uint16_t subdivision_level = 0;
  uint16_t format = 0;
};
static_assert(sizeof(MicromapDesc) == 8);

// Bytes of the micro-triangles of one micromap: at least 1.
constexpr uint64_t micromap_bytes(uint32_t level, MicromapFormat format) {
  const uint64_t bits = (uint64_t{1} << 2 * level) * (format == MicromapFormat::kTwoStates ? 1 : 2);
  return bits < 8 ? 1 : bits / 8;
}

// The micro-triangle that holds the point with these barycentrics, u and v the weights of vertices
// 1 and 2 as the triangle was built. Points on an edge between two belong to either.
inline uint32_t micro_triangle_index(float u, float v, uint32_t level);

// The micromaps of an array, copied from the build's inputs.
class MicromapArray {
 public:
  static constexpr uint64_t kBytesEach = 16;  // besides its bits

  // `bits` are the input buffer's bytes from the micromap's offset on: as many as micromap_bytes().
  void add(uint32_t level, MicromapFormat format, std::span<const uint8_t> bits);

  uint32_t size() const { return static_cast<uint32_t>(micromaps_.size()); }
  uint32_t level(uint32_t micromap) const { return micromaps_[micromap].level; }
  MicromapFormat format(uint32_t micromap) const { return micromaps_[micromap].format; }
  std::span<const uint8_t> bits(uint32_t micromap) const {
    const Micromap& one = micromaps_[micromap];
    return std::span(bits_).subspan(one.offset, micromap_bytes(one.level, one.format));
  }
  uint64_t held_bytes() const { return bits_.size() + micromaps_.size() * kBytesEach; }
  MicromapState state(uint32_t micromap, uint32_t micro_triangle) const {
    const Micromap& one = micromaps_[micromap];
    const uint8_t* bits = bits_.data() + one.offset;
    const uint32_t k = micro_triangle;
    if (one.format == MicromapFormat::kTwoStates) {
      return static_cast<MicromapState>(bits[k >> 3] >> (k & 7) & 1);
    }
    return static_cast<MicromapState>(bits[k >> 2] >> 2 * (k & 3) & 3);
  }
  MicromapState state_at(uint32_t micromap, float u, float v) const {
    return state(micromap, micro_triangle_index(u, v, micromaps_[micromap].level));
  }

 private:
  struct Micromap {
    uint64_t offset;  // in bits_
    uint32_t level;
    MicromapFormat format;
  };
  std::vector<Micromap> micromaps_;
  std::vector<uint8_t> bits_;
};

// Which micromap each triangle of a geometry has.
struct MicromapLinkage {
  uint64_t address = 0;          // of the array; 0: all indices are special ones
  std::vector<int32_t> indices;  // by triangle: a micromap of the array, or a SpecialIndex
  // What was at the address when it was first there; kept, even if other data come there later.
  std::shared_ptr<const MicromapArray> array;

  // What cannot be looked up, for want of an array or of a micromap, any-hit shaders decide.
  MicromapState state_at(uint32_t primitive, float u, float v) const {
    const int32_t index = indices[primitive];
    if (index >= 0) {
      const auto micromap = static_cast<uint32_t>(index);
      if (array == nullptr || micromap >= array->size()) return MicromapState::kUnknownOpaque;
      return array->state_at(micromap, u, v);
    }
    // -1 to -5 are the states 0 to 4.
    return static_cast<MicromapState>(~index);
  }
};

// Opacity of a triangle after micromap, instance and ray have had their say.
enum class Opacity : uint8_t { kTransparent, kOpaque, kNonOpaque };

// What a micromap's state makes of a triangle. `two_states`: instance or ray fold unknown states.
inline Opacity opacity_of(MicromapState state, bool two_states, bool geometry_opaque) {
  if (state == MicromapState::kOfGeometry) {
    return geometry_opaque ? Opacity::kOpaque : Opacity::kNonOpaque;
  }
  if (two_states) state = as_two_states(state);
  if (state == MicromapState::kTransparent) return Opacity::kTransparent;
  return state == MicromapState::kOpaque ? Opacity::kOpaque : Opacity::kNonOpaque;
}

// The low 16 bits, each moved to twice its place.
constexpr uint32_t spread_bits(uint32_t bits) {
  bits = (bits | bits << 8) & 0x00FF00FFu;
  bits = (bits | bits << 4) & 0x0F0F0F0Fu;
  bits = (bits | bits << 2) & 0x33333333u;
  return (bits | bits << 1) & 0x55555555u;
}

// The curve of DXR's figures: it enters a triangle at its first vertex, leaves it at its last one,
// and visits a quarter, the middle, and the two other quarters.
inline uint32_t micro_triangle_index(float u, float v, uint32_t level) {
  const uint32_t n = 1u << level;
  // NaN becomes 0.
  const float fu = (u > 0 ? std::min(u, 1.0f) : 0.0f) * static_cast<float>(n);
  const float fv = (v > 0 ? std::min(v, 1.0f) : 0.0f) * static_cast<float>(n);
  uint32_t iu = std::min(static_cast<uint32_t>(fu), n - 1);
  const uint32_t iv = std::min(static_cast<uint32_t>(fv), n - 1);
  // Truncation is the floor of what is not negative.
  const float within = (fu - static_cast<float>(static_cast<uint32_t>(fu))) +
                       (fv - static_cast<float>(static_cast<uint32_t>(fv)));
  const uint32_t sum = iu + iv;
  if (sum >= n) iu -= sum - n + 1;  // on or beyond the edge u + v = 1
  uint32_t iw = ~(iu + iv);
  if (within >= 1 && sum < n - 1) --iw;  // the cell's second triangle
  const uint32_t even = ~(iu ^ iw) & (n - 1);
  const uint32_t both = (iu ^ iv) & even;
  uint32_t flips = both;
  for (const uint32_t shift : {1u, 2u, 4u, 8u}) flips ^= flips >> shift;
  const uint32_t odd = (((flips ^ iu) & ~even) | both) & (n - 1);
  return spread_bits(even) | spread_bits(odd) << 1;
}

}  // namespace kaamos::runtime
