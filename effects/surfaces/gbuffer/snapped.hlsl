// SPDX-License-Identifier: MIT
// For tests: triangles whose vertices lie on the rasterizer's grid of 1/256 pixel, drawn and traced
// along z. Both see the same triangles then, pixel by pixel.

struct Constants {
  float size;  // of the square picture, pixels
};
ConstantBuffer<Constants> constants : register(b0);
RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<uint> traced : register(u0);

// Positions are pixels in x and y, and depth in z.
[shader("vertex")]
float4 GridVertex(float3 position : POSITION) : SV_Position {
  return float4(2.0 * position.x / constants.size - 1.0, 1.0 - 2.0 * position.y / constants.size,
                position.z, 1.0);
}

[shader("pixel")]
uint DrawnTriangle(uint primitive : SV_PrimitiveID) : SV_Target0 {
  return primitive + 1;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void TraceTriangles(uint3 id : SV_DispatchThreadID) {
  RayDesc ray;
  ray.Origin = float3(float2(id.xy) + 0.5, 0.0);
  ray.TMin = 0.0;
  ray.Direction = float3(0.0, 0.0, 1.0);
  ray.TMax = 2.0;
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xFF, ray);
  query.Proceed();
  traced[id.xy] =
      query.CommittedStatus() == COMMITTED_TRIANGLE_HIT ? query.CommittedPrimitiveIndex() + 1 : 0;
}
