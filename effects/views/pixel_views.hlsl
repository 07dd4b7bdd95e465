// SPDX-License-Identifier: MIT
// Views of what a frame holds for each pixel: structures, clusters, the denoiser's memory, the
// volume of indirect light.
#include "hit_lighting.hlsli"
#include "indirect_volume.hlsli"

RWTexture2D<float4> numbers : register(u0, space3);
// The memory of the denoiser of light: first and second moment of the luminance, frames of history,
// instance. That of visibility: visibility over time, frames of history.
RWTexture2D<float4> moments : register(u1, space3);
// By instance: which bottom level it stands on, + 1.
StructuredBuffer<uint> bottom_levels : register(t3, space3);
// The corners of each instance's box, eight each, relative to the camera. Bits 0 to 2 of a corner's
// number tell on which side it is along x, y and z.
StructuredBuffer<float4> box_corners : register(t4, space3);

struct ViewConstants {
  uint count;  // of instances, or of samples per frame
};
ConstantBuffer<ViewConstants> constants : register(b0, space3);

uint2 SizeOf(RWTexture2D<float4> picture) {
  uint width, height;
  picture.GetDimensions(width, height);
  return uint2(width, height);
}

// Bottom level + 1, instance + 1, primitive, and 1 on the edge of a box [BoxOutlines].
[shader("compute")]
[numthreads(8, 8, 1)]
void BottomLevels(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= SizeOf(numbers))) return;
  const uint2 ids = g_ids[id.xy];
  numbers[id.xy] = ids.x == 0 ? float4(0, 0, 0, 0)
                              : float4(float(bottom_levels[ids.x - 1]), float2(ids), 0);
}

// The part of 0..1 in which a + t * d stays within 0..size is cut down to what remains of it.
void CutToPicture(float a, float d, float size, inout float from, inout float to) {
  if (d == 0.0) {
    if (a < 0.0 || a >= size) to = -1.0;
    return;
  }
  const float t0 = -a / d;
  const float t1 = (size - a) / d;
  from = max(from, min(t0, t1));
  to = min(to, max(t0, t1));
}

static const float kSameDepth = 0.02;  // how far behind a surface an edge still shows, of its depth

// One thread per edge: x is the edge of a box, y the instance. Edges behind surfaces are left out.
// Threads that meet at a pixel write the same.
[shader("compute")]
[numthreads(8, 8, 1)]
void BoxOutlines(uint3 id : SV_DispatchThreadID) {
  if (id.x >= 12 || id.y >= constants.count) return;
  // Edge e runs along axis e / 4, between two corners that differ in that bit.
  const uint axis = id.x / 4;
  const uint low = (1u << axis) - 1;
  const uint side = id.x % 4;
  const uint corner = (side & low) | ((side & ~low) << 1);
  float3 a = box_corners[id.y * 8 + corner].xyz;
  float3 b = box_corners[id.y * 8 + (corner | (1u << axis))].xyz;
  const float z_a = dot(a, frame.camera_forward);
  const float z_b = dot(b, frame.camera_forward);
  if (!(max(z_a, z_b) > frame.near_plane)) return;
  const float3 along = b - a;
  if (z_a < frame.near_plane) a += along * ((frame.near_plane - z_a) / (z_b - z_a));
  if (z_b < frame.near_plane) b -= along * ((frame.near_plane - z_b) / (z_a - z_b));

  const uint2 pixels = SizeOf(numbers);
  const float2 size = float2(pixels);
  float depth_a, depth_b;
  const float2 start = size * PictureUv(a, frame.camera_right, frame.over_right, frame.camera_up,
                                        frame.over_up, frame.camera_forward, depth_a);
  const float2 end = size * PictureUv(b, frame.camera_right, frame.over_right, frame.camera_up,
                                      frame.over_up, frame.camera_forward, depth_b);
  const float2 way = end - start;
  float from = 0.0;
  float to = 1.0;
  CutToPicture(start.x, way.x, size.x, from, to);
  CutToPicture(start.y, way.y, size.y, from, to);
  if (!(from <= to)) return;
  const uint steps = uint(ceil(max(abs(way.x), abs(way.y)) * (to - from))) + 1;
  for (uint i = 0; i <= steps; ++i) {
    const float t = lerp(from, to, float(i) / float(steps));
    const int2 pixel = clamp(int2(start + t * way), int2(0, 0), int2(pixels) - 1);
    // 1 / depth runs straight over the picture, or depth where the camera's rays are parallel.
    const float depth = frame.is_orthographic != 0 ? lerp(depth_a, depth_b, t)
                                                   : 1.0 / lerp(1.0 / depth_a, 1.0 / depth_b, t);
    const float surface = g_view_z[pixel];
    if (surface > 0.0 && depth > surface * (1.0 + kSameDepth)) continue;
    numbers[pixel] = float4(numbers[pixel].xyz, 1);
  }
}

