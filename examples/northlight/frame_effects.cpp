// SPDX-License-Identifier: MIT
#include "frame_effects.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/frame/picture.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/lights/light_constants.h"
#include "effects/ray_order/ray_order.h"
#include "effects/sun_shadow/sun_shadow.h"
#include "effects/taa/taa.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

constexpr rtapi::Format kSignalFormat = rtapi::Format::kR32G32B32A32Float;

// An empty id would mean that the user stopped the program.
rtapi::Error failure(const std::string& text) {
  return {"effects", rtapi::ErrorCode::kFailed, text};
}

DenoiseMethod denoise_method(const std::string& name) {
  if (name == "none") return DenoiseMethod::kNone;
  if (name == "gaussian") return DenoiseMethod::kGaussian;
  if (name == "bilateral") return DenoiseMethod::kBilateral;
  if (name == "temporal") return DenoiseMethod::kTemporal;
  if (name == "control") return DenoiseMethod::kControl;
  return DenoiseMethod::kSvgf;
}

}  // namespace

rtapi::Result<ShaderLibraries> built_in_libraries() {
  ShaderLibraries out;
  const auto denoise = denoise_libraries();
  if (!denoise) return denoise.error();
  out.denoise = *denoise;
  struct {
    rtapi::Result<rtapi::ShaderLibrary> loaded;
    rtapi::ShaderLibrary* library;
  } const parts[] = {{gbuffer_library(), &out.gbuffer},
                     {ambient_occlusion_library(), &out.ambient_occlusion},
                     {sun_shadow_library(), &out.sun_shadow},
                     {composite_library(), &out.composite},
                     {lighting_library(), &out.lighting},
                     {direct_library(), &out.direct},
                     {contact_shadow_library(), &out.contact_shadow},
                     {volume_bake_library(), &out.volume_bake},
                     {indirect_diffuse_library(), &out.indirect_diffuse},
                     {reflections_library(), &out.reflections},
                     {transparent_library(), &out.transparent},
                     {ray_order_library(), &out.ray_order},
                     {taa_library(), &out.taa}};
  for (const auto& part : parts) {
    if (!part.loaded) return part.loaded.error();
    *part.library = *part.loaded;
  }
  return out;
}

rtapi::Status FrameEffects::create(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                   const Frame& frame, const GpuScene& gpu, const Scene& scene,
                                   const Options& options, const ShaderLibraries& libraries,
                                   const std::function<void(double)>& bake_progress,
                                   const std::atomic<bool>& stop) {
  const Camera& camera = scene.cameras.front();
  given_ = {device, queue, &frame, &gpu, options, &libraries, camera.position()};
  const auto lights = light_constants(scene, camera.position());
  const auto lighting = Lighting::create(device, frame, gpu, libraries.lighting,
                                         static_cast<std::uint32_t>(lights.size()));
  if (!lighting) return lighting.error();
  lighting_ = *lighting;
  if (lights.empty() && !options.keep_local) {
    left_out_.push_back("local lights and contact shadows: the scene has no local light");
  } else if (options.local) {
    const auto direct = DirectLighting::create(device, frame, *lighting_, libraries.direct);
    if (!direct) return direct.error();
    direct_ = *direct;
    contact_ = options.contact;
    if (contact_) {
      if (const auto s = add_contact(); !s) return s;
    }
  }
  if (options.transparent) {
    has_glass_ = std::any_of(scene.instances.begin(), scene.instances.end(),
                             [](const Instance& i) { return (i.mask & kMaskTransparent) != 0; });
    has_glass_ = has_glass_ || options.keep_glass;
    if (!has_glass_) left_out_.push_back("glass: the scene has none");
  }
  // Hits of reflections and of indirect rays read the volume too.
  rtapi::CommandList list = device.CreateCommandList().value();
  lighting_->update(list, frame);
  if (const auto s = queue.ExecuteAndWait(list); !s) return s;
  auto baked = volume(scene, bake_progress, stop);
  if (!baked) return baked.error();
  const auto gpu_volume = GpuVolume::create(device, *baked, camera.position());
  if (!gpu_volume) return gpu_volume.error();
  volume_ = *gpu_volume;
  if (options.gi) {
    if (const auto s = add_indirect(); !s) return s;
  }
  if (options.reflections) {
    if (const auto s = add_reflections(); !s) return s;
  }
  if (has_glass_) {
    if (const auto s = add_transparent(); !s) return s;
  }
  if (options.ao) {
    if (const auto s = add_signal("ao", frame.texture(kAmbientOcclusionSum), options.ao_samples,
                                  options.pixel_step("ao"));
        !s) {
      return s;
    }
  }
  if (options.sun && scene.sun) {
    if (const auto s = add_signal("sun", frame.texture(kSunVisibilitySum), options.sun_samples,
                                  options.pixel_step("sun"));
        !s) {
      return s;
    }
  }
  if (const auto s = create_filters(); !s) return s;
  if (contact_) {
    if (const auto s = direct_->set_contact(*denoised("contact")); !s) return s;
  }
  FrameParts parts;
  parts.sun_visibility = denoised("sun");
  parts.ambient = denoised("ao");
  if (direct_) parts.local_lights = contact_ ? &direct_->total() : &direct_->direct();
  parts.indirect = denoised("indirect");
  parts.reflection = denoised("reflection");
  const auto compose = ComposePass::create(device, frame, libraries.composite, parts);
  if (!compose) return compose.error();
  compose_ = *compose;
  return {};
}

