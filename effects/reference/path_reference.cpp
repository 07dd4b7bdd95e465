// SPDX-License-Identifier: MIT
#include "effects/reference/path_reference.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "effects/assets/common/sampling.h"
#include "effects/assets/scene/scene_checksum.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

// Samples of a pixel in a batch: the unit in which a reference goes on, is stopped and is saved.
constexpr std::uint32_t kBatch = 16;
// Rows of a band; parts take turns with them, so that all have much the same to do.
constexpr std::uint32_t kBandRows = 4;

std::uint32_t seed_of(std::uint32_t seed, std::uint32_t half) {
  return half == 0 ? seed : hash_combine(seed, 0x9E3779B9u);
}

std::uint32_t channels_of(PathLayer layer) {
  if (layer == kPathGlass) return 4;
  return layer == kPathVisibility ? 2 : 3;
}

// Raised where a layer's meaning changes, so that older sums are not gone on with.
constexpr std::uint32_t kLayersVersion = 2;

// Pictures with layers of their own: the tint of the sun's light only where glass casts shadows.
std::uint32_t layers_of(const PathReferenceDesc& desc) {
  return desc.paths.glass_tint >= 0.0f ? kPathLayerCount : kPathSunTint;
}

}  // namespace

std::uint64_t reference_fingerprint(const Scene& scene, const PathReferenceDesc& desc) {
  Checksum checksum;
  add_scene(checksum, scene);
  checksum.add_value(kLayersVersion);
  checksum.add_value(desc.paths.bounces);
  checksum.add_value(desc.paths.occlusion_radius);
  checksum.add_value(desc.paths.lamps_apart);
  checksum.add_value(desc.sun_angular_radius);
  checksum.add_value(desc.ray_cones);
  checksum.add_value(desc.seconds.value_or(-1.0));
  if (desc.paths.glass_tint >= 0.0f) checksum.add_value(desc.paths.glass_tint);
  return checksum.value();
}

rtapi::Result<std::unique_ptr<PathReference>> PathReference::create(const rtapi::Device& device,
                                                                    const Scene& scene,
                                                                    const PathReferenceDesc& desc) {
  std::unique_ptr<PathReference> out(new PathReference());
  out->desc_ = desc;
  FrameSettings settings;
  settings.width = desc.width;
  settings.height = desc.height;
  settings.whole_frame = false;
  settings.moving = desc.seconds.has_value();
  settings.sun_angular_radius = desc.sun_angular_radius;
  settings.ray_cones = desc.ray_cones;
  auto renderer = FrameRenderer::create(device, scene, settings);
  if (!renderer) return renderer.error();
  out->renderer_ = std::move(*renderer);
  const FrameMoment moment = {
      .seconds = desc.seconds.value_or(0.0), .camera = scene.cameras.front(), .cut = true};
  if (const auto s = out->renderer_->begin_frame(moment); !s) return s.error();
  const auto library = path_tracer_library();
  if (!library) return library.error();
  auto tracer = PathTracer::create(device, out->renderer_->frame(), out->renderer_->context().gpu,
                                   scene, out->renderer_->scene_stage().states_at(moment),
                                   moment.camera.position(), desc.paths, *library);
  if (!tracer) return tracer.error();
  out->tracer_ = std::move(*tracer);
  PathSums& sums = out->sums_;
  sums.width = desc.width;
  sums.height = desc.height;
  sums.seed = desc.seed;
  sums.fingerprint = reference_fingerprint(scene, desc);
  for (std::uint32_t i = 0; i < layers_of(desc); ++i) {
    sums.add_layer(path_layer_name(PathLayer(i)), channels_of(PathLayer(i)));
  }
  const std::uint32_t lamps = desc.each_lamp ? out->tracer_->lamps() : 0;
  for (std::uint32_t i = 0; i < lamps; ++i) sums.add_layer("lamp" + std::to_string(i), 4);
  return out;
}