// Lights of the pixel's cluster, the cluster, and 1 where more lights than a list holds made it all
// lights of the scene.
[shader("compute")]
[numthreads(8, 8, 1)]
void LightClusters(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= SizeOf(numbers))) return;
  numbers[id.xy] = float4(0, 0, 0, 0);
  if (g_ids[id.xy].x == 0) return;
  const float3 position = g_position[id.xy].xyz;
  const ClusterRange range = ClusterLights(position);
  numbers[id.xy] = float4(float(range.count), float(ClusterOf(position)),
                          range.first == kClusterOverflow ? 1.0 : 0.0, 0);
}

static const float kEnoughFrames = 4.0;  // as svgf.hlsl
static const int kReach = 3;             // pixels

// The variance of the luminance over time; while there are too few frames for that, over 7 x 7
// pixels of the same instance, raised as SVGF does it. Then its root, the mean of the luminance,
// and the frames. [Schied et al. 2017, Spatiotemporal Variance-Guided Filtering]
[shader("compute")]
[numthreads(8, 8, 1)]
void Variance(uint3 id : SV_DispatchThreadID) {
  const int2 size = int2(SizeOf(numbers));
  const int2 pixel = int2(id.xy);
  if (any(pixel >= size)) return;
  numbers[pixel] = float4(0, 0, 0, 0);
  if (g_ids[pixel].x == 0) return;
  const float4 own = moments[pixel];
  float2 sum = own.xy;
  float scale = 1.0;
  if (own.z < kEnoughFrames) {
    float count = 1.0;
    for (int y = -kReach; y <= kReach; ++y) {
      for (int x = -kReach; x <= kReach; ++x) {
        const int2 other = pixel + int2(x, y);
        if (all(other == pixel) || any(other < int2(0, 0)) || any(other >= size)) continue;
        if (g_ids[other].x != g_ids[pixel].x) continue;
        sum += moments[other].xy;
        count += 1.0;
      }
    }
    sum /= count;
    scale = kEnoughFrames / max(own.z, 1.0);
  }
  const float variance = max(sum.y - sum.x * sum.x, 0.0) * scale;
  numbers[pixel] = float4(variance, sqrt(variance), sum.x, own.z);
}

// The same of visibility: of the mean of a frame's samples, if they were drawn one by one.
[shader("compute")]
[numthreads(8, 8, 1)]
void VisibilityVariance(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= SizeOf(numbers))) return;
  numbers[id.xy] = float4(0, 0, 0, 0);
  if (g_ids[id.xy].x == 0) return;
  const float mean = moments[id.xy].x;
  const float variance = max(mean - mean * mean, 0.0) / float(max(constants.count, 1u));
  numbers[id.xy] = float4(variance, sqrt(variance), mean, moments[id.xy].y);
}

// Frames that stand behind the pixel.
[shader("compute")]
[numthreads(8, 8, 1)]
void HistoryLength(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= SizeOf(numbers))) return;
  const float frames = g_ids[id.xy].x == 0 ? 0.0 : moments[id.xy].z;
  numbers[id.xy] = float4(frames, 0, 0, 0);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void VisibilityHistory(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= SizeOf(numbers))) return;
  const float frames = g_ids[id.xy].x == 0 ? 0.0 : moments[id.xy].y;
  numbers[id.xy] = float4(frames, 0, 0, 0);
}

// Finds where a surface reads the volume: the level (-1: nothing is stored there), the cell's place
// among all cells, the size of cells in metres, and 1 if the cell lies in a solid.
// [VolumeIrradianceAt]
[shader("compute")]
[numthreads(8, 8, 1)]
void VolumeCells(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= SizeOf(numbers))) return;
  numbers[id.xy] = float4(-1, 0, 0, 0);
  const VolumeConstants volume = volume_constants[0];
  if (g_ids[id.xy].x == 0 || volume.enabled == 0) return;
  const float3 position =
      g_position[id.xy].xyz + OctahedralDecode(g_normal[id.xy]) * (0.5 * volume.cell);
  const float3 at = (position - volume.origin) * volume.over_cell;
  if (any(abs(at) > kFarthestCell)) return;
  const uint3 cell = uint3(int3(floor(at)));
  const uint brick = FindBrick(cell, volume.bricks);
  if (brick == kNoBrick) return;
  const uint3 place = (cell >> BrickLevel(brick)) % kBrickCells;
  const uint index =
      (brick & ~kBrickLevelBits) + place.x + kBrickCells * (place.y + kBrickCells * place.z);
  numbers[id.xy] = float4(float(BrickLevel(brick)), float(index),
                          volume.cell * BrickCellSize(brick),
                          IsInSolid(LoadVolumeCell(brick, cell)) ? 1.0 : 0.0);
}
