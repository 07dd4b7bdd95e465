// SPDX-License-Identifier: MIT
#include "stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <thread>
#include <utility>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/frame/picture.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/lights/light_constants.h"
#include "effects/sun_shadow/sun_shadow.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

constexpr rtapi::Format kSumFormat = rtapi::Format::kR32G32B32A32Float;
constexpr std::uint32_t kBackgroundSamples = 16;
// A dispatch should not take longer, so that progress shows and Ctrl-C gets a response.
constexpr double kDispatchSeconds = 0.3;

rtapi::Error failure(const std::string& text) {
  return {"measure", rtapi::ErrorCode::kFailed, text};
}

// Everything that the volume depends on, including the program's own timestamp, since its shaders
// are part of it.
std::string volume_key(const Options& options) {
  std::error_code ignored;
  std::string text = fmt::format("{} {} {} {}", options.scene, options.gi_cell.value_or(0),
                                 options.gi_bake_samples, options.seed);
  for (const std::string& material : options.materials) text += " " + material;
  for (const std::string& file : {options.scene, std::string("/proc/self/exe")}) {
    const auto time = std::filesystem::last_write_time(file, ignored);
    if (!ignored) text += fmt::format(" {}", time.time_since_epoch().count());
  }
  std::uint64_t hash = 0xCBF29CE484222325u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
  return fmt::format("{:016x}", hash);
}

double clock_ms(const Options& options) {
  timespec now{};
  clock_gettime(options.cpu_clock ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  const double ms = static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
  if (!options.cpu_clock) return ms;
  const unsigned threads =
      options.threads > 0 ? options.threads : std::thread::hardware_concurrency();
  return ms / std::max(threads, 1u);
}

std::uint32_t channels_of(Effect effect) {
  if (effect == Effect::kAo || effect == Effect::kSun) return 1;
  return effect == Effect::kContact ? 2 : 3;
}

}  // namespace

rtapi::Status Stage::create_device(std::function<void(const std::string&)> message) {
  rtapi::DeviceDesc desc;
  desc.Backend = options_.backend;
  desc.Threads = options_.threads;
  if (options_.precision == "fast") desc.Precision = rtapi::TraversalPrecision::kFast;
  if (options_.precision == "exact") desc.Precision = rtapi::TraversalPrecision::kExact;
  desc.CollectStatistics = true;
  desc.OnMessage = [message = std::move(message)](const rtapi::Message& m) { message(m.Text); };
  const auto device = rtapi::CreateDevice(desc);
  if (!device) return device.error();
  device_ = *device;
  const auto queue = device_.CreateCommandQueue();
  if (!queue) return queue.error();
  queue_ = *queue;
  const auto list = device_.CreateCommandList();
  if (!list) return list.error();
  list_ = *list;
  return {};
}

rtapi::Result<std::unique_ptr<Stage>> Stage::create(
    const Options& options, const Scene& scene, const ShaderLibraries& libraries,
    const Needs& needs, const std::string& cache, const StageProgress& progress,
    const std::atomic<bool>& stop, std::function<void(const std::string&)> message) {
  std::unique_ptr<Stage> out(new Stage(options, scene, libraries, stop));
  if (const auto s = out->create_device(std::move(message)); !s) return s.error();
  const Camera& camera = scene.cameras.front();
  auto gpu = create_gpu_scene(out->device_, out->queue_, scene, camera.position());
  if (!gpu) return gpu.error();
  out->gpu_ = std::move(*gpu);
  FrameDesc desc;
  desc.width = options.width;
  desc.height = options.height;
  desc.seed = options.seed;
  desc.max_pass_views = 2048;  // many denoisers side by side
  if (options.sun_angle_degrees) {
    desc.sun_angular_radius = *options.sun_angle_degrees * 3.14159265f / 360.0f;
  }
  auto frame = Frame::create(out->device_, out->queue_, scene, out->gpu_, camera, desc);
  if (!frame) return frame.error();
  out->frame_ = std::move(*frame);
  const auto gbuffer =
      RayPass::create(out->device_, out->frame_, out->gpu_, gbuffer_pass(libraries.gbuffer));
  if (!gbuffer) return gbuffer.error();
  const auto drawn = out->execute([&](rtapi::CommandList& list) {
    gbuffer->dispatch(list, out->frame_, {.sample_count = 1}, options.height);
  });
  if (!drawn) return drawn.error();
  if (needs.lights || needs.volume || needs.glass) {
    if (const auto s = out->create_lights(); !s) return s.error();
  }
  if (needs.volume || needs.glass) {
    if (const auto s = out->create_volume(cache, progress); !s) return s.error();
  }
  if (needs.glass) {
    if (const auto s = out->render_background(); !s) return s.error();
  }
  return out;
}

