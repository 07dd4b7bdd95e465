// SPDX-License-Identifier: MIT
//
// Blends eight colours with what a render target holds, in float. [D3D11.3: 17.5]
#pragma once

#include <rtapi/graphics_pipeline.h>

#include "runtime/raster/target_codec.h"

namespace kaamos::raster {

// `colors`: four columns of floats each. `source` is clamped to what the format can hold.
void blend_colors(const rtapi::RenderTargetBlendDesc& desc, const TargetCodec& codec,
                  const float blend_factor[4], const shader::Column* source,
                  const shader::Column* destination, shader::Column* result);

}  // namespace kaamos::raster
