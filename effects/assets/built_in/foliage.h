// SPDX-License-Identifier: MIT
/// @file
/// Leaves that are cards with a mask, and a fence of thin wires: where any-hit shaders decide what
/// a ray hits. The same leaves exist as true geometry, so that the picture has a truth.
#pragma once

#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

inline constexpr std::uint32_t kLeafTexels = 32;    ///< along each side of the mask
inline constexpr std::uint32_t kLeavesOfTwig = 20;  ///< cards of one mesh
inline constexpr double kFenceWireRadius = 0.001;   ///< metres

/// The parameters of make_foliage.
struct FoliageDesc {
  std::uint32_t twigs = 100;  ///< instances of kLeavesOfTwig leaves each: 2000 leaves
  /// The leaves are meshes of squares, one for each texel of the mask that is not open, instead of
  /// cards with an alpha test. A ray hits the same points.
  bool tessellated = false;
  std::uint32_t seed = 1;  ///< of where the twigs stand
};

/// A hedge behind a wire fence, in the sun. Instances 0 and 1 are the ground and the fence, then
/// the twigs, which share one mesh. Half of a card is open; the mask is read without filtering, so
/// that its edges are those of the squares.
Scene make_foliage(const FoliageDesc& desc);

/// Returns whether a texel of the leaf's mask is leaf. `x` and `y` below kLeafTexels, row 0 on top.
bool is_leaf(std::uint32_t x, std::uint32_t y);

}  // namespace kaamos::effects
