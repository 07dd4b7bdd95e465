// SPDX-License-Identifier: MIT
// FEATURE: extended Texture2DMS, Texture2DMSArray, RWTexture2DMS, RWTexture2DMSArray
// EXPECT u32 0 1
// EXPECT f32 4 0 0 0
// EXPECT u32 16 7
Texture2DMS<float4> colors : register(t1);
Texture2DMS<float3, 4> colors_of_4 : register(t2);
Texture2DMSArray<uint2> pages : register(t3);
RWTexture2DMS<float, 2> target : register(u1);
RWTexture2DMSArray<int, 8> targets : register(u2);
Texture2DMS<float> unused : register(t4);
RWByteAddressBuffer results : register(u0);

static float3 seen = 0;

float3 all_uses(int2 at, uint index) {
  uint width, height, elements, samples, status;
  float float_width, float_height, float_samples;
  colors.GetDimensions(width, height, samples);
  colors.GetDimensions(float_width, float_height, float_samples);
  pages.GetDimensions(width, height, elements, samples);
  targets.GetDimensions(width, height, elements, samples);
  float3 sum = colors.Load(at, index).rgb + colors_of_4.Load(at, 0, int2(1, 0));
  sum += colors_of_4.Load(at, 0, int2(1, 0), status) + colors_of_4[uint2(at)];
  sum.xy += pages.Load(int3(at, 0), 3) + pages.sample[index][uint3(at, 1)];
  sum.xy += colors.GetSamplePosition(1) + target.GetSamplePosition(index);
  sum += colors.sample[3][uint2(at)].xyz;
  target[uint2(at)] = sum.x;
  target.sample[1][uint2(at)] = target.Load(at, 1) + target.Load(at, 1, status);
  targets.sample[index][uint3(at, 2)] = 3;
  targets[uint3(at, 2)] += 2;
  return sum + status;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z != 0) seen = all_uses(int2(z, z), z);
  results.Store(0, z + 1);
  results.Store3(4, asuint(seen));
  Texture2DMS<float4> chosen = colors;
  results.Store(16, z == 0 ? 7 : uint(chosen.Load(int2(0, 0), 0).x));
}
