// SPDX-License-Identifier: MIT
#include "effects/engine/ray_effect.h"

namespace kaamos::effects {

rtapi::Result<std::unique_ptr<RayEffect>> RayEffect::create(const EffectScope& scope,
                                                            const RayPassDesc& desc,
                                                            bool is_sorted) {
  std::unique_ptr<RayEffect> out(new RayEffect(scope.frame, scope.views));
  const auto pass = RayPass::create(scope.device, scope.frame, scope.gpu, desc);
  if (!pass) return pass.error();
  out->pass_ = *pass;
  if (is_sorted && !desc.key_generation.empty()) {
    const auto keys = RayPass::create(scope.device, scope.frame, scope.gpu, key_pass(desc));
    if (!keys) return keys.error();
    out->keys_ = *keys;
  }
  return out;
}

void RayEffect::record(rtapi::CommandList& list, const EffectSettings& settings,
                       const PassConstants& constants) {
  record_rows(list, settings, constants, traced_rows(constants, frame_.height()));
}

void RayEffect::record_rows(rtapi::CommandList& list, const EffectSettings& settings,
                            const PassConstants& constants, std::uint32_t row_count) const {
  pass_.dispatch(list, frame_, constants, row_count, PassArguments(views_, settings.constants));
}

void RayEffect::record_keys(rtapi::CommandList& list, const EffectSettings& settings,
                            const PassConstants& constants) const {
  if (!keys_) return;
  keys_->dispatch(list, frame_, constants, frame_.height(),
                  PassArguments(views_, settings.constants));
}

}  // namespace kaamos::effects
