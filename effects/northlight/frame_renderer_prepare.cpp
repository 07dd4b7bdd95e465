// SPDX-License-Identifier: MIT
// What is made before the first frame: scene, pipelines, pictures, the volume of indirect light.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/assets/scene/light_constants.h"
#include "effects/engine/picture.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/surfaces/gbuffer/gbuffer.h"

namespace kaamos::effects {

namespace {

bool has_glass(const Scene& scene) {
  return std::any_of(scene.instances.begin(), scene.instances.end(), [](const Instance& instance) {
    return (instance.mask & kMaskTransparent) != 0;
  });
}

bool is_glossy(const Material& material) {
  const MaterialConstants& constants = material.constants;
  return constants.metallic > 0.0f || constants.roughness < kMatteRoughness ||
         constants.image[kMetallicRoughnessTexture] != kNoTexture;
}

// Of what is shown; glass reflects by itself.
bool has_glossy(const Scene& scene) {
  const auto shows_glossy = [&](std::uint32_t mesh) {
    const auto& geometries = scene.meshes[mesh].geometries;
    return std::any_of(geometries.begin(), geometries.end(), [&](const Geometry& geometry) {
      return is_glossy(scene.materials[geometry.material]);
    });
  };
  return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
    return shows_glossy(instance.mesh) ||
           std::any_of(instance.levels.begin(), instance.levels.end(),
                       [&](const Level& level) { return shows_glossy(level.mesh); });
  });
}

std::uint32_t count_local_lights(const Scene& scene) {
  const glm::dvec3 origin = scene.cameras.front().position();
  return static_cast<std::uint32_t>(light_constants(scene, origin).size());
}

// Brings along what the chosen effects include.
void add_included(std::map<std::string, EffectSettings>& chosen,
                  const std::vector<Effect>& effects) {
  for (const Effect& effect : effects) {
    if (effect.includes.empty() || chosen.count(effect.name) == 0) continue;
    const Effect* included = find_effect(effects, effect.includes);
    if (included != nullptr) chosen.try_emplace(included->name, included->defaults);
  }
}

}  // namespace

std::map<std::string, EffectSettings> choose_effects(const std::vector<std::string>& names,
                                                     const std::vector<Effect>& effects) {
  std::map<std::string, EffectSettings> out;
  for (const std::string& name : names) {
    const Effect* effect = find_effect(effects, name);
    if (effect != nullptr) {
      out[name] = effect->defaults;
      out[name].named = true;
    } else if (name == "all") {
      for (const Effect& each : effects) {
        if (each.alternative_to.empty()) out.try_emplace(each.name, each.defaults);
      }
    } else {
      out[name] = {};
    }
  }
  add_included(out, effects);
  return out;
}

bool scene_offers(const Scene& scene, const EffectNeeds& needs) {
  return (!needs.sun || scene.sun) && (!needs.glass || has_glass(scene)) &&
         (!needs.glossy || has_glossy(scene)) &&
         (!needs.local_lights || count_local_lights(scene) > 0);
}

bool need_whole_frame(const std::map<std::string, EffectSettings>& chosen,
                      const std::vector<Effect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [&](const Effect& effect) {
    return chosen.count(effect.name) != 0 && has_own_pictures(effect);
  });
}

FrameRenderer::FrameRenderer(const rtapi::Device& device, const Scene& scene,
                             const FrameSettings& settings, std::vector<Effect> effects)
    : settings_(settings),
      scene_(scene),
      effects_(std::move(effects)),
      device_(device),
      clock_ms_([] {
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        return std::chrono::duration<double, std::milli>(now).count();
      }) {
  add_included(settings_.effects, effects_);
}

rtapi::Result<std::unique_ptr<FrameRenderer>> FrameRenderer::create(const rtapi::Device& device,
                                                                    const Scene& scene,
                                                                    const FrameSettings& settings,
                                                                    std::vector<Effect> effects) {
  std::unique_ptr<FrameRenderer> out(
      new FrameRenderer(device, scene, settings, std::move(effects)));
  if (const auto s = out->check_settings(); !s) return s.error();
  const auto queue = device.CreateCommandQueue();
  if (!queue) return queue.error();
  out->queue_ = *queue;
  if (const auto s = out->create_scene(); !s) return s.error();
  return out;
}

