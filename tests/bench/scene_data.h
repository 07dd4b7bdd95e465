// SPDX-License-Identifier: MIT
//
// The lounge as both sides read it: vertices unchanged, 32-bit indices, and the ray sets.
#pragma once

#include <kaamos/shader/abi.h>

#include <array>
#include <cstdint>
#include <vector>

#include "effects/assets/scene/scene.h"

namespace kaamos::bench {

using Ray = shader::RayDesc;

struct GeometryData {
  uint32_t first_vertex = 0;  // in the mesh
  uint32_t vertex_count = 0;
  uint32_t first_index = 0;  // in MeshData::indices
  uint32_t triangle_count = 0;
  uint32_t material = 0;
  bool alpha_tested = false;
};

struct MeshData {
  const std::vector<effects::Vertex>* vertices = nullptr;
  std::vector<uint32_t> indices;  // relative to the geometry's first vertex
  std::vector<GeometryData> geometries;
  uint32_t first_record = 0;  // of its geometries, counted through all meshes
};

struct InstanceData {
  uint32_t mesh = 0;
  std::array<float, 12> transform = {};  // object to world, 3x4, row-major
};

struct SceneData {
  effects::Scene scene;
  std::vector<MeshData> meshes;
  std::vector<InstanceData> instances;
  uint32_t record_count = 0;
};

SceneData make_scene_data();

// The data that a hit shader looks up. The layout is that of bench.hlsl.
struct MaterialData {
  float base_color[4];
  float alpha_cutoff;
  int32_t image;  // of the base colour; -1: no image
};
std::vector<MaterialData> materials_of(const effects::Scene& scene);

enum class RaySet { kPrimary, kSun, kAmbientOcclusion, kGgx, kDiffuse };
inline constexpr RaySet kRaySets[] = {RaySet::kPrimary, RaySet::kSun, RaySet::kAmbientOcclusion,
                                      RaySet::kGgx, RaySet::kDiffuse};
const char* name_of(RaySet set);  // "primary", "sun", "ao", "ggx", "diffuse"
// Returns whether the rays only ask if there is a hit.
bool is_visibility(RaySet set);

// A surface point seen by the camera.
struct SurfacePoint {
  float position[3];  // moved off the surface, towards the camera
  float normal[3];    // geometric, towards the camera
  float view[3];      // unit, from the camera
};

std::vector<Ray> primary_rays(const effects::Scene& scene, uint32_t width, uint32_t height);
// One ray for each point; every call returns the same rays.
std::vector<Ray> secondary_rays(const effects::Scene& scene,
                                const std::vector<SurfacePoint>& points, RaySet set);

}  // namespace kaamos::bench
