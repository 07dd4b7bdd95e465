// SPDX-License-Identifier: MIT
/// @file
/// The passes of the views, each over a finished frame, whose numbers come back as 4 channels. The
/// shaders tell what they are.
#pragma once

#include <rtapi/rtapi.h>

#include <string>

#include "effects/assets/image/image.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {

/// The shaders of views of hits, which are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> hit_views_library();
/// The shaders of views of pixels, likewise.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> pixel_views_library();

// Each takes a renderer that has rendered a frame with what ViewNeeds name. [views.h]
//
// The views of hit_views.hlsl show where the first reflection ray of each pixel hits; the fourth
// channel is the distance in metres (-1: it hits nothing, 0: there is no ray). Rays are as long as
// those of the frame's reflections.

/// Texture coordinates of hits.
/// @errors those of the device and of RayPass::create.
rtapi::Result<FloatImage> view_hit_uv(FrameRenderer& renderer);
/// Base colours of hits.
/// @errors those of the device and of RayPass::create.
rtapi::Result<FloatImage> view_hit_albedo(FrameRenderer& renderer);
/// Radiance of hits as if all were white and matte.
/// @errors those of the device and of RayPass::create.
rtapi::Result<FloatImage> view_hit_lighting(FrameRenderer& renderer);

// The views of pixel_views.hlsl show what the frame holds for each pixel. `signal`: one of
// remembered_signals.

/// Bottom level, instance, primitive, and whether the edge of an instance's box is there.
/// @errors those of the device and of ComputePass::create.
rtapi::Result<FloatImage> view_bottom_levels(FrameRenderer& renderer);
/// Lights of the pixel's cluster, which one that is, and 1 where its list has overflowed.
/// @errors those of the device and of ComputePass::create.
rtapi::Result<FloatImage> view_light_clusters(FrameRenderer& renderer);
/// Variance, its root and the mean of a signal, and frames behind them.
/// @errors those of the device and of ComputePass::create.
rtapi::Result<FloatImage> view_variance(FrameRenderer& renderer, const std::string& signal);
/// Frames that the denoiser of a signal has gathered.
/// @errors those of the device and of ComputePass::create.
rtapi::Result<FloatImage> view_history_length(FrameRenderer& renderer, const std::string& signal);
/// Level, number and side in metres of the cell of indirect light, and whether it is in a solid.
/// @errors those of the device and of ComputePass::create.
rtapi::Result<FloatImage> view_volume_cells(FrameRenderer& renderer);

}  // namespace kaamos::effects
