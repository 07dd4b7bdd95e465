// SPDX-License-Identifier: MIT
// Ambient occlusion by rays, and the alternatives to it, as effects of a frame.
#include "effects/occlusion/rows.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "effects/engine/effect_pass.h"
#include "effects/occlusion/ambient_occlusion/ambient_occlusion.h"
#include "effects/occlusion/baked_ao/baked_ao.h"
#include "effects/occlusion/screen_space_ao/line_sweep_ao.h"
#include "effects/occlusion/screen_space_ao/screen_space_ao.h"
#include "effects/occlusion/second_layer/second_layer.h"
#include "effects/occlusion/settings.h"

namespace kaamos::effects {

namespace {

constexpr const char* kFilter = "occlusion/screen_space_ao/occlusion_filter";
constexpr const char* kSecondLayer = "occlusion/second_layer/second_layer";
constexpr const char* kLineSweep = "occlusion/screen_space_ao/line_sweep_ao";

class ScreenSpaceAoPass : public EffectPass {
 public:
  ScreenSpaceAoPass(const Frame& frame, ScreenSpaceAo passes)
      : frame_(frame), passes_(std::move(passes)) {}
  rtapi::Status begin_frame(const Camera&) override { return passes_.begin_frame(); }
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    passes_.record(list, frame_, constants, settings.constants);
  }
  std::uint64_t bytes() const override { return passes_.bytes(); }

 private:
  const Frame& frame_;
  ScreenSpaceAo passes_;
};

// Points in the hemisphere, over two layers of depth.
class LayeredAoPass : public EffectPass {
 public:
  LayeredAoPass(const Frame& frame, SecondLayer layer, ScreenSpaceAo passes)
      : frame_(frame), layer_(std::move(layer)), passes_(std::move(passes)) {}
  rtapi::Status begin_frame(const Camera& camera) override {
    layer_.begin_frame(camera);
    return passes_.begin_frame();
  }
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    const auto own = settings.get_constants<HemisphereConstants>();
    layer_.record(list, own.separation * constants.radius);
    passes_.record(list, frame_, constants, settings.constants);
  }
  std::uint64_t bytes() const override { return layer_.bytes() + passes_.bytes(); }

 private:
  const Frame& frame_;
  SecondLayer layer_;
  ScreenSpaceAo passes_;
};

class LineSweepAoPass : public EffectPass {
 public:
  LineSweepAoPass(const Frame& frame, LineSweepAo passes)
      : frame_(frame), passes_(std::move(passes)) {}
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    passes_.record(list, frame_, constants, settings.get_constants<LineSweepSettings>());
  }
  std::uint64_t bytes() const override { return passes_.bytes(); }

 private:
  const Frame& frame_;
  LineSweepAo passes_;
};

constexpr const char* kOneLayer =
    "what is outside of the picture or behind something; things seem to go on behind what is seen";

// A row whose signal is called `layer`.
Effect occlusion_row(const char* name, const char* about, const char* layer) {
  Effect row = {.name = name, .about = about};
  row.signals = {{.name = layer, .channels = 1, .is_sum = false, .part = &FrameParts::ambient}};
  row.replaced_by = "gi";
  row.alternative_to = "ao";
  row.misses = kOneLayer;
  return row;
}

template <class Constants>
EffectStep step(std::string label, const Constants& constants) {
  EffectStep out{std::move(label), EffectSettings().set_constants(constants)};
  out.settings.radius = kDefaultScreenSpaceRadius;
  return out;
}

// More and more points.
template <class Constants>
std::vector<EffectStep> steps_of_points(Constants constants) {
  std::vector<EffectStep> out;
  for (const std::uint32_t count : {4u, 8u, 16u, 32u, 64u}) {
    constants.samples = count;
    out.push_back(step(fmt::format("{} points", count), constants));
  }
  return out;
}

std::vector<EffectStep> hbao_steps() {
  std::vector<EffectStep> out;
  for (const std::uint32_t count : {3u, 6u, 8u, 16u}) {
    HbaoConstants constants;
    constants.directions = constants.steps = count;
    out.push_back(step(fmt::format("{0} directions, {0} steps", count), constants));
  }
  return out;
}

// XeGTAO's low, medium, high and ultra quality.
std::vector<EffectStep> gtao_steps() {
  std::vector<EffectStep> out;
  for (const auto& [slices, steps] : {std::pair(1u, 2u), {2u, 2u}, {3u, 3u}, {9u, 3u}}) {
    GtaoConstants constants;
    constants.slices = slices;
    constants.steps = steps;
    out.push_back(
        step(fmt::format("{} {}, {} steps", slices, slices == 1 ? "slice" : "slices", steps),
             constants));
  }
  return out;
}

std::vector<EffectStep> accurate_gtao_steps() {
  std::vector<EffectStep> out;
  for (const std::uint32_t slices : {4u, 8u, 16u}) {
    out.push_back(step(fmt::format("{} slices, {} steps", slices, 2 * slices),
                       accurate_gtao(slices, 2 * slices)));
  }
  return out;
}

