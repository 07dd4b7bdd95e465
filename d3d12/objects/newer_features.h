// SPDX-License-Identifier: MIT
//
// Features of CheckFeatureSupport whose values are past those of an older d3d12.h, so that a switch
// over its enumeration has no room for them. Numbers are those of Agility SDK 1.619.
#pragma once

#include <windows.h>

namespace kaamos::d3d12::newer {

// Values of D3D12_FEATURE.
enum class Feature : UINT {
  kOptions16 = 45,
  kOptions17 = 46,
  kOptions18 = 47,
  kOptions19 = 48,
  kOptions20 = 49,
  kPredication = 50,
  kHardwareCopy = 52,
  kOptions21 = 53,
  kTightAlignment = 54,
  kOptions22 = 65,
};

}  // namespace kaamos::d3d12::newer