rtapi::Status FrameRenderer::check_settings() const {
  if (settings_.sun_map > kMaxSunMap) {
    return make_error(ErrorId::kFrameRenderer,
                      "a map of the sun of " + std::to_string(settings_.sun_map) +
                          " texels a side; 0 to " + std::to_string(kMaxSunMap) + " are allowed");
  }
  for (const auto& [name, ignored] : settings_.effects) {
    const Effect* effect = find_effect(effects_, name);
    if (effect == nullptr) {
      return make_error(ErrorId::kFrameRenderer,
                        "there is no effect \"" + name + "\" but " + effect_names(effects_));
    }
    if (!settings_.whole_frame && has_own_pictures(*effect)) {
      return make_error(
          ErrorId::kFrameRenderer,
          "effect \"" + name + "\" has pictures of its own: set FrameSettings::whole_frame");
    }
  }
  return {};
}

rtapi::Status FrameRenderer::create_scene() {
  const Camera& camera = scene_.cameras.front();
  moment_.camera = camera;
  if (settings_.moving || !scene_.skins.empty()) {
    auto manager = StructureManager::create(device_, queue_, scene_);
    if (!manager) return manager.error();
    structures_ = std::move(*manager);
    gpu_ = structures_->scene();
  } else {
    auto gpu = create_gpu_scene(device_, queue_, scene_, camera.position());
    if (!gpu) return gpu.error();
    gpu_ = std::move(*gpu);
  }
  FrameDesc desc;
  desc.width = settings_.width;
  desc.height = settings_.height;
  desc.seed = settings_.seed;
  desc.ray_cones = settings_.ray_cones;
  desc.sun_angular_radius = settings_.sun_angular_radius;
  desc.sun_map = settings_.sun_map;
  desc.max_pass_views = settings_.max_pass_views;
  auto frame = Frame::create(device_, scene_, gpu_, camera, desc);
  if (!frame) return frame.error();
  frame_ = std::move(*frame);
  if (!structures_) return {};
  // What is baked later sees the scene as it is at the beginning.
  const auto begun = begin_frame(moment_);
  has_begun_ = false;
  return begun;
}

void FrameRenderer::set_libraries(ShaderLibraries libraries) {
  libraries_ = std::move(libraries);
  has_own_libraries_ = true;
  is_prepared_ = false;
}

