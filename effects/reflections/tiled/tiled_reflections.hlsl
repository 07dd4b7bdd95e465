// SPDX-License-Identifier: MIT
// Chooses what the reflections of each tile of pixels cost before rays are traced: none, an
// environment map, the picture, or rays. These are sent for a list of tiles, whose length only the
// device knows. [survey 6.4; Giacalone 2016]
#include "../hybrid/picture_hit.hlsli"
#include "../screen_space/screen_follow.hlsli"
#include "../traced/reflection_shading.hlsli"

// As those of effects/reflections/hybrid.
RWTexture2D<float4> reflection : register(u0, space3);
RWTexture2D<float4> hits : register(u1, space3);
// x: the class of the pixel, y: that of its tile, the dearest of its pixels.
RWTexture2D<float4> classes : register(u2, space3);
RWStructuredBuffer<uint> tiles : register(u3, space3);  // with rays: x + 65536 * y, in no order
// DispatchRaysDesc: kTilePixels x how many tiles these are x 1.
RWStructuredBuffer<uint> dispatch_rays : register(u4, space3);

struct TiledConstants {
  ScreenReflectionConstants screen;
  uint sun_at_hits;
  float roughest_screen;  // rougher surfaces are not looked for in the picture
  float roughest_traced;  // rougher surfaces show what a miss shows
};
ConstantBuffer<TiledConstants> constants : register(b0, space3);

uint SunAtHits() { return constants.sun_at_hits; }

static const uint kTile = 8;                      // pixels along a side
static const uint kTilePixels = kTile * kTile;
static const uint kHeightWord = 23;               // of DispatchRaysDesc

// effects/reflections/tiled/tiled_reflections.h has the same numbers, from cheap to dear.
static const uint kNothingShown = 0;  // the sky
static const uint kByEnvironment = 1;
static const uint kByPicture = 2;
static const uint kByRays = 3;

groupshared uint g_class;

// Adds up the pixel's samples from the picture. False: one of them needs a ray.
bool SumOfPicture(uint2 pixel, ReflectionPoint surface, float2 size, inout ScreenHit hit,
                  out float4 sum) {
  sum = float4(0, 0, 0, 0);
  if (!(surface.roughness <= constants.roughest_screen)) return false;
  const float3 scale = ReflectionScaleAt(surface);
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const ReflectionRay sample =
        SampleReflectionRay(pixel, surface, LengthsOf(constants.screen),
                            pass_constants.first_sample + i, frame.seed);
    hit = NoHit(kNoRay);
    if (!sample.exists) continue;
    float3 light;
    if (!LightOfPicture(pixel, surface, sample, constants.screen, size, hit, light)) return false;
    sum += float4(light * sample.weight / scale, hit.distance);
  }
  return true;
}

// Returns the class of a pixel, and stores its reflection unless that takes rays.
uint Classify(uint2 pixel, float2 size) {
  if (any(float2(pixel) >= size)) return kNothingShown;
  ScreenHit hit = NoHit(kNoRay);
  float4 sum = float4(0, 0, 0, 0);
  uint own = kNothingShown;
  if (g_ids[pixel].x != 0) {
    const ReflectionPoint surface = LoadReflectionPoint(pixel);
    if (!(surface.roughness <= constants.roughest_traced)) {
      own = kByEnvironment;
      sum = ReflectionSum(pixel, constants.screen, false, size, hit);
    } else {
      own = SumOfPicture(pixel, surface, size, hit, sum) ? kByPicture : kByRays;
    }
  }
  hits[pixel] = float4(hit.place, hit.distance, float(hit.outcome));
  if (own != kByRays) reflection[pixel] = SumBefore(reflection, pixel) + sum;
  return own;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ClassifyTiles(uint3 id : SV_DispatchThreadID, uint3 tile : SV_GroupID,
                   uint index : SV_GroupIndex) {
  if (index == 0) g_class = kNothingShown;
  GroupMemoryBarrierWithGroupSync();
  const float2 size = PictureSize();
  const uint own = Classify(id.xy, size);
  InterlockedMax(g_class, own);
  GroupMemoryBarrierWithGroupSync();
  if (all(float2(id.xy) < size)) classes[id.xy] = float4(float(own), float(g_class), 0, 0);
  if (index != 0 || g_class != kByRays) return;
  uint place;
  InterlockedAdd(dispatch_rays[kHeightWord], 1, place);
  tiles[place] = tile.x + 65536 * tile.y;
}

[shader("raygeneration")]
void TiledRayGen() {
  const uint2 index = DispatchRaysIndex().xy;
  const uint tile = tiles[index.y];
  const uint2 pixel =
      kTile * uint2(tile & 0xFFFF, tile >> 16) + uint2(index.x % kTile, index.x / kTile);
  if (any(float2(pixel) >= PictureSize()) || uint(classes[pixel].x) != kByRays) return;
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  const float3 scale = ReflectionScaleAt(surface);
  float4 sum = float4(0, 0, 0, 0);
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const uint sample_index = pass_constants.first_sample + i;
    const ReflectionRay sample =
        SampleReflectionRay(pixel, surface, LengthsOf(constants.screen), sample_index, frame.seed);
    if (!sample.exists) continue;
    const ReflectionPayload payload =
        FollowReflectionRay(pixel, surface, sample, sample_index, frame.seed);
    sum += float4(payload.radiance * sample.weight / scale,
                  payload.distance >= 0.0 ? payload.distance : sample.length);
  }
  reflection[pixel] = SumBefore(reflection, pixel) + sum;
}
