// SPDX-License-Identifier: MIT
/// @file
/// The context that the stages of a frame share.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/engine/frame.h"
#include "effects/engine/gpu_scene.h"
#include "effects/engine/profile.h"
#include "effects/engine/ray_pass.h"
#include "effects/northlight/libraries.h"
#include "effects/northlight/pass_runner.h"
#include "effects/northlight/settings.h"

namespace kaamos::effects {

/// A frame of a sequence.
struct FrameMoment {
  std::uint32_t index = 0;  ///< from 0 on
  double seconds = 0;       ///< on the scene's clock
  Camera camera;            ///< where it is seen from
  bool cut = false;         ///< the frame is unrelated to the previous one
};

/// One frame, as all of its stages see it: what it is made of, and what executes it.
struct FrameContext {
  const Scene& scene;           ///< what is rendered
  FrameSettings settings;       ///< with the effects that the chosen ones include
  std::vector<Effect> effects;  ///< the registry
  rtapi::Device device;         ///< what executes it
  PassRunner runner = {};       ///< executes and times its passes
  GpuScene gpu = {};            ///< `scene` on the device
  Frame frame = {};             ///< the pictures and root table that all passes share
  /// The one that the last begin_frame began; before that the scene's camera, at 0 s.
  FrameMoment moment = {};
  ShaderLibraries libraries = {};  ///< those that prepare took
  /// Parts of the frame that this scene or these settings have no use for, and why.
  std::vector<std::string> left_out = {};
  Profile* profile = nullptr;  ///< gets the steps of the work; null: nobody asks
  /// Statistics of preparing a whole frame; empty if there was nothing to bake or to load.
  std::optional<PassStatistics> set_up = {};
};

/// Adds what an unprepared frame can tell of FrameContext::left_out: by its settings and its scene.
void list_left_out(FrameContext& context);

/// The pipelines of the G-buffer, unless it is drawn, and of the effects, for their shader tables,
/// with the built-in shaders. They are made without preparing anything else.
/// @errors those of rtapi::LoadShaderLibrary and of RayPass::create.
rtapi::Result<std::vector<std::pair<std::string, RayPass>>> create_ray_passes(
    const FrameContext& context);

}  // namespace kaamos::effects
