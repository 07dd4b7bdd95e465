// SPDX-License-Identifier: MIT
// Alpha test for any-hit shaders: holes in leaves and fences. Opaque geometry never runs it.
#ifndef KAAMOS_ALPHA_TEST_HLSLI
#define KAAMOS_ALPHA_TEST_HLSLI

#include "frame.hlsli"

// True where the surface has a hole. Reads level 0 of the texture, because the shadow of a leaf
// must not depend on how far away the camera is.
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