rtapi::Status FrameEffects::add_signal(const std::string& name, const rtapi::Texture& sum,
                                       std::uint32_t samples, std::uint32_t pixel_step) {
  auto signal = std::make_unique<Signal>();
  signal->name = name;
  signal->sum = sum;
  signal->samples = samples;
  signal->pixel_step = pixel_step;
  const auto mean = given_.frame->create_picture(given_.device, name + " mean", kSignalFormat);
  if (!mean) return mean.error();
  signal->mean = *mean;
  signals_.push_back(std::move(signal));
  return {};
}

rtapi::Status FrameEffects::create_filters() {
  DenoiseDesc desc = default_denoise(denoise_method(given_.options.denoise));
  if (const auto passes = given_.options.denoise_passes) {
    desc.iterations = desc.iterations_with_history = *passes;
  }
  std::vector<Signal*> alike;
  for (const auto& signal : signals_) {
    // Only reflections store the distance to their hits.
    if (desc.method == DenoiseMethod::kControl && signal->name == "reflection") {
      DenoiseDesc of_lobes = desc;
      of_lobes.constants.lobe_scale = 1;
      if (const auto s = create_filter(of_lobes, {signal.get()}); !s) return s;
    } else {
      alike.push_back(signal.get());
    }
  }
  return alike.empty() ? rtapi::Status{} : create_filter(desc, alike);
}

rtapi::Status FrameEffects::create_filter(const DenoiseDesc& desc,
                                          const std::vector<Signal*>& signals) {
  const Frame& frame = *given_.frame;
  const DenoiseLibraries& libraries = given_.libraries->denoise;
  SignalFilter filter;
  filter.name = signals.size() == 1 ? "denoise " + signals[0]->name
                                    : "denoise " + std::to_string(signals.size()) + " signals";
  std::vector<Denoiser::Signal> inputs;
  for (Signal* signal : signals) {
    signal->filter = filters_.size();
    signal->index = inputs.size();
    inputs.push_back({signal->name, signal->mean, signal->name == "reflection"});
    filter.signals.push_back(signal);
  }
  auto denoiser = Denoiser::create(given_.device, frame, libraries, inputs, desc);
  if (!denoiser) return denoiser.error();
  filter.denoiser = std::move(*denoiser);
  for (const Signal* signal : signals) {
    const auto s = filter.denoiser.create_load(given_.device, frame, libraries, signal->sum,
                                               signal->pixel_step, signal->index);
    if (!s) return s;
  }
  filters_.push_back(std::move(filter));
  return {};
}

rtapi::Status FrameEffects::add_contact() {
  const auto sum = given_.frame->create_picture(given_.device, "contact sum", kSignalFormat);
  if (!sum) return sum.error();
  const auto views = given_.frame->create_pass_views(given_.device);
  if (!views) return views.error();
  contact_views_ = *views;
  if (const auto s = contact_views_.set_unordered_access(0, direct_->strongest()); !s) return s;
  if (const auto s = contact_views_.set_unordered_access(1, *sum); !s) return s;
  ContactShadowConstants constants;
  constants.length = given_.options.contact_length;
  steps_.push_back({contact_shadow_pass(given_.libraries->contact_shadow),
                    given_.options.contact_samples,
                    PassArguments(contact_views_, constants),
                    {},
                    given_.options.pixel_step("contact")});
  return add_signal("contact", *sum, given_.options.contact_samples, steps_.back().pixel_step);
}

