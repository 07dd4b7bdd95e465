// SPDX-License-Identifier: MIT
// Any-hit shaders: holes in leaves and fences. Opaque geometry never gets here.
#ifndef KAAMOS_ALPHA_TEST_HLSLI
#define KAAMOS_ALPHA_TEST_HLSLI

#include "frame.hlsli"
#include "geometry.hlsli"

// True where the surface is open. Level 0 of the texture: shadows of a leaf do not depend on how far
// the camera is.
bool IsOpenAt(float2 barycentrics) {
  const MaterialConstants material = materials[hit_constants.material_id];
  if ((material.flags & kMaterialAlphaTested) == 0) {
    return false;
  }
  float alpha = material.base_color.a;
  const int image = material.image[kBaseColorTexture];
  if (image >= 0) {
    const uint3 corners = LoadTriangle(indices, hit_constants, PrimitiveIndex());
    const float2 uv = MaterialUv(material, kBaseColorTexture,
                                 InterpolateUv(vertices, hit_constants, corners, barycentrics));
    const uint sampler_id = material.sampler[kBaseColorTexture];
    alpha *= textures[NonUniformResourceIndex(image)]
                 .SampleLevel(samplers[NonUniformResourceIndex(sampler_id)], uv, 0.0)
                 .a;
  }
  return alpha < material.alpha_cutoff;
}

#endif
