// SPDX-License-Identifier: MIT
// Small frames whose views are known beforehand.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/views/views.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {

inline constexpr std::uint32_t kViewWidth = 40;
inline constexpr std::uint32_t kViewHeight = 30;

// A white matte floor under a black sky, seen from above.
inline Scene make_bare_floor() {
  Scene scene = start_scene("floor");
  const std::uint32_t white = add_paint(scene, "white", glm::vec3(1));
  add_floor(scene, "floor", {-20, -20}, {20, 20}, 0, white);
  add_view(scene, "view", {0.13, 1.2, 3.1}, {0.02, 0.3, -0.5}, 0.9);
  return scene;
}

struct ViewFrame {
  std::string backend;
  std::vector<std::string> effects;
  DenoiseMethod denoise = DenoiseMethod::kNone;
  std::shared_ptr<IndirectVolume> volume = std::make_shared<IndirectVolume>();  // an empty one
  bool whole = true;
};

inline std::unique_ptr<FrameRenderer> make_view_renderer(const Scene& scene,
                                                         const ViewFrame& frame) {
  FrameSettings settings;
  settings.width = kViewWidth;
  settings.height = kViewHeight;
  settings.effects = choose_effects(frame.effects);
  settings.whole_frame = frame.whole;
  settings.denoise = default_denoise(frame.denoise);
  settings.volume.given = frame.volume;
  rtapi::DeviceDesc device;
  device.Backend = frame.backend;
  return FrameRenderer::create(test::device_for(device), scene, settings).value();
}

inline FloatImage see(FrameRenderer& renderer, const std::string& view,
                      const std::string& signal = {}) {
  return look_at(*find_view(view).value(), renderer, signal).value();
}

}  // namespace kaamos::effects
