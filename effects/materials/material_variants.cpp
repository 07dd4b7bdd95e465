// SPDX-License-Identifier: MIT
#include "effects/materials/material_variants.h"

#include <shaders/material_variants.h>

#include <utility>

namespace kaamos::effects {

namespace {

SettingTable<VariantConstants> variant_settings() {
  using C = VariantConstants;
  return {switch_setting("at-hits", &C::at_hits,
                         "mirrors show skin, eyes and hair by models of their own, too")};
}

}  // namespace

Effect material_variants_row() {
  Effect row = {.name = "material-variants",
                .about = "skin, eyes and hair by models of their own in the sun"};
  row.library = {"materials/material_variants", material_variants_library};
  row.pass = material_variants_pass;
  row.compose = "VariantCompose";
  row.signals = {{.name = "material_variants", .is_sum = false, .is_light = true}};
  set_constants(row, VariantConstants{}, variant_settings());
  row.needs.sun = true;
  row.on_request = true;
  row.misses = "all light but the sun's";
  return row;
}

RayPassDesc material_variants_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "material variants";
  desc.library = std::move(library);
  desc.ray_generation = "VariantRayGen";
  desc.miss[kRayTypeSurface] = "VariantMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"VariantAnyHit", "VariantClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 52;
  desc.max_recursion_depth = 2;  // a hit traces a ray to the sun
  return desc;
}

rtapi::Result<rtapi::ShaderLibrary> material_variants_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_material_variants());
}

}  // namespace kaamos::effects
