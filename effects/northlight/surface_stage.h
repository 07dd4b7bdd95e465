// SPDX-License-Identifier: MIT
/// @file
/// The surfaces that the pixels of a frame show: the G-buffer, traced or drawn.
#pragma once

#include <rtapi/rtapi.h>

#include <optional>

#include "effects/engine/compute_pass.h"
#include "effects/engine/ray_pass.h"
#include "effects/northlight/frame_context.h"
#include "effects/surfaces/gbuffer/primary_comparison.h"
#include "effects/surfaces/gbuffer/raster_gbuffer.h"

namespace kaamos::effects {

/// The G-buffer of a frame.
class SurfaceStage {
 public:
  /// The context must stay.
  explicit SurfaceStage(FrameContext& context) : context_(context) {}
  SurfaceStage(const SurfaceStage&) = delete;
  SurfaceStage& operator=(const SurfaceStage&) = delete;

  /// Makes the passes.
  /// @errors those of RayPass, RasterGBuffer and curvature_pass.
  rtapi::Status create();
  /// Records them over the whole picture. Drawn surfaces are those of now: what their draws read is
  /// written while they are recorded.
  void record(rtapi::CommandList& list);
  /// Executes them as passes of the frame.
  /// @errors those of the device.
  rtapi::Result<Outcome> run(const Progress& progress);
  /// Compares the drawn G-buffer with one by rays, and what both take. The frame's pictures stay as
  /// they are.
  /// @errors those of the device; KA3046 the G-buffer is not drawn.
  rtapi::Result<PrimaryComparison> compare();
  /// Null: the G-buffer is traced, or there is none before prepare.
  const RasterGBuffer* raster() const { return raster_ ? &*raster_ : nullptr; }

 private:
  rtapi::Result<RayPass> create_rays() const;
  void record_rays(rtapi::CommandList& list, const RayPass& rays) const;
  void record_draws(rtapi::CommandList& list);
  void record_curvature(rtapi::CommandList& list) const;
  rtapi::Result<Outcome> run_draws(const Progress& progress);

  FrameContext& context_;
  std::optional<RayPass> rays_;
  std::optional<RasterGBuffer> raster_;  // draws it instead
  std::optional<ComputePass> curvature_;
};

}  // namespace kaamos::effects
