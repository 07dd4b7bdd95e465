// SPDX-License-Identifier: MIT
// Ground-truth ambient occlusion: marches over the depth picture in slices through the view ray,
// finds both horizons and integrates the cosine between them in closed form. The defaults are those
// of XeGTAO 1.30. [Jimenez et al. 2016]
#include "horizons.hlsli"
#include "occlusion.hlsli"
#include "sampling.hlsli"

struct GtaoConstants {
  uint filter_passes;  // of occlusion_filter.hlsl, for the host
  uint slices;
  uint steps;               // to each side of a slice
  float radius_multiplier;  // on the radius
  float falloff_range;      // last part of the radius over which occluders fade; 0: a hard end
  float sample_power;       // above 1: more steps near the pixel
  float thin_occluder;      // 0..0.7: occluders deeper than wide count less
  float final_power;        // on visibility, by occlusion_filter.hlsl
  float least;              // visibility, by the same
  float least_pixels;       // that the first step goes
  float level_offset;       // larger: finer levels of the depth picture
  float normal_flattening;  // part by which slices that the normal leaves are made up for
  uint noise;               // 0: the same directions and steps everywhere
  float pull;               // part of its depth by which a pixel moves nearer
  uint half_resolution;     // 1: one of each 2 x 2 pixels is looked at
  uint rotations;           // frames after which the directions of a tile repeat; 0: XeGTAO's noise
  float fresh;              // least weight of a new frame, by occlusion_filter.hlsl; 1: none before
  uint multibounce;         // by the same
  uint bent_normals;        // 1: the mean open direction is found too
};
ConstantBuffer<GtaoConstants> gtao : register(b0, space3);

// Levels 1 to 4 of the depth picture; level 0 is g_view_z.
static const uint kLevels = 4;
RWTexture2D<float> depths[kLevels] : register(u8, space3);

// Returns the part of an occluder at that distance that counts.
float Falloff(float distance, float radius) {
  if (!(gtao.falloff_range > 0.0)) return distance <= radius ? 1.0 : 0.0;
  return saturate((radius - distance) / (gtao.falloff_range * radius));
}

float DepthAt(int2 pixel, uint level) {
  if (level == 0) return g_view_z[pixel];
  // A picture of odd size loses its last row or column with every level.
  uint width, height;
  depths[level - 1].GetDimensions(width, height);
  return depths[level - 1][min(pixel >> level, int2(width, height) - 1)];
}

