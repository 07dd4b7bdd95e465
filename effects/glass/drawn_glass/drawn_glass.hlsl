// SPDX-License-Identifier: MIT
// Glass by draws, from back to front, each layer blended over what is behind it. A layer whose depth
// is the one that a ray found before shows what that ray's mirror image holds; all others show an
// environment map. [Control; survey 6.5]
#include "../../reflections/environment_map/environment_map.hlsli"
#include "../../surfaces/gbuffer/camera_hit.hlsli"
#include "../../surfaces/gbuffer/store.hlsli"
#include "../transparent/glass_layer.hlsli"

RWTexture2D<float4> glass_radiance : register(u0, space3);       // as effects/glass/transparent has them
RWTexture2D<float4> glass_transmittance : register(u1, space3);
// The results of the rays: radiance that the nearest layer mirrors and its view depth (0: no
// glass); x: whether it sees the sun.
RWTexture2D<float4> first_mirrored : register(u2, space3);
RWTexture2D<float4> first_sun : register(u3, space3);
// The pictures that the draws leave.
Texture2D<float4> drawn_radiance : register(t3, space3);
Texture2D<float4> drawn_transmittance : register(t4, space3);
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

struct GlassVertex {
  float4 position : SV_Position;
};

struct GlassPixel {
  float4 radiance : SV_Target0;       // w: 1 - transmittance, by which what is behind is covered
  float4 transmittance : SV_Target1;  // by colour
};

[shader("vertex")]
GlassVertex DrawnGlassVertex(float3 position : POSITION) {
  const float3 world = mul(ObjectToWorld(draws[constants.draw]), float4(position, 1.0));
  GlassVertex result;
  result.position = ToClip(world, constants.clip_scale, constants.size);
  return result;
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

// The surface that a draw shows at a pixel.
Surface DrawnSurface(ByteAddressBuffer vertices_of, ByteAddressBuffer indices_of, TriangleHit hit,
                     float3 towards) {
  const float3 position = LoadHitPoint(vertices_of, indices_of, hit).spawn.position;
  return LoadSurface(vertices_of, indices_of, hit,
                     ConeWidthAfter(dot(position, frame.camera_forward) * length(towards)));
}

GlassPixel ShadeGlass(ByteAddressBuffer vertices_of, ByteAddressBuffer indices_of, SceneDraw draw,
                      uint2 pixel, uint primitive) {
  const CameraRay ray = PixelRay(pixel, uint2(constants.size));
  const TriangleHit hit =
      CameraHit(vertices_of, indices_of, geometries[draw.geometry], draw, primitive, ray);
  const Surface surface = DrawnSurface(vertices_of, indices_of, hit, ray.direction);
  const float view_z = dot(surface.position, frame.camera_forward);
  const float opaque_z = g_view_z[pixel];
  const float coverage = Coverage(surface.opacity);
  const bool has_back = (materials[hit.layout.material_id].flags & kMaterialDoubleSided) != 0;
  if (!(coverage > 0.0) || (surface.back_face && !has_back) ||
      (opaque_z > 0.0 && view_z >= opaque_z)) {
    discard;
  }
  const float sun = constants.sun != 0 ? first_sun[pixel].x : 0.0;
  GlassLayer layer = LitLayer(surface, coverage, hit.direction, sun);
  AddMirrored(layer, surface, coverage, hit.direction,
              LayerMirrors(surface, hit.direction, view_z, first_mirrored[pixel]),
              constants.full_reflection != 0);
  const float open = RadianceLuminance(layer.transmittance);
  GlassPixel result;
  result.radiance = float4(layer.radiance, 1.0 - open);
  result.transmittance = float4(layer.transmittance, open);
  return result;
}

[shader("pixel")]
GlassPixel DrawnGlassPixel(GlassVertex vertex, uint primitive : SV_PrimitiveID) {
  const SceneDraw draw = draws[constants.draw];
  return ShadeGlass(geometry_buffers[2 * draw.geometry], geometry_buffers[2 * draw.geometry + 1],
                    draw, uint2(vertex.position.xy), primitive);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void DrawnGlassResult(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  glass_radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  glass_radiance[id.xy] = float4(drawn_radiance[id.xy].rgb, first_mirrored[id.xy].w);
  glass_transmittance[id.xy] = float4(drawn_transmittance[id.xy].rgb, 0.0);
}
