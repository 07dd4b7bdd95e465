// SPDX-License-Identifier: MIT
// Chooses the pixels that may find their reflection in the picture, by their roughness and by a
// march over blocks of pixels that misses nothing; the others show what a miss shows. The full
// march then runs for a list of pixels, whose length only the device knows. Or, older, by a coarse
// march of one pixel in four that marks what is around it, and misses some. [Wronski 2014; Giacalone
// 2016]
#include "screen_follow.hlsli"

struct MaskConstants {
  ScreenReflectionConstants screen;
  float roughest;       // rougher surfaces are not looked for in the picture
  uint march_blocks;    // 0: roughness alone decides
  uint half_mask;       // 1: marks of half the resolution decide instead
  uint dilation;        // pixels of half the resolution that are marked around one, to each side
};
ConstantBuffer<MaskConstants> constants : register(b0, space3);

// As those of screen_reflections.hlsl.
RWTexture2D<float4> reflection : register(u0, space3);
RWTexture2D<float4> hits : register(u1, space3);
// The least and the largest view depth of the surfaces of each block of pixels (0, 0: all sky), and
// the first pixel with a surface + 1 if all of them have its normal, else 0.
RWTexture2D<float4> depth_bounds : register(u2, space3);
RWStructuredBuffer<uint> pixels : register(u3, space3);     // x + 65536 * y, in no order
RWStructuredBuffer<uint> pixel_count : register(u4, space3);  // how many these are
// The groups of threads that they take: arguments of an indirect dispatch.
RWStructuredBuffer<uint> groups : register(u5, space3);
RWStructuredBuffer<uint> marks : register(u6, space3);  // of 2 x 2 pixels each, by rows: 1: looked for

static const uint kBlock = 8;   // pixels along a side
static const uint kGroup = 64;  // pixels of a thread group

uint2 PixelOfBlock(uint2 block, uint index) {
  return block * kBlock + uint2(index % kBlock, index / kBlock);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void BoundDepths(uint3 id : SV_DispatchThreadID) {
  const uint2 size = uint2(PictureSize());
  uint2 blocks;
  depth_bounds.GetDimensions(blocks.x, blocks.y);
  if (all(id.xy == uint2(0, 0))) pixel_count[0] = 0;
  if (any(id.xy >= blocks)) return;
  float least = kSkyZ, most = 0.0;
  uint first = 0;
  bool is_flat = true;
  for (uint i = 0; i < kBlock * kBlock; ++i) {
    const uint2 pixel = PixelOfBlock(id.xy, i);
    if (any(pixel >= size)) continue;
    const float view_z = g_view_z[pixel];
    if (!(view_z > 0.0)) continue;
    if (most == 0.0) first = i;
    is_flat = is_flat && all(g_normal[pixel] == g_normal[PixelOfBlock(id.xy, first)]);
    least = min(least, view_z);
    most = max(most, view_z);
  }
  depth_bounds[id.xy] = most > 0.0 ? float4(least, most, is_flat ? float(first + 1) : 0.0, 0)
                                   : float4(0, 0, 0, 0);
}

uint2 HalfSize() { return (uint2(PictureSize()) + 1) / 2; }

[shader("compute")]
[numthreads(8, 8, 1)]
void ClearMarks(uint3 id : SV_DispatchThreadID) {
  const uint2 size = HalfSize();
  if (all(id.xy == uint2(0, 0))) pixel_count[0] = 0;
  if (all(id.xy < size)) marks[id.y * size.x + id.x] = 0;
}

// Follows the rays of one pixel of 2 x 2 in steps twice as long up to the first thing that they get
// behind, however far. [Wronski 2014]
bool MeetsSomething(uint2 pixel) {
  if (g_ids[pixel].x == 0) return false;
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  if (!(surface.roughness <= constants.roughest)) return false;
  ScreenReflectionConstants coarse = constants.screen;
  coarse.stride *= 2.0;
  coarse.steps = (coarse.steps + 1) / 2;
  coarse.thickness = kLongestRay;
  coarse.strict = 0;
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const ReflectionRay sample = SampleReflectionRay(
        pixel, surface, LengthsOf(coarse), pass_constants.first_sample + i, frame.seed);
    if (!sample.exists) continue;
    const ScreenHit hit = MarchReflection(surface, sample, g_ids[pixel].x, coarse, PictureSize());
    if (hit.outcome == kHit) return true;
  }
  return false;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void MarkPixels(uint3 id : SV_DispatchThreadID) {
  const uint2 size = HalfSize();
  if (any(id.xy >= size) || !MeetsSomething(2 * id.xy)) return;
  const int reach = int(constants.dilation);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const int2 at = int2(id.xy) + int2(x, y);
      if (any(at < int2(0, 0)) || any(at >= int2(size))) continue;
      InterlockedOr(marks[uint(at.y) * size.x + uint(at.x)], 1);
    }
  }
}

