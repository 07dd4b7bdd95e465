// SPDX-License-Identifier: MIT
#include "effects/northlight/surface_stage.h"

#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"
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

rtapi::Result<RayPass> SurfaceStage::create_rays() const {
  return RayPass::create(context_.device, context_.frame, context_.gpu,
                         gbuffer_pass(context_.libraries.at("surfaces/gbuffer/gbuffer")));
}

rtapi::Status SurfaceStage::create() {
  const ShaderLibraries& libraries = context_.libraries;
  if (context_.settings.primary == Primary::kRaster) {
    auto raster = RasterGBuffer::create(
        context_.device, context_.frame, context_.scene, context_.gpu,
        {libraries.at("surfaces/gbuffer/raster"), libraries.at("surfaces/gbuffer/resolve")});
    if (!raster) return raster.error();
    raster_ = std::move(*raster);
  } else {
    const auto rays = create_rays();
    if (!rays) return rays.error();
    rays_ = *rays;
  }
  if (!context_.settings.curvature_to_roughness) return {};
  const auto pass =
      curvature_pass(context_.device, context_.frame, libraries.at("surfaces/gbuffer/curvature"));
  if (!pass) return pass.error();
  curvature_ = *pass;
  return {};
}

void SurfaceStage::record_rays(rtapi::CommandList& list, const RayPass& rays) const {
  const Frame& frame = context_.frame;
  rays.dispatch(list, frame, {.sample_count = 1, .accumulate = 0}, frame.height());
}

void SurfaceStage::record_draws(rtapi::CommandList& list) {
  raster_->record_draws(list, context_.frame, context_.moment.camera);
}

void SurfaceStage::record_curvature(rtapi::CommandList& list) const {
  const Frame& frame = context_.frame;
  if (curvature_) curvature_->dispatch(list, frame, {}, {}, frame.width(), frame.height());
}

void SurfaceStage::record(rtapi::CommandList& list) {
  if (raster_) {
    record_draws(list);
    raster_->record_resolve(list, context_.frame);
  } else {
    record_rays(list, *rays_);
  }
  record_curvature(list);
}

rtapi::Result<Outcome> SurfaceStage::run_draws(const Progress& progress) {
  const auto drawn = context_.runner.run_draws("G-buffer draws", raster_->bytes(),
                                               [&](auto& list) { record_draws(list); });
  if (!drawn) return drawn.error();
  const auto resolved =
      context_.runner.run("G-buffer resolve", surface_bytes(context_.frame),
                          [&](auto& list) { raster_->record_resolve(list, context_.frame); });
  if (!resolved) return resolved.error();
  return !progress || progress("G-buffer", 1) ? Outcome::kDone : Outcome::kStopped;
}

rtapi::Result<Outcome> SurfaceStage::run(const Progress& progress) {
  const Frame& frame = context_.frame;
  if (raster_) {
    if (const auto s = run_draws(progress); !is_done(s)) return s;
  } else {
    SampledWork work;
    work.title = "G-buffer";
    work.first_sample = context_.moment.index;
    work.rows = frame.height();
    work.rows_per_band = context_.settings.rows;
    work.record = [&](rtapi::CommandList& list, const PassConstants& constants,
                      std::uint32_t row_count) {
      rays_->dispatch(list, frame, constants, row_count);
    };
    const auto s = context_.runner.run_pass(work, surface_bytes(frame), progress);
    if (!is_done(s)) return s;
  }
  if (!curvature_) return Outcome::kDone;
  const std::uint64_t bytes = picture_bytes(frame.texture(kShadingNormal)) +
                              picture_bytes(frame.texture(kIds)) +
                              picture_bytes(frame.texture(kMaterial));
  const auto s =
      context_.runner.run("curvature", bytes, [&](auto& list) { record_curvature(list); });
  if (!s) return s.error();
  return Outcome::kDone;
}

rtapi::Result<PrimaryComparison> SurfaceStage::compare() {
  if (!raster_) {
    return make_error(ErrorId::kFrameRenderer,
                      "the G-buffer is traced, so that there is nothing to compare with rays: set "
                      "FrameSettings::primary to Primary::kRaster");
  }
  PassRunner& runner = context_.runner;
  const auto rays = create_rays();
  if (!rays) return rays.error();
  const auto ray_ms = runner.execute([&](rtapi::CommandList& list) { record_rays(list, *rays); });
  if (!ray_ms) return ray_ms.error();
  const auto draw_ms = runner.execute([&](rtapi::CommandList& list) { record_draws(list); });
  if (!draw_ms) return draw_ms.error();
  const auto resolve_ms = runner.execute(
      [&](rtapi::CommandList& list) { raster_->record_resolve(list, context_.frame); });
  if (!resolve_ms) return resolve_ms.error();
  if (curvature_) {
    const auto done = runner.execute([&](rtapi::CommandList& list) { record_curvature(list); });
    if (!done) return done.error();
  }
  const auto difference =
      compare_with_rays(context_.device, runner.queue(), context_.frame, context_.scene,
                        context_.gpu, context_.moment.camera, *raster_);
  if (!difference) return difference.error();
  return PrimaryComparison{*difference, *draw_ms, *resolve_ms, *ray_ms};
}

}  // namespace kaamos::effects
