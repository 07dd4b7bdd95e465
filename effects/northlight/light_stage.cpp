// SPDX-License-Identifier: MIT
#include "effects/northlight/light_stage.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

namespace kaamos::effects {

template <class Reads>
bool LightStage::any_rendered(Reads reads) const {
  const FrameSettings& settings = context_.settings;
  return std::any_of(context_.effects.begin(), context_.effects.end(), [&](const Effect& effect) {
    return reads(effect.needs) &&
           is_rendered(context_.scene, settings, context_.effects, effect.name);
  });
}

rtapi::Result<Outcome> LightStage::create(const Needs& needs, const Progress& progress) {
  has_main_ = needs.main;
  leaves_out_strongest_ = needs.main && needs.strongest;
  if (const auto s = create_lighting(); !s) return s.error();
  return create_volume(progress);
}

rtapi::Status LightStage::create_lighting() {
  const rtapi::Device& device = context_.device;
  const Frame& frame = context_.frame;
  const ShaderLibraries& libraries = context_.libraries;
  const std::uint32_t lights = count_local_lights(context_.scene);
  reads_lights_ = has_main_ || any_rendered([](const EffectNeeds& needs) {
                    const bool shades = (needs.lights || needs.volume) && !needs.lights_once;
                    return shades || needs.strongest_lights;
                  });
  const bool is_early = reads_early();
  const auto lighting =
      Lighting::create(device, frame, context_.gpu, libraries.at("light/lights/lighting"),
                       reads_lights_ || is_early ? lights : 0);
  if (!lighting) return lighting.error();
  lighting_ = *lighting;
  if (context_.settings.light_maps == LightMaps::kDrawn && (reads_lights_ || is_early)) {
    const auto s = lighting_->draw_maps(device, frame, context_.scene, context_.gpu,
                                        libraries.at("light/lights/light_map_draws"));
    if (!s) return s;
  }
  lighting_->see(context_.moment.camera.position());
  if (has_main_) {
    const auto direct =
        DirectLighting::create(device, frame, *lighting_, libraries.at("light/direct/direct"));
    if (!direct) return direct.error();
    direct_ = *direct;
  }
  list_left_out(lights);
  if (!is_early) return {};
  const auto updated = context_.runner.execute(
      [&](rtapi::CommandList& list) { lighting_->update(list, context_.frame); });
  if (!updated) return updated.error();
  return {};
}

void LightStage::list_left_out(std::uint32_t lights) {
  if (!has_main_ && lights == 0) {
    context_.left_out.push_back("local lights and contact shadows: the scene has no local light");
  }
  if (!reads_lights_ && lights > 0) {
    context_.left_out.push_back(
        reads_early()
            ? "lists and shadow maps of local lights in every frame: they are read once, to bake"
            : "lists and shadow maps of local lights: no effect reads them");
  }
  const FrameSettings& settings = context_.settings;
  for (const Effect& effect : context_.effects) {
    if (effect.needs.glass && settings.effects.count(effect.name) != 0 &&
        !is_rendered(context_.scene, settings, context_.effects, effect.name) &&
        !has_glass(context_.scene)) {
      context_.left_out.push_back(effect.about + ": the scene has none");
    }
  }
}

bool LightStage::reads_early() const {
  if (bakes_volume()) return true;
  return std::any_of(context_.effects.begin(), context_.effects.end(), [&](const Effect& effect) {
    return effect.make && effect.needs.lights &&
           is_rendered(context_.scene, context_.settings, context_.effects, effect.name);
  });
}

bool LightStage::bakes_volume() const {
  const VolumeSettings& wanted = context_.settings.volume;
  return reads_volume() && !wanted.given &&
         (wanted.file.empty() || !std::filesystem::exists(wanted.file));
}

bool LightStage::reads_volume() const {
  return context_.settings.whole_frame &&
         any_rendered([](const EffectNeeds& needs) { return needs.volume; });
}

rtapi::Result<Outcome> LightStage::create_volume(const Progress& progress) {
  const auto step =
      Profile::enter(context_.profile, ProfilePart::kStart, "volume of indirect light");
  const VolumeSettings& wanted = context_.settings.volume;
  IndirectVolume volume;
  if (!reads_volume()) {
    context_.left_out.push_back("the volume of indirect light: no effect reads it");
  } else if (wanted.given) {
    volume = *wanted.given;
  } else if (!wanted.file.empty() && std::filesystem::exists(wanted.file)) {
    auto loaded = load_volume(wanted.file);
    if (!loaded.ok()) return loaded.error();
    volume = std::move(loaded.value());
  } else {
    auto laid_out = lay_out_volume();
    if (!laid_out) return laid_out.error();
    volume = std::move(*laid_out);
    if (wanted.whole || !wanted.file.empty()) {
      if (const auto baked = bake_volume(volume, progress); !is_done(baked)) return baked;
    } else if (!volume.cells.empty()) {
      auto on_demand = VolumeOnDemand::create(bake_scope(), bake_desc(false), std::move(volume));
      if (!on_demand) return on_demand.error();
      on_demand_.emplace(std::move(*on_demand));
    }
  }
  const glm::dvec3 origin = context_.moment.camera.position();
  const auto uploaded = GpuVolume::create(
      context_.device, on_demand_ ? on_demand_->asking() : volume, origin, bakes_on_demand());
  if (!uploaded) return uploaded.error();
  gpu_volume_ = *uploaded;
  const auto none = GpuVolume::create(context_.device, {}, origin);
  if (!none) return none.error();
  no_volume_ = *none;
  has_volume_ = reads_volume();
  return Outcome::kDone;
}

rtapi::Result<IndirectVolume> LightStage::lay_out_volume() {
  const std::optional<float> cell = context_.settings.volume.cell;
  auto volume = layout_volume(context_.scene, cell);
  if (!volume.ok()) return volume.error();
  if (!cell && volume.value().cell != kVolumeCell) {
    std::ostringstream text;
    text << "cells of " << kVolumeCell << " m in the volume of indirect light: the scene is large, "
         << volume.value().cells.size() << " cells of " << volume.value().cell
         << " m bake faster (--gi-cell " << kVolumeCell << ")";
    context_.left_out.push_back(text.str());
  }
  return std::move(volume.value());
}

BakeScope LightStage::bake_scope() const {
  return {context_.device,
          context_.runner.queue(),
          context_.frame,
          context_.gpu,
          context_.scene,
          *lighting_,
          context_.libraries.at("indirect/indirect_diffuse/volume_bake")};
}

BakeDesc LightStage::bake_desc(bool is_whole) const {
  const VolumeSettings& wanted = context_.settings.volume;
  return {is_whole ? wanted.samples : std::min(wanted.samples, kDemandPaths), wanted.error,
          wanted.bounces, wanted.seed.value_or(context_.settings.seed), wanted.lights};
}

rtapi::Result<Outcome> LightStage::bake_volume(IndirectVolume& volume, const Progress& progress) {
  bake_.emplace();
  const auto step = [&](double done) { return !progress || progress("indirect light", done); };
  const auto baked = effects::bake_volume(bake_scope(), context_.moment.camera.position(),
                                          bake_desc(true), volume, &*bake_, step);
  const std::string& file = context_.settings.volume.file;
  if (!is_done(baked) || file.empty()) return baked;
  if (const auto saved = save_volume(file, volume); !saved.ok()) return saved.error();
  return Outcome::kDone;
}

rtapi::Result<Outcome> LightStage::bake_read(bool is_first, const Progress& progress) {
  baked_ = 0;
  const auto reads = gpu_volume_.take_reads(context_.device, context_.runner.queue());
  if (!reads) return reads.error();
  const auto step = [&](double done) { return !progress || progress("indirect light", done); };
  const auto done = on_demand_->bake(*reads, context_.moment.camera.position(), step, baked_);
  if (!is_done(done)) return done;
  if (is_first) {
    gpu_volume_.set_cells(on_demand_->asking());
    is_asking_ = true;
  } else if (is_asking_ || baked_ > 0) {
    const auto known = on_demand_->known();
    if (!known) return known.error();
    gpu_volume_.set_cells(*known);
    is_asking_ = false;
  }
  return Outcome::kDone;
}

std::optional<BakeStatistics> LightStage::bake() const {
  return on_demand_ ? on_demand_->statistics() : bake_;
}

void LightStage::begin_frame() {
  gpu_volume_.set_origin(context_.moment.camera.position());
}

void LightStage::record(rtapi::CommandList& list) {
  lighting_->see(context_.moment.camera.position());
  if (reads_lights_) lighting_->update(list, context_.frame);
  if (direct_) {
    direct_->dispatch(list, context_.frame, leaves_out_strongest_, context_.settings.light_culling);
  }
}

rtapi::Status LightStage::run() {
  if (!reads_lights_) return {};
  const std::uint64_t bytes = direct_ ? direct_->bytes() : lighting_->bytes();
  return context_.runner.run("local lights", bytes, [&](auto& list) { record(list); });
}

void LightStage::record_strongest(rtapi::CommandList& list) const {
  if (leaves_out_strongest_) {
    direct_->add_strongest(list, context_.frame, combination_);
  }
}

}  // namespace kaamos::effects
