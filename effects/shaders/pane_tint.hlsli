// SPDX-License-Identifier: MIT
// What a pane of glass lets through of a light behind it, for the shadows that glass casts.
#ifndef KAAMOS_PANE_TINT_HLSLI
#define KAAMOS_PANE_TINT_HLSLI

#include "frame.hlsli"

// Where the pane does not cover, all light goes through; where it does, a part of it that the pane
// colours. `tint`: 1 a part of the pane's own colour; 0 none, which is what the camera sees of
// things behind the pane. [McGuire & Enderton 2011, Colored Stochastic Shadow Maps]
float3 PaneTransmittance(float4 color, float tint) {
  const float coverage = Contain(color.a, 1.0);
  return float3(1, 1, 1) - coverage * (float3(1, 1, 1) - tint * Contain(color.rgb, 1.0));
}

// Colour and coverage of a pane. Texture level 0, because a shadow must not depend on how far away
// the camera is.
float4 PaneColor(MaterialConstants material, float2 uv, float4 vertex_color) {
  float4 color = material.base_color * vertex_color;
  if (HasTexture(material, kBaseColorTexture)) {
    const uint image = material.image[kBaseColorTexture];
    const uint sampler_id = material.sampler_id[kBaseColorTexture];
    color *= textures[NonUniformResourceIndex(image)]
                 .SampleLevel(samplers[NonUniformResourceIndex(sampler_id)],
                              MaterialUv(material, kBaseColorTexture, uv), 0.0);
  }
  return color;
}

// Those of the triangle of the any-hit shader that calls this.
float4 PaneColorAt(float2 barycentrics) {
  const MaterialConstants material = materials[hit_constants.material_id];
  float2 uv = float2(0, 0);
  float4 vertex_color = float4(1, 1, 1, 1);
  if (HasTexture(material, kBaseColorTexture) || hit_constants.color_offset != 0) {
    const uint3 corners = LoadTriangle(indices, hit_constants.index_size_bytes, PrimitiveIndex());
    uv = LoadUvOf(vertices, hit_constants, corners, barycentrics,
                  UsesSecondUv(material, kBaseColorTexture));
    if (hit_constants.color_offset != 0) {
      vertex_color = LoadColor(vertices, hit_constants, corners, barycentrics);
    }
  }
  return PaneColor(material, uv, vertex_color);
}

#endif
