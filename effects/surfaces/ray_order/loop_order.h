// SPDX-License-Identifier: MIT
/// @file
/// The two loops of visibility, over pixels and over triangles, in either order: what rasterization
/// and ray tracing are before structures and hardware. [survey 3.5]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/assets/scene/scene.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"
#include "effects/engine/pass_views.h"

namespace kaamos::effects {

/// The nesting of the two loops. The picture is the same, bit for bit.
enum class LoopOrder : std::uint8_t {
  kRaster,  ///< for each triangle, for each pixel: what a triangle needs is computed once for all
  kRays,    ///< for each pixel, for each triangle: only the pixel's ray and its hit are kept
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> loop_order_library();

/// Finds what each pixel of a frame with a perspective camera shows by testing every triangle
/// against every pixel.
class VisibilityLoops {
 public:
  /// Takes the triangles of a valid scene as they stand at its start, without skins, glass left out
  /// and cutouts closed. Each thread has a tile of 8 x 8 pixels.
  /// @errors those of the device, among them KA0990 no memory; KA0537 a library without the pass.
  static rtapi::Result<VisibilityLoops> create(const rtapi::Device& device, const Frame& frame,
                                               const Scene& scene, const glm::dvec3& camera,
                                               const rtapi::ShaderLibrary& library);
  /// Records the pass.
  void dispatch(rtapi::CommandList& list, const Frame& frame, LoopOrder order) const;
  /// R32G32_FLOAT: view depth in metres, and the number of the triangle + 1, instance by instance;
  /// 0 where nothing is seen.
  const rtapi::Texture& seen() const { return seen_; }
  /// Triangles that are tested.
  std::uint32_t triangle_count() const { return triangle_count_; }

 private:
  rtapi::Buffer triangles_;
  rtapi::Texture seen_;
  ComputePass pass_;
  PassViews views_;
  std::uint32_t triangle_count_ = 0;
};

}  // namespace kaamos::effects
