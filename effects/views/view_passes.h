// SPDX-License-Identifier: MIT
/// @file
/// What each view looks at: a pass over a finished frame, whose numbers come back as 4 channels.
/// The shaders tell what they are.
#pragma once

#include <rtapi/rtapi.h>

#include <string>

#include "effects/image/image.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
///@{
rtapi::Result<rtapi::ShaderLibrary> hit_views_library();
rtapi::Result<rtapi::ShaderLibrary> pixel_views_library();
///@}

// Each has the errors of the device, of RayPass::create or of ComputePass::create, and takes a
// renderer that has rendered a frame with what ViewNeeds name. [views.h]

/// Where the first reflection ray of each pixel hits, of hit_views.hlsl: texture coordinates, base
/// colour, lighting alone; and the distance in metres (-1: it hits nothing, 0: there is no ray).
/// Rays are as long as those of the frame's reflections.
///@{
rtapi::Result<FloatImage> view_hit_uv(FrameRenderer& renderer);
rtapi::Result<FloatImage> view_hit_albedo(FrameRenderer& renderer);
rtapi::Result<FloatImage> view_hit_lighting(FrameRenderer& renderer);
///@}

/// What the frame holds for each pixel, of pixel_views.hlsl. `signal`: one of remembered_signals.
///@{
rtapi::Result<FloatImage> view_bottom_levels(FrameRenderer& renderer);
rtapi::Result<FloatImage> view_light_clusters(FrameRenderer& renderer);
rtapi::Result<FloatImage> view_variance(FrameRenderer& renderer, const std::string& signal);
rtapi::Result<FloatImage> view_history_length(FrameRenderer& renderer, const std::string& signal);
rtapi::Result<FloatImage> view_volume_cells(FrameRenderer& renderer);
///@}

}  // namespace kaamos::effects
