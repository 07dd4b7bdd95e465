// SPDX-License-Identifier: MIT
//
// A small room that gives every effect something to do, and the ways in which tests move, turn and
// take it apart. All places are multiples of 1/64 m: adding a whole number of metres rounds
// nothing.
#pragma once

#include <glm/glm.hpp>

#include "rig.h"

namespace kaamos::test {

// What stands where among the materials.
enum RoomMaterial : std::uint32_t {
  kRoomWall,
  kRoomFloor,   // glossy
  kRoomMirror,  // roughness 0
  kRoomMetal,   // rough
  kRoomCard,    // alpha-tested
  kRoomGlass,
  kRoomLamp,  // emits
};

// Four walls less one, a mirror, a ball of rough metal, a card with holes, a pane, a lamp, three
// local lights, sun and an even sky.
effects::Scene make_room();

struct Case {
  effects::Scene scene;
  RigOptions options;
};

// Everything that is measured in metres times `s`: geometry, lights, camera, and the effects' own
// lengths. Illuminances stay. `by_transforms`: meshes stay as they are and instances grow.
Case scaled(Case of, double s, bool by_transforms = false);
effects::Scene moved(effects::Scene scene, const glm::dvec3& by);
// `turn`: a rotation. The sky must be even.
effects::Scene turned(effects::Scene scene, const glm::dmat3& turn);
// Triangles of every geometry in another order, their corners turned.
effects::Scene reordered(effects::Scene scene);
// Every instance a mesh of its own whose vertices stand in the world.
effects::Scene flattened(effects::Scene scene);
// Every instance a mesh that was squeezed by 1:64, skewed, and a transform that undoes it.
effects::Scene stretched(effects::Scene scene);
// The mirror image in x; the picture is that of the room from right to left. Instances get
// transforms of negative determinant.
effects::Scene mirrored(effects::Scene scene);
// Local lights, sun, sky and lamps k times as bright.
effects::Scene brightened(effects::Scene scene, float k);

}  // namespace kaamos::test
