// SPDX-License-Identifier: MIT
#include "effects/measure/study/light_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "effects/assets/scene/light_constants.h"
#include "effects/measure/curves/measure.h"
#include "effects/measure/run/effect_runs.h"
#include "effects/shadows/adaptive_shadow/adaptive_shadow.h"
#include "effects/shadows/lamp_shadow/lamp_shadow.h"
#include "effects/shadows/rows.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr const char* kLampShadow = "lamp-shadow";
constexpr std::uint32_t kFullRays = kAdaptiveHighSamples;  // as many as high quality's most
constexpr std::uint32_t kManyRays = 256;                   // of what is taken for right
constexpr std::uint32_t kSettling = 7;  // frames by which adaptive rays have found the penumbras

// The sun's effect and the lamps', with the settings of both; the lamps' say nothing of the lamp.
struct Technique {
  LightTechnique about;
  std::string sun, lamp;
  EffectSettings sun_settings, lamp_settings;
  bool has_history = false;
};

Technique by_map(const char* name, const char* label, const char* sun, LampShadow method) {
  return {{name, label, true},
          sun,
          kLampShadow,
          find_effect(northlight_effects(), sun)->defaults,
          EffectSettings().set_constants(LampShadowConstants{.method = method})};
}

Technique by_rays(const char* name, LampShadow method, std::uint32_t rays) {
  return {{name, fmt::format("{} {}", rays, rays == 1 ? "ray" : "rays")},
          "sun",
          kLampShadow,
          EffectSettings{.samples = rays},
          EffectSettings{.samples = rays}.set_constants(LampShadowConstants{.method = method})};
}

Technique by_adaptive_rays(const char* name, std::uint32_t most) {
  const auto settings = EffectSettings{.samples = most}.set_constants(AdaptiveShadowConstants{});
  return {{name, fmt::format("{} rays at most", most)},
          "adaptive-sun",
          "adaptive-sun",
          settings,
          settings,
          true};
}

const std::vector<Technique>& techniques() {
  static const std::vector<Technique> all = {
      by_map("shadow map, hard", "2048 x 2048; lamps 128 x 128", "sun-map", LampShadow::kMapHard),
      by_rays("rays, hard", LampShadow::kRayHard, 1),
      by_adaptive_rays("rays, soft, standard", kAdaptiveStandardSamples),
      by_adaptive_rays("rays, soft, high", kAdaptiveHighSamples),
      by_map("PCSS", "16 + 32 taps", "sun-pcss", LampShadow::kMapPcss),
      by_map("hybrid", "1 ray and PCSS", "sun-hybrid", LampShadow::kHybrid),
      by_rays("rays, soft, everywhere", LampShadow::kRays, kFullRays)};
  return all;
}

EffectSettings for_lamp(const Technique& technique, std::uint32_t lamp) {
  EffectSettings out = technique.lamp_settings;
  if (technique.lamp == kLampShadow) {
    auto constants = out.get_constants<LampShadowConstants>();
    constants.light = lamp;
    return out.set_constants(constants);
  }
  auto constants = out.get_constants<AdaptiveShadowConstants>();
  constants.light = lamp;
  return out.set_constants(constants);
}

// Places in light_constants of the lamps that are nearest to the camera; none where there are too
// few.
std::vector<std::uint32_t> nearest_lamps(const Scene& scene) {
  const auto lights = light_constants(scene, scene.cameras.front().position());
  std::vector<std::uint32_t> out(lights.size());
  for (std::uint32_t i = 0; i < out.size(); ++i) out[i] = i;
  std::stable_sort(out.begin(), out.end(), [&](std::uint32_t a, std::uint32_t b) {
    return glm::length(lights[a].position) < glm::length(lights[b].position);
  });
  out.resize(out.size() < kLampsBesideTheSun ? 0 : kLampsBesideTheSun);
  return out;
}

double mean_square_difference(const FloatImage& a, const FloatImage& b,
                              const std::vector<std::uint8_t>& mask) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) continue;
    sum += std::pow(a.values[a.channels * i] - b.values[b.channels * i], 2);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

