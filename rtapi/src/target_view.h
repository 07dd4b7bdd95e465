// SPDX-License-Identifier: MIT
//
// Render target and depth-stencil descriptors: slots that only the host reads, when a call is
// recorded.
#pragma once

#include <memory>
#include <string>

#include <rtapi/result.h>
#include <rtapi/types.h>

#include "runtime/backend/draw_commands.h"

namespace rtapi::detail {

struct DeviceImpl;
struct TextureImpl;
struct MemoryUse;

struct TargetSlot {
  std::weak_ptr<TextureImpl> texture;  // a descriptor keeps nothing alive
  kaamos::runtime::TargetView view;    // its texture is null
  bool written = false;
  bool is_null = false;  // a null descriptor: draws to it are dropped
  std::string texture_name = {};
};

// What a handle stands for now. A null descriptor gives a view without texture.
struct ReadTarget {
  kaamos::runtime::TargetView view;
  std::weak_ptr<const void> owner;
  std::string texture_name;
};
// KA0731 unless it is a descriptor of a living texture in a heap of that type.
Result<ReadTarget> ReadTargetSlot(const DeviceImpl& device, CpuDescriptorHandle handle,
                                  bool depth_stencil, const std::string& where);

}  // namespace rtapi::detail
