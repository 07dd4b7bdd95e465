// SPDX-License-Identifier: MIT
// Indirect light by rays, and what came before near-field rays: the volume times occlusion.
// [GDC 2018 talk; Northlight deck: Indirect Diffuse Illumination]
#include "effects/indirect/rows.h"

#include <utility>

#include "effects/engine/effect_pass.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/indirect/indirect_diffuse/occluded_volume.h"
#include "effects/indirect/settings.h"

namespace kaamos::effects {

namespace {

constexpr const char* kOccludedVolume = "indirect/indirect_diffuse/occluded_volume";
constexpr const char* kOcclusion = "occlusion/screen_space_ao/gtao";
constexpr const char* kOcclusionFilter = "occlusion/screen_space_ao/occlusion_filter";

class OccludedVolumePass : public EffectPass {
 public:
  OccludedVolumePass(const Frame& frame, OccludedVolume passes)
      : frame_(frame), passes_(std::move(passes)) {}
  static rtapi::Result<std::unique_ptr<EffectPass>> make(const EffectScope& scope) {
    auto passes =
        OccludedVolume::create(scope.device, scope.frame, scope.library(kOccludedVolume),
                               scope.library(kOcclusion), scope.library(kOcclusionFilter),
                               scope.views, scope.settings.get_constants<OccludedVolumeSettings>());
    if (!passes) return passes.error();
    return std::unique_ptr<EffectPass>(
        std::make_unique<OccludedVolumePass>(scope.frame, std::move(*passes)));
  }
  rtapi::Status begin_frame(const Camera&) override { return passes_.begin_frame(); }
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    passes_.record(list, frame_, constants, settings.get_constants<OccludedVolumeSettings>());
  }
  std::uint64_t bytes() const override { return passes_.bytes(); }

 private:
  const Frame& frame_;
  OccludedVolume passes_;
};

Effect indirect_row(const char* name, const char* about, const char* layer, bool is_sum) {
  Effect row = {.name = name, .about = about};
  row.signals = {
      {.name = layer, .is_sum = is_sum, .is_light = true, .part = &FrameParts::indirect}};
  row.needs.volume = true;
  row.alternative_to = "gi";
  return row;
}

// By the rays' pass.
Effect ray_occluded_row() {
  Effect row = indirect_row("gi-ray-ao", "the volume x ray traced AO", "indirect_ray_ao",
                            /*is_sum=*/true);
  row.library = {"indirect/indirect_diffuse/indirect_diffuse", indirect_diffuse_library};
  row.pass = indirect_diffuse_pass;
  set_constants(row, IndirectConstants{.mode = IndirectMode::kTimesOpen},
                close_settings(indirect_settings(), {"mode"}));
  row.needs.lights = true;  // where shaders of other modes read them
  row.samples_option = "gi-ray-ao-samples";
  row.repeats = true;
  row.misses = "from which side the open part lets light in, and light from what moves";
  return row;
}

EffectStep occlusion_step(const char* label, const GtaoConstants& occlusion, float radius) {
  return {label, EffectSettings().set_constants(OccludedVolumeSettings{occlusion, radius})};
}

Effect screen_occluded_row() {
  Effect row = indirect_row("gi-screen-ao", "the volume x screen-space AO", "indirect_screen_ao",
                            /*is_sum=*/false);
  row.library = {kOccludedVolume, occluded_volume_library};
  row.more_libraries = {{kOcclusion, gtao_library}, {kOcclusionFilter, occlusion_filter_library}};
  row.make = OccludedVolumePass::make;
  set_constants(row, OccludedVolumeSettings{}, occluded_volume_settings());
  const float far = IndirectConstants().length;
  row.steps = {occlusion_step("GTAO of 0.5 m", {}, kDefaultScreenSpaceRadius),
               occlusion_step("GTAO of 3 m", {}, far),
               occlusion_step("accurate GTAO of 3 m", accurate_gtao(4, 16), far)};
  row.misses =
      "light through thin walls where nothing occludes, colour from things that the volume does "
      "not know, and occluders out of the picture";
  return row;
}

}  // namespace

Effect indirect_diffuse_row() {
  return {
      .name = "gi",
      .about = "indirect diffuse light",
      .library = {"indirect/indirect_diffuse/indirect_diffuse", indirect_diffuse_library},
      .pass = indirect_diffuse_pass,
      .trace = indirect_diffuse_pass,
      .signals = {{.name = "indirect", .is_light = true, .part = &FrameParts::indirect}},
      .defaults = EffectSettings().set_constants(IndirectConstants{}),
      .needs = {.lights = true, .volume = true},
      .constants = describe_constants(indirect_settings()),
      .samples_option = "gi-samples",
      .repeats = true,
      .may_equal = "no surface that rays hit mirrors a lamp or the sun",
  };
}

std::vector<Effect> indirect_alternatives() {
  return {screen_occluded_row(), ray_occluded_row()};
}

}  // namespace kaamos::effects