rtapi::Result<Outcome> PathReference::trace_bands(std::uint32_t half, std::uint32_t count,
                                                  const StepCallback& progress) {
  rtapi::Device device = renderer_->device();
  auto list = device.CreateCommandList();
  if (!list) return list.error();
  device.ResetStatistics();
  const std::uint32_t bands = (desc_.height + kBandRows - 1) / kBandRows;
  for (std::uint32_t band = desc_.part; band < bands; band += desc_.parts) {
    const std::uint32_t row = band * kBandRows;
    if (const auto reset = list->Reset(); !reset) return reset.error();
    tracer_->record(*list, renderer_->frame(), seed_of(desc_.seed, half), sums_.samples[half],
                    count, row, std::min(kBandRows, desc_.height - row));
    if (const auto done = renderer_->queue().ExecuteAndWait(*list); !done) return done.error();
    if (progress && !progress((band + 1.0) / bands)) return Outcome::kStopped;
  }
  rays_ += device.GetStatistics().TraceRayCalls;
  return Outcome::kDone;
}

rtapi::Status PathReference::add_batch(std::uint32_t half, std::uint32_t count) {
  const std::size_t pixels = static_cast<std::size_t>(desc_.width) * desc_.height;
  const std::uint32_t pictures = layers_of(desc_);
  for (std::uint32_t i = 0; i < pictures; ++i) {
    const auto image = renderer_->read(tracer_->layer(PathLayer(i)));
    if (!image) return image.error();
    PathSums::Layer& layer = sums_.layers[i];
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      for (std::uint32_t c = 0; c < layer.channels; ++c) {
        layer.sums[half][pixel * layer.channels + c] += image->values[4 * pixel + c];
      }
    }
  }
  if (sums_.layers.size() > pictures) {
    const auto bytes = rtapi::ReadbackBuffer(device(), renderer_->queue(), tracer_->each_lamp());
    if (!bytes) return bytes.error();
    const auto* values = reinterpret_cast<const float*>(bytes->data());
    for (std::size_t i = pictures; i < sums_.layers.size(); ++i) {
      std::vector<double>& out = sums_.layers[i].sums[half];
      for (double& value : out) value += *values++;
    }
  }
  sums_.samples[half] += count;
  return {};
}

rtapi::Result<Outcome> PathReference::trace_batch(std::uint32_t samples,
                                                  const StepCallback& progress) {
  const std::uint32_t each = (samples + 1) / 2;
  const std::uint32_t half = sums_.samples[1] < sums_.samples[0] ? 1 : 0;
  if (sums_.samples[half] >= each) return Outcome::kDone;
  const std::uint32_t count = std::min(kBatch, each - sums_.samples[half]);
  const auto step = [&](double done) {
    return !progress || progress((this->samples() + count * done) / (2.0 * each));
  };
  const auto traced = trace_bands(half, count, step);
  if (!is_done(traced)) return traced;
  if (const auto s = add_batch(half, count); !s) return s.error();
  return Outcome::kDone;
}

rtapi::Result<Outcome> PathReference::accumulate(std::uint32_t samples,
                                                 const StepCallback& progress) {
  while (this->samples() < samples) {
    const auto traced = trace_batch(samples, progress);
    if (!is_done(traced)) return traced;
  }
  return Outcome::kDone;
}

void PathReference::keep_own_bands() {
  for (PathSums::Layer& layer : sums_.layers) {
    const std::size_t row_values = static_cast<std::size_t>(desc_.width) * layer.channels;
    for (auto& half : layer.sums) {
      for (std::uint32_t row = 0; row < desc_.height; ++row) {
        if (row / kBandRows % desc_.parts == desc_.part) continue;
        std::fill_n(half.begin() + static_cast<std::ptrdiff_t>(row * row_values), row_values, 0.0);
      }
    }
  }
}

}  // namespace kaamos::effects
