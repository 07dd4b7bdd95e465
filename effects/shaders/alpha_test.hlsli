// SPDX-License-Identifier: MIT
// Any-hit shaders: holes in leaves and fences. Opaque geometry never gets here.
#ifndef KAAMOS_ALPHA_TEST_HLSLI
#define KAAMOS_ALPHA_TEST_HLSLI

#include "frame.hlsli"

// True where the surface is open. Level 0 of the texture: shadows of a leaf do not depend on how far
// the camera is.
bool IsOpenAt(float2 barycentrics) {
  const MaterialConstants material = materials[hit_constants.material_id];
  float alpha = 1.0;
  if (HasTexture(material, kBaseColorTexture)) {
    const uint3 corners = LoadTriangle(indices, hit_constants.index_size_bytes, PrimitiveIndex());
    const float2 uv = MaterialUv(material, kBaseColorTexture,
                                 LoadUv(vertices, hit_constants, corners, barycentrics));
    const uint image = material.image[kBaseColorTexture];
    const uint sampler_id = material.sampler_id[kBaseColorTexture];
    alpha = textures[NonUniformResourceIndex(image)]
                .SampleLevel(samplers[NonUniformResourceIndex(sampler_id)], uv, 0.0)
                .a;
  }
  return IsOpen(material, alpha);
}

#endif
