// SPDX-License-Identifier: MIT
#include "renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "effects/ambient_occlusion/ambient_occlusion.h"
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

rtapi::Result<ShaderLibraries> built_in_libraries() {
  const auto gbuffer = gbuffer_library();
  const auto ao = ambient_occlusion_library();
  const auto sun = sun_shadow_library();
  const auto composite = composite_library();
  for (const auto* library : {&gbuffer, &ao, &sun, &composite}) {
    if (!*library) return library->error();
  }
  return ShaderLibraries{*gbuffer, *ao, *sun, *composite};
}

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

rtapi::Status Renderer::run_pass(const RayPass& pass, const std::string& name,
                                 std::uint32_t samples, const Progress& progress,
                                 const std::atomic<bool>& stop, FrameResult& result) {
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
      pass.dispatch(*list, frame_, constants, count);
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

std::vector<Renderer::Step> Renderer::steps(const ShaderLibraries& libraries) const {
  std::vector<Step> out = {{gbuffer_pass(libraries.gbuffer), 1}};
  if (options_.ao) {
    out.push_back({ambient_occlusion_pass(libraries.ambient_occlusion), options_.ao_samples});
  }
  if (options_.sun && scene_.sun) {
    out.push_back({sun_shadow_pass(libraries.sun_shadow), options_.sun_samples});
  }
  return out;
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

  for (const Step& step : steps(libraries)) {
    const auto pass = RayPass::create(device_, frame_, gpu_, step.desc);
    if (!pass) return pass.error();
    const auto done = run_pass(*pass, step.desc.name, step.samples, progress, stop, result);
    if (!done) return done.error();
  }

  CompositeConstants weights;
  weights.ao_samples = options_.ao ? options_.ao_samples : 0;
  weights.sun_samples = options_.sun && scene_.sun ? options_.sun_samples : 0;
  const auto start = Clock::now();
  const auto composite = CompositePass::create(device_, frame_, libraries.composite);
  if (!composite) return composite.error();
  if (const auto reset = list->Reset(); !reset) return reset.error();
  composite->dispatch(*list, frame_, weights);
  if (const auto done = queue_.ExecuteAndWait(*list); !done) return done.error();
  result.passes.push_back(
      {"composite", std::chrono::duration<double, std::milli>(Clock::now() - start).count(), {}});
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
