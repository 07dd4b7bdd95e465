// SPDX-License-Identifier: MIT
// Local lights at any point of the scene, visible or not. A grid of clusters about the camera finds
// the lights, and shadow maps in an atlas tell whether they are visible. Every pass that shades
// hits includes this. [Northlight deck: Light Culling, Lighting Data]
#ifndef KAAMOS_HIT_LIGHTING_HLSLI
#define KAAMOS_HIT_LIGHTING_HLSLI

#include "brdf.hlsli"
#include "encoding.hlsli"
#include "frame.hlsli"

// effects/light/lights/lighting.h binds these for a pass and holds the same numbers. A texel of the atlas
// stores the plane that the light sees there: all p, relative to the light, with dot(xyz, p) = 1.
// w is 1 / distance of the hit, in 1/metres. All are 0 if nothing was hit.
RWTexture2D<float4> shadow_atlas : register(u16, space3);
RWStructuredBuffer<uint> cluster_counts : register(u17, space3);
RWStructuredBuffer<uint> cluster_lights : register(u18, space3);

static const uint kClusterCells = 32;        // per axis
static const uint kClusterCapacity = 64;     // lights in a cluster
static const float kClusterInnerSize = 0.5;  // metres, of the cells next to the camera
// Marks a cluster with more lights than it can hold. There all lights of the scene are evaluated,
// so none is lost.
static const uint kClusterOverflow = 0xFFFFFFFF;

static const uint kShadowTile = 128;         // texels along a side of a light's map
static const uint kShadowTilesPerRow = 32;
static const float kShadowOffset = 1.5;      // texels that a point is moved along its normal
static const float kShadowTolerance = 0.5;   // texels behind an occluder that still count as lit

// Cells grow with the distance from the camera, two per doubling of 1 + distance / inner size. The
// outermost cells reach to infinity, so every point lies in a cell, also behind the camera: rays
// hit what the camera does not see.
int ClusterCoordinate(float x) {
  // The exponent and the first mantissa bit: twice the integer part of log2, plus which half of the
  // octave it is.
  const int halves = int(asuint(1.0 + abs(x) / kClusterInnerSize) >> 22) - 254;
  const int cell = min(halves, int(kClusterCells) / 2 - 1);
  return int(kClusterCells) / 2 + (x < 0.0 ? -1 - cell : cell);
}

// Bounds of a cell along an axis: coordinate c contains ClusterLow(c) <= x <= ClusterHigh(c).
float ClusterDistance(int cells) { return (asfloat(uint(cells + 254) << 22) - 1.0) * kClusterInnerSize; }

float ClusterLow(int coordinate) {
  const int half_cells = int(kClusterCells) / 2;
  if (coordinate == 0) return -1e30;
  return coordinate < half_cells ? -ClusterDistance(half_cells - coordinate)
                                 : ClusterDistance(coordinate - half_cells);
}

float ClusterHigh(int coordinate) {
  const int half_cells = int(kClusterCells) / 2;
  if (coordinate == int(kClusterCells) - 1) return 1e30;
  return coordinate < half_cells ? -ClusterDistance(half_cells - 1 - coordinate)
                                 : ClusterDistance(coordinate + 1 - half_cells);
}

// The grid is aligned with the camera's axes.
float3 ClusterSpace(float3 position) {
  return float3(dot(position, frame.camera_right) * frame.over_right,
                dot(position, frame.camera_up) * frame.over_up, dot(position, frame.camera_forward));
}

uint ClusterOf(float3 position) {
  const float3 p = ClusterSpace(position);
  return (uint(ClusterCoordinate(p.z)) * kClusterCells + uint(ClusterCoordinate(p.y))) *
             kClusterCells + uint(ClusterCoordinate(p.x));
}

float RadianceLuminance(float3 radiance) {
  return dot(radiance, float3(0.2126, 0.7152, 0.0722));
}

// Returns where a direction from the light falls on its shadow map, 0..1. A spot's map covers its
// cone in perspective, a point light's covers all directions as an octahedron.
float2 ShadowMapUv(LightConstants light, float3 direction, float distance) {
  if (light.is_spot == 0) {
    return OctahedralEncode(direction) * 0.5 + 0.5;
  }
  const float along = max(dot(direction, light.direction), 1e-6 * distance);
  return float2(dot(direction, light.map_right), dot(direction, light.map_up)) * (0.5 / along) + 0.5;
}

// The inverse: the direction of a point of a light's map.
float3 ShadowMapDirection(LightConstants light, float2 uv) {
  if (light.is_spot == 0) {
    return OctahedralDecode(uv * 2.0 - 1.0);
  }
  // The length of the axes is 1 / the tangent of the cone's half angle.
  const float2 p = (uv * 2.0 - 1.0) / dot(light.map_right, light.map_right);
  return normalize(light.direction + p.x * light.map_right + p.y * light.map_up);
}

uint2 ShadowTileOrigin(uint light) {
  return uint2(light % kShadowTilesPerRow, light / kShadowTilesPerRow) * kShadowTile;
}

// Tells whether a point, given relative to the light, lies behind what a texel saw. The test
// compares planes instead of distances: on a wall seen at a slant the distance changes a lot within
// a texel but the plane does not, so no wall shadows itself or its neighbour in a corner. A plane
// is valid only near its texel, so its distance is kept within a factor of two of the one stored.
bool IsBehind(float4 occluder, float3 from_light, float receiver, float tolerance) {
  const float ratio = receiver * occluder.w;
  const float along = clamp(dot(occluder.xyz, from_light), 0.5 * ratio, 2.0 * ratio);
  return along * receiver > receiver + tolerance * along;
}