// One level of the depth picture from the one before. What is much nearer than the farthest of four
// counts less: it would occlude what it does not reach. [XeGTAO: DepthMIPFilter]
void Shrink(int2 pixel, uint level) {
  uint width, height;
  depths[level - 1].GetDimensions(width, height);
  if (!IsInside(pixel, int2(width, height))) return;
  const float radius = 0.75 * Radius() * gtao.radius_multiplier;
  float z[4];
  float farthest = 0.0;
  for (uint i = 0; i < 4; ++i) {
    const int2 source = 2 * pixel + int2(i & 1u, i >> 1u);
    z[i] = level == 1 ? g_view_z[source] : depths[max(level, 2u) - 2][source];
    if (IsSurface(z[i])) farthest = max(farthest, z[i]);
  }
  float sum = 0.0;
  float weights = 0.0;
  for (uint k = 0; k < 4; ++k) {
    if (!IsSurface(z[k])) continue;
    const float weight = Falloff(farthest - z[k], radius);
    sum += weight * z[k];
    weights += weight;
  }
  depths[level - 1][pixel] = weights > 0.0 ? sum / weights : 0.0;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ShrinkDepth1(uint3 id : SV_DispatchThreadID) { Shrink(int2(id.xy), 1); }
[shader("compute")]
[numthreads(8, 8, 1)]
void ShrinkDepth2(uint3 id : SV_DispatchThreadID) { Shrink(int2(id.xy), 2); }
[shader("compute")]
[numthreads(8, 8, 1)]
void ShrinkDepth3(uint3 id : SV_DispatchThreadID) { Shrink(int2(id.xy), 3); }
[shader("compute")]
[numthreads(8, 8, 1)]
void ShrinkDepth4(uint3 id : SV_DispatchThreadID) { Shrink(int2(id.xy), 4); }

// Returns how far along a Hilbert curve over 64 x 64 pixels a pixel is.
uint HilbertIndex(uint2 pixel) {
  uint x = pixel.x & 63u;
  uint y = pixel.y & 63u;
  uint index = 0;
  for (uint half_side = 32; half_side > 0; half_side /= 2) {
    const uint right = (x & half_side) > 0 ? 1 : 0;
    const uint down = (y & half_side) > 0 ? 1 : 0;
    index += half_side * half_side * ((3u * right) ^ down);
    if (down == 0) {
      if (right == 1) {
        x = 63u - x;
        y = 63u - y;
      }
      const uint swapped = x;
      x = y;
      y = swapped;
    }
  }
  return index;
}

// Numbers in 0..1 for the direction and the steps: the R2 sequence along the curve, another part of
// it in each of 64 frames. Or a small tile's, turned from frame to frame.
float2 Noise(int2 block) {
  if (gtao.noise == 0) return float2(0.0, 0.5);
  if (gtao.rotations != 0) return RotatedNoise(block, gtao.rotations);
  const uint index = HilbertIndex(uint2(block)) + 288u * (frame.frame_index % 64u);
  return frac(0.5 + float(index) * float2(0.75487766624669276, 0.569840290998));
}

// Returns the horizon's cosine as a sample raises it.
float RaisedHorizon(float cosine, float low, int2 pixel, uint level, float3 centre,
                    float3 to_camera, float radius, int2 size) {
  if (!IsInside(pixel, size)) return cosine;
  const float view_z = DepthAt(pixel, level);
  if (!IsSurface(view_z)) return cosine;
  const float3 delta = ViewPosition(pixel, view_z, size) - centre;
  const float distance = length(delta);
  if (distance < 1e-6 * centre.z) return cosine;
  const float3 flat = float3(delta.xy, delta.z * (1.0 + gtao.thin_occluder));
  const float weight = Falloff(length(flat), radius);
  return max(cosine, lerp(low, dot(delta, to_camera) / distance, weight));
}

[shader("compute")]
[numthreads(8, 8, 1)]
void GroundTruthOcclusion(uint3 id : SV_DispatchThreadID) {
  const int2 block = int2(id.xy);
  const int2 size = PictureSize();
  const int step_pixels = gtao.half_resolution != 0 ? 2 : 1;
  if (!IsInside(block, Blocks(size, step_pixels))) return;
  const int2 pixel = PixelOfBlock(block, step_pixels, gtao.fresh < 1.0, size);
  const float view_z = g_view_z[pixel];
  const float radius = Radius() * gtao.radius_multiplier;
  if (!IsSurface(view_z) || !(radius > 0.0)) {
    raw[pixel] = 1.0;
    if (gtao.bent_normals != 0) raw_bent[pixel] = float4(0, 0, 0, 0);
    return;
  }
  // A little nearer, so that rounding does not make a surface occlude itself.
  const float3 centre = ViewPosition(pixel, view_z * (1.0 - gtao.pull), size);
  const float3 to_camera = ToCamera(centre);
  const float3 normal = ViewNormal(g_shading_normal[pixel], to_camera);
  const ViewBasis basis = MakeViewBasis(to_camera);
  const float2 noise = Noise(block);
  const uint slices = max(gtao.slices, 1u);
  const float most_pixels = length(float2(size));
  float visibility = 0.0;
  float3 bent = float3(0, 0, 0);
  for (uint slice = 0; slice < slices; ++slice) {
    const float phi = 0.5 * kTwoPi * (float(slice) + noise.x) / float(slices);
    const float3 direction = cos(phi) * basis.right + sin(phi) * basis.up;
    const float2 per_metre = PixelsPerMetre(centre, direction, size);
    const float2 way = normalize(per_metre);
    const float reach = min(radius * length(per_metre), most_pixels);
    const SliceNormal projected = ProjectNormal(normal, direction, to_camera);
    // Where nothing occludes, the horizons are where the surface ends.
    const float low0 = cos(projected.gamma - kHalfPi);
    const float low1 = cos(projected.gamma + kHalfPi);
    float cosine0 = low0;
    float cosine1 = low1;
    for (uint i = 0; i < gtao.steps && reach >= gtao.least_pixels; ++i) {
      // Every step of every slice is somewhere else. [Roberts 2018: the golden ratio]
      const float shift = float(slice + i * gtao.steps) * 0.6180339887498948482;
      const float jitter = gtao.noise != 0 ? frac(noise.y + shift) : noise.y;
      const float part = pow((float(i) + jitter) / float(gtao.steps), gtao.sample_power);
      const float along = part * reach + gtao.least_pixels;
      const int2 step = int2(round(along * way));
      const int level = int(clamp(log2(along) - gtao.level_offset, 0.0, float(kLevels)));
      cosine0 = RaisedHorizon(cosine0, low0, pixel - step, uint(level), centre, to_camera, radius, size);
      cosine1 = RaisedHorizon(cosine1, low1, pixel + step, uint(level), centre, to_camera, radius, size);
    }
    const float weight = lerp(projected.length, 1.0, gtao.normal_flattening);
    const float h0 = -SafeAcos(cosine0);
    const float h1 = SafeAcos(cosine1);
    visibility += weight * SliceVisibility(h0, h1, projected.gamma);
    if (gtao.bent_normals == 0) continue;
    const float2 bend = weight * SliceBend(h0, h1, projected.gamma);
    bent += bend.x * direction + bend.y * to_camera;
  }
  // On an open plane that is seen aslant one slice is above 1 and another below: only their mean is
  // a visibility. What is done to that is done behind the filter.
  raw[pixel] = visibility / float(slices);
  if (gtao.bent_normals != 0) raw_bent[pixel] = float4(bent / float(slices), 0.0);
}