rtapi::Status FrameEffects::add_indirect() {
  const auto sum = given_.frame->create_picture(given_.device, "indirect sum", kSignalFormat);
  if (!sum) return sum.error();
  const auto views = given_.frame->create_pass_views(given_.device);
  if (!views) return views.error();
  indirect_views_ = *views;
  if (const auto s = indirect_views_.set_unordered_access(0, *sum); !s) return s;
  if (const auto s = lighting_->bind(indirect_views_); !s) return s;
  if (const auto s = volume_.bind(indirect_views_); !s) return s;
  IndirectConstants constants;
  const std::string& mode = given_.options.gi_mode;
  constants.mode = mode == "direct"              ? IndirectMode::kDirect
                   : mode == "hit-black"         ? IndirectMode::kHitBlack
                   : mode == "near-field-glossy" ? IndirectMode::kNearFieldGlossy
                                                 : IndirectMode::kNearField;
  steps_.push_back({indirect_diffuse_pass(given_.libraries->indirect_diffuse),
                    given_.options.gi_samples,
                    PassArguments(indirect_views_, constants),
                    {},
                    given_.options.pixel_step("gi")});
  return add_signal("indirect", *sum, given_.options.gi_samples, steps_.back().pixel_step);
}

rtapi::Status FrameEffects::add_reflections() {
  const auto sum = given_.frame->create_picture(given_.device, "reflection sum", kSignalFormat);
  if (!sum) return sum.error();
  const auto views = given_.frame->create_pass_views(given_.device);
  if (!views) return views.error();
  reflection_views_ = *views;
  if (const auto s = reflection_views_.set_unordered_access(0, *sum); !s) return s;
  if (const auto s = lighting_->bind(reflection_views_); !s) return s;
  if (const auto s = volume_.bind(reflection_views_); !s) return s;
  ReflectionConstants constants;
  constants.firefly_limit = given_.options.firefly_limit;
  steps_.push_back({reflections_pass(given_.libraries->reflections),
                    given_.options.reflection_samples,
                    PassArguments(reflection_views_, constants),
                    {},
                    given_.options.pixel_step("reflections")});
  return add_signal("reflection", *sum, given_.options.reflection_samples,
                    steps_.back().pixel_step);
}

// One ray per pixel without noise, so there is nothing to denoise.
rtapi::Status FrameEffects::add_transparent() {
  const Frame& frame = *given_.frame;
  const auto glass = frame.create_picture(given_.device, "glass", kSignalFormat);
  if (!glass) return glass.error();
  glass_ = *glass;
  const auto transmittance = frame.create_picture(given_.device, "transmittance", kSignalFormat);
  if (!transmittance) return transmittance.error();
  transmittance_ = *transmittance;
  const auto views = frame.create_pass_views(given_.device);
  if (!views) return views.error();
  glass_views_ = *views;
  if (const auto s = glass_views_.set_unordered_access(0, glass_); !s) return s;
  if (const auto s = glass_views_.set_unordered_access(1, transmittance_); !s) return s;
  if (const auto s = lighting_->bind(glass_views_); !s) return s;
  if (const auto s = volume_.bind(glass_views_); !s) return s;
  const auto compose =
      transparent_compose_pass(given_.device, frame, given_.libraries->transparent);
  if (!compose) return compose.error();
  glass_compose_ = *compose;
  steps_.push_back({transparent_pass(given_.libraries->transparent), 1,
                    PassArguments(glass_views_, deck_layers(given_.options.glass_layers))});
  return {};
}

