// SPDX-License-Identifier: MIT
#include "effects/northlight/effects.h"

#include <utility>

#include "effects/glass/rows.h"
#include "effects/indirect/rows.h"
#include "effects/light/rows.h"
#include "effects/materials/material_variants.h"
#include "effects/occlusion/rows.h"
#include "effects/particles/particles.h"
#include "effects/reflections/rows.h"
#include "effects/shadows/rows.h"

namespace kaamos::effects {

namespace {

std::vector<Effect> make_effects() {
  std::vector<Effect> out = {
      ambient_occlusion_row(), sun_shadow_row(),  local_lights_row(), contact_shadow_row(),
      indirect_diffuse_row(),  reflections_row(), transparent_row(),  glass_shadow_row(),
  };
  for (const auto alternatives :
       {shadow_alternatives, occlusion_alternatives, indirect_alternatives, reflection_alternatives,
        glass_alternatives}) {
    for (Effect& row : alternatives()) out.push_back(std::move(row));
  }
  out.push_back(material_variants_row());
  out.push_back(particles_row());  // over all others
  return out;
}

}  // namespace

const std::vector<Effect>& northlight_effects() {
  static const std::vector<Effect> effects = make_effects();
  return effects;
}

}  // namespace kaamos::effects
