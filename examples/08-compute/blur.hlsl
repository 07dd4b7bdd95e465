// SPDX-License-Identifier: MIT
// Two compute shaders: one draws, one blurs rows through groupshared memory.

RWTexture2D<float4> image : register(u0);
RWTexture2D<float4> blurred : register(u1);
cbuffer Constants : register(b0) {
  uint2 size;
  int radius;
};

[shader("compute")]
[numthreads(8, 8, 1)]
void Draw(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= size)) {
    return;
  }
  const float2 p = (float2(id.xy) + 0.5 - 0.5 * float2(size)) / float(size.y);
  const float petals = 0.3 + 0.1 * cos(7.0 * atan2(p.y, p.x));
  const float3 color = length(p) < petals ? float3(0.95, 0.5, 0.1) : float3(0.1, 0.15, 0.3);
  image[id.xy] = float4(color, 1.0);
}

static const int kGroup = 64;
static const int kMaxRadius = 32;
groupshared float3 row[kGroup + 2 * kMaxRadius];

// Each thread loads its pixel, some also a border pixel; after the barrier all of them can be read.
[shader("compute")]
[numthreads(kGroup, 1, 1)]
void BlurRows(uint3 id : SV_DispatchThreadID, uint3 group : SV_GroupID, uint thread : SV_GroupIndex) {
  const int first = int(group.x) * kGroup - kMaxRadius;
  for (int i = int(thread); i < kGroup + 2 * kMaxRadius; i += kGroup) {
    const int x = clamp(first + i, 0, int(size.x) - 1);
    row[i] = image[uint2(x, id.y)].rgb;
  }
  GroupMemoryBarrierWithGroupSync();

  // No blur at the left edge of the picture, the full `radius` at the right one.
  const int reach = min(kMaxRadius, radius * int(id.x) / int(size.x));
  float3 sum = float3(0, 0, 0);
  for (int offset = -reach; offset <= reach; ++offset) {
    sum += row[int(thread) + kMaxRadius + offset];
  }
  if (all(id.xy < size)) {
    blurred[id.xy] = float4(sum / float(2 * reach + 1), 1.0);
  }
}
