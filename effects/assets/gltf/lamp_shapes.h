// SPDX-License-Identifier: MIT
/// @file
/// Geometry that glows where a local light stands is the picture of that lamp. Files do not say so,
/// and would have the light twice: from the lamp and from what glows.
#pragma once

#include <cstddef>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Finds geometries whose material emits light without a texture, whose box holds a point or spot
/// light, and which are smaller than a tenth of the scene. Each becomes an instance of its own with
/// kMaskEmissiveProxy. What has skins or levels of detail stays as it is. Returns the number of
/// geometries found.
std::size_t separate_lamp_shapes(Scene& scene);

}  // namespace kaamos::effects
