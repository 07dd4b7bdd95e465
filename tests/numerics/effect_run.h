// SPDX-License-Identifier: MIT
//
// Runs one effect over one scene through the real passes, on a picture small enough for thousands
// of rays per pixel.
#pragma once

#include <cstdint>

#include "effects/assets/scene/scene.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::test {

enum class Effect { kAmbientOcclusion, kSunShadow };

struct EffectRun {
  Effect effect = Effect::kAmbientOcclusion;
  std::uint32_t width = 24;
  std::uint32_t height = 16;
  std::uint32_t samples = 4096;
  float radius = 4.0f;  // of ambient occlusion
  std::uint32_t seed = 0;
  std::uint32_t threads = 0;
};

struct EffectResult {
  effects::FloatImage visibility;  // mean over the samples
  effects::FloatImage position;    // x, y, z relative to the camera
  effects::FloatImage ids;         // instance + 1, primitive
};

// Throws rtapi::ResultError.
EffectResult run_effect(const effects::Scene& scene, const EffectRun& run);

}  // namespace kaamos::test
