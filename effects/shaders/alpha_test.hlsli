// SPDX-License-Identifier: MIT
// Alpha test for any-hit and pixel shaders: holes in leaves and fences. Opaque geometry never runs
// it.
#ifndef KAAMOS_ALPHA_TEST_HLSLI
#define KAAMOS_ALPHA_TEST_HLSLI

#include "frame.hlsli"

// True where a surface with these texture coordinates and this opacity of its vertices has a hole.
// Reads level 0 of the texture, because the shadow of a leaf must not depend on how far away the
// camera is.
bool IsOpenAtUv(MaterialConstants material, float2 uv, float vertex_alpha) {
  float alpha = vertex_alpha;
  if (HasTexture(material, kBaseColorTexture)) {
    const uint image = material.image[kBaseColorTexture];
    const uint sampler_id = material.sampler_id[kBaseColorTexture];
    alpha *= textures[NonUniformResourceIndex(image)]
                 .SampleLevel(samplers[NonUniformResourceIndex(sampler_id)],
                              MaterialUv(material, kBaseColorTexture, uv), 0.0)
                 .a;
  }
  return IsOpen(material, alpha);
}

// True where the triangle of the any-hit shader that calls this has a hole.
bool IsOpenAt(float2 barycentrics) {
  const MaterialConstants material = materials[hit_constants.material_id];
  float2 uv = float2(0, 0);
  float vertex_alpha = 1.0;
  if (HasTexture(material, kBaseColorTexture) || hit_constants.color_offset != 0) {
    const uint3 corners = LoadTriangle(indices, hit_constants.index_size_bytes, PrimitiveIndex());
    uv = LoadUvOf(vertices, hit_constants, corners, barycentrics,
                  UsesSecondUv(material, kBaseColorTexture));
    if (hit_constants.color_offset != 0) {
      vertex_alpha = LoadColor(vertices, hit_constants, corners, barycentrics).w;
    }
  }
  return IsOpenAtUv(material, uv, vertex_alpha);
}

// Texture coordinates of a vertex that IsOpenAtUv takes, for vertex shaders of draws. `first`: its
// first ones.
float2 HoleUv(ByteAddressBuffer vertices_of, HitConstants layout, uint vertex, float2 first) {
  if (layout.color_offset == 0) return first;
  if (!UsesSecondUv(materials[layout.material_id], kBaseColorTexture)) return first;
  return LoadVertexFloat2(vertices_of, layout.vertex_stride, UvOffset(layout, true), vertex);
}

// Opacity of a vertex, for vertex shaders of draws.
float VertexAlpha(ByteAddressBuffer vertices_of, HitConstants layout, uint vertex) {
  if (layout.color_offset == 0) return 1.0;
  return LoadVertexColor(vertices_of, layout.vertex_stride, layout.color_offset, vertex).w;
}

#endif
