// SPDX-License-Identifier: MIT
//
// Joins eight colours with what a render target holds: blending in float, logic operations bit by
// bit. [D3D11.3: 17.5, 17.9]
#pragma once

#include <rtapi/graphics_pipeline.h>

#include "runtime/raster/target_codec.h"

namespace kaamos::raster {

// Four columns of floats each. The sources are clamped to what the format can hold; `second` is
// null if no factor reads it.
void blend_colors(const rtapi::RenderTargetBlendDesc& desc, const TargetCodec& codec,
                  const float blend_factor[4], const shader::Column* source,
                  const shader::Column* second, const shader::Column* destination,
                  shader::Column* result);

// `words`: of the source, and then the result.
void apply_logic_op(rtapi::LogicOp op, const shader::Column& destination, shader::Column& words);

}  // namespace kaamos::raster