rtapi::Status Stage::create_lights() {
  const auto count =
      static_cast<std::uint32_t>(light_constants(scene_, scene_.cameras.front().position()).size());
  const auto lighting = Lighting::create(device_, frame_, gpu_, libraries_.lighting, count);
  if (!lighting) return lighting.error();
  lighting_ = *lighting;
  if (count > 0) {
    const auto direct = DirectLighting::create(device_, frame_, *lighting_, libraries_.direct);
    if (!direct) return direct.error();
    direct_ = *direct;
  }
  const auto done = execute([&](rtapi::CommandList& list) {
    lighting_->update(list, frame_);
    if (direct_) direct_->dispatch(list, frame_, true);
  });
  if (!done) return done.error();
  return {};
}

rtapi::Status Stage::create_volume(const std::string& cache, const StageProgress& progress) {
  std::string path = options_.gi_volume;
  if (path.empty()) path = cache + "/volume-" + volume_key(options_) + ".bin";
  IndirectVolume volume;
  if (std::filesystem::exists(path)) {
    auto loaded = load_volume(path);
    if (!loaded.ok()) return failure(loaded.error());
    volume = std::move(loaded.value());
  } else {
    auto laid_out = layout_volume(scene_, options_.gi_cell);
    if (!laid_out.ok()) return failure(laid_out.error());
    volume = std::move(laid_out.value());
    BakeDesc desc;
    desc.samples = options_.gi_bake_samples;
    desc.seed = options_.seed;
    const auto show = [&](double done) { progress("volume of light", done); };
    if (const auto baked = bake_volume(device_, queue_, frame_, gpu_, *lighting_,
                                       scene_.cameras.front().position(), libraries_.volume_bake,
                                       desc, volume, show, stop_);
        !baked) {
      return baked.error();
    }
    if (const auto saved = save_volume(path, volume); !saved.ok()) return failure(saved.error());
  }
  const auto gpu_volume = GpuVolume::create(device_, volume, scene_.cameras.front().position());
  if (!gpu_volume) return gpu_volume.error();
  volume_ = *gpu_volume;
  const auto none = GpuVolume::create(device_, {}, scene_.cameras.front().position());
  if (!none) return none.error();
  no_volume_ = *none;
  return {};
}

rtapi::Status Stage::render_background() {
  const auto composite = CompositePass::create(device_, frame_, libraries_.composite);
  if (!composite) return composite.error();
  composite_ = *composite;
  for (const Effect effect : {Effect::kAo, Effect::kSun}) {
    if (effect == Effect::kSun && !scene_.sun) continue;
    Setting setting{.effect = effect, .samples = kBackgroundSamples};
    setting.ao_radius = options_.ao_radius;
    if (const auto ran = run(setting); !ran) return ran.error();
  }
  return {};
}

rtapi::Result<Stage::Pass*> Stage::pass(const Setting& setting) {
  const auto key = std::make_pair(setting.effect, setting.trace_only);
  if (const auto found = passes_.find(key); found != passes_.end()) return &found->second;
  auto created = create_pass(setting);
  if (!created) return created.error();
  return &passes_.emplace(key, std::move(*created)).first->second;
}

rtapi::Result<Stage::Pass> Stage::create_pass(const Setting& setting) {
  const Effect effect = setting.effect;
  RayPassDesc desc;
  switch (effect) {
    case Effect::kAo:
      desc = ambient_occlusion_pass(libraries_.ambient_occlusion);
      break;
    case Effect::kSun:
      desc = sun_shadow_pass(libraries_.sun_shadow);
      break;
    case Effect::kContact:
      desc = contact_shadow_pass(libraries_.contact_shadow);
      break;
    case Effect::kReflections:
      desc = setting.trace_only ? reflections_trace_pass(libraries_.reflections)
                                : reflections_pass(libraries_.reflections);
      break;
    case Effect::kGi:
      desc = indirect_diffuse_pass(libraries_.indirect_diffuse);
      break;
    case Effect::kTransparent:
      desc = transparent_pass(libraries_.transparent);
      break;
  }
  Pass out;
  const auto rays = RayPass::create(device_, frame_, gpu_, desc);
  if (!rays) return rays.error();
  out.rays = *rays;
  if (effect == Effect::kAo || effect == Effect::kSun) return out;
  const auto views = frame_.create_pass_views(device_);
  if (!views) return views.error();
  out.views = *views;
  const auto sum = frame_.create_picture(device_, desc.name + " sum", kSumFormat);
  if (!sum) return sum.error();
  out.sum = *sum;
  if (effect == Effect::kContact) {
    if (!direct_) return failure("the scene has no local light that could cast contact shadows");
    out.sum_at = 1;
    if (const auto s = out.views.set_unordered_access(0, direct_->strongest()); !s)
      return s.error();
  } else {
    if (const auto s = lighting_->bind(out.views); !s) return s.error();
    const GpuVolume& volume = setting.trace_only ? no_volume_ : volume_;
    if (const auto s = volume.bind(out.views); !s) return s.error();
  }
  if (const auto s = out.views.set_unordered_access(out.sum_at, out.sum); !s) return s.error();
  if (effect == Effect::kContact) {
    if (const auto s = create_lit(out); !s) return s.error();
  }
  if (effect == Effect::kTransparent) {
    if (const auto s = create_glass(out); !s) return s.error();
  }
  return out;
}