// No pixel of a flat block is hit from behind: so the plane that a ray leaves is not met again.
bool IsLeft(ScreenRay ray, uint2 block, float first_pixel) {
  if (!(first_pixel > 0.0)) return false;
  const uint2 pixel = PixelOfBlock(block, uint(first_pixel) - 1);
  return !(dot(ray.direction, OctahedralDecode(g_normal[pixel])) < 0.0);
}

// Tells whether a ray's depths in a part of it may meet a surface of the blocks that it passes
// there.
bool MayMeet(ScreenRay ray, float s0, float s1, float before, float thickness,
             float step_thickness, int2 blocks) {
  const float2 a = ScreenPlace(ray, s0), b = ScreenPlace(ray, s1);
  const int2 first = clamp(int2(floor((min(a, b) - 1.0) / float(kBlock))), int2(0, 0), blocks - 1);
  const int2 last = clamp(int2(floor((max(a, b) + 1.0) / float(kBlock))), int2(0, 0), blocks - 1);
  const float d0 = ScreenDepth(ray, before), d1 = ScreenDepth(ray, s1);
  const float nearest = min(d0, d1) * (1.0 - 1e-5), farthest = max(d0, d1) * (1.0 + 1e-5);
  const float behind = thickness + step_thickness * (farthest - nearest);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      const float4 bounds = depth_bounds[int2(x, y)];
      if (!(bounds.y > 0.0) || IsLeft(ray, uint2(x, y), bounds.z)) continue;
      if (farthest >= bounds.x && nearest <= bounds.y + behind) return true;
    }
  }
  return false;
}

// Every sample of the march lies in one of the parts, and so do the depths since the sample before.
bool MayHit(ScreenRay ray, float length, float2 size) {
  if (!ray.exists) return false;
  uint2 blocks;
  depth_bounds.GetDimensions(blocks.x, blocks.y);
  const float2 extent = abs(ray.along);
  const float major = max(extent.x, extent.y);
  const uint parts = uint(ceil(major / float(kBlock)));
  // A sample and the one before it may lie this far apart.
  float back = 0.0;
  if (constants.screen.march == kMarchPixels) back = max(constants.screen.stride, 1.0) / major;
  if (constants.screen.march == kMarchLine) back = 1.0 / float(constants.screen.steps);
  float thickness = Contain(constants.screen.thickness, kLongestRay);
  float step_thickness = constants.screen.step_thickness;
  if (constants.screen.march == kMarchMetres) {
    // No step is deeper.
    thickness += step_thickness * 1.001 * length / float(constants.screen.steps);
    step_thickness = 0.0;
  }
  for (uint i = 0; i < parts; ++i) {
    const float s0 = float(i) / float(parts), s1 = float(i + 1) / float(parts);
    if (MayMeet(ray, s0, s1, max(0.0, s0 - back), thickness, step_thickness,
                int2(blocks))) return true;
  }
  return false;
}

bool IsLookedFor(uint2 pixel, float2 size) {
  if (g_ids[pixel].x == 0) return false;
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  if (!(surface.roughness <= constants.roughest)) return false;
  if (constants.half_mask != 0) return marks[(pixel.y / 2) * HalfSize().x + pixel.x / 2] != 0;
  if (constants.march_blocks == 0) return true;
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const ReflectionRay sample =
        SampleReflectionRay(pixel, surface, LengthsOf(constants.screen),
                            pass_constants.first_sample + i, frame.seed);
    if (!sample.exists) continue;
    const ScreenRay ray = MakeScreenRay(surface.origin, sample.direction, sample.length, size);
    if (MayHit(ray, sample.length, size)) return true;
  }
  return false;
}

void StoreReflection(uint2 pixel, bool is_marched, float2 size) {
  ScreenHit hit;
  const float4 sum = ReflectionSum(pixel, constants.screen, is_marched, size, hit);
  reflection[pixel] = SumBefore(reflection, pixel) + sum;
  hits[pixel] = float4(hit.place, hit.distance, float(hit.outcome));
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ClassifyPixels(uint3 id : SV_DispatchThreadID) {
  const uint2 pixel = id.xy;
  const float2 size = PictureSize();
  if (any(float2(pixel) >= size)) return;
  if (!IsLookedFor(pixel, size)) {
    StoreReflection(pixel, false, size);
    return;
  }
  uint place;
  InterlockedAdd(pixel_count[0], 1, place);
  pixels[place] = pixel.x + 65536 * pixel.y;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void CountGroups(uint3 id : SV_DispatchThreadID) {
  groups[0] = (pixel_count[0] + kGroup - 1) / kGroup;
  groups[1] = 1;
  groups[2] = 1;
}

[shader("compute")]
[numthreads(64, 1, 1)]
void MarchPixels(uint3 id : SV_DispatchThreadID) {
  if (id.x >= pixel_count[0]) return;
  const uint packed = pixels[id.x];
  StoreReflection(uint2(packed & 0xFFFF, packed >> 16), true, PictureSize());
}
