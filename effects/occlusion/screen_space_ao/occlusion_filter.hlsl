// SPDX-License-Identifier: MIT
// What follows the search for occluders: the mean of 4 x 4 pixels, which sees every pixel of the tile
// of noise once, or of 5 x 5, both without what lies at another depth; from one of 2 x 2 pixels to
// all; the mean over frames. [Mittring 2007; Jimenez et al. 2016]
#include "horizons.hlsli"
#include "occlusion.hlsli"

struct FilterConstants {
  int before;       // pixels that the filter reaches to the left and up
  int behind;       // to the right and down
  uint edge_aware;  // 0: blurs over edges
  uint from;        // 0: reads raw, 1: reads filtered
  uint to;          // 0: writes raw, 1: writes filtered, 2: writes the result
  float power;      // on the result
  float least;      // of the result
  int step;         // 2: only one of each 2 x 2 pixels was looked at, and counts here
  uint takes_turns;  // which one: another in each of four frames
  uint multibounce;  // 1: the result has light of occluders too
  uint bent;         // 1: bent normals go the same way
  float fresh;       // AccumulateOcclusion: least weight of the new frame
  uint has_history;  // 0: there is no frame before
};
ConstantBuffer<FilterConstants> filter : register(b0, space3);

// Of the surface in world space; where nothing is open, its normal.
RWTexture2D<float4> bent_normal : register(u3, space3);
// The mean over frames, of the frame before and up to this one. x: visibility, y: frames, z: view
// depth (0: sky), w: instance.
RWTexture2D<float4> before : register(u6, space3);
RWTexture2D<float4> now : register(u7, space3);
RWTexture2D<float4> bent_before : register(u12, space3);
RWTexture2D<float4> bent_now : register(u13, space3);

// Change of the depth from one pixel to the next, by the side where it changes less.
float Slope(int2 pixel, int2 axis, float view_z, int2 size) {
  const float behind = IsInside(pixel - axis, size) ? g_view_z[pixel - axis] : 0.0;
  const float ahead = IsInside(pixel + axis, size) ? g_view_z[pixel + axis] : 0.0;
  const bool has_behind = IsSurface(behind);
  const bool has_ahead = IsSurface(ahead);
  if (has_behind && (!has_ahead || abs(view_z - behind) < abs(ahead - view_z))) return view_z - behind;
  return has_ahead ? ahead - view_z : 0.0;
}

float2 Gradient(int2 pixel, float view_z, int2 size) {
  return float2(Slope(pixel, int2(1, 0), view_z, size), Slope(pixel, int2(0, 1), view_z, size));
}

// Off the plane of this pixel by a hundredth of the depth: another surface. [XeGTAO: edges]
float SameSurface(float view_z, float2 gradient, float other_z, int2 offset) {
  const float off = abs(other_z - view_z - dot(gradient, float2(offset)));
  return saturate(1.25 - off / (0.011 * view_z));
}

// A pixel's value: visibility in w, the mean open direction in xyz.
static const float4 kOpen = float4(0, 0, 0, 1);

float4 Load(int2 pixel) {
  float4 value = float4(0, 0, 0, filter.from == 0 ? raw[pixel] : filtered[pixel]);
  if (filter.bent != 0) {
    value.xyz = filter.from == 0 ? raw_bent[pixel].xyz : filtered_bent[pixel].xyz;
  }
  return value;
}

void StoreResult(int2 pixel, float4 value) {
  const float visibility = max(pow(saturate(value.w), filter.power), filter.least);
  float3 lit = float3(visibility, visibility, visibility);
  if (filter.multibounce != 0) {
    const float3 diffuse = DecodeColor(g_base_color[pixel].rgb) * (1.0 - g_material[pixel].y);
    lit = MultiBounce(visibility, diffuse);
  }
  result[pixel] = float4(lit, 1.0);
  if (filter.bent == 0) return;
  float3 normal = OctahedralDecode(g_shading_normal[pixel]);
  if (dot(value.xyz, value.xyz) > 1e-12) {
    normal = normalize(value.x * frame.over_right * frame.camera_right +
                       value.y * frame.over_up * frame.camera_up + value.z * frame.camera_forward);
  }
  bent_normal[pixel] = float4(normal, 0.0);
}

void Store(int2 pixel, float4 value) {
  if (filter.to == 2) {
    StoreResult(pixel, value);
    return;
  }
  if (filter.to == 0) raw[pixel] = value.w;
  if (filter.to == 1) filtered[pixel] = value.w;
  if (filter.bent == 0) return;
  if (filter.to == 0) raw_bent[pixel] = float4(value.xyz, 0.0);
  if (filter.to == 1) filtered_bent[pixel] = float4(value.xyz, 0.0);
}