class LightStudy {
 public:
  LightStudy(const Options& options, const Scene& scene, const Progress& progress)
      : options_(options),
        scene_(scene),
        progress_(progress),
        lamps_(nearest_lamps(scene)),
        effects_(northlight_effects()),
        tracks_(techniques().size()) {
    effects_.push_back(lamp_shadow_row());
  }

  rtapi::Result<Outcome> run(Primary primary, LightCosts& costs) {
    if (const auto s = create(primary); !is_done(s)) return s;
    for (std::uint32_t frame = 0; frame < kSettling + options_.repeats; ++frame) {
      const bool counts = frame >= kSettling;
      const auto begun = renderer_->begin_frame({.index = frame,
                                                 .seconds = options_.seconds.value_or(0.0),
                                                 .camera = scene_.cameras.front(),
                                                 .cut = frame == 0});
      if (!begun) return begun.error();
      if (const auto s = run_frame(frame, counts); !s) return s.error();
      const double done = (frame + 1.0) / (kSettling + options_.repeats);
      if (!progress_(
              primary == Primary::kRays ? "lights, traced G-buffer" : "lights, drawn G-buffer",
              done)) {
        return Outcome::kStopped;
      }
    }
    return fill(costs);
  }

 private:
  struct Track {
    std::vector<double> sun_ms, lamps_ms;     // without maps
    double sun_square = 0, lamps_square = 0;  // errors, of the last frame; of the lamps their sum
  };

  rtapi::Result<Outcome> create(Primary primary) {
    Options own = options_;
    own.frame.effects.clear();
    const auto add = [&](const std::string& name) {
      EffectSettings& settings = own.frame.effects[name];
      settings = find_effect(effects_, name)->defaults;
      settings.named = true;
    };
    for (const Technique& technique : techniques()) add(technique.sun);
    if (!lamps_.empty()) add(kLampShadow);
    own.frame.whole_frame = true;
    own.frame.denoise = default_denoise(DenoiseMethod::kNone);
    own.frame.light_maps = LightMaps::kDrawn;
    own.frame.primary = primary;
    const auto device = create_device(own, options_.say);
    if (!device) return device.error();
    auto renderer = FrameRenderer::create(*device, scene_, own.frame, effects_);
    if (!renderer) return renderer.error();
    renderer_ = std::move(*renderer);
    if (options_.cpu_clock) renderer_->runner().set_clock(cpu_clock(options_.threads));
    return renderer_->prepare(
        [&](const std::string& what, double done) { return !progress_ || progress_(what, done); });
  }

  rtapi::Result<double> run_part(const char* part) {
    return renderer_->runner().execute(
        [&](rtapi::CommandList& list) { renderer_->record(list, part, {}); });
  }

  rtapi::Result<FloatImage> look(const std::string& effect, const EffectSettings& settings,
                                 std::uint32_t first_sample, double& ms) {
    const auto ran = renderer_->run(effect, settings, first_sample);
    if (!ran) return ran.error();
    ms = ran->ms;
    return renderer_->read(find_effect(effects_, effect)->signals.front().name);
  }

  // The visibility of all lights by many rays, the sun's first.
  rtapi::Status find_right(std::vector<FloatImage>& right) {
    double ignored = 0;
    auto sun = look("sun", EffectSettings{.samples = kManyRays}, 0, ignored);
    if (!sun) return sun.error();
    right.push_back(std::move(*sun));
    for (const std::uint32_t lamp : lamps_) {
      auto image = look(kLampShadow,
                        EffectSettings{.samples = kManyRays}.set_constants(
                            LampShadowConstants{.light = lamp, .method = LampShadow::kRays}),
                        0, ignored);
      if (!image) return image.error();
      right.push_back(std::move(*image));
    }
    return {};
  }

