// SPDX-License-Identifier: MIT
#include "renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/frame/picture.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/sun_shadow/sun_shadow.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

using Clock = std::chrono::steady_clock;

// Samples that a pixel takes in one dispatch at most.
constexpr std::uint32_t kSamplesPerDispatch = 64;
// A dispatch should not take longer, so that progress moves and Ctrl-C is heard.
constexpr double kDispatchSeconds = 0.25;

rtapi::Error stopped() {
  return {"", rtapi::ErrorCode::kFailed, "interrupted"};
}

}  // namespace

rtapi::Result<std::unique_ptr<Renderer>> Renderer::create(
    const Options& options, const Scene& scene, std::function<void(const std::string&)> message) {
  std::unique_ptr<Renderer> out(new Renderer(options, scene));
  rtapi::DeviceDesc desc;
  desc.Backend = options.backend;
  desc.Threads = options.threads;
  if (options.precision == "fast") desc.Precision = rtapi::TraversalPrecision::kFast;
  if (options.precision == "exact") desc.Precision = rtapi::TraversalPrecision::kExact;
  desc.CollectStatistics = true;
  desc.Checked = options.checked;
  desc.OnMessage = [message = std::move(message)](const rtapi::Message& m) { message(m.Text); };
  const auto device = rtapi::CreateDevice(desc);
  if (!device) return device.error();
  out->device_ = *device;
  const auto queue = out->device_.CreateCommandQueue();
  if (!queue) return queue.error();
  out->queue_ = *queue;

  const Camera& camera = scene.cameras.front();
  auto gpu = create_gpu_scene(out->device_, out->queue_, scene, camera.position());
  if (!gpu) return gpu.error();
  out->gpu_ = std::move(*gpu);
  FrameDesc frame_desc;
  frame_desc.width = options.width;
  frame_desc.height = options.height;
  frame_desc.seed = options.seed;
  if (options.sun_angle_degrees) {
    frame_desc.sun_angular_radius = *options.sun_angle_degrees * 3.14159265f / 360.0f;
  }
  auto frame = Frame::create(out->device_, out->queue_, scene, out->gpu_, camera, frame_desc);
  if (!frame) return frame.error();
  out->frame_ = std::move(*frame);
  return out;
}

rtapi::Status Renderer::run_step(const RayStep& step, const Progress& progress,
                                 const std::atomic<bool>& stop, FrameResult& result) {
  const std::string& name = step.desc.name;
  const std::uint32_t samples = step.samples;
  const auto pass = RayPass::create(device_, frame_, gpu_, step.desc);
  if (!pass) return pass.error();
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  device_.ResetStatistics();
  const auto start = Clock::now();
  std::uint32_t rows = std::min<std::uint32_t>(32, options_.height);
  for (std::uint32_t sample = 0; sample < samples; sample += kSamplesPerDispatch) {
    PassConstants constants;
    constants.first_sample = sample;
    constants.sample_count = std::min(kSamplesPerDispatch, samples - sample);
    constants.radius = options_.ao_radius;
    for (std::uint32_t row = 0; row < options_.height;) {
      if (stop) return stopped();
      const std::uint32_t count = std::min(rows, options_.height - row);
      constants.first_row = row;
      if (const auto reset = list->Reset(); !reset) return reset;
      pass->dispatch(*list, frame_, constants, count, step.arguments);
      const auto before = Clock::now();
      if (const auto done = execute_band(*list, name, row, count, result); !done) return done;
      const double seconds = std::chrono::duration<double>(Clock::now() - before).count();
      const double fit = rows * std::clamp(kDispatchSeconds / std::max(seconds, 1e-4), 0.5, 2.0);
      rows = static_cast<std::uint32_t>(std::clamp(fit, 1.0, static_cast<double>(options_.height)));
      row += count;
      progress(name,
               (sample + constants.sample_count * (static_cast<double>(row) / options_.height)) /
                   samples);
    }
  }
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  result.passes.push_back({name, ms, device_.GetStatistics()});
  return {};
}

rtapi::Status Renderer::run_compute(const std::string& name,
                                    const std::function<void(rtapi::CommandList&)>& record,
                                    FrameResult& result) {
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  device_.ResetStatistics();
  const auto start = Clock::now();
  record(*list);
  if (const auto done = queue_.ExecuteAndWait(*list); !done) return done;
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  result.passes.push_back({name, ms, device_.GetStatistics()});
  return {};
}

