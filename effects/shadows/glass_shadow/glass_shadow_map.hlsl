// SPDX-License-Identifier: MIT
// Shadows of glass by a map beside the one of what is solid: what all panes of a texel let through
// together, and the depth of the pane that is nearest to the sun. What lies behind that depth is
// tinted by all of them. [Filion & McNaughton 2008, StarCraft II: Effects and Techniques]

// Mirrors the members of GlassShadowMapConstants of glass_shadow_map.h behind `map`.
struct GlassMapConstants {
  float tint;  // of PaneTransmittance
};
#define KAAMOS_SHADOW_MAP_MORE GlassMapConstants

#include "../shadow_map/pcss.hlsli"
#include "pane_tint.hlsli"

Texture2D<float4> pane_colors : register(t5, space3);  // product of what panes let through
Texture2D<float> pane_depths : register(t6, space3);   // metres; of the nearest
// Vertices and indices of geometry i are number 2 * i and 2 * i + 1.
ByteAddressBuffer geometry_buffers[] : register(t0, space4);

struct PaneVertex {
  float4 position : SV_Position;
  float4 color : COLOR;  // of the vertex
  float2 uv : TEXCOORD;
  float depth : DEPTH;   // metres from the plane where the map begins
};

[shader("vertex")]
PaneVertex GlassMapVertex(float3 position : POSITION, float2 uv : TEXCOORD,
                          uint vertex : SV_VertexID) {
  const ShadowMap map = maps[0];
  const float4 world = float4(mul(ObjectToWorld(draws[constants.draw]), float4(position, 1.0)), 1.0);
  const float2 at = float2(dot(map.to_map[0], world), dot(map.to_map[1], world)) *
                    (2.0 / float(constants.size));
  const uint geometry = draws[constants.draw].geometry;
  const HitConstants layout = geometries[geometry];
  PaneVertex result;
  result.depth = dot(map.to_map[2], world);
  result.position = float4(at.x - 1.0, 1.0 - at.y, result.depth / map.range, 1.0);
  result.uv = uv;
  result.color = float4(1, 1, 1, 1);
  if (layout.color_offset != 0) {
    result.color = LoadVertexColor(geometry_buffers[2 * geometry], layout.vertex_stride,
                                   layout.color_offset, vertex);
  }
  if (UsesSecondUv(materials[layout.material_id], kBaseColorTexture)) {
    result.uv = LoadVertexFloat2(geometry_buffers[2 * geometry], layout.vertex_stride,
                                 UvOffset(layout, true), vertex);
  }
  return result;
}

struct PanePixel {
  float4 color : SV_Target0;  // multiplies what is there
  float depth : SV_Target1;   // the smallest stays
};

[shader("pixel")]
PanePixel GlassMapPixel(PaneVertex vertex) {
  const HitConstants layout = geometries[draws[constants.draw].geometry];
  const float4 color = PaneColor(materials[layout.material_id], vertex.uv, vertex.color);
  if (!(color.a > 0.0)) discard;
  PanePixel result;
  result.color = float4(PaneTransmittance(color, constants.more.tint), 1.0);
  result.depth = vertex.depth;
  return result;
}

// What the panes of one texel let through to the receiver.
float3 TexelTint(Receiver receiver, int2 texel) {
  if (!IsInMap(texel)) return float3(1, 1, 1);
  if (DepthAt(receiver, float2(texel) + 0.5) <= pane_depths[uint2(texel)]) return float3(1, 1, 1);
  return pane_colors[uint2(texel)].rgb;
}

// The mean over a disk of texels that each pixel turns.
[shader("compute")]
[numthreads(8, 8, 1)]
void GlassMapLookup(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  visibility.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  Surface surface;
  if (!LoadSurface(id.xy, surface)) {
    // Where the sun is not to be seen its colour does not count.
    visibility[id.xy] = float4(1, 1, 1, 1);
    return;
  }
  const Receiver receiver = MakeReceiver(0, surface.position, surface.normal);
  const float texels = constants.radius / maps[0].texel;
  float3 sum = float3(0, 0, 0);
  for (uint i = 0; i < constants.taps; ++i) {
    // One tap alone is the texel itself.
    const float2 away = constants.taps > 1 ? DiskTap(i, surface.turn) * texels : float2(0, 0);
    sum += TexelTint(receiver, int2(floor(receiver.at + away)));
  }
  visibility[id.xy] = float4(sum / float(constants.taps), 1.0);
}