  rtapi::Status run_frame(std::uint32_t frame, bool counts) {
    // Any run draws the surfaces before the first of them is timed.
    const auto surfaces = run_part("gbuffer");
    if (!surfaces) return surfaces.error();
    const auto maps = run_part("lights");
    if (!maps) return maps.error();
    if (counts) {
      surfaces_ms_.push_back(*surfaces);
      maps_ms_.push_back(*maps);
    }
    const bool is_last = frame + 1 == kSettling + options_.repeats;
    std::vector<FloatImage> right;
    if (is_last) {
      if (const auto s = find_right(right); !s) return s;
      if (const auto s = find_mask(); !s) return s;
    }
    for (std::size_t i = 0; i < techniques().size(); ++i) {
      const Technique& technique = techniques()[i];
      if (!counts && !technique.has_history && frame > 0) continue;  // one run warms it up
      if (const auto s = run_technique(technique, frame, counts, right, tracks_[i]); !s) return s;
    }
    return {};
  }

  rtapi::Status find_mask() {
    const auto ids = renderer_->read(renderer_->frame().texture(kIds));
    if (!ids) return ids.error();
    mask_.resize(std::size_t{ids->width} * ids->height);
    for (std::size_t i = 0; i < mask_.size(); ++i) {
      mask_[i] = ids->values[ids->channels * i] > 0 ? 1 : 0;
    }
    return {};
  }

  // `right`: empty but in the last frame.
  rtapi::Status run_technique(const Technique& technique, std::uint32_t frame, bool counts,
                              const std::vector<FloatImage>& right, Track& track) {
    double ms = 0, lamps_ms = 0;
    const auto first = [&](const EffectSettings& settings) { return frame * settings.samples; };
    const auto sun = look(technique.sun, technique.sun_settings, first(technique.sun_settings), ms);
    if (!sun) return sun.error();
    if (counts) track.sun_ms.push_back(ms);
    if (!right.empty()) track.sun_square = mean_square_difference(*sun, right[0], mask_);
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
      const EffectSettings settings = for_lamp(technique, lamps_[i]);
      const auto lamp = look(technique.lamp, settings, first(settings), ms);
      if (!lamp) return lamp.error();
      lamps_ms += ms;
      if (!right.empty()) {
        track.lamps_square += mean_square_difference(*lamp, right[i + 1], mask_);
      }
    }
    if (counts) track.lamps_ms.push_back(lamps_ms);
    return {};
  }

  Outcome fill(LightCosts& costs) const {
    const auto all_lamps = static_cast<double>(std::max(count_local_lights(scene_), 1u));
    const auto lamps = static_cast<double>(lamps_.size());
    costs.surfaces_ms = median(surfaces_ms_);
    costs.map_ms = median(maps_ms_) / all_lamps;
    costs.lamps = lamps_.size();
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const Track& track = tracks_[i];
      LightCost cost;
      cost.sun_ms = median(track.sun_ms);
      cost.lamps_ms = median(track.lamps_ms);
      if (techniques()[i].about.has_map) cost.lamps_ms += lamps * costs.map_ms;
      cost.sun_error = std::sqrt(track.sun_square);
      cost.all_error = std::sqrt((track.sun_square + track.lamps_square) / (1 + lamps));
      costs.by_technique.push_back(cost);
    }
    return Outcome::kDone;
  }

  const Options& options_;
  const Scene& scene_;
  const Progress& progress_;
  std::vector<std::uint32_t> lamps_;
  std::vector<Effect> effects_;  // those of the registry, and the lamp's
  std::unique_ptr<FrameRenderer> renderer_;
  std::vector<double> surfaces_ms_, maps_ms_;
  std::vector<Track> tracks_;
  std::vector<std::uint8_t> mask_;
};

}  // namespace

const std::vector<LightTechnique>& light_techniques() {
  static const std::vector<LightTechnique> all = [] {
    std::vector<LightTechnique> out;
    for (const Technique& each : techniques()) out.push_back(each.about);
    return out;
  }();
  return all;
}

rtapi::Result<Outcome> measure_lights(const Options& options, const Scene& scene, Primary primary,
                                      const Progress& progress, LightCosts& costs) {
  return LightStudy(options, scene, progress).run(primary, costs);
}

}  // namespace kaamos::measure
