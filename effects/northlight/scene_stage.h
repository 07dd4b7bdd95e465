// SPDX-License-Identifier: MIT
/// @file
/// The scene of a frame on the device, and how it follows a sequence: poses, levels of detail,
/// structures, camera.
#pragma once

#include <rtapi/rtapi.h>

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "effects/assets/scene/animation.h"
#include "effects/geometry/structures/structures.h"
#include "effects/northlight/frame_context.h"

namespace kaamos::effects {

/// Fills in FrameContext::gpu and FrameContext::frame, and moves both on.
class SceneStage {
 public:
  /// The context must stay.
  explicit SceneStage(FrameContext& context) : context_(context) {}
  SceneStage(const SceneStage&) = delete;
  SceneStage& operator=(const SceneStage&) = delete;

  /// Uploads the scene, builds its structures and makes the frame's pictures.
  /// @errors those of the device.
  rtapi::Status create();
  /// Moves on to another frame of a sequence.
  /// @errors KA3046 the camera is elsewhere than the scene's first and FrameSettings::moving is not
  /// set; others of the device.
  rtapi::Status begin_frame(const FrameMoment& moment);
  /// What runs from here on sees other levels of detail, over the surfaces that are drawn already.
  /// [StructureOptions::coarser_rays]
  /// @errors KA3046 coarser_rays is 0 in the settings; those of the device.
  rtapi::Status set_coarser_rays(std::uint32_t levels);
  /// The samples of what runs from here on, as if the frame had had this seed.
  /// @errors those of the device.
  rtapi::Status set_seed(std::uint32_t seed);
  /// The states of the instances at a moment: where they are, and at which level of detail.
  std::vector<InstanceState> states_at(const FrameMoment& moment) const;
  /// Null if nothing moves.
  const StructureStatistics* structures() const {
    return structures_ ? &structures_->statistics() : nullptr;
  }

 private:
  FrameContext& context_;
  std::optional<StructureManager> structures_;
  glm::vec2 jitter_{0.0f};
};

}  // namespace kaamos::effects
