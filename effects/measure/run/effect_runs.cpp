// SPDX-License-Identifier: MIT
#include "effects/measure/run/effect_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "effects/assets/common/sampling.h"
#include "effects/denoise/denoise.h"
#include "effects/engine/picture.h"
#include "effects/engine/profile.h"
#include "effects/measure/run/picture_key.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr std::uint32_t kBackgroundSamples = 16;
constexpr std::uint32_t kMostDenoiserViews = 2048;  // many denoisers side by side

double cpu_ms(std::uint32_t threads) {
  return process_clock_ms() /
         std::max(threads > 0 ? threads : std::thread::hardware_concurrency(), 1u);
}

FloatImage first_channels(const FloatImage& image, std::uint32_t channels) {
  FloatImage out(image.width, image.height, channels);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = image.values[i / channels * image.channels + i % channels];
  }
  return out;
}

}  // namespace

std::function<double()> cpu_clock(std::uint32_t threads) {
  return [threads] { return cpu_ms(threads); };
}

Setting setting_of(const std::string& effect, std::uint32_t samples) {
  Setting out{.effect = effect, .settings = find_effect(northlight_effects(), effect)->defaults};
  out.settings.samples = samples;
  return out;
}

void add_setting(Checksum& checksum, const Setting& setting) {
  const auto& [effect, settings, first_sample, lit, times_ao, independent] = setting;
  checksum.add(effect);
  add_settings(checksum, settings);
  checksum.add_value(first_sample);
  checksum.add_value(lit);
  checksum.add_value(times_ao);
  checksum.add_value(independent);
}

Setting in_frame(Setting setting, std::uint32_t index) {
  setting.first_sample = index * setting.settings.samples;
  return setting;
}

rtapi::Result<Outcome> EffectRuns::create(const Options& options, const Scene& scene,
                                          const std::vector<std::string>& effects,
                                          const std::string& cache, const Progress& progress,
                                          const Say& message, std::unique_ptr<EffectRuns>& out) {
  out = std::make_unique<EffectRuns>();
  Options own = options;
  choose_in_frame(own, effects);
  for (auto& [name, settings] : own.frame.effects) {
    settings.pixel_step = 1;
    const EffectNeeds& needs = find_effect(northlight_effects(), name)->needs;
    settings.keep = needs.glass || needs.panes;
  }
  own.frame.order = RayOrder::kPixels;
  own.frame.max_pass_views = kMostDenoiserViews;
  if (own.frame.volume.file.empty()) {
    own.frame.volume.file = cache + "/volume-" + volume_key(options, scene) + ".bin";
  }
  auto renderer = create_renderer(own, scene, message);
  if (!renderer) return renderer.error();
  out->renderer_ = std::move(*renderer);
  out->ao_radius_ = options.effects.at("ao").radius;
  out->key_ = picture_key(own, scene);
  out->seed_ = options.frame.seed;
  out->seconds_ = options.seconds.value_or(0.0);
  if (options.cpu_clock) {
    out->renderer_->runner().set_clock(cpu_clock(options.threads));
  }
  if (const auto s = out->renderer_->prepare(progress); !is_done(s)) return s;
  for (const Effect& effect : northlight_effects()) {
    if (!effect.needs.glass || !out->renderer_->effects().renders(effect.name)) continue;
    if (const auto s = out->create_background(); !s) return s.error();
  }
  return Outcome::kDone;
}

std::string EffectRuns::key(const Setting& setting) const {
  Checksum checksum;
  checksum.add(key_);
  add_setting(checksum, setting);
  return as_key(checksum);
}

rtapi::Status EffectRuns::begin_frame(std::uint32_t index) {
  return renderer_->begin_frame({.index = index,
                                 .seconds = seconds_,
                                 .camera = renderer_->context().scene.cameras.front(),
                                 .cut = index == 0});
}

rtapi::Status EffectRuns::create_background() {
  const rtapi::Texture sun = renderer_->effects().sum("sun"), ao = renderer_->effects().sum("ao");
  FrameParts sums;
  if (sun) sums.sun_visibility = &sun;
  if (ao) sums.ambient = &ao;
  const auto composite = CompositePass::create(
      renderer_->device(), renderer_->frame(),
      renderer_->context().libraries.at("composition/composite/composite"), sums);
  if (!composite) return composite.error();
  background_ = *composite;
  for (const char* effect : {"ao", "sun"}) {
    if (!renderer_->effects().renders(effect)) continue;
    Setting setting = setting_of(effect, kBackgroundSamples);
    setting.settings.radius = ao_radius_;
    const auto ran = run(setting);
    if (!ran) return ran.error();
  }
  return {};
}

rtapi::Status EffectRuns::draw_background() {
  const auto drawn = renderer_->runner().execute([&](rtapi::CommandList& list) {
    const auto samples = [&](const char* effect) {
      return renderer_->effects().renders(effect) ? kBackgroundSamples : 0;
    };
    background_->dispatch(list, renderer_->frame(), {samples("ao"), samples("sun")});
  });
  if (!drawn) return drawn.error();
  return {};
}

rtapi::Result<FloatImage> EffectRuns::read_background() {
  if (background_) {
    if (const auto drawn = draw_background(); !drawn) return drawn.error();
  }
  return renderer_->read("radiance");
}

bool EffectRuns::is_glass(const Setting& setting) const {
  return find_effect(renderer_->context().effects, setting.effect)->needs.glass;
}

rtapi::Status EffectRuns::set_seed(std::uint32_t seed) {
  seed_ = seed;
  return renderer_->set_seed(seed);
}