std::vector<EffectStep> gtao_over_frames_steps() {
  std::vector<EffectStep> out;
  for (const auto& [label, fresh] : {std::pair("no frames before", 1.0f),
                                     {"new frames weigh 1/6", 1.0f / 6},
                                     {"new frames weigh 1/12", 1.0f / 12}}) {
    GtaoConstants constants = gtao_over_frames();
    constants.fresh = fresh;
    out.push_back(step(label, constants));
  }
  return out;
}

std::vector<EffectStep> line_sweep_steps() {
  std::vector<EffectStep> out;
  for (const std::uint32_t count : {4u, 8u, 16u, 32u}) {
    out.push_back(step(fmt::format("lines of {} directions", count), LineSweepSettings{count}));
  }
  return out;
}

template <class Constants>
Effect screen_space_row(const char* name, const char* about, const char* layer,
                        EffectLibrary library, ScreenSpaceAoKind kind, const Constants& constants,
                        const SettingTable<Constants>& table, std::vector<EffectStep> steps) {
  Effect row = occlusion_row(name, about, layer);
  row.steps = std::move(steps);
  row.library = library;
  row.more_libraries = {{kFilter, occlusion_filter_library}};
  row.make = [kind, file = library.file](
                 const EffectScope& scope) -> rtapi::Result<std::unique_ptr<EffectPass>> {
    auto passes =
        ScreenSpaceAo::create(scope.device, scope.frame, kind, scope.library(file),
                              scope.library(kFilter), scope.views, scope.settings.constants);
    if (!passes) return passes.error();
    return std::unique_ptr<EffectPass>(
        std::make_unique<ScreenSpaceAoPass>(scope.frame, std::move(*passes)));
  };
  set_constants(row, constants, table);
  row.defaults.radius = kDefaultScreenSpaceRadius;
  return row;
}

Effect layered_row(const EffectLibrary& library) {
  const HemisphereConstants constants{.layers = 2};
  Effect row =
      screen_space_row("hemisphere-ao-layers", "hemisphere ambient occlusion, two layers of depth",
                       "hemisphere_ao_layers", library, ScreenSpaceAoKind::kHemisphere, constants,
                       hemisphere_settings(), steps_of_points(constants));
  row.more_libraries.push_back({kSecondLayer, second_layer_library});
  row.make = [file = library.file](
                 const EffectScope& scope) -> rtapi::Result<std::unique_ptr<EffectPass>> {
    auto layer = SecondLayer::create(scope, scope.library(kSecondLayer));
    if (!layer) return layer.error();
    auto passes = ScreenSpaceAo::create(scope.device, scope.frame, ScreenSpaceAoKind::kHemisphere,
                                        scope.library(file), scope.library(kFilter), scope.views,
                                        scope.settings.constants);
    if (!passes) return passes.error();
    return std::unique_ptr<EffectPass>(
        std::make_unique<LayeredAoPass>(scope.frame, std::move(*layer), std::move(*passes)));
  };
  row.may_equal = "nothing stands before a crease, so that the second layer hides nothing";
  row.misses = "what is outside of the picture, or behind two things";
  return row;
}

// Those of a row that only makes visibility.
SettingTable<GtaoConstants> gtao_settings_without_bend() {
  return close_settings(gtao_settings(), {"bent-normals"});
}

Effect gtao_row(const char* name, const char* about, const char* layer,
                const GtaoConstants& constants, std::vector<EffectStep> steps) {
  return screen_space_row(name, about, layer, {"occlusion/screen_space_ao/gtao", gtao_library},
                          ScreenSpaceAoKind::kGtao, constants, gtao_settings_without_bend(),
                          std::move(steps));
}

Effect gtao_over_frames_row() {
  Effect row = gtao_row("gtao-frames", "ground-truth ambient occlusion, few directions over frames",
                        "gtao_frames", gtao_over_frames(), gtao_over_frames_steps());
  row.has_history = true;
  row.misses = fmt::format("{}; for some frames what moves", kOneLayer);
  return row;
}

Effect gtao_bent_row() {
  GtaoConstants constants;
  constants.bent_normals = 1;
  std::vector<EffectStep> steps = gtao_steps();
  for (EffectStep& each : steps) {
    auto bent = each.settings.get_constants<GtaoConstants>();
    bent.bent_normals = 1;
    each.settings.set_constants(bent);
  }
  Effect row = gtao_row("gtao-bent", "ground-truth ambient occlusion, sky from where it is open",
                        "gtao_bent", constants, std::move(steps));
  row.signals.push_back(
      {.name = "gtao_bent_normal", .output = 3, .is_sum = false, .part = &FrameParts::bent_normal});
  return row;
}

