// SPDX-License-Identifier: MIT
#include "renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/frame/picture.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/scene/levels.h"
#include "effects/sun_shadow/sun_shadow.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

using Clock = std::chrono::steady_clock;

// The most samples that a pixel takes in one dispatch.
constexpr std::uint32_t kSamplesPerDispatch = 64;
// A dispatch should not take longer, so that progress shows and Ctrl-C gets a response.
constexpr double kDispatchSeconds = 0.25;

// Size of the frame's pictures that a pass writes and of its own resources.
std::uint64_t bytes_of(const RayStep& step, const Frame& frame) {
  std::uint64_t sum = step.arguments.views ? step.arguments.views->bytes() : 0;
  for (const FrameTexture texture : step.writes) sum += picture_bytes(frame.texture(texture));
  return sum;
}

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

  if (const auto made = out->create_scene(); !made) return made.error();
  return out;
}

rtapi::Status Renderer::create_scene() {
  const Camera& camera = scene_.cameras.front();
  moment_.camera = camera;
  if (options_.frames > 0 || !scene_.skins.empty()) {
    auto manager = StructureManager::create(device_, queue_, scene_);
    if (!manager) return manager.error();
    structures_ = std::move(*manager);
    gpu_ = structures_->scene();
  } else {
    auto gpu = create_gpu_scene(device_, queue_, scene_, camera.position());
    if (!gpu) return gpu.error();
    gpu_ = std::move(*gpu);
  }
  FrameDesc frame_desc;
  frame_desc.width = options_.width;
  frame_desc.height = options_.height;
  frame_desc.seed = options_.seed;
  frame_desc.ray_cones = options_.texture_lod == "cone";
  if (options_.sun_angle_degrees) {
    frame_desc.sun_angular_radius = *options_.sun_angle_degrees * 3.14159265f / 360.0f;
  }
  auto frame = Frame::create(device_, queue_, scene_, gpu_, camera, frame_desc);
  if (!frame) return frame.error();
  frame_ = std::move(*frame);
  if (!structures_) return {};
  FrameResult ignored;  // what is baked later needs the scene in its initial state
  return begin_frame(moment_, ignored);
}

rtapi::Status Renderer::add_passes(const std::vector<RayStep>& steps, std::vector<Pass>& out) {
  out.clear();
  for (const RayStep& step : steps) {
    const auto pass = RayPass::create(device_, frame_, gpu_, step.desc);
    if (!pass) return pass.error();
    out.push_back({step, *pass, {}});
    if (!sorter_ || step.desc.key_generation.empty()) continue;
    const auto keys = RayPass::create(device_, frame_, gpu_, key_pass(step.desc));
    if (!keys) return keys.error();
    out.back().keys = *keys;
  }
  return {};
}

rtapi::Status Renderer::prepare(const ShaderLibraries& libraries, const Progress& progress,
                                const std::atomic<bool>& stop, FrameResult& result) {
  effects_.reset();
  taa_.reset();
  if (!options_.sort_rays.empty()) {
    auto sorter = RaySorter::create(device_, frame_, libraries.ray_order);
    if (!sorter) return sorter.error();
    sorter_ = std::move(*sorter);
  }
  if (options_.whole_frame()) {
    effects_ = std::make_unique<FrameEffects>();
    const auto bake_progress = [&](double done) { progress("indirect light", done); };
    const auto start = Clock::now();
    if (const auto created = effects_->create(device_, queue_, frame_, gpu_, scene_, options_,
                                              libraries, bake_progress, stop);
        !created) {
      return created;
    }
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    result.passes.push_back({"set-up and bake", ms, device_.GetStatistics()});
    result.left_out = effects_->left_out();
    if (const auto done = add_passes(effects_->steps(), effect_passes_); !done) return done;
  } else {
    const auto composite = CompositePass::create(device_, frame_, libraries.composite);
    if (!composite) return composite.error();
    composite_ = *composite;
  }
  if (options_.taa) {
    const auto taa = TemporalAntialiasing::create(device_, frame_, libraries.taa);
    if (!taa) return taa.error();
    taa_ = *taa;
  }
  if (std::none_of(gpu_.geometries.begin(), gpu_.geometries.end(),
                   [](const GpuGeometry& geometry) { return geometry.alpha_tested; })) {
    result.left_out.push_back("any-hit shaders: nothing is alpha-tested");
  }
  if (scene_.skins.empty()) result.left_out.push_back("skinning: the scene has no skin");
  return add_passes(steps(libraries), passes_);
}