rtapi::Status Stage::create_lit(const Pass& pass) {
  const auto mean = frame_.create_picture(device_, "contact mean", kSumFormat);
  if (!mean) return mean.error();
  contact_mean_ = *mean;
  auto load = Denoiser::create(device_, frame_, libraries_.denoise, "contact", contact_mean_,
                               default_denoise(DenoiseMethod::kNone));
  if (!load) return load.error();
  contact_load_ = std::move(*load);
  if (const auto s = contact_load_.create_load(device_, frame_, libraries_.denoise, pass.sum); !s) {
    return s;
  }
  return direct_->set_contact(contact_mean_);
}

rtapi::Result<FloatImage> Stage::read_lit(const Setting& setting) {
  const auto added = execute([&](rtapi::CommandList& list) {
    contact_load_.load(list, frame_, 1.0f / static_cast<float>(setting.samples));
    direct_->add_strongest(list, frame_);
  });
  if (!added) return added.error();
  const auto image = read_picture(device_, queue_, direct_->total());
  if (!image) return image.error();
  FloatImage out(image->width, image->height, 3);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = image->values[i / 3 * image->channels + i % 3];
  }
  return out;
}

rtapi::Status Stage::create_glass(Pass& pass) {
  glass_ = pass.sum;
  const auto transmittance = frame_.create_picture(device_, "transmittance", kSumFormat);
  if (!transmittance) return transmittance.error();
  transmittance_ = *transmittance;
  if (const auto s = pass.views.set_unordered_access(1, transmittance_); !s) return s;
  const auto compose = transparent_compose_pass(device_, frame_, libraries_.transparent);
  if (!compose) return compose.error();
  glass_compose_ = *compose;
  return {};
}

PassArguments Stage::arguments(const Pass& pass, const Setting& setting) const {
  switch (setting.effect) {
    case Effect::kAo:
    case Effect::kSun:
      return {};
    case Effect::kContact:
      return {pass.views, setting.contact};
    case Effect::kReflections:
      return {pass.views, setting.reflection};
    case Effect::kGi:
      return {pass.views, setting.indirect};
    case Effect::kTransparent:
      break;
  }
  return {pass.views, setting.glass};
}

void Stage::clear(rtapi::CommandList& list, const Pass& pass, Effect effect) const {
  if (effect == Effect::kAo) {
    frame_.clear(list, kAmbientOcclusionSum);
  } else if (effect == Effect::kSun) {
    frame_.clear(list, kSunVisibilitySum);
  } else {
    pass.views.clear(list, pass.sum_at, pass.sum);
  }
  list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
}

rtapi::Result<double> Stage::execute(const std::function<void(rtapi::CommandList&)>& record) {
  if (stop_) return rtapi::Error{{}, rtapi::ErrorCode::kFailed, "interrupted"};
  if (const auto reset = list_.Reset(); !reset) return reset.error();
  record(list_);
  const double start = clock_ms(options_);
  if (const auto done = queue_.ExecuteAndWait(list_); !done) return done.error();
  return clock_ms(options_) - start;
}

rtapi::Status Stage::set_seed(std::uint32_t seed) {
  const Camera& camera = scene_.cameras.front();
  frame_.set_seed(seed);
  return frame_.set_camera(device_, scene_, camera, {.previous_camera = camera});
}