rtapi::Result<IndirectVolume> FrameEffects::volume(const Scene& scene,
                                                   const std::function<void(double)>& bake_progress,
                                                   const std::atomic<bool>& stop) {
  const Options& options = given_.options;
  if (!options.gi && !options.reflections && !has_glass_) {
    left_out_.push_back("the volume of indirect light: no effect reads it");
    return IndirectVolume{};
  }
  if (!options.gi_volume.empty() && std::filesystem::exists(options.gi_volume)) {
    auto loaded = load_volume(options.gi_volume);
    if (!loaded.ok()) return failure(loaded.error());
    return std::move(loaded.value());
  }
  auto laid_out = layout_volume(scene, options.gi_cell);
  if (!laid_out.ok()) return failure(laid_out.error());
  if (const float cell = laid_out.value().cell; !options.gi_cell && cell != kVolumeCell) {
    std::ostringstream text;
    text << "cells of " << kVolumeCell << " m in the volume of indirect light: the scene is large, "
         << laid_out.value().cells.size() << " cells of " << cell << " m bake faster (--gi-cell "
         << kVolumeCell << ")";
    left_out_.push_back(text.str());
  }
  BakeDesc desc;
  desc.samples = options.gi_bake_samples;
  desc.seed = options.seed;
  if (const auto baked = bake_volume(given_.device, given_.queue, *given_.frame, *given_.gpu,
                                     *lighting_, given_.origin, given_.libraries->volume_bake, desc,
                                     laid_out.value(), bake_progress, stop);
      !baked) {
    return baked.error();
  }
  if (!options.gi_volume.empty()) {
    if (const auto saved = save_volume(options.gi_volume, laid_out.value()); !saved.ok()) {
      return failure(saved.error());
    }
  }
  return std::move(laid_out.value());
}

const rtapi::Texture* FrameEffects::denoised(const std::string& name) const {
  for (const auto& signal : signals_) {
    if (signal->name == name) return &result(*signal);
  }
  return nullptr;
}

std::vector<FrameEffects::SignalPictures> FrameEffects::signals() const {
  std::vector<SignalPictures> out;
  for (const auto& signal : signals_) {
    out.push_back({signal->name, signal->mean, result(*signal)});
  }
  return out;
}

void FrameEffects::begin_frame(const glm::dvec3& origin, bool cut) {
  volume_.set_origin(origin);
  if (!cut) return;
  for (SignalFilter& filter : filters_) filter.denoiser.reset();
}

void FrameEffects::light(rtapi::CommandList& list, const Frame& frame) const {
  lighting_->update(list, frame);
  if (direct_) direct_->dispatch(list, frame, contact_);
}

std::vector<FrameEffects::Filter> FrameEffects::filters(const Frame& frame) {
  std::vector<Filter> out;
  for (SignalFilter& filter : filters_) {
    out.push_back({filter.name,
                   [&frame, &filter](rtapi::CommandList& list) {
                     for (const Signal* signal : filter.signals) {
                       filter.denoiser.load(list, frame, 1.0f / static_cast<float>(signal->samples),
                                            signal->index);
                     }
                     filter.denoiser.dispatch(list, frame);
                   },
                   filter.denoiser.bytes()});
  }
  return out;
}

void FrameEffects::compose(rtapi::CommandList& list, const Frame& frame) const {
  if (contact_) direct_->add_strongest(list, frame);
  compose_->dispatch(list, frame);
  if (has_glass_) {
    glass_compose_.dispatch(list, frame, {}, PassArguments(glass_views_), frame.width(),
                            frame.height());
  }
}

std::uint64_t FrameEffects::light_bytes() const {
  return direct_ ? direct_->bytes() : lighting_->bytes();
}

std::uint64_t FrameEffects::compose_bytes() const {
  return compose_->bytes() + picture_bytes(glass_) + picture_bytes(transmittance_);
}

std::vector<FrameEffects::Layer> FrameEffects::layers() const {
  std::vector<Layer> out;
  for (const auto& signal : signals_) {
    // Every frame already has the raw sums of ambient occlusion and the sun as layers.
    if (signal->sum.GetDesc().Format == kSignalFormat) {
      const bool half = signal->pixel_step != 1;  // the sum has gaps
      out.push_back({signal->name, half ? signal->mean : signal->sum,
                     half ? 1.0f : 1.0f / static_cast<float>(signal->samples)});
    }
    out.push_back({signal->name + "_denoised", result(*signal), 1});
  }
  if (has_glass_) {
    out.push_back({"glass", glass_, 1});
    out.push_back({"glass_transmittance", transmittance_, 1});
  }
  if (direct_) {
    out.push_back({"local_lights", contact_ ? direct_->total() : direct_->direct(), 1});
  }
  return out;
}

}  // namespace northlight
