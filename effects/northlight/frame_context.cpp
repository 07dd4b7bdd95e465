// SPDX-License-Identifier: MIT
#include "effects/northlight/frame_context.h"

#include <fmt/format.h>

#include <algorithm>

#include "effects/northlight/signal_filters.h"
#include "effects/surfaces/gbuffer/gbuffer.h"

namespace kaamos::effects {

void list_left_out(FrameContext& context) {
  const FrameSettings& settings = context.settings;
  std::vector<std::string>& out = context.left_out;
  if (is_matte(context.scene, settings, context.effects)) {
    out.push_back("reflections: no material is metallic or smoother than " +
                  fmt::format("{:g}", kMatteRoughness) +
                  "; surfaces reflect what reaches them from all sides, unless reflections are "
                  "named");
  }
  for (const Effect& effect : context.effects) {
    const Effect* instead = what_replaces(settings, context.effects, effect);
    if (settings.effects.count(effect.name) == 0 || instead == nullptr ||
        is_rendered(context.scene, settings, context.effects, effect.name)) {
      continue;
    }
    out.push_back(effect.about + ": " + instead->about +
                  " takes its place; its layer is there if \"" + effect.name +
                  "\" is named among the effects");
  }
  const auto shows_glass = [&](const Effect& effect) {
    return effect.needs.glass && is_rendered(context.scene, settings, context.effects, effect.name);
  };
  if (has_glass(context.scene) &&
      std::none_of(context.effects.begin(), context.effects.end(), shows_glass)) {
    out.emplace_back(
        "glass and what else is blended (alphaMode BLEND): no effect that shows it is chosen, such "
        "as \"transparent\"");
  }
  const auto shows_shadows = [&](const Effect& effect) {
    return is_rendered(context.scene, settings, context.effects, effect.name) &&
           std::any_of(effect.signals.begin(), effect.signals.end(),
                       [](const EffectSignal& signal) { return signal.is_visibility; });
  };
  if (!reads_sharpness(settings) &&
      std::any_of(context.effects.begin(), context.effects.end(), shows_shadows)) {
    out.emplace_back("how sharp shadows are: no denoiser reads it");
  }
  if (std::none_of(context.gpu.geometries.begin(), context.gpu.geometries.end(),
                   [](const GpuGeometry& geometry) { return geometry.alpha_tested; })) {
    out.emplace_back("any-hit shaders: nothing is alpha-tested");
  }
  if (context.scene.skins.empty()) out.emplace_back("skinning: the scene has no skin");
}

rtapi::Result<std::vector<std::pair<std::string, RayPass>>> create_ray_passes(
    const FrameContext& context) {
  std::vector<RayPassDesc> descs;
  if (context.settings.primary == Primary::kRays) {
    const auto gbuffer = gbuffer_library();
    if (!gbuffer) return gbuffer.error();
    descs.push_back(gbuffer_pass(*gbuffer));
  }
  for (const Effect& effect : context.effects) {
    if (!effect.pass ||
        !is_rendered(context.scene, context.settings, context.effects, effect.name)) {
      continue;
    }
    const auto library = effect.library.built_in();
    if (!library) return library.error();
    descs.push_back(effect.pass(*library));
  }
  std::vector<std::pair<std::string, RayPass>> out;
  for (const RayPassDesc& desc : descs) {
    const auto pass = RayPass::create(context.device, context.frame, context.gpu, desc);
    if (!pass) return pass.error();
    out.emplace_back(desc.name, *pass);
  }
  return out;
}

}  // namespace kaamos::effects
