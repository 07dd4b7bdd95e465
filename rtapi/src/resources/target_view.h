// SPDX-License-Identifier: MIT
//
// Render target and depth-stencil descriptors, as calls that draw to them read them.
#pragma once

#include <memory>
#include <string>

#include <rtapi/result.h>
#include <rtapi/types.h>

#include "runtime/backend/draw_commands.h"

namespace rtapi::detail {

struct DeviceImpl;

// The target that a handle stands for now. A null descriptor gives a view without texture.
struct ReadTarget {
  kaamos::runtime::TargetView view;
  std::weak_ptr<const void> owner;
  std::string texture_name;
};
// KA0731 unless it is a descriptor of a living texture in a heap of that type.
Result<ReadTarget> read_target_slot(const DeviceImpl& device, CpuDescriptorHandle handle,
                                    bool depth_stencil, const std::string& where);

}  // namespace rtapi::detail