// Visibility of a light by its shadow map: four texels, bilinearly weighted. The point is first
// moved along its normal by a few texels' size, because a curved surface lies behind the tangent
// planes next to it.
float ShadowMapVisibility(uint id, LightConstants light, float3 position, float3 normal) {
  const float texel = length(position - light.position) * light.map_texel;
  const float3 from_light = position + normal * (kShadowOffset * texel) - light.position;
  const float receiver = length(from_light);
  if (!(receiver > 0.0)) return 1.0;
  const float2 at = ShadowMapUv(light, from_light, receiver) * float(kShadowTile) - 0.5;
  const int2 corner = int2(floor(at));
  const float2 part = at - floor(at);
  const uint2 origin = ShadowTileOrigin(id);
  float visible = 0.0;
  [unroll] for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const int2 texel_at = clamp(corner + offset, int2(0, 0), int2(kShadowTile - 1, kShadowTile - 1));
    const float4 occluder = shadow_atlas[origin + uint2(texel_at)];
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    visible += IsBehind(occluder, from_light, receiver, kShadowTolerance * texel) ? 0.0 : weight;
  }
  return visible;
}

// Tells whether the sun's map covers a point.
bool IsInSunMap(float3 position) {
  const float3 p = position - frame.sun_map_centre;
  return frame.sun_map_size != 0 &&
         max(abs(dot(p, frame.sun_map_right)), abs(dot(p, frame.sun_map_up))) <= 1.0;
}

// The corner of the sun's map: right of the tiles.
uint2 SunMapOrigin() {
  return uint2(clamp(frame.light_count, 1u, kShadowTilesPerRow) * kShadowTile, 0);
}

// Visibility of the sun's centre by its map, as ShadowMapVisibility. A texel stores where along the
// sunlight it saw a surface, metres from the map's centre; how much that changes from texel to
// texel to the right and up; and 1. All are 0 if nothing was hit.
float SunMapVisibility(float3 position, float3 normal) {
  const float3 p = position + normal * (kShadowOffset * frame.sun_map_texel) - frame.sun_map_centre;
  const float receiver = -dot(p, frame.direction_to_sun);
  const float2 at = float2(dot(p, frame.sun_map_right), dot(p, frame.sun_map_up)) *
                        (0.5 * float(frame.sun_map_size)) + (0.5 * float(frame.sun_map_size) - 0.5);
  const int2 corner = int2(floor(at));
  const float2 part = at - floor(at);
  const uint2 origin = SunMapOrigin();
  const int last = int(frame.sun_map_size) - 1;
  float visible = 0.0;
  [unroll] for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const int2 texel_at = clamp(corner + offset, int2(0, 0), int2(last, last));
    const float4 occluder = shadow_atlas[origin + uint2(texel_at)];
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    const float plane = occluder.x + dot(occluder.yz, at - float2(texel_at));
    const bool is_behind =
        occluder.w > 0.0 && receiver > plane + kShadowTolerance * frame.sun_map_texel;
    visible += is_behind ? 0.0 : weight;
  }
  return visible;
}

// Radiance of one light reflected towards `view`, without shadow.
float3 LightRadiance(LightConstants light, Brdf brdf, BrdfView view, float3 position) {
  const LightSample s = SampleLight(light, position);
  if (!any(s.irradiance > 0.0)) return float3(0, 0, 0);
  return s.irradiance * EvaluateBrdfForLamp(brdf, view, s.direction);
}

float3 ShadowedLightRadiance(uint id, Brdf brdf, BrdfView view, float3 position,
                             float3 geometric_normal) {
  const LightConstants light = lights[id];
  const float3 radiance = LightRadiance(light, brdf, view, position);
  if (!(RadianceLuminance(radiance) > 0.0)) return float3(0, 0, 0);
  return radiance * ShadowMapVisibility(id, light, position, geometric_normal);
}

// The lights that a loop over a cluster visits; ClusterLight returns each.
struct ClusterRange {
  uint count;
  uint first;  // into cluster_lights; kClusterOverflow: all lights of the scene
};

ClusterRange ClusterLights(float3 position) {
  const uint cluster = ClusterOf(position);
  ClusterRange range;
  range.count = cluster_counts[cluster];
  range.first = cluster * kClusterCapacity;
  if (range.count == kClusterOverflow) {
    range.count = frame.light_count;
    range.first = kClusterOverflow;
  }
  return range;
}

uint ClusterLight(ClusterRange range, uint index) {
  if (range.first == kClusterOverflow) return index;
  return cluster_lights[range.first + index];
}

// Reflected radiance of all local lights at a point, with their shadow maps.
float3 LocalLights(Brdf brdf, BrdfView view, float3 position, float3 geometric_normal) {
  const ClusterRange range = ClusterLights(position);
  float3 sum = float3(0, 0, 0);
  for (uint i = 0; i < range.count; ++i) {
    sum += ShadowedLightRadiance(ClusterLight(range, i), brdf, view, position, geometric_normal);
  }
  return sum;
}

// The same times pi, of a surface that spreads what it reflects.
float3 LocalMatteLights(SpreadBrdf brdf, float3 position, float3 normal) {
  const ClusterRange range = ClusterLights(position);
  float3 sum = float3(0, 0, 0);
  for (uint i = 0; i < range.count; ++i) {
    const uint id = ClusterLight(range, i);
    const LightConstants light = lights[id];
    const LightSample s = SampleLight(light, position);
    const float facing = dot(normal, s.direction);
    const float3 irradiance = s.irradiance * facing;
    if (!(RadianceLuminance(irradiance) > 0.0)) continue;
    sum += irradiance * SpreadAlbedo(brdf, facing) * ShadowMapVisibility(id, light, position, normal);
  }
  return sum;
}

#endif