// A thread for each pixel that was looked at.
[shader("compute")]
[numthreads(8, 8, 1)]
void FilterOcclusion(uint3 id : SV_DispatchThreadID) {
  const int2 block = int2(id.xy);
  const int2 size = PictureSize();
  const int2 blocks = Blocks(size, filter.step);
  if (!IsInside(block, blocks)) return;
  const bool takes_turns = filter.takes_turns != 0;
  const int2 pixel = PixelOfBlock(block, filter.step, takes_turns, size);
  const float view_z = g_view_z[pixel];
  float4 value = kOpen;
  if (IsSurface(view_z)) {
    const float2 gradient = Gradient(pixel, view_z, size);
    float4 sum = float4(0, 0, 0, 0);
    float weights = 0.0;
    for (int y = -filter.before; y <= filter.behind; ++y) {
      for (int x = -filter.before; x <= filter.behind; ++x) {
        const int2 other_block = block + int2(x, y);
        if (!IsInside(other_block, blocks)) continue;
        const int2 other = PixelOfBlock(other_block, filter.step, takes_turns, size);
        const float other_z = g_view_z[other];
        if (!IsSurface(other_z)) continue;
        const float weight = filter.edge_aware != 0
                                 ? SameSurface(view_z, gradient, other_z, other - pixel)
                                 : 1.0;
        sum += weight * Load(other);
        weights += weight;
      }
    }
    value = sum / weights;
  }
  Store(pixel, value);
}

// From the pixels that were looked at to all of them: between the four around each, as far as they
// show the same surface. [Kopf et al. 2007]
[shader("compute")]
[numthreads(8, 8, 1)]
void UpscaleOcclusion(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = PictureSize();
  if (!IsInside(pixel, size)) return;
  const float view_z = g_view_z[pixel];
  if (!IsSurface(view_z)) {
    Store(pixel, kOpen);
    return;
  }
  const bool takes_turns = filter.takes_turns != 0;
  const float2 gradient = Gradient(pixel, view_z, size);
  const float2 place = float2(pixel - PlaceInBlock(takes_turns)) / float(filter.step);
  const float2 corner = floor(place);
  const float2 part = place - corner;
  float4 sum = 1e-9 * kOpen;
  float weights = 1e-9;
  for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const int2 block = clamp(int2(corner) + offset, int2(0, 0), Blocks(size, filter.step) - 1);
    const int2 other = PixelOfBlock(block, filter.step, takes_turns, size);
    const float other_z = g_view_z[other];
    if (!IsSurface(other_z)) continue;
    const float by_place = (offset.x == 1 ? part.x : 1.0 - part.x) *
                           (offset.y == 1 ? part.y : 1.0 - part.y);
    // Where none of them shows the surface, the others are better than nothing.
    const float weight = (by_place + 1e-3) *
                         (SameSurface(view_z, gradient, other_z, other - pixel) + 1e-4);
    sum += weight * Load(other);
    weights += weight;
  }
  Store(pixel, sum / weights);
}

// What a pixel's surface had in the frame before; frames 0: it was not seen, or was another one.
struct History {
  float4 value;
  float frames;
};

History FindHistory(int2 pixel, float view_z, float2 gradient, int2 size) {
  History found;
  found.value = float4(0, 0, 0, 0);
  found.frames = 0.0;
  const float4 motion = g_motion[pixel];
  if (filter.has_history == 0 || !all(isfinite(motion.xyz))) return found;
  const float2 place = float2(pixel) + motion.xy * float2(size);
  // Far outside the picture, the conversion to integers would overflow.
  if (any(place < float2(-1, -1)) || any(place > float2(size))) return found;
  const float expected_z = view_z + motion.z;
  const float tolerance = 2.0 * (abs(gradient.x) + abs(gradient.y)) + 0.01 * expected_z;
  const float2 corner = floor(place);
  const float2 part = place - corner;
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const int2 tap = int2(corner) + offset;
    if (!IsInside(tap, size)) continue;
    const float4 old = before[tap];
    if (!(old.z > 0.0) || old.w != float(g_ids[pixel].x)) continue;
    if (!(abs(old.z - expected_z) <= tolerance) || !isfinite(old.x)) continue;
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    found.value.w += weight * old.x;
    found.frames += weight * old.y;
    if (filter.bent != 0) found.value.xyz += weight * bent_before[tap].xyz;
    weights += weight;
  }
  // A hundredth of a pixel is rounding error, not history.
  if (weights < 0.01) {
    found.frames = 0.0;
    return found;
  }
  found.value /= weights;
  found.frames /= weights;
  return found;
}

// The mean over frames, where surfaces are now: of all of them at first, later each new one has the
// weight `fresh`.
[shader("compute")]
[numthreads(8, 8, 1)]
void AccumulateOcclusion(uint3 id : SV_DispatchThreadID) {
  const int2 pixel = int2(id.xy);
  const int2 size = PictureSize();
  if (!IsInside(pixel, size)) return;
  const float view_z = g_view_z[pixel];
  if (!IsSurface(view_z)) {
    now[pixel] = float4(0, 0, 0, 0);
    StoreResult(pixel, kOpen);
    return;
  }
  const History found = FindHistory(pixel, view_z, Gradient(pixel, view_z, size), size);
  const float frames = min(found.frames, 1e4) + 1.0;
  const float weight = max(saturate(filter.fresh), 1.0 / frames);
  const float4 value = lerp(found.value, Load(pixel), weight);
  now[pixel] = float4(value.w, frames, view_z, float(g_ids[pixel].x));
  if (filter.bent != 0) bent_now[pixel] = float4(value.xyz, 0.0);
  StoreResult(pixel, value);
}
