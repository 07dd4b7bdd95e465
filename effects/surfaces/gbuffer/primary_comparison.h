// SPDX-License-Identifier: MIT
/// @file
/// Finds where the drawn G-buffer shows another triangle than primary rays hit, and why. The
/// rasterizer moves vertices to a grid of 1/256 pixel. That moves edges by 7.3e-4 pixels on
/// average, and so many pixels flip per pixel of an edge's length: 1.67e-3 / sqrt(pixels per
/// triangle) of all pixels if triangles are equally large and equilateral, more if they are
/// slivers.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "effects/engine/frame.h"
#include "effects/surfaces/gbuffer/raster_gbuffer.h"

namespace kaamos::effects {

/// The triangle that a pixel shows.
struct SeenTriangle {
  std::uint32_t instance = 0;   ///< + 1; 0: nothing
  std::uint32_t geometry = 0;   ///< in its mesh
  std::uint32_t primitive = 0;  ///< in its geometry
  float view_z = 0;             ///< metres along the camera's axis

  /// Returns whether both are the same triangle, or both nothing.
  bool same_triangle(const SeenTriangle& other) const {
    return instance == other.instance && geometry == other.geometry && primitive == other.primitive;
  }
};

/// Pixels where draws and rays differ, by the first of these reasons that holds.
struct PrimaryDifference {
  std::uint64_t pixels = 0;        ///< of the picture
  std::uint64_t covered = 0;       ///< where rays hit something
  std::uint64_t triangles = 0;     ///< different ones that rays hit
  std::uint64_t hit_or_not = 0;    ///< one shows a surface, the other nothing
  std::uint64_t other_levels = 0;  ///< rays see another level of detail of the instance
  std::uint64_t silhouettes = 0;   ///< the depths differ by more than 1 %
  std::uint64_t neighbours = 0;    ///< the triangles share a corner
  std::uint64_t others = 0;        ///< other surfaces close by: a leaf over a leaf, a foot's floor
  double expected = 0;             ///< pixels that snapping flips, by the length of all edges

  /// All of them.
  std::uint64_t differing() const {
    return hit_or_not + other_levels + silhouettes + neighbours + others;
  }
  /// Their share of the covered pixels.
  double share() const;
  /// Covered pixels per triangle that rays hit.
  double pixels_per_triangle() const;
  /// Share of the covered pixels that snapping alone flips.
  double expected_share() const;
  /// The same if all triangles were equally large and equilateral.
  double expected_share_of_equals() const;
};

/// Two pictures of a scene whose instances stand as they do now.
struct SeenPictures {
  std::span<const SeenTriangle> drawn;   ///< of all pixels, row by row
  std::span<const SeenTriangle> traced;  ///< the same by rays
  Camera camera;                         ///< of both
  std::uint32_t height = 0;              ///< of both, pixels
};
/// Compares them.
PrimaryDifference compare_pictures(const Scene& scene, const GpuScene& gpu,
                                   const SeenPictures& pictures);

/// The visibility buffer that was executed last, read back. View depths are those of the frame.
/// @errors those of rtapi::ReadbackTexture.
rtapi::Result<std::vector<SeenTriangle>> read_drawn(const rtapi::Device& device,
                                                    rtapi::CommandQueue& queue, const Frame& frame,
                                                    const GpuScene& gpu,
                                                    const RasterGBuffer& raster);
/// Returns what primary rays hit.
/// @errors those of RayPass::create, Frame::create_pass_views and rtapi::ReadbackTexture.
rtapi::Result<std::vector<SeenTriangle>> trace_seen(const rtapi::Device& device,
                                                    rtapi::CommandQueue& queue, const Frame& frame,
                                                    const GpuScene& gpu);
/// Compares the last drawn and resolved frame, as `camera` saw it, with rays.
/// @errors those of read_drawn and trace_seen.
rtapi::Result<PrimaryDifference> compare_with_rays(const rtapi::Device& device,
                                                   rtapi::CommandQueue& queue, const Frame& frame,
                                                   const Scene& scene, const GpuScene& gpu,
                                                   const Camera& camera,
                                                   const RasterGBuffer& raster);

/// A drawn G-buffer beside one by rays, both of the same frame.
struct PrimaryComparison {
  PrimaryDifference difference;  ///< of what they show
  double draw_ms = 0;            ///< of the visibility buffer
  double resolve_ms = 0;         ///< of the pictures that are made of it
  double ray_ms = 0;             ///< of the same pictures by rays
};

}  // namespace kaamos::effects
