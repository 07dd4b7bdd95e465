// SPDX-License-Identifier: MIT
/// @file
/// Stand-ins for the three scenes that the survey and Ray Tracing Gems measure shadows in, with
/// about as many triangles: a pub (281,000), a resort (376,000) and a breakfast room (1.4 million).
/// [survey 5.3: figure 18]
#pragma once

#include <cstdint>
#include <optional>

#include "effects/assets/scene/camera_path.h"
#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Names one of the scenes.
enum class StressKind : std::uint8_t {
  kPub,        ///< a room, large lamps over tables, chairs with thin legs
  kResort,     ///< outdoors, the sun, houses, palms and parasols
  kBreakfast,  ///< a room, one laid table after another, seen from below their tops too
};

/// The parameters of make_stress_scene.
struct StressDesc {
  StressKind kind = StressKind::kPub;  ///< which scene it stands for
  /// 1 or 4. The resort's first one is the sun; all others are large lamps.
  std::uint32_t lights = 4;
  /// The share of the triangles; 1: as many as the original has. From 1/32 on. Things keep their
  /// place and size and are made of fewer triangles, and small ones are fewer.
  double scale = 1.0 / 32;
  std::uint32_t seed = 1;  ///< of where small things lie
};

/// Triangles after instancing that the original has.
std::uint64_t original_triangles(StressKind kind);

/// The scene, with instanced_triangle_count within 1 % of scale times the original's. The small
/// things that fill up what is missing are last.
Scene make_stress_scene(const StressDesc& desc);

/// Returns which one a scene is, by its name: "pub", "resort" or "breakfast", "-full" where the
/// scale is 1, "-1" with one light. None: another scene.
std::optional<StressKind> stress_kind(const Scene& scene);

/// The camera's way through it, 20 s long, from the first camera on.
CameraPath stress_camera_path(StressKind kind);

}  // namespace kaamos::effects