rtapi::Result<Stage::Run> Stage::run(const Setting& setting) {
  const auto found = pass(setting);
  if (!found) return found.error();
  const Pass& pass = **found;
  const bool glass = setting.effect == Effect::kTransparent;
  const auto occlusion = setting.times_ao > 0 ? this->pass({.effect = Effect::kAo}) : found;
  if (!occlusion) return occlusion.error();
  const auto cleared = execute([&](rtapi::CommandList& list) {
    clear(list, pass, setting.effect);
    if (setting.times_ao > 0) clear(list, pass, Effect::kAo);
    if (!glass) return;
    composite_->dispatch(list, frame_, {kBackgroundSamples, scene_.sun ? kBackgroundSamples : 0});
  });
  if (!cleared) return cleared.error();
  device_.ResetStatistics();
  const PassArguments words = arguments(pass, setting);
  const auto ms = execute([&](rtapi::CommandList& list) {
    pass.rays.dispatch(list, frame_,
                       {.first_sample = setting.first_sample,
                        .sample_count = setting.samples,
                        .radius = setting.ao_radius},
                       frame_.height(), words);
    if (glass) glass_compose_.dispatch(list, frame_, {}, words, frame_.width(), frame_.height());
    if (setting.times_ao == 0) return;
    (*occlusion)
        ->rays.dispatch(list, frame_,
                        {.sample_count = setting.times_ao, .radius = setting.ao_radius},
                        frame_.height());
  });
  if (!ms) return ms.error();
  return Run{*ms, device_.GetStatistics().TraceRayCalls};
}

rtapi::Status Stage::accumulate(const Setting& setting,
                                const std::function<void(double)>& progress) {
  const auto found = pass(setting);
  if (!found) return found.error();
  const Pass& pass = **found;
  const auto cleared =
      execute([&](rtapi::CommandList& list) { clear(list, pass, setting.effect); });
  if (!cleared) return cleared.error();
  std::uint32_t step = 1;
  for (std::uint32_t sample = 0; sample < setting.samples;) {
    const std::uint32_t count = std::min(step, setting.samples - sample);
    const auto ms = execute([&](rtapi::CommandList& list) {
      pass.rays.dispatch(
          list, frame_,
          {.first_sample = sample, .sample_count = count, .radius = setting.ao_radius},
          frame_.height(), arguments(pass, setting));
    });
    if (!ms) return ms.error();
    sample += count;
    progress(static_cast<double>(sample) / setting.samples);
    const double fit = step * std::clamp(kDispatchSeconds * 1000 / std::max(*ms, 0.1), 0.5, 2.0);
    step = static_cast<std::uint32_t>(std::clamp(fit, 1.0, 1024.0));
  }
  return {};
}

rtapi::Result<rtapi::Texture> Stage::sum(const Setting& setting) {
  if (setting.effect == Effect::kAo) return frame_.texture(kAmbientOcclusionSum);
  if (setting.effect == Effect::kSun) return frame_.texture(kSunVisibilitySum);
  const auto found = pass(setting);
  if (!found) return found.error();
  return (*found)->sum;
}

rtapi::Result<FloatImage> Stage::read(const Setting& setting) {
  if (setting.lit) return read_lit(setting);
  const bool glass = setting.effect == Effect::kTransparent;
  const auto texture = sum(setting);
  if (!texture) return texture.error();
  const auto image = read_picture(device_, queue_, glass ? frame_.texture(kRadiance) : *texture);
  if (!image) return image.error();
  const std::uint32_t channels = channels_of(setting.effect);
  const float scale = glass ? 1.0f : 1.0f / static_cast<float>(setting.samples);
  FloatImage out(image->width, image->height, channels);
  for (std::size_t pixel = 0; pixel < out.values.size() / channels; ++pixel) {
    for (std::uint32_t c = 0; c < channels; ++c) {
      out.values[pixel * channels + c] = image->values[pixel * image->channels + c] * scale;
    }
  }
  if (setting.times_ao == 0) return out;
  const auto open = frame_.read(device_, queue_, kAmbientOcclusionSum);
  if (!open) return open.error();
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] *= open->values[i / channels] / static_cast<float>(setting.times_ao);
  }
  return out;
}

rtapi::Result<std::vector<std::uint8_t>> Stage::mask(bool glass) {
  const auto image = read_picture(device_, queue_, glass ? glass_ : frame_.texture(kIds));
  if (!image) return image.error();
  std::vector<std::uint8_t> out(std::size_t{image->width} * image->height);
  for (std::size_t pixel = 0; pixel < out.size(); ++pixel) {
    const float value = image->values[pixel * image->channels + (glass ? 3 : 0)];
    out[pixel] = value > 0 ? 1 : 0;
  }
  return out;
}

}  // namespace northlight
