// SPDX-License-Identifier: MIT
#include "effects/glass/transparent/transparent.h"

#include <shaders/transparent.h>

#include <algorithm>
#include <utility>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> transparent_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_transparent());
}

RayPassDesc transparent_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "transparent";
  desc.library = std::move(library);
  desc.ray_generation = "TransparentRayGen";
  desc.miss[kRayTypeSurface] = "TransparentMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"TransparentAnyHit", "TransparentClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 80;
  desc.max_recursion_depth = 3;  // a layer, its mirror image, a shadow ray to the sun there
  return desc;
}

RayPassDesc glass_reflection_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc = transparent_pass(std::move(library));
  desc.name = "mirror images of glass";
  desc.ray_generation = "GlassReflectionRayGen";
  return desc;
}

TransparentConstants deck_layers(std::uint32_t layers) {
  TransparentConstants constants;
  constants.reflecting_layers = std::min(layers, kMaxSortedLayers);
  constants.sorted_layers = constants.reflecting_layers;
  return constants;
}

TransparentConstants sorted_reference() {
  return deck_layers(kMaxSortedLayers);
}

}  // namespace kaamos::effects