rtapi::Result<Outcome> FrameRenderer::prepare(const Progress& progress) {
  if (is_prepared_) return Outcome::kDone;
  frame_.release_pass_views();  // those of earlier shaders
  filters_ = {};
  gradients_.reset();
  compose_.reset();
  compose_some_.clear();
  compose_unreflected_.reset();
  kept_.reset();
  taa_.reset();
  left_out_.clear();
  set_up_.reset();
  bake_.reset();
  has_surfaces_ = has_effects_ = is_early_done_ = false;
  const std::vector<EffectLibrary> wanted = frame_libraries(settings_, effects_);
  if (!has_own_libraries_) {
    auto loaded = load_libraries(wanted);
    if (!loaded) return loaded.error();
    libraries_ = std::move(*loaded);
  }
  for (const EffectLibrary& library : wanted) {
    if (libraries_.count(library.file) != 0) continue;
    return make_error(ErrorId::kLibraries,
                      "the frame needs the shader library \"" + library.file +
                          "\": hand all of frame_libraries() to set_libraries");
  }
  if (settings_.order != RayOrder::kPixels) {
    auto sorter = RaySorter::create(device_, frame_, libraries_.at("surfaces/ray_order/ray_order"));
    if (!sorter) return sorter.error();
    sorter_ = std::move(*sorter);
  }
  if (const auto s = create_gbuffer(); !s) return s.error();
  find_active();
  if (settings_.whole_frame) {
    const double start = clock_ms_();
    if (const auto done = prepare_whole(progress); !is_done(done)) return done;
    set_up_ = {"set-up and bake", clock_ms_() - start, device_.GetStatistics()};
  } else {
    const auto composite =
        CompositePass::create(device_, frame_, libraries_.at("composition/composite/composite"));
    if (!composite) return composite.error();
    composite_ = *composite;
    for (const auto& effect : active_) {
      if (const auto s = create_effect(*effect); !s) return s.error();
    }
  }
  if (settings_.taa) {
    const auto taa =
        TemporalAntialiasing::create(device_, frame_, libraries_.at("composition/taa/taa"));
    if (!taa) return taa.error();
    taa_ = *taa;
  }
  list_left_out();
  is_prepared_ = true;
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::prepare_whole(const Progress& progress) {
  if (const auto s = create_lighting(); !s) return s.error();
  if (const auto s = create_volume(progress); !is_done(s)) return s;
  if (const auto s = create_radiance(); !s) return s.error();
  for (const auto& effect : active_) {
    if (const auto s = create_effect(*effect); !s) return s.error();
  }
  if (const auto s = create_gradients(); !s) return s.error();
  if (const auto s = create_filters(); !s) return s.error();
  if (const auto s = create_compose(); !s) return s.error();
  return Outcome::kDone;
}

rtapi::Status FrameRenderer::create_lighting() {
  const std::uint32_t lights = count_local_lights(scene_);
  const auto lighting =
      Lighting::create(device_, frame_, gpu_, libraries_.at("light/lights/lighting"), lights);
  if (!lighting) return lighting.error();
  lighting_ = *lighting;
  if (settings_.light_maps == LightMaps::kDrawn) {
    const auto s = lighting_->draw_maps(device_, frame_, scene_, gpu_,
                                        libraries_.at("light/lights/light_map_draws"));
    if (!s) return s;
  }
  lighting_->see(moment_.camera.position());
  direct_.reset();
  const bool has_main_lighting = std::any_of(
      active_.begin(), active_.end(), [](const auto& effect) { return !has_passes(*effect->row); });
  if (has_main_lighting) {
    const auto direct =
        DirectLighting::create(device_, frame_, *lighting_, libraries_.at("light/direct/direct"));
    if (!direct) return direct.error();
    direct_ = *direct;
  } else if (lights == 0) {
    left_out_.push_back("local lights and contact shadows: the scene has no local light");
  }
  for (const Effect& effect : effects_) {
    if (effect.needs.glass && settings_.effects.count(effect.name) != 0 &&
        active(effect.name) == nullptr && !has_glass(scene_)) {
      left_out_.push_back(effect.about + ": the scene has none");
    }
  }
  // Baking reads the shadow maps.
  const auto updated = execute([&](rtapi::CommandList& list) { lighting_->update(list, frame_); });
  if (!updated) return updated.error();
  return {};
}

bool FrameRenderer::reads_volume() const {
  return settings_.whole_frame &&
         std::any_of(effects_.begin(), effects_.end(), [&](const Effect& effect) {
           return effect.needs.volume && renders(effect.name);
         });
}

rtapi::Result<Outcome> FrameRenderer::create_volume(const Progress& progress) {
  const VolumeSettings& wanted = settings_.volume;
  IndirectVolume volume;
  if (!reads_volume()) {
    left_out_.push_back("the volume of indirect light: no effect reads it");
  } else if (wanted.given) {
    volume = *wanted.given;
  } else if (!wanted.file.empty() && std::filesystem::exists(wanted.file)) {
    auto loaded = load_volume(wanted.file);
    if (!loaded.ok()) return loaded.error();
    volume = std::move(loaded.value());
  } else if (const auto baked = bake_indirect(volume, progress); !is_done(baked)) {
    return baked;
  }
  const glm::dvec3 origin = moment_.camera.position();
  const auto uploaded = GpuVolume::create(device_, volume, origin);
  if (!uploaded) return uploaded.error();
  gpu_volume_ = *uploaded;
  const auto none = GpuVolume::create(device_, {}, origin);
  if (!none) return none.error();
  no_volume_ = *none;
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::bake_indirect(IndirectVolume& volume,
                                                    const Progress& progress) {
  const VolumeSettings& wanted = settings_.volume;
  auto laid_out = layout_volume(scene_, wanted.cell);
  if (!laid_out.ok()) return laid_out.error();
  volume = std::move(laid_out.value());
  if (!wanted.cell && volume.cell != kVolumeCell) {
    std::ostringstream text;
    text << "cells of " << kVolumeCell << " m in the volume of indirect light: the scene is large, "
         << volume.cells.size() << " cells of " << volume.cell << " m bake faster (--gi-cell "
         << kVolumeCell << ")";
    left_out_.push_back(text.str());
  }
  const BakeDesc desc = {wanted.samples, wanted.error, wanted.bounces,
                         wanted.seed.value_or(settings_.seed), wanted.lights};
  bake_.emplace();
  const auto step = [&](double done) { return !progress || progress("indirect light", done); };
  const auto baked = bake_volume(
      device_, queue_, frame_, gpu_, scene_, *lighting_, moment_.camera.position(),
      libraries_.at("indirect/indirect_diffuse/volume_bake"), desc, volume, &*bake_, step);
  if (!is_done(baked) || wanted.file.empty()) return baked;
  if (const auto saved = save_volume(wanted.file, volume); !saved.ok()) {
    return saved.error();
  }
  return Outcome::kDone;
}

rtapi::Status FrameRenderer::add_signal(SignalFilters& to, const Active& effect,
                                        std::size_t index) const {
  const EffectSignal& signal = effect.row->signals[index];
  SignalSums sums = {effect.pictures[index], effect.sharpness[index], {}, is_late(effect), {}};
  if (effect.row->needs.strongest_lights) sums.lights = direct_->strongest();
  if (effect.gradient && index == 0) sums.changes = {gradients_->changes(), *effect.gradient};
  return to.add(device_, frame_, signal, sums, effect.settings);
}

rtapi::Status FrameRenderer::add_signal(SignalFilters& to, const std::string& name) const {
  for (const auto& effect : active_) {
    for (std::size_t i = 0; i < effect->pictures.size(); ++i) {
      if (effect->row->signals[i].name == name) return add_signal(to, *effect, i);
    }
  }
  return make_error(ErrorId::kFrameRenderer, "the frame has no signal \"" + name + "\"");
}

rtapi::Status FrameRenderer::create_filters() {
  for (const auto& effect : active_) {
    for (std::size_t i = 0; i < effect->pictures.size(); ++i) {
      if (!effect->row->signals[i].is_sum) continue;
      if (const auto s = add_signal(filters_, *effect, i); !s) return s;
    }
  }
  return filters_.create(device_, frame_, denoise_libraries(libraries_), settings_.denoise);
}

rtapi::Status FrameRenderer::create_compose() {
  FrameParts parts;
  for (const auto& effect : active_) {
    // Of several, the last one stays: alternatives stand behind what they are alternatives to.
    if (effect->row->needs.strongest_lights) {
      if (const auto s = direct_->set_contact(*composed(*effect, 0)); !s) return s;
    }
    for (std::size_t i = 0; i < effect->row->signals.size(); ++i) {
      const EffectSignal& signal = effect->row->signals[i];
      if (signal.part == nullptr) continue;
      parts.*signal.part = composed(*effect, i);
    }
  }
  parts.is_matte = is_matte();
  const auto compose =
      ComposePass::create(device_, frame_, libraries_.at("composition/composite/composite"), parts);
  if (!compose) return compose.error();
  compose_ = *compose;
  if (!kept_) return {};
  parts.reflection = nullptr;
  const auto unreflected =
      ComposePass::create(device_, frame_, libraries_.at("composition/composite/composite"), parts);
  if (!unreflected) return unreflected.error();
  compose_unreflected_ = *unreflected;
  return {};
}

// Whether reflections are chosen, and left out because nothing shows them.
bool FrameRenderer::is_matte() const {
  return std::any_of(effects_.begin(), effects_.end(), [&](const Effect& effect) {
    return effect.needs.glossy && settings_.effects.count(effect.name) != 0 &&
           active(effect.name) == nullptr && what_replaces(effect) == nullptr;
  });
}

void FrameRenderer::list_left_out() {
  if (is_matte()) {
    left_out_.push_back(
        "reflections: no material is metallic or smoother than " +
        fmt::format("{:g}", kMatteRoughness) +
        "; surfaces reflect what reaches them from all sides, unless reflections are named");
  }
  for (const Effect& effect : effects_) {
    const auto chosen = settings_.effects.find(effect.name);
    const Effect* instead = what_replaces(effect);
    if (chosen == settings_.effects.end() || instead == nullptr || active(effect.name)) continue;
    left_out_.push_back(effect.about + ": " + instead->about +
                        " takes its place; its layer is there if \"" + effect.name +
                        "\" is named among the effects");
  }
  if (std::none_of(gpu_.geometries.begin(), gpu_.geometries.end(),
                   [](const GpuGeometry& geometry) { return geometry.alpha_tested; })) {
    left_out_.push_back("any-hit shaders: nothing is alpha-tested");
  }
  if (scene_.skins.empty()) left_out_.push_back("skinning: the scene has no skin");
}

rtapi::Result<std::vector<std::pair<std::string, RayPass>>> FrameRenderer::ray_passes() const {
  std::vector<RayPassDesc> descs;
  if (settings_.primary == Primary::kRays) {
    const auto gbuffer = gbuffer_library();
    if (!gbuffer) return gbuffer.error();
    descs.push_back(gbuffer_pass(*gbuffer));
  }
  for (const Effect& effect : effects_) {
    const auto chosen = settings_.effects.find(effect.name);
    if (chosen == settings_.effects.end() || !effect.pass) continue;
    if (!is_of_use(effect, chosen->second)) continue;
    const auto library = effect.library.built_in();
    if (!library) return library.error();
    descs.push_back(effect.pass(*library));
  }
  std::vector<std::pair<std::string, RayPass>> out;
  for (const RayPassDesc& desc : descs) {
    const auto pass = RayPass::create(device_, frame_, gpu_, desc);
    if (!pass) return pass.error();
    out.emplace_back(desc.name, *pass);
  }
  return out;
}

}  // namespace kaamos::effects
