// SPDX-License-Identifier: MIT
/// @file
/// Makes what scene files often lack: camera, sun, sky, ground.
#pragma once

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// A camera that frames `bounds` seen from the front, the right and a little above.
Camera framing_camera(const Bounds& bounds);

/// True where the middle of the scene is closed in by surfaces that face it: a room. Scenes of more
/// than 4 million triangles are not looked at, and count as seen from outside.
bool is_interior(const Scene& scene);

/// Inside a room a camera before one of its corners that looks across; else the framing camera.
Camera default_camera(const Scene& scene);

/// A warm sun, high and from the side.
Sun default_sun();
/// A blue sky over grey ground.
Sky default_sky();

/// True where little lies under the scene that a shadow could fall on: less than a third of its
/// outline is covered by surfaces facing up in its lowest twentieth.
bool needs_ground(const Scene& scene);

/// Adds a grey plane (mesh and instance "ground") under the scene, 12 times as wide as it is. It is
/// not counted by cameras made before.
void add_ground(Scene& scene);

}  // namespace kaamos::effects