rtapi::Result<RunStatistics> EffectRuns::run_independent(const Setting& setting) {
  Setting one = setting;
  one.settings.samples = 1;
  one.independent = false;
  RunStatistics all;
  for (std::uint32_t i = 0; i < setting.settings.samples; ++i) {
    if (const auto s = renderer_->set_seed(hash_combine(seed_, i)); !s) return s.error();
    const auto ran = run(one);
    if (!ran) return ran;
    all.ms += ran->ms;
    all.rays += ran->rays;
    const auto image = read(one);
    if (!image) return image.error();
    if (i == 0) mean_ = FloatImage(image->width, image->height, image->channels);
    for (std::size_t k = 0; k < mean_.values.size(); ++k) {
      mean_.values[k] += image->values[k] / static_cast<float>(setting.settings.samples);
    }
  }
  if (const auto s = renderer_->set_seed(seed_); !s) return s.error();
  return all;
}

rtapi::Result<double> EffectRuns::upscale(const EffectSignal& signal, std::uint32_t samples) {
  Upscaled& into = upscaled_[signal.name];
  const Frame& frame = renderer_->frame();
  if (!into.picture) {
    const auto picture = frame.create_picture(renderer_->device(), signal.name + " upscaled",
                                              rtapi::Format::kR32G32B32A32Float);
    if (!picture) return picture.error();
    into.picture = *picture;
    const auto libraries = denoise_libraries();
    if (!libraries) return libraries.error();
    auto load = SumLoad::create(renderer_->device(), frame, *libraries,
                                renderer_->effects().sum(signal.name), into.picture, 2);
    if (!load) return load.error();
    into.load = std::move(*load);
  }
  return renderer_->runner().execute([&](rtapi::CommandList& list) {
    into.load.record(list, frame, 1.0f / static_cast<float>(samples));
  });
}

rtapi::Result<RunStatistics> EffectRuns::run(const Setting& setting) {
  if (setting.independent) return run_independent(setting);
  if (is_glass(setting)) {
    if (!background_) return renderer_->run(setting.effect, setting.settings);
    if (const auto drawn = draw_background(); !drawn) return drawn.error();
  }
  const auto ran = renderer_->run(setting.effect, setting.settings, setting.first_sample);
  if (ran && setting.settings.pixel_step == 2) {
    const auto ms =
        upscale(find_effect(renderer_->context().effects, setting.effect)->signals.front(),
                setting.settings.samples);
    if (!ms) return ms.error();
    return RunStatistics{ran->ms + *ms, ran->rays};
  }
  if (!ran || setting.times_ao == 0) return ran;
  EffectSettings occlusion;
  occlusion.samples = setting.times_ao;
  occlusion.radius = ao_radius_;
  const auto more = renderer_->run("ao", occlusion);
  if (!more) return more;
  return RunStatistics{ran->ms + more->ms, ran->rays + more->rays};
}

rtapi::Result<Outcome> EffectRuns::accumulate(const Setting& setting, const Progress& progress) {
  return renderer_->accumulate(setting.effect, setting.settings, progress);
}

rtapi::Texture EffectRuns::sum(const Setting& setting) const {
  const Effect* effect = find_effect(renderer_->context().effects, setting.effect);
  return renderer_->effects().sum(effect->signals.front().name);
}

rtapi::Result<FloatImage> EffectRuns::read_lit(const Setting& setting) {
  const EffectSignal& signal =
      find_effect(renderer_->context().effects, setting.effect)->signals.front();
  if (signal.part == &FrameParts::local_lights) {
    const auto whole = renderer_->read(signal.name);
    if (!whole) return whole.error();
    return first_channels(*whole, 3);
  }
  const auto taken =
      renderer_->composition().take_strongest(*renderer_->effects().find(setting.effect));
  if (!taken) return taken.error();
  const auto added = renderer_->runner().execute([&](rtapi::CommandList& list) {
    renderer_->filters().record_rest(list);
    renderer_->lights().record_strongest(list);
  });
  if (!added) return added.error();
  const auto image = renderer_->read("local_lights");
  if (!image) return image.error();
  return first_channels(*image, 3);
}

rtapi::Result<FloatImage> EffectRuns::read(const Setting& setting) {
  if (setting.lit) return read_lit(setting);
  if (setting.independent) return mean_;
  const EffectSignal& signal =
      find_effect(renderer_->context().effects, setting.effect)->signals.front();
  if (setting.settings.pixel_step == 2) {
    const auto upscaled = renderer_->read(upscaled_.at(signal.name).picture);
    if (!upscaled) return upscaled.error();
    return first_channels(*upscaled, signal.channels);
  }
  const auto image = renderer_->read(is_glass(setting) ? "radiance" : signal.name);
  if (!image) return image.error();
  FloatImage out = first_channels(*image, signal.channels);
  if (setting.times_ao == 0) return out;
  const auto open = renderer_->read("ao");
  if (!open) return open.error();
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] *= open->values[i / signal.channels];
  }
  return out;
}

rtapi::Result<std::vector<std::uint8_t>> EffectRuns::mask(bool glass) {
  const auto image =
      renderer_->read(glass ? renderer_->effects().sum("glass") : renderer_->frame().texture(kIds));
  if (!image) return image.error();
  std::vector<std::uint8_t> out(std::size_t{image->width} * image->height);
  for (std::size_t pixel = 0; pixel < out.size(); ++pixel) {
    const float value = image->values[pixel * image->channels + (glass ? 3 : 0)];
    out[pixel] = value > 0 ? 1 : 0;
  }
  return out;
}

}  // namespace kaamos::measure
