// SPDX-License-Identifier: MIT
//
// Renders every effect of one small frame on a backend.
#pragma once

#include <map>
#include <string>

#include "effects/assets/scene/scene.h"
#include "effects/engine/frame.h"
#include "effects/glass/transparent/transparent.h"

namespace kaamos::parity {

struct FrameRun {
  std::string backend = "embree";
  uint32_t width = 320;
  uint32_t height = 180;
  uint32_t samples = 4;
  uint32_t seed = 3;
};

struct RenderedFrame {
  std::map<effects::FrameTexture, effects::FloatImage> pictures;
  std::map<std::string, effects::FloatImage> sums;  // of visible samples, by signal
};

// All pictures of the frame, and the sums of ambient occlusion and the sun. Throws
// rtapi::ResultError.
RenderedFrame render_frame(const effects::Scene& scene, const FrameRun& run);

struct GlassRun {
  effects::FloatImage ids;       // of what is behind the glass
  effects::FloatImage whole;     // radiance, glass over what is behind it
  effects::FloatImage coverage;  // transmittance, and the number of layers traced one by one
};

// The transparent pass, lit by sunlight and sky.
GlassRun render_glass(const effects::Scene& scene, const FrameRun& run,
                      const effects::TransparentConstants& constants);

}  // namespace kaamos::parity
