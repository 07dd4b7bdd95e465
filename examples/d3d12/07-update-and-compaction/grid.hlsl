// SPDX-License-Identifier: MIT
// Makes the vertices of a square grid from their heights.

ByteAddressBuffer heights : register(t0);
RWByteAddressBuffer vertices : register(u0);
cbuffer Grid : register(b0) {
  uint cells;  // along each side
};

[RootSignature("RootConstants(num32BitConstants = 1, b0), SRV(t0), UAV(u0)")]
[numthreads(8, 8, 1)]
void MakeVertices(uint2 id : SV_DispatchThreadID) {
  if (any(id > cells)) {
    return;
  }
  const uint vertex = id.y * (cells + 1) + id.x;
  const float2 place = 2.0 * float2(id) / float(cells) - 1.0;
  const float height = asfloat(heights.Load(4 * vertex));
  vertices.Store3(12 * vertex, asuint(float3(place.x, height, place.y)));
}
