// SPDX-License-Identifier: MIT
/// @file
/// Scenes of glass.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// A pane across the view.
struct Pane {
  double distance = 1.0;       ///< metres before the camera, of the side that faces it
  float alpha = 0.5f;          ///< coverage, 0..1
  glm::vec3 emissive{0.0f};    ///< radiance of the glass itself
  double thickness = 0.0;      ///< metres; 0: a sheet, else a closed box
  bool double_sided = true;    ///< false: backs do not count as layers
  double turned = 0.0;         ///< radians about the vertical
  glm::vec3 base_color{0.0f};  ///< linear, of what light it lets through and reflects
};

/// Panes that shine by themselves before a wall that shines with `background`, 50 m away, under a
/// black sky without sun and lights: what is seen is what the over operator makes of the panes'
/// alphas and radiances. The camera looks along -z from the origin; instance 0 is the wall, i + 1
/// pane i.
Scene make_pane_oracle(std::span<const Pane> panes, const glm::vec3& background);

/// The parameters of make_glass_stack.
struct GlassStackDesc {
  std::uint32_t panes = 5;  ///< 1..8; other numbers are taken for the nearest of these
  bool crossed = false;     ///< every second one turned by a right angle, all through one axis
  bool thick = false;       ///< 6 mm boxes, double-sided: backs count as layers too
  bool cabinet = true;      ///< a display cabinet beside the stack
};

/// Coloured panes of coverage 0.1 to 0.9 in a row before coloured props, and a display cabinet of
/// glass with things on its shelves, under sun and sky and two lamps.
Scene make_glass_stack(const GlassStackDesc& desc);

}  // namespace kaamos::effects
