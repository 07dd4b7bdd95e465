// SPDX-License-Identifier: MIT
/// @file
/// Levels of detail: which mesh of an instance a frame shows. All effects' rays and the G-buffer
/// see the same level, because they share one top level. [Northlight deck: Bottom Level Structures]
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Part of the picture's height that the sphere around the mesh in `transform` covers; infinite
/// where the camera is inside of it.
double screen_coverage(const Bounds& bounds, const glm::dmat4& transform, const Camera& camera);

/// The mesh to show of each instance: the first of its levels that covers enough, else the last.
/// `transforms`: one per instance; empty: those of the scene.
std::vector<std::uint32_t> select_levels(const Scene& scene, const Camera& camera,
                                         std::span<const glm::dmat4> transforms = {});
/// Makes the scene show the levels that the camera wants; meshes and levels stay.
void show_levels(Scene& scene, const Camera& camera);

/// Coverage of `count` levels where a file gives none: half as much from level to level, from 0.5
/// on, and 0 for the last.
std::vector<float> default_coverages(std::size_t count);

/// Joins instances at one place whose names are the same up to "lod0", "lod1", ... (any case) into
/// one with levels, as exporters write them that know no extension for it. Returns how many are
/// gone.
std::size_t join_levels_by_name(Scene& scene);

}  // namespace kaamos::effects
