// SPDX-License-Identifier: MIT
// What the pixels of a frame show: the G-buffer, traced or drawn.
#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/surfaces/gbuffer/gbuffer.h"

namespace kaamos::effects {

namespace {

constexpr FrameTexture kSurfaceTextures[] = {kDepth,     kViewZ,    kNormal,   kShadingNormal,
                                             kBaseColor, kEmissive, kMaterial, kIds,
                                             kPosition,  kMotion};

std::uint64_t surface_bytes(const Frame& frame) {
  std::uint64_t sum = 0;
  for (const FrameTexture texture : kSurfaceTextures) sum += picture_bytes(frame.texture(texture));
  return sum;
}

}  // namespace

rtapi::Status FrameRenderer::create_gbuffer() {
  raster_.reset();
  curvature_.reset();
  if (settings_.primary == Primary::kRaster) {
    auto raster = RasterGBuffer::create(
        device_, frame_, scene_, gpu_,
        {libraries_.at("surfaces/gbuffer/raster"), libraries_.at("surfaces/gbuffer/resolve")});
    if (!raster) return raster.error();
    raster_ = std::move(*raster);
  } else {
    const auto gbuffer = RayPass::create(device_, frame_, gpu_,
                                         gbuffer_pass(libraries_.at("surfaces/gbuffer/gbuffer")));
    if (!gbuffer) return gbuffer.error();
    gbuffer_ = *gbuffer;
  }
  if (!settings_.curvature_to_roughness) return {};
  const auto pass = curvature_pass(device_, frame_, libraries_.at("surfaces/gbuffer/curvature"));
  if (!pass) return pass.error();
  curvature_ = *pass;
  return {};
}

void FrameRenderer::record_draws(rtapi::CommandList& list) {
  raster_->record_draws(list, frame_, static_cast<float>(moment_.camera.near_plane));
}

void FrameRenderer::record_gbuffer(rtapi::CommandList& list) {
  if (raster_) {
    record_draws(list);
    raster_->record_resolve(list, frame_);
  } else {
    gbuffer_.dispatch(list, frame_, {.sample_count = 1, .accumulate = 0}, frame_.height());
  }
  record_curvature(list);
}

rtapi::Result<Outcome> FrameRenderer::run_gbuffer(const Progress& progress) {
  if (!raster_) {
    if (const auto s = run_pass("G-buffer", gbuffer_, nullptr, progress); !is_done(s)) return s;
    statistics_.back().bytes = surface_bytes(frame_);
    return Outcome::kDone;
  }
  auto draws = device_.CreateCommandList();
  if (!draws) return draws.error();
  device_.ResetStatistics();
  const double start = clock_ms_();
  record_draws(*draws);
  const auto drawn =
      execute_draws_ ? execute_draws_(queue_, *draws) : queue_.ExecuteAndWait(*draws);
  if (!drawn) return drawn.error();
  statistics_.push_back(
      {"G-buffer draws", clock_ms_() - start, device_.GetStatistics(), raster_->bytes()});
  if (const auto s = run_compute("G-buffer resolve", surface_bytes(frame_),
                                 [&](auto& list) { raster_->record_resolve(list, frame_); });
      !s) {
    return s.error();
  }
  return !progress || progress("G-buffer", 1) ? Outcome::kDone : Outcome::kStopped;
}

rtapi::Status FrameRenderer::draw_surfaces() {
  const auto prepared = prepare();
  if (!prepared) return prepared.error();
  if (has_surfaces_) return {};
  const auto drawn = execute([&](rtapi::CommandList& list) {
    record_gbuffer(list);
    if (settings_.whole_frame) record_lights(list);
  });
  if (!drawn) return drawn.error();
  has_surfaces_ = true;
  return {};
}

rtapi::Result<PrimaryComparison> FrameRenderer::compare_primary() {
  const auto prepared = prepare();
  if (!prepared) return prepared.error();
  if (!raster_) {
    return make_error(ErrorId::kFrameRenderer,
                      "the G-buffer is traced, so that there is nothing to compare with rays: set "
                      "FrameSettings::primary to Primary::kRaster");
  }
  const auto rays = RayPass::create(device_, frame_, gpu_,
                                    gbuffer_pass(libraries_.at("surfaces/gbuffer/gbuffer")));
  if (!rays) return rays.error();
  const auto ray_ms = execute([&](rtapi::CommandList& list) {
    rays->dispatch(list, frame_, {.sample_count = 1, .accumulate = 0}, frame_.height());
  });
  if (!ray_ms) return ray_ms.error();
  const auto draw_ms = execute([&](rtapi::CommandList& list) { record_draws(list); });
  if (!draw_ms) return draw_ms.error();
  const auto resolve_ms =
      execute([&](rtapi::CommandList& list) { raster_->record_resolve(list, frame_); });
  if (!resolve_ms) return resolve_ms.error();
  if (curvature_) {
    const auto done = execute([&](rtapi::CommandList& list) { record_curvature(list); });
    if (!done) return done.error();
  }
  const auto difference =
      compare_with_rays(device_, queue_, frame_, scene_, gpu_, moment_.camera, *raster_);
  if (!difference) return difference.error();
  return PrimaryComparison{*difference, *draw_ms, *resolve_ms, *ray_ms};
}

}  // namespace kaamos::effects
