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
#include "effects/engine/outcome.h"
#include "effects/northlight/effects.h"
#include "effects/northlight/pass_runner.h"
#include "effects/northlight/settings.h"

namespace kaamos::effects {

/// By EffectLibrary::file.
using ShaderLibraries = std::map<std::string, rtapi::ShaderLibrary>;

/// Those that a frame of these settings needs.
std::vector<EffectLibrary> frame_libraries(
    const FrameSettings& settings, const std::vector<Effect>& effects = northlight_effects());

/// Loads what is built in, and compiles first what the build left to its first use, on all threads;
/// `progress` is told on the caller's, and only of what takes longer than half a second. `out` is
/// complete with kDone.
/// @errors those of rtapi::LoadShaderLibrary.
rtapi::Result<Outcome> load_libraries(const std::vector<EffectLibrary>& libraries,
                                      ShaderLibraries& out, const Progress& progress = {});

/// The denoiser's among them.
DenoiseLibraries denoise_libraries(const ShaderLibraries& libraries);

}  // namespace kaamos::effects
