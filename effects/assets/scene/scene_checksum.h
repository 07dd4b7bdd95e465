// SPDX-License-Identifier: MIT
/// @file
/// A checksum of a scene, for what is kept in files and was made from it.
#pragma once

#include "effects/assets/common/checksum.h"
#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Adds all that a picture of the scene depends on: everything but names. Exposure counts too.
void add_scene(Checksum& checksum, const Scene& scene);

}  // namespace kaamos::effects
