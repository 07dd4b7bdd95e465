// SPDX-License-Identifier: MIT
/// @file
/// The skinned runner: a figure of capsules on a 20-bone skeleton that walks in a circle, with a
/// cape on its back, and a crowd of the same figure.
#pragma once

#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Who runs.
struct RunnerOptions {
  std::uint32_t crowd = 8;  ///< figures besides the hero
  /// In how many poses the crowd walks: figures in the same pose share vertices and structure.
  std::uint32_t crowd_poses = 4;
};

/// Instance 0 is the floor, 1 the hero, then the crowd. The walk closes after kRunnerSeconds.
Scene make_runner_scene(const RunnerOptions& options = {});

/// After so many seconds the walk starts anew.
inline constexpr double kRunnerSeconds = 8.0;
/// Joints of each figure.
inline constexpr std::uint32_t kRunnerBones = 20;

}  // namespace kaamos::effects
