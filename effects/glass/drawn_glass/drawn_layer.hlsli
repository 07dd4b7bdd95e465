// SPDX-License-Identifier: MIT
// What draws of glass share: the layer that a draw shows at a pixel, and the light that it sends to
// the camera. [Control; survey 6.5]
#ifndef KAAMOS_DRAWN_LAYER_HLSLI
#define KAAMOS_DRAWN_LAYER_HLSLI

#include "../../reflections/environment_map/environment_map.hlsli"
#include "../../surfaces/gbuffer/camera_hit.hlsli"
#include "../../surfaces/gbuffer/store.hlsli"
#include "../transparent/glass_layer.hlsli"
#include "alpha_test.hlsli"

RWTexture2D<float4> glass_radiance : register(u0, space3);       // as effects/glass/transparent has them
RWTexture2D<float4> glass_transmittance : register(u1, space3);
// The result of the rays: radiance that the nearest layer mirrors and its view depth (0: no glass).
RWTexture2D<float4> first_mirrored : register(u2, space3);
StructuredBuffer<SceneDraw> draws : register(t7, space3);
StructuredBuffer<HitConstants> geometries : register(t8, space3);
// Vertices and indices of geometry i are number 2 * i and 2 * i + 1.
ByteAddressBuffer geometry_buffers[] : register(t0, space4);

// Mirrors DrawnGlassConstants in drawn_glass.h. It begins as TransparentConstants do.
struct DrawnGlassConstants {
  uint reflecting_layers;
  uint sorted_layers;
  uint weight_kind;
  uint sun;               // 0: the sun does not shine on glass
  float reflection_length;
  float fade;
  uint full_reflection;   // 1: reflections keep their strength where coverage is thin
  float depth_scale;
  float tolerance;        // part of the view depth by which a layer may miss the depth of the ray's
  uint fallback;          // of other layers: 0 nothing, 1 the environment map
  uint draw;              // in `draws`
  float clip_scale;       // of ToClip
  float2 size;            // of the picture, pixels
};
ConstantBuffer<DrawnGlassConstants> constants : register(b0, space3);

// A layer of glass at a pixel.
struct DrawnLayer {
  Surface surface;
  float3 direction;  // from the camera, unit
  float view_z;
  float coverage;
  bool is_seen;      // not a hole, not the back of single-sided glass, not behind what is opaque
};

DrawnLayer LayerOf(ByteAddressBuffer vertices_of, ByteAddressBuffer indices_of, SceneDraw draw,
                   uint2 pixel, uint primitive) {
  const CameraRay ray = PixelRay(pixel, uint2(constants.size));
  const TriangleHit hit =
      CameraHit(vertices_of, indices_of, geometries[draw.geometry], draw, primitive, ray);
  const float3 position = LoadHitPoint(vertices_of, indices_of, hit).spawn.position;
  DrawnLayer layer;
  layer.direction = hit.direction;
  layer.view_z = dot(position, frame.camera_forward);
  layer.surface = LoadSurface(vertices_of, indices_of, hit,
                              ConeWidthAfter(layer.view_z * length(ray.direction)));
  layer.coverage = Coverage(layer.surface.opacity);
  const bool has_back = (materials[hit.layout.material_id].flags & kMaterialDoubleSided) != 0;
  const float opaque_z = g_view_z[pixel];
  layer.is_seen = layer.coverage > 0.0 && (has_back || !layer.surface.back_face) &&
                  !(opaque_z > 0.0 && layer.view_z >= opaque_z);
  return layer;
}

// That of a draw at a pixel of one of its triangles.
DrawnLayer LayerOf(SceneDraw draw, uint2 pixel, uint primitive) {
  const uint vertices_at = 2 * draw.geometry;
  return LayerOf(geometry_buffers[NonUniformResourceIndex(vertices_at)],
                 geometry_buffers[NonUniformResourceIndex(vertices_at + 1)], draw, pixel, primitive);
}

// True where a triangle that a query meets has a hole. Queries have no hit groups: the geometry is
// found by the number of its hit record.
bool IsHole(ByteAddressBuffer vertices_of, ByteAddressBuffer indices_of, HitConstants layout,
            uint primitive, float2 barycentrics) {
  const MaterialConstants material = materials[layout.material_id];
  const uint3 corners = LoadTriangle(indices_of, layout.index_size_bytes, primitive);
  const float2 uv = LoadUvOf(vertices_of, layout, corners, barycentrics,
                             UsesSecondUv(material, kBaseColorTexture));
  float alpha = 1.0;
  if (layout.color_offset != 0) alpha = LoadColor(vertices_of, layout, corners, barycentrics).w;
  return IsOpenAtUv(material, uv, alpha);
}

// 1 where the sun is visible from a layer.
float LayerSeesSun(Surface surface) {
  if (constants.sun == 0 || !(dot(surface.normal, frame.direction_to_sun) > 0.0)) return 0.0;
  RayDesc ray;
  ray.Origin = SurfaceOrigin(surface, frame.direction_to_sun);
  ray.TMin = 0.0;
  ray.Direction = frame.direction_to_sun;
  ray.TMax = kSunDistance;
  RayQuery<RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, kMaskWithoutLamps, ray);
  while (query.Proceed()) {
    const uint geometry =
        query.CandidateInstanceContributionToHitGroupIndex() / kRayTypeCount +
        query.CandidateGeometryIndex();
    if (!IsHole(geometry_buffers[NonUniformResourceIndex(2 * geometry)],
                geometry_buffers[NonUniformResourceIndex(2 * geometry + 1)], geometries[geometry],
                query.CandidatePrimitiveIndex(), query.CandidateTriangleBarycentrics())) {
      query.CommitNonOpaqueTriangleHit();
    }
  }
  return query.CommittedStatus() == COMMITTED_NOTHING ? 1.0 : 0.0;
}

// Returns the light that a layer mirrors.
float3 LayerMirrors(Surface surface, float3 direction, float view_z, float4 first) {
  if (abs(view_z - first.w) <= constants.tolerance * view_z) return first.rgb;
  if (constants.fallback == 0) return float3(0, 0, 0);
  float3 mirrored = reflect(direction, surface.shading_normal);
  // A normal-mapped direction can point into the pane.
  if (!(dot(mirrored, surface.normal) > 0.0)) mirrored = reflect(direction, surface.normal);
  return EnvironmentRadiance(surface.position, mirrored, 0.0);
}

// The light of a layer, with its mirror image.
GlassLayer ShadeLayer(DrawnLayer layer, float4 first) {
  GlassLayer shaded =
      LitLayer(layer.surface, layer.coverage, layer.direction, LayerSeesSun(layer.surface));
  AddMirrored(shaded, layer.surface, layer.coverage, layer.direction,
              LayerMirrors(layer.surface, layer.direction, layer.view_z, first),
              constants.full_reflection != 0);
  return shaded;
}

struct GlassVertex {
  float4 position : SV_Position;
};

[shader("vertex")]
GlassVertex DrawnGlassVertex(float3 position : POSITION) {
  const float3 world = mul(ObjectToWorld(draws[constants.draw]), float4(position, 1.0));
  GlassVertex result;
  result.position = ToClip(world, constants.clip_scale, constants.size);
  return result;
}

#endif