std::vector<InstanceState> Renderer::states_at(const Moment& moment) const {
  std::vector<InstanceState> states = evaluate_instances(scene_, moment.seconds);
  std::vector<glm::dmat4> transforms;
  for (const InstanceState& state : states) transforms.push_back(state.transform);
  const std::vector<std::uint32_t> meshes = select_levels(scene_, moment.camera, transforms);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].mesh = static_cast<std::int32_t>(meshes[i]);
  }
  return states;
}

rtapi::Status Renderer::begin_frame(const Moment& moment, FrameResult& result) {
  FrameTime time;
  time.index = moment.index;
  time.previous_camera = moment.index == 0 ? moment.camera : moment_.camera;
  time.previous_jitter = jitter_;
  jitter_ = options_.taa ? taa_jitter(moment.index) : glm::vec2(0.0f);
  time.jitter = jitter_;
  moment_ = moment;
  const glm::dvec3 origin = moment.camera.position();
  if (structures_) {
    const auto start = Clock::now();
    if (const auto done = structures_->execute(device_, queue_, states_at(moment), origin); !done) {
      return done;
    }
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    result.passes.push_back({"structures", ms, {}});
  }
  if (moment.cut && taa_) taa_->reset();
  return frame_.set_camera(device_, scene_, moment.camera, time);
}

rtapi::Status Renderer::sort_rays(const Pass& pass, const PassConstants& constants, double& ms) {
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  const auto start = Clock::now();
  pass.keys->dispatch(*list, frame_, constants, options_.height, pass.step.arguments);
  sorter_->sort(*list, frame_,
                options_.sort_rays == "origin" ? RayOrder::kOrigin : RayOrder::kDirection);
  const auto done = queue_.ExecuteAndWait(*list);
  ms += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return done;
}

rtapi::Status Renderer::run_pass(const Pass& pass, const Progress& progress,
                                 const std::atomic<bool>& stop, FrameResult& result) {
  const std::string& name = pass.step.desc.name;
  const std::uint32_t samples = pass.step.samples;
  // Each frame of a sequence continues each pixel's sample sequence, so that samples are spread as
  // evenly over several frames as within one.
  const std::uint32_t first = moment_.index * samples;
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  double order_ms = 0;
  device_.ResetStatistics();
  const auto start = Clock::now();
  const std::uint32_t step = pass.step.pixel_step;
  const std::uint32_t height = (options_.height + step - 1) / step;
  std::uint32_t rows = std::min<std::uint32_t>(32, height);
  for (std::uint32_t sample = 0; sample < samples; sample += kSamplesPerDispatch) {
    PassConstants constants;
    constants.first_sample = first + sample;
    constants.sample_count = std::min(kSamplesPerDispatch, samples - sample);
    constants.radius = options_.ao_radius;
    constants.pixel_step = step;
    constants.accumulate = sample > 0 ? 1 : 0;
    // Sorting orders all pixels, so it does not apply at half resolution.
    if (pass.keys && step == 1) {
      if (const auto sorted = sort_rays(pass, constants, order_ms); !sorted) return sorted;
      constants.sorted = 1;
    }
    for (std::uint32_t row = 0; row < height;) {
      if (stop) return stopped();
      const std::uint32_t count = std::min(rows, height - row);
      constants.first_row = row;
      if (const auto reset = list->Reset(); !reset) return reset;
      pass.pass.dispatch(*list, frame_, constants, count, pass.step.arguments);
      const auto before = Clock::now();
      if (const auto done = execute_band(*list, name, row, count, result); !done) return done;
      const double seconds = std::chrono::duration<double>(Clock::now() - before).count();
      const double fit = rows * std::clamp(kDispatchSeconds / std::max(seconds, 1e-4), 0.5, 2.0);
      rows = static_cast<std::uint32_t>(std::clamp(fit, 1.0, static_cast<double>(height)));
      row += count;
      progress(name,
               (sample + constants.sample_count * (static_cast<double>(row) / height)) / samples);
    }
  }
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  if (pass.keys) result.passes.push_back({name + " order", order_ms, {}});
  result.passes.push_back(
      {name, ms - order_ms, device_.GetStatistics(), bytes_of(pass.step, frame_)});
  return {};
}

rtapi::Status Renderer::run_compute(const std::string& name, std::uint64_t bytes,
                                    const std::function<void(rtapi::CommandList&)>& record,
                                    FrameResult& result) {
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  device_.ResetStatistics();
  const auto start = Clock::now();
  record(*list);
  if (const auto done = queue_.ExecuteAndWait(*list); !done) return done;
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  result.passes.push_back({name, ms, device_.GetStatistics(), bytes});
  return {};
}

