// SPDX-License-Identifier: MIT
//
// Links the stages of a graphics pipeline by their semantics.
#pragma once

#include <rtapi/graphics_pipeline.h>
#include <rtapi/result.h>

#include "runtime/backend/linked_graphics.h"

namespace rtapi::detail {

struct DeviceImpl;

// Elements of the input layout to inputs of the vertex shader. [RAS-13 to RAS-19]
Status link_input_layout(const GraphicsPipelineStateDesc& desc,
                         kaamos::runtime::LinkedGraphics& linked);
// Outputs of the vertex shader to inputs of the pixel shader, and system values of both.
// [RAS-21 to RAS-24, RAS-77 to RAS-80]
Status link_stages(const DeviceImpl& device, kaamos::runtime::LinkedGraphics& linked);
// Outputs of the pixel shader to render targets. [RAS-109 to RAS-112]
Status link_targets(const DeviceImpl& device, kaamos::runtime::LinkedGraphics& linked);

}  // namespace rtapi::detail
