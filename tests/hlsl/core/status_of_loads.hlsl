// SPDX-License-Identifier: MIT
// FEATURE: core status of loads and samples, CheckAccessFullyMapped
// The value, and 1: every resource is mapped.
// EXPECT u32 0 5 1
// EXPECT u32 8 6 1
// EXPECT u32 16 7 1
// EXPECT u32 24 8 1
// EXPECT u32 32 18 1
// EXPECT f32 40 3 1
// EXPECT f32 48 4 1
// EXPECT f32 56 2 1
// EXPECT f32 64 4 1
// EXPECT u32 72 0
Texture2D<float4> image : register(t0);
TextureCube<float4> sides_cube : register(t5);
Buffer<uint> texels : register(t1);
ByteAddressBuffer raw : register(t2);
struct Item {
  uint a, b;
};
StructuredBuffer<Item> items : register(t3);
RWTexture2D<float4> written : register(u1);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint status = z;
  results.Store(0, texels.Load(5 + z, status));
  results.Store(4, CheckAccessFullyMapped(status) ? 1 : 0);
  status = z;
  results.Store(8, raw.Load(24 + z, status));
  results.Store(12, CheckAccessFullyMapped(status) ? 1 : 0);
  status = 7;
  results.Store(16, raw.Load2(24 + z, status).y);
  results.Store(20, status);
  status = 8 + z;  // read before it is written
  results.Store(24, raw.Load<uint>(status * 4, status));
  results.Store(28, status);
  status = z;
  results.Store(32, items.Load(9 + z, status).a);
  results.Store(36, status);
  status = z;
  results.Store(40, asuint(image.Load(int3(1 + z, 2, 0), int2(2, 0), status).x));
  results.Store(44, asuint((float)status));
  status = z;
  results.Store(48, asuint(image.SampleLevel(point_sampler, float2(0.5, 0.5), z, int2(0, 0), status).y));
  results.Store(52, asuint((float)status));
  status = z;
  results.Store(56, asuint(written.Load(int2(2 + z, 1), status).x));
  results.Store(60, asuint((float)status));
  status = z;
  results.Store(64, asuint(image.Gather(point_sampler, float2(0.5, 0.5), int2(0, 0), status).y));
  results.Store(68, asuint((float)status));
  results.Store(72, CheckAccessFullyMapped(z) ? 1 : 0);
}
