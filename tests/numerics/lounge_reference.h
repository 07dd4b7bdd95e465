// SPDX-License-Identifier: MIT
//
// The lounge at 96 x 54 pixels: ambient occlusion and sun visibility, with their error bounds.
#pragma once

#include <cstdint>
#include <string>

#include "effect_run.h"
#include "effects/assets/common/errors.h"
#include "effects/assets/scene/scene.h"

namespace kaamos::test {

inline constexpr std::uint32_t kLoungeWidth = 96;
inline constexpr std::uint32_t kLoungeHeight = 54;
// The committed reference has kLoungeScrambles pictures of kLoungeRays each, with seeds from 0 on.
inline constexpr std::uint32_t kLoungeScrambles = 16;
inline constexpr std::uint32_t kLoungeRays = 2048;
// Rays of the picture that a normal run compares with it.
inline constexpr std::uint32_t kQuickRays = 256;
inline constexpr std::uint32_t kQuickSeed = 1000;

// The mean over the scrambles, pixel by pixel.
struct Estimate {
  effects::FloatImage mean;
  effects::FloatImage error;      // standard error of the mean, from the spread of the scrambles
  effects::FloatImage deviation;  // standard deviation of a single scramble
  effects::FloatImage ids;        // instance + 1, primitive
};

// Throws rtapi::ResultError. `scrambles` >= 2; seeds first_seed, first_seed + 1, ...
Estimate estimate_lounge(const effects::Scene& lounge, Effect effect, std::uint32_t rays,
                         std::uint32_t scrambles, std::uint32_t first_seed);
EffectRun lounge_run(Effect effect, std::uint32_t rays, std::uint32_t seed);

// The committed data for one effect.
struct LoungeReference {
  effects::FloatImage mean;
  effects::FloatImage error;      // standard error of the mean
  effects::FloatImage deviation;  // standard deviation of one picture of kQuickRays
  effects::FloatImage ids;
};

std::string lounge_reference_path();  // in the source tree
effects::Result<LoungeReference> read_lounge_reference(Effect effect);
// Renders everything again, which takes a minute or more. Throws rtapi::ResultError.
effects::Status write_lounge_reference(const std::string& path);

}  // namespace kaamos::test
