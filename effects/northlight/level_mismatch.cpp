// SPDX-License-Identifier: MIT
#include "effects/northlight/level_mismatch.h"

#include <utility>

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

namespace {

constexpr const char* kSun = "sun";

rtapi::Result<FloatImage> sun_through(FrameRenderer& renderer, std::uint32_t coarser_rays) {
  const auto s = renderer.scene_stage().set_coarser_rays(coarser_rays);
  if (!s) return s.error();
  const auto ran = renderer.run(kSun, renderer.context().settings.effects.at(kSun));
  if (!ran) return ran.error();
  return renderer.read(kSun);
}

}  // namespace

rtapi::Result<LevelMismatch> count_level_mismatch(FrameRenderer& renderer) {
  const FrameSettings& settings = renderer.context().settings;
  if (settings.primary != Primary::kRaster || settings.effects.count(kSun) == 0) {
    return make_error(ErrorId::kFrameRenderer,
                      "levels of detail of rays and draws can be compared in the sun alone: choose "
                      "the effect \"sun\" and set FrameSettings::primary to Primary::kRaster");
  }
  const auto matched = sun_through(renderer, 0);
  if (!matched) return matched.error();
  const auto mismatched = sun_through(renderer, settings.structures.coarser_rays);
  if (!mismatched) return mismatched.error();
  const auto ids = renderer.read("ids");
  if (!ids) return ids.error();
  LevelMismatch out;
  for (std::size_t i = 0; i < matched->values.size() / matched->channels; ++i) {
    const auto instance = static_cast<std::size_t>(ids->values[i * ids->channels]);
    if (instance == 0 || renderer.context().scene.instances[instance - 1].levels.empty()) continue;
    ++out.pixels;
    const bool is_lit = matched->values[i * matched->channels] > 0.5f;
    const bool rays_say = mismatched->values[i * mismatched->channels] > 0.5f;
    if (is_lit) ++out.lit;
    if (is_lit && !rays_say) ++out.false_shadows;
    if (!is_lit && rays_say) ++out.false_light;
  }
  return out;
}

}  // namespace kaamos::effects