std::vector<RayStep> Renderer::steps(const ShaderLibraries& libraries) const {
  std::vector<RayStep> out = {{gbuffer_pass(libraries.gbuffer), 1, {}}};
  if (options_.ao) {
    out.push_back({ambient_occlusion_pass(libraries.ambient_occlusion), options_.ao_samples, {}});
  }
  if (options_.sun && scene_.sun) {
    out.push_back({sun_shadow_pass(libraries.sun_shadow), options_.sun_samples, {}});
  }
  return out;
}

rtapi::Status Renderer::run_effects(FrameEffects& effects, const Progress& progress,
                                    const std::atomic<bool>& stop, FrameResult& result) {
  result.left_out = effects.left_out();
  if (const auto done = run_compute(
          "local lights", [&](rtapi::CommandList& list) { effects.light(list, frame_); }, result);
      !done) {
    return done;
  }
  for (const RayStep& step : effects.steps()) {
    if (const auto done = run_step(step, progress, stop, result); !done) return done;
  }
  for (const auto& filter : effects.filters(frame_)) {
    if (const auto done = run_compute(filter.name, filter.record, result); !done) return done;
  }
  if (const auto done = run_compute(
          "composite", [&](rtapi::CommandList& list) { effects.compose(list, frame_); }, result);
      !done) {
    return done;
  }
  for (const FrameEffects::Layer& layer : effects.layers()) {
    auto image = read_picture(device_, queue_, layer.picture);
    if (!image) return image.error();
    for (float& value : image->values) value *= layer.scale;
    result.layers[layer.name] = std::move(*image);
  }
  return {};
}

rtapi::Status Renderer::run_composite(const ShaderLibraries& libraries, FrameResult& result) {
  CompositeConstants weights;
  weights.ao_samples = options_.ao ? options_.ao_samples : 0;
  weights.sun_samples = options_.sun && scene_.sun ? options_.sun_samples : 0;
  const auto composite = CompositePass::create(device_, frame_, libraries.composite);
  if (!composite) return composite.error();
  return run_compute(
      "composite", [&](rtapi::CommandList& list) { composite->dispatch(list, frame_, weights); },
      result);
}

rtapi::Result<FrameResult> Renderer::render(const ShaderLibraries& libraries,
                                            const Progress& progress,
                                            const std::atomic<bool>& stop) {
  FrameResult result;
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  frame_.clear(*list, kAmbientOcclusionSum);
  frame_.clear(*list, kSunVisibilitySum);
  list->ResourceBarrier(rtapi::ResourceBarrier::Uav());
  if (const auto done = queue_.ExecuteAndWait(*list); !done) return done.error();

  FrameEffects effects;
  if (options_.whole_frame()) {
    const auto bake_progress = [&](double done) { progress("indirect light", done); };
    const auto start = Clock::now();
    if (const auto created = effects.create(device_, queue_, frame_, gpu_, scene_, options_,
                                            libraries, bake_progress, stop);
        !created) {
      return created.error();
    }
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    result.passes.push_back({"set-up and bake", ms, device_.GetStatistics()});
  }
  for (const RayStep& step : steps(libraries)) {
    if (const auto done = run_step(step, progress, stop, result); !done) return done.error();
  }
  const auto done = options_.whole_frame() ? run_effects(effects, progress, stop, result)
                                           : run_composite(libraries, result);
  if (!done) return done.error();
  if (const auto read = read_layers(result); !read) return read.error();
  return result;
}

rtapi::Status Renderer::read_layers(FrameResult& result) {
  struct Layer {
    const char* name;
    FrameTexture texture;
    float scale;
  };
  std::vector<Layer> layers = {{"depth", kDepth, 1},          {"view_z", kViewZ, 1},
                               {"normal", kNormal, 1},        {"shading_normal", kShadingNormal, 1},
                               {"base_color", kBaseColor, 1}, {"emissive", kEmissive, 1},
                               {"material", kMaterial, 1},    {"ids", kIds, 1},
                               {"position", kPosition, 1}};
  if (options_.ao) {
    layers.push_back({"ao", kAmbientOcclusionSum, 1.0f / static_cast<float>(options_.ao_samples)});
  }
  if (options_.sun && scene_.sun) {
    layers.push_back({"sun", kSunVisibilitySum, 1.0f / static_cast<float>(options_.sun_samples)});
  }
  for (const Layer& layer : layers) {
    auto image = frame_.read(device_, queue_, layer.texture);
    if (!image) return image.error();
    for (float& value : image->values) {
      value *= layer.scale;
    }
    result.layers[layer.name] = std::move(*image);
  }
  auto radiance = frame_.read(device_, queue_, kRadiance);
  if (!radiance) return radiance.error();
  result.radiance = std::move(*radiance);
  return {};
}

}  // namespace northlight
