// SPDX-License-Identifier: MIT
// The meshes of the lounge; only lounge*.cpp include it.
#pragma once

#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects::lounge {

/// Materials, in the order of Scene::materials.
enum MaterialId : std::uint32_t {
  kFloor,
  kWall,
  kCeiling,
  kWood,
  kDarkWood,
  kBrass,
  kBlackMetal,
  kRubber,
  kTealFabric,
  kRedFabric,
  kSandFabric,
  kPiping,
  kRug,
  kPaper,
  kCover,
  kPorcelain,
  kSoil,
  kStem,
  kLeaf,
  kDomeShell,
  kDomeLine,
  kLampBulb,
  kTerrace,
  kMaterialCount
};

/// Inside of the room: x -6..6, z -5..5, y 0..4.
inline constexpr double kRoomX = 6.0;
inline constexpr double kRoomZ = 5.0;
inline constexpr double kRoomHeight = 4.0;
/// Radius of the opening in the ceiling under the dome.
inline constexpr double kDomeRadius = 2.3;
/// The bulbs of the floor lamps: their middle above the floor, and their radius.
inline constexpr double kBulbHeight = 1.48;
inline constexpr double kBulbRadius = 0.045;

Mesh room();
Mesh dome();
Mesh rug();
Mesh chair();
Mesh small_sofa();
Mesh round_sofa();
Mesh table();
Mesh magazine();
Mesh floor_lamp();
Mesh bulb();
Mesh plant();

/// Materials, pictures and samplers.
void add_materials(Scene& scene);
/// The leaf: outline, cuts and holes in alpha, veins in colour.
TextureImage leaf_texture();

}  // namespace kaamos::effects::lounge