Effect line_sweep_row() {
  Effect row = occlusion_row("line-sweep-ao", "line-sweep ambient occlusion", "line_sweep_ao");
  row.needs.perspective = true;
  row.steps = line_sweep_steps();
  row.library = {kLineSweep, line_sweep_ao_library};
  row.make = [](const EffectScope& scope) -> rtapi::Result<std::unique_ptr<EffectPass>> {
    auto passes =
        LineSweepAo::create(scope.device, scope.frame, scope.library(kLineSweep), scope.views);
    if (!passes) return passes.error();
    return std::unique_ptr<EffectPass>(
        std::make_unique<LineSweepAoPass>(scope.frame, std::move(*passes)));
  };
  set_constants(row, LineSweepSettings{}, line_sweep_settings());
  row.defaults.radius = kDefaultScreenSpaceRadius;
  return row;
}

Effect uniform_row() {
  return {.name = "ao-uniform",
          .about = "ambient occlusion by uniform rays",
          .library = {"occlusion/ambient_occlusion/ambient_occlusion", ambient_occlusion_library},
          .pass = uniform_ambient_occlusion_pass,
          .signals = {{.name = "ao_uniform", .channels = 1, .part = &FrameParts::ambient}},
          .defaults = EffectSettings{.samples = kDefaultAmbientOcclusionSamples,
                                     .radius = kDefaultAmbientOcclusionRadius}
                          .set_constants(UniformOcclusionConstants{}),
          .replaced_by = "gi",
          .alternative_to = "ao",
          .constants = describe_constants(uniform_occlusion_settings()),
          .samples_option = "ao-uniform-samples",
          .repeats = true};
}

std::vector<EffectStep> baked_steps() {
  std::vector<EffectStep> out;
  for (const float texel : {0.4f, 0.2f, 0.1f}) {
    EffectStep& each = out.emplace_back(
        step(fmt::format("texels of {:g} m", texel), BakedAoConstants{.texel = texel}));
    each.settings.radius = kDefaultAmbientOcclusionRadius;
  }
  return out;
}

Effect baked_row() {
  Effect row = occlusion_row("baked-ao", "ambient occlusion baked into texels", "baked_ao");
  row.steps = baked_steps();
  row.library = {"occlusion/baked_ao/baked_ao", baked_ao_library};
  row.make = make_baked_ao;
  set_constants(row, BakedAoConstants{}, baked_ao_settings());
  row.defaults.radius = kDefaultAmbientOcclusionRadius;
  row.may_equal = "a triangle has 1,024 texels along an edge at most, and a scene so many in all";
  row.misses = "what moves; normal maps; what is smaller than a texel";
  return row;
}

}  // namespace

Effect ambient_occlusion_row() {
  return {
      .name = "ao",
      .about = "ambient occlusion",
      .library = {"occlusion/ambient_occlusion/ambient_occlusion", ambient_occlusion_library},
      .pass = ambient_occlusion_pass,
      .signals = {{.name = "ao",
                   .channels = 1,
                   .format = rtapi::Format::kR32Float,
                   .part = &FrameParts::ambient}},
      .defaults = {.samples = kDefaultAmbientOcclusionSamples,
                   .radius = kDefaultAmbientOcclusionRadius},
      .replaced_by = "gi",
      .samples_option = "ao-samples",
      .is_plain = true,
      .repeats = true,
  };
}

std::vector<Effect> occlusion_alternatives() {
  const EffectLibrary crytek = {"occlusion/screen_space_ao/crytek_ao", crytek_ao_library};
  const EffectLibrary hemisphere = {"occlusion/screen_space_ao/hemisphere_ao",
                                    hemisphere_ao_library};
  const EffectLibrary hbao = {"occlusion/screen_space_ao/hbao", hbao_library};
  return {
      screen_space_row("crytek-ao", "Crytek's ambient occlusion", "crytek_ao", crytek,
                       ScreenSpaceAoKind::kCrytek, CrytekConstants{}, crytek_settings(),
                       steps_of_points(CrytekConstants{})),
      screen_space_row("crytek-ao-remapped", "Crytek's ambient occlusion, open walls white",
                       "crytek_ao_remapped", crytek, ScreenSpaceAoKind::kCrytek,
                       CrytekConstants{.remap = 1}, crytek_settings(),
                       steps_of_points(CrytekConstants{.remap = 1})),
      screen_space_row("hemisphere-ao", "hemisphere ambient occlusion", "hemisphere_ao", hemisphere,
                       ScreenSpaceAoKind::kHemisphere, HemisphereConstants{},
                       close_settings(hemisphere_settings(), {"separation"}),
                       steps_of_points(HemisphereConstants{})),
      layered_row(hemisphere),
      screen_space_row("hbao", "horizon-based ambient occlusion", "hbao", hbao,
                       ScreenSpaceAoKind::kHbao, HbaoConstants{}, hbao_settings(), hbao_steps()),
      gtao_row("gtao", "ground-truth ambient occlusion", "gtao", GtaoConstants{}, gtao_steps()),
      gtao_row("gtao-accurate", "ground-truth ambient occlusion, accuracy mode", "gtao_accurate",
               accurate_gtao(16, 32), accurate_gtao_steps()),
      gtao_over_frames_row(),
      gtao_bent_row(),
      line_sweep_row(),
      baked_row(),
      uniform_row()};
}

}  // namespace kaamos::effects
