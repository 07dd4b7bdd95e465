// SPDX-License-Identifier: MIT
/// @file
/// The shader libraries of a frame: those of its effects, by the registry, and those of the passes
/// that every frame stands on.
#pragma once

#include <rtapi/rtapi.h>

#include <map>
#include <string>
#include <vector>

#include "effects/denoise/denoise.h"
#include "effects/northlight/effects.h"
#include "effects/northlight/settings.h"

namespace kaamos::effects {

/// By EffectLibrary::file.
using ShaderLibraries = std::map<std::string, rtapi::ShaderLibrary>;

/// Those that a frame of these settings needs.
std::vector<EffectLibrary> frame_libraries(
    const FrameSettings& settings, const std::vector<Effect>& effects = northlight_effects());

/// Loads what is built in.
/// @errors those of rtapi::LoadShaderLibrary.
rtapi::Result<ShaderLibraries> load_libraries(const std::vector<EffectLibrary>& libraries);

/// The denoiser's among them.
DenoiseLibraries denoise_libraries(const ShaderLibraries& libraries);

}  // namespace kaamos::effects