std::vector<RayStep> Renderer::steps(const ShaderLibraries& libraries) const {
  std::vector<RayStep> out = {{gbuffer_pass(libraries.gbuffer),
                               1,
                               {},
                               {kDepth, kViewZ, kNormal, kShadingNormal, kBaseColor, kEmissive,
                                kMaterial, kIds, kPosition, kMotion}}};
  if (options_.ao) {
    out.push_back({ambient_occlusion_pass(libraries.ambient_occlusion),
                   options_.ao_samples,
                   {},
                   {kAmbientOcclusionSum},
                   options_.pixel_step("ao")});
  }
  if (options_.sun && scene_.sun) {
    out.push_back({sun_shadow_pass(libraries.sun_shadow),
                   options_.sun_samples,
                   {},
                   {kSunVisibilitySum},
                   options_.pixel_step("sun")});
  }
  return out;
}

rtapi::Status Renderer::run_effects(const Progress& progress, const std::atomic<bool>& stop,
                                    FrameResult& result) {
  if (const auto done = run_compute(
          "local lights", effects_->light_bytes(),
          [&](rtapi::CommandList& list) { effects_->light(list, frame_); }, result);
      !done) {
    return done;
  }
  for (const Pass& pass : effect_passes_) {
    if (const auto done = run_pass(pass, progress, stop, result); !done) return done;
  }
  for (const auto& filter : effects_->filters(frame_)) {
    if (const auto done = run_compute(filter.name, filter.bytes, filter.record, result); !done) {
      return done;
    }
  }
  return run_compute(
      "composite", effects_->compose_bytes() + picture_bytes(frame_.texture(kRadiance)),
      [&](rtapi::CommandList& list) { effects_->compose(list, frame_); }, result);
}

rtapi::Status Renderer::run_composite(FrameResult& result) {
  CompositeConstants weights;
  weights.ao_samples = options_.ao ? options_.ao_samples : 0;
  weights.sun_samples = options_.sun && scene_.sun ? options_.sun_samples : 0;
  std::uint64_t bytes = picture_bytes(frame_.texture(kRadiance));
  if (weights.ao_samples > 0) bytes += picture_bytes(frame_.texture(kAmbientOcclusionSum));
  if (weights.sun_samples > 0) bytes += picture_bytes(frame_.texture(kSunVisibilitySum));
  return run_compute(
      "composite", bytes,
      [&](rtapi::CommandList& list) { composite_.dispatch(list, frame_, weights); }, result);
}

rtapi::Status Renderer::render_frame(const Progress& progress, const std::atomic<bool>& stop,
                                     FrameResult& result) {
  if (effects_) effects_->begin_frame(moment_.camera.position(), moment_.cut);
  for (const Pass& pass : passes_) {
    if (const auto done = run_pass(pass, progress, stop, result); !done) return done;
  }
  const auto done = effects_ ? run_effects(progress, stop, result) : run_composite(result);
  if (!done || !taa_) return done;
  return run_compute(
      "taa", taa_->bytes(), [&](rtapi::CommandList& l) { taa_->dispatch(l, frame_); }, result);
}

rtapi::Result<FrameResult> Renderer::render(const ShaderLibraries& libraries,
                                            const Progress& progress,
                                            const std::atomic<bool>& stop) {
  FrameResult result;
  if (const auto done = prepare(libraries, progress, stop, result); !done) return done.error();
  if (const auto done = render_frame(progress, stop, result); !done) return done.error();
  if (const auto done = read_layers(result); !done) return done.error();
  return result;
}

rtapi::Result<FloatImage> Renderer::read(const rtapi::Texture& picture) {
  return read_picture(device_, queue_, picture);
}

rtapi::Status Renderer::read_radiance(FrameResult& result) {
  auto radiance = read(taa_ ? taa_->result() : frame_.texture(kRadiance));
  if (!radiance) return radiance.error();
  result.radiance = std::move(*radiance);
  return {};
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
    // In its stored form, as EncodeColor makes it; alpha is 1. [effects/shaders/encoding.hlsli]
    if (layer.texture == kBaseColor) {
      for (float& value : image->values) value *= value;
    }
    result.layers[layer.name] = std::move(*image);
  }
  if (effects_) {
    for (const FrameEffects::Layer& layer : effects_->layers()) {
      auto image = read(layer.picture);
      if (!image) return image.error();
      for (float& value : image->values) value *= layer.scale;
      result.layers[layer.name] = std::move(*image);
    }
  }
  return read_radiance(result);
}

}  // namespace northlight
