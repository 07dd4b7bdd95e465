// SPDX-License-Identifier: MIT
/// @file
/// Renders the reference of a scene: batches of samples, until there are enough or somebody stops
/// it.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "effects/engine/outcome.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/reference/path_sums.h"
#include "effects/reference/path_tracer.h"

namespace kaamos::effects {

/// Describes a reference.
struct PathReferenceDesc {
  std::uint32_t width = 320;         ///< pixels, 1 to 16384
  std::uint32_t height = 180;        ///< pixels, 1 to 16384
  std::uint32_t seed = 0;            ///< the same seed gives the same reference
  PathTracerDesc paths;              ///< what paths may do
  bool each_lamp = false;            ///< a layer for each lamp too, as long as there are few
  float sun_angular_radius = -1.0f;  ///< [FrameDesc]
  bool ray_cones = true;             ///< [FrameDesc]
  /// On the scene's clock; none: the scene as it stands.
  std::optional<double> seconds;
  /// Only bands of rows number part, part + parts, ... are traced; the sums of all parts add up to
  /// those of one.
  ///@{
  std::uint32_t part = 0;
  std::uint32_t parts = 1;
  ///@}
};

/// A reference in the making. Not for several threads at once.
class PathReference {
 public:
  /// Uploads the scene, which must stay for the reference's life.
  /// @errors those of the device.
  static rtapi::Result<std::unique_ptr<PathReference>> create(const rtapi::Device& device,
                                                              const Scene& scene,
                                                              const PathReferenceDesc& desc);

  /// Goes on until each pixel has `samples` samples, rounded up to an even number; half of them for
  /// each half. Stops only between batches, so what is done by then can be gone on with.
  /// @errors those of the device.
  rtapi::Result<Outcome> accumulate(std::uint32_t samples, const StepCallback& progress);

  /// The next batch of accumulate; nothing is added where it is stopped. `samples`: of each pixel,
  /// in the end.
  /// @errors those of the device.
  rtapi::Result<Outcome> trace_batch(std::uint32_t samples, const StepCallback& progress);
  /// Sets the sums of bands that another part traces to zero.
  void keep_own_bands();

  /// The sums of what is done; loading puts sums there.
  ///@{
  PathSums& sums() { return sums_; }
  const PathSums& sums() const { return sums_; }
  ///@}
  /// Samples of each pixel so far.
  std::uint32_t samples() const { return sums_.samples[0] + sums_.samples[1]; }
  /// Rays traced so far, shadow rays included.
  std::uint64_t rays() const { return rays_; }
  /// The device on which it is rendered.
  const rtapi::Device& device() const { return renderer_->device(); }

 private:
  rtapi::Result<Outcome> trace_bands(std::uint32_t half, std::uint32_t count,
                                     const StepCallback& progress);
  rtapi::Status add_batch(std::uint32_t half, std::uint32_t count);

  PathReferenceDesc desc_;
  std::unique_ptr<FrameRenderer> renderer_;  // holds the scene on the device
  std::optional<PathTracer> tracer_;
  PathSums sums_;
  std::uint64_t rays_ = 0;
};

/// A number that tells scenes apart: their content, the camera and what the desc adds.
std::uint64_t reference_fingerprint(const Scene& scene, const PathReferenceDesc& desc);

}  // namespace kaamos::effects
