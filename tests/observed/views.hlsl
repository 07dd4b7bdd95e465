// SPDX-License-Identifier: MIT
// One resource of each kind, which all tests bind to one view. Texels are asked for at (1, 2, 3) and,
// of arrays, in elements 0 and 1.

RWByteAddressBuffer g_out : register(u0);
cbuffer Constants : register(b0) { uint4 g_constants; }
SamplerState g_point : register(s0, space2);


Texture1D<float> f1 : register(t0, space1);
Texture1DArray<float> f1a : register(t1, space1);
Texture2D<float> f2 : register(t2, space1);
Texture2DArray<float> f2a : register(t3, space1);
Texture3D<float> f3 : register(t4, space1);
TextureCube<float> fc : register(t5, space1);
TextureCubeArray<float> fca : register(t6, space1);
Texture2D<uint> u2 : register(t7, space1);

RWTexture1D<float> w1 : register(u0, space1);
RWTexture1DArray<float> w1a : register(u1, space1);
RWTexture2D<float> w2 : register(u2, space1);
RWTexture2DArray<float> w2a : register(u3, space1);
RWTexture3D<float> w3 : register(u4, space1);
RWTexture2D<uint> wu2 : register(u5, space1);

void put(inout uint at, uint value) {
  g_out.Store(4 * at, value);
  ++at;
}

[shader("compute")] [numthreads(1, 1, 1)]
void Load() {
  uint at = 0;
  put(at, uint(f1.Load(int2(1, 0))));
  put(at, uint(f1a.Load(int3(1, 0, 0))));
  put(at, uint(f1a.Load(int3(1, 1, 0))));
  put(at, uint(f2.Load(int3(1, 2, 0))));
  put(at, uint(f2a.Load(int4(1, 2, 0, 0))));
  put(at, uint(f2a.Load(int4(1, 2, 1, 0))));
  put(at, uint(f3.Load(int4(1, 2, 3, 0))));
  put(at, u2.Load(int3(1, 2, 0)));
}

// Texel (1, 2) of 4 x 4, and the texel (2, 2) of faces +x and -z.
[shader("compute")] [numthreads(1, 1, 1)]
void Sample() {
  const float2 uv = float2(1.5f / 4, 2.5f / 4);
  uint at = 0;
  put(at, uint(f1.SampleLevel(g_point, uv.x, 0)));
  put(at, uint(f1a.SampleLevel(g_point, float2(uv.x, 0), 0)));
  put(at, uint(f1a.SampleLevel(g_point, float2(uv.x, 1), 0)));
  put(at, uint(f2.SampleLevel(g_point, uv, 0)));
  put(at, uint(f2a.SampleLevel(g_point, float3(uv, 0), 0)));
  put(at, uint(f2a.SampleLevel(g_point, float3(uv, 1), 0)));
  put(at, uint(f3.SampleLevel(g_point, float3(uv, 3.5f / 4), 0)));
  put(at, uint(fc.SampleLevel(g_point, float3(1, -0.1f, -0.1f), 0)));
  put(at, uint(fc.SampleLevel(g_point, float3(-0.1f, -0.1f, -1), 0)));
  put(at, uint(fca.SampleLevel(g_point, float4(1, -0.1f, -0.1f, 0), 0)));
  put(at, uint(fca.SampleLevel(g_point, float4(1, -0.1f, -0.1f, 1), 0)));
}

[shader("compute")] [numthreads(1, 1, 1)]
void Size() {
  uint at = 0, x = 0, y = 0, z = 0;
  f1.GetDimensions(x);
  put(at, x);
  f1a.GetDimensions(x, z);
  put(at, 10 * x + z);
  f2.GetDimensions(x, y);
  put(at, 10 * x + y);
  f2a.GetDimensions(x, y, z);
  put(at, 100 * x + 10 * y + z);
  f3.GetDimensions(x, y, z);
  put(at, 100 * x + 10 * y + z);
  fc.GetDimensions(x, y);
  put(at, 10 * x + y);
  fca.GetDimensions(x, y, z);
  put(at, 100 * x + 10 * y + z);
  u2.GetDimensions(x, y);
  put(at, 10 * x + y);
}

// Stores 100, 200, ... through each kind in turn, as g_constants.x says, and reads through it.
[shader("compute")] [numthreads(1, 1, 1)]
void Store() {
  uint at = 0;
  const uint which = g_constants.x;
  if (which == 0) { w1[1] = 100; put(at, uint(w1[1])); }
  if (which == 1) { w1a[uint2(1, 0)] = 200; put(at, uint(w1a[uint2(1, 0)])); }
  if (which == 2) { w1a[uint2(1, 1)] = 300; put(at, uint(w1a[uint2(1, 1)])); }
  if (which == 3) { w2[uint2(1, 2)] = 400; put(at, uint(w2[uint2(1, 2)])); }
  if (which == 4) { w2a[uint3(1, 2, 0)] = 500; put(at, uint(w2a[uint3(1, 2, 0)])); }
  if (which == 5) { w2a[uint3(1, 2, 1)] = 600; put(at, uint(w2a[uint3(1, 2, 1)])); }
  if (which == 6) { w3[uint3(1, 2, 3)] = 700; put(at, uint(w3[uint3(1, 2, 3)])); }
  if (which == 7) { wu2[uint2(1, 2)] = 800; put(at, wu2[uint2(1, 2)]); }
}

// Through the heap itself.
[shader("compute")] [numthreads(1, 1, 1)]
void LoadFromHeap() {
  uint at = 0;
  Texture1D<float> a = ResourceDescriptorHeap[g_constants.x];
  put(at, uint(a.Load(int2(1, 0))));
  Texture1DArray<float> b = ResourceDescriptorHeap[g_constants.x];
  put(at, uint(b.Load(int3(1, 0, 0))));
  put(at, uint(b.Load(int3(1, 1, 0))));
  Texture2D<float> c = ResourceDescriptorHeap[g_constants.x];
  put(at, uint(c.Load(int3(1, 2, 0))));
  Texture2DArray<float> d = ResourceDescriptorHeap[g_constants.x];
  put(at, uint(d.Load(int4(1, 2, 0, 0))));
  put(at, uint(d.Load(int4(1, 2, 1, 0))));
  Texture3D<float> e = ResourceDescriptorHeap[g_constants.x];
  put(at, uint(e.Load(int4(1, 2, 3, 0))));
  Texture2D<uint> f = ResourceDescriptorHeap[g_constants.x];
  put(at, f.Load(int3(1, 2, 0)));
}

[shader("compute")] [numthreads(1, 1, 1)]
void LoadOne() { g_out.Store(0, uint(f2.Load(int3(1, 2, 0)))); }

[shader("compute")] [numthreads(1, 1, 1)]
void StoreOne() { w2[uint2(1, 2)] = 5; }
