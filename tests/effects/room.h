// SPDX-License-Identifier: MIT
//
// A small room that gives every effect something to do, and the ways in which tests move, turn and
// take it apart. All positions are multiples of 1/64 m, so adding whole metres rounds nothing.
#pragma once

#include <glm/glm.hpp>

#include "rig.h"

namespace kaamos::test {

// The index of each material.
enum RoomMaterial : std::uint32_t {
  kRoomWall,
  kRoomFloor,   // glossy
  kRoomMirror,  // roughness 0
  kRoomMetal,   // rough
  kRoomCard,    // alpha-tested
  kRoomGlass,
  kRoomLamp,  // emits
};

// Three of four walls, a mirror, a ball of rough metal, a card with holes, a pane, a lamp, three
// local lights, the sun and a uniform sky.
effects::Scene make_room();

struct Case {
  effects::Scene scene;
  RigOptions options;
};

// Multiplies everything measured in metres by `s`: geometry, lights, camera, and the effects' own
// lengths. Illuminances stay the same. `by_transforms`: instances grow instead of meshes.
Case scaled(Case of, double s, bool by_transforms = false);
effects::Scene moved(effects::Scene scene, const glm::dvec3& by);
// `turn` is a rotation. The sky must be uniform.
effects::Scene turned(effects::Scene scene, const glm::dmat3& turn);
// The triangles of every geometry in another order, with their corners rotated.
effects::Scene reordered(effects::Scene scene);
// Makes every instance a mesh of its own with vertices in world space.
effects::Scene flattened(effects::Scene scene);
// Squeezes every instance's mesh by 1:64, skews it, and gives the instance a transform that undoes
// this.
effects::Scene stretched(effects::Scene scene);
// The mirror image in x, which shows the room's picture flipped left to right. Instances get
// transforms with a negative determinant.
effects::Scene mirrored(effects::Scene scene);
// Makes local lights, sun, sky and lamps k times as bright.
effects::Scene brightened(effects::Scene scene, float k);

}  // namespace kaamos::test
