// SPDX-License-Identifier: MIT
//
// Opacity micromaps: what an array holds once it is built, and the opacity of a point of a triangle.
// [DXR: Opacity micromaps]
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace kaamos::runtime {

// D3D12_RAYTRACING_OPACITY_MICROMAP_STATE.
enum class MicromapState : uint8_t {
  kTransparent = 0,
  kOpaque = 1,
  kUnknownTransparent = 2,
  kUnknownOpaque = 3,
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

// The micro-triangle that holds the point with these barycentrics, u and v the weights of vertices 1
// and 2 as the triangle was built. Points on an edge between two belong to either.
uint32_t micro_triangle_index(float u, float v, uint32_t level);

// The micromaps of an array, copied from the build's inputs.
class MicromapArray {
 public:
  // `bits` are the input buffer's bytes from the micromap's offset on: as many as micromap_bytes().
  void add(uint32_t level, MicromapFormat format, std::span<const uint8_t> bits);

  uint32_t size() const { return static_cast<uint32_t>(micromaps_.size()); }
  uint32_t level(uint32_t micromap) const { return micromaps_[micromap].level; }
  MicromapState state(uint32_t micromap, uint32_t micro_triangle) const;
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

}  // namespace kaamos::runtime
