// SPDX-License-Identifier: MIT
//
// The scene that raster/... draws, the same for Kaamos and for the baseline, and what both must
// leave in their targets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene_data.h"

namespace kaamos::bench {

// Depth alone, as of a shadow map (D32_FLOAT, LESS); reversed depth (GREATER) with the five targets
// of a G-buffer; reversed depth with the numbers of triangles (R32_UINT).
enum class RasterPass { kShadow, kGBuffer, kIds };

// The constants of raster.hlsl.
struct RasterConstants {
  float clip[4][4] = {};
  float before[3][4] = {};
  uint32_t first_triangle = 0;
};

struct RasterScene {
  RasterPass pass = RasterPass::kShadow;
  uint32_t width = 0;
  uint32_t height = 0;
  RasterConstants constants;
  std::vector<float> positions;   // x, y, z of each vertex
  std::vector<uint32_t> indices;  // three for each triangle
  uint32_t draws = 1;             // of consecutive triangles; what does not divide is left out

  uint32_t triangles() const { return static_cast<uint32_t>(indices.size() / 3); }
  uint32_t triangles_per_draw() const { return triangles() / draws; }
  float cleared_depth() const { return pass == RasterPass::kShadow ? 1.0f : 0.0f; }
};

// A height field and 50 spheres above it: some 300,000 * detail triangles, 301,600 for 1.
RasterScene make_raster_scene(RasterPass pass, uint32_t width, uint32_t height, double detail = 1);
// The scene of the ray sets in the world, as seen by its camera (primary_rays()): kIds.
RasterScene make_raster_scene(const SceneData& data, uint32_t width, uint32_t height);
inline constexpr float kRasterNear = 0.1f;  // of reversed depth: z of the view is this over depth

// The pictures that a pass leaves. Texels as in memory: RGBA8 sRGB, RGBA16F, RGBA8, RG16F,
// R32_UINT.
struct RasterPictures {
  std::vector<float> depth;
  std::vector<std::vector<std::byte>> colors;
};

inline constexpr uint32_t kGBufferTargets = 5;
inline constexpr uint32_t kGBufferBytes[kGBufferTargets] = {4, 8, 4, 4, 4};

// Throws if the pictures differ by more than rounding: another coverage for more than one pixel in
// 100,000 (edges lie where snapping puts them, and vertices are rounded differently), another
// triangle for more than one in 10,000, other depths or colours for more than one in 1,000.
void check_same_pictures(const RasterScene& scene, const RasterPictures& ours,
                         const RasterPictures& baseline);

}  // namespace kaamos::bench
