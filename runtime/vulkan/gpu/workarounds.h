// SPDX-License-Identifier: MIT
//
// Driver faults that this backend works around: which, on which drivers, and how to disable each.
// runtime/vulkan/README.md and draws/README.md explain them.
#pragma once

#include <volk.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kaamos::vulkan {

enum class Workaround : uint32_t {
  kRestoreAttributes,      // B1
  kOwnIntersectionStages,  // B2
  kCopyHitBuiltins,        // B3
  kPadBoxes,               // B4
  kFirstVertexInAddress,   // B5
  kSanitizeNan,            // B6
  kTrackReportedT,         // B7
  kInterleaveRows,         // B11
  kSortPrimitives,         // SORT
  kFilterInFloats,         // FILTER
  kBoundPayloads,          // PAYLOAD
  kReserveCallables,       // CALLABLES
  kKeepMemoryWrites,       // RASUAV
  kHalveDepthBias,         // BIAS2
  kBarycentricsStage,      // BARY
  kRoundTenBits,           // RT10
  kRefuseSnormBlend,       // SNORMB
  kLimitSnorm,             // SNORMC
  kReplaceNanDepth,        // NANZ
  kKeepHeap,               // TRIM
  kLimitDepth,             // DEPTH16
};

// Driver versions as one number: major * 1000 + minor.
struct WorkaroundInfo {
  Workaround workaround;
  const char* name;  // "B1": the name that KAAMOS_VULKAN_DISABLE_WORKAROUNDS lists
  VkDriverId driver;
  uint32_t first_version;
  uint32_t last_version;
  bool by_default;      // false: only if KAAMOS_VULKAN_ENABLE_WORKAROUNDS lists it
  uint32_t shader_bit;  // shader::spirv::Workaround, or 0
  const char* reason;
};
std::span<const WorkaroundInfo> workaround_table();

class Workarounds {
 public:
  bool has(Workaround workaround) const {
    return (bits_ >> static_cast<uint32_t>(workaround) & 1) != 0;
  }
  // The value of kWorkaroundsConstant.
  uint32_t shader_bits() const { return shader_bits_; }

  void insert(const WorkaroundInfo& info) {
    bits_ |= 1u << static_cast<uint32_t>(info.workaround);
    shader_bits_ |= info.shader_bit;
  }

 private:
  uint32_t bits_ = 0;
  uint32_t shader_bits_ = 0;
};

// "Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)" gives 25000; 0 if there is no such version in it.
uint32_t driver_version(std::string_view driver_info);

// The workarounds for a driver. `disabled` and `enabled` are comma-separated lists of names; "all"
// means every one. Unknown names go to `unknown`.
Workarounds workarounds_for(VkDriverId driver, std::string_view driver_info,
                            std::string_view disabled, std::string_view enabled,
                            std::vector<std::string>* unknown);

}  // namespace kaamos::vulkan
