// SPDX-License-Identifier: MIT
//
// Faults of drivers that this backend works around: which, for whom, and how to do without. The
// README of this folder explains each.
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
};

// Versions of drivers as one number: major * 1000 + minor.
struct WorkaroundInfo {
  Workaround workaround;
  const char* name;  // "B1": what KAAMOS_VULKAN_DISABLE_WORKAROUNDS lists
  VkDriverId driver;
  uint32_t first_version;
  uint32_t last_version;
  bool by_default;      // false: only where KAAMOS_VULKAN_ENABLE_WORKAROUNDS lists it
  uint32_t shader_bit;  // shader::spirv::Workaround, or 0
  const char* reason;
};
std::span<const WorkaroundInfo> workaround_table();

class Workarounds {
 public:
  bool has(Workaround workaround) const {
    return (bits_ >> static_cast<uint32_t>(workaround) & 1) != 0;
  }
  // For kWorkaroundsConstant.
  uint32_t shader_bits() const { return shader_bits_; }

  void insert(const WorkaroundInfo& info) {
    bits_ |= 1u << static_cast<uint32_t>(info.workaround);
    shader_bits_ |= info.shader_bit;
  }

 private:
  uint32_t bits_ = 0;
  uint32_t shader_bits_ = 0;
};

// "Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)" is 25000; 0 where no version of that form is in it.
uint32_t driver_version(std::string_view driver_info);

// Those for a driver. `disabled` and `enabled` are lists of names with commas between; "all" is
// each of them. Names that are none go to `unknown`.
Workarounds workarounds_for(VkDriverId driver, std::string_view driver_info,
                            std::string_view disabled, std::string_view enabled,
                            std::vector<std::string>* unknown);

}  // namespace kaamos::vulkan
