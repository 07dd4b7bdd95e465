// SPDX-License-Identifier: MIT
// Ambient occlusion from the depth picture, as effects of a frame.
#include <utility>

#include "effects/northlight/effect_pass.h"
#include "effects/northlight/techniques.h"
#include "effects/screen_space_ao/line_sweep_ao.h"
#include "effects/screen_space_ao/screen_space_ao.h"

namespace kaamos::effects {

namespace {

constexpr const char* kFilter = "screen_space_ao/occlusion_filter";
constexpr const char* kLineSweep = "screen_space_ao/line_sweep_ao";

class ScreenSpaceAoPass : public EffectPass {
 public:
  ScreenSpaceAoPass(const Frame& frame, ScreenSpaceAo passes)
      : frame_(frame), passes_(std::move(passes)) {}
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    passes_.record(list, frame_, constants, settings.constants);
  }
  std::uint64_t bytes() const override { return passes_.bytes(); }

 private:
  const Frame& frame_;
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
Effect screen_space_row(const char* name, const char* about, const char* layer,
                        EffectLibrary library, ScreenSpaceAoKind kind, const Constants& constants) {
  Effect row = occlusion_row(name, about, layer);
  row.library = library;
  row.more_libraries = {{kFilter, occlusion_filter_library}};
  row.make = [kind, file = library.file](
                 const EffectScope& scope) -> rtapi::Result<std::unique_ptr<EffectPass>> {
    auto passes = ScreenSpaceAo::create(scope.device, scope.frame, kind, scope.library(file),
                                        scope.library(kFilter), scope.views);
    if (!passes) return passes.error();
    return std::unique_ptr<EffectPass>(
        std::make_unique<ScreenSpaceAoPass>(scope.frame, std::move(*passes)));
  };
  row.defaults.set_constants(constants);
  row.defaults.radius = kDefaultScreenSpaceRadius;
  return row;
}

Effect line_sweep_row() {
  Effect row = occlusion_row("line-sweep-ao", "line-sweep ambient occlusion", "line_sweep_ao");
  row.library = {kLineSweep, line_sweep_ao_library};
  row.make = [](const EffectScope& scope) -> rtapi::Result<std::unique_ptr<EffectPass>> {
    auto passes =
        LineSweepAo::create(scope.device, scope.frame, scope.library(kLineSweep), scope.views);
    if (!passes) return passes.error();
    return std::unique_ptr<EffectPass>(
        std::make_unique<LineSweepAoPass>(scope.frame, std::move(*passes)));
  };
  row.defaults.set_constants(LineSweepSettings{});
  row.defaults.radius = kDefaultScreenSpaceRadius;
  return row;
}

}  // namespace

std::vector<Effect> ambient_occlusion_techniques() {
  const EffectLibrary crytek = {"screen_space_ao/crytek_ao", crytek_ao_library};
  const EffectLibrary hemisphere = {"screen_space_ao/hemisphere_ao", hemisphere_ao_library};
  const EffectLibrary hbao = {"screen_space_ao/hbao", hbao_library};
  const EffectLibrary gtao = {"screen_space_ao/gtao", gtao_library};
  return {screen_space_row("crytek-ao", "Crytek's ambient occlusion", "crytek_ao", crytek,
                           ScreenSpaceAoKind::kCrytek, CrytekConstants{}),
          screen_space_row("crytek-ao-remapped", "Crytek's ambient occlusion, open walls white",
                           "crytek_ao_remapped", crytek, ScreenSpaceAoKind::kCrytek,
                           CrytekConstants{.remap = 1}),
          screen_space_row("hemisphere-ao", "hemisphere ambient occlusion", "hemisphere_ao",
                           hemisphere, ScreenSpaceAoKind::kHemisphere, HemisphereConstants{}),
          screen_space_row("hbao", "horizon-based ambient occlusion", "hbao", hbao,
                           ScreenSpaceAoKind::kHbao, HbaoConstants{}),
          screen_space_row("gtao", "ground-truth ambient occlusion", "gtao", gtao,
                           ScreenSpaceAoKind::kGtao, GtaoConstants{}),
          screen_space_row("gtao-accurate", "ground-truth ambient occlusion, accuracy mode",
                           "gtao_accurate", gtao, ScreenSpaceAoKind::kGtao, accurate_gtao(16, 32)),
          line_sweep_row()};
}

}  // namespace kaamos::effects
