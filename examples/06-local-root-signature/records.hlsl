// SPDX-License-Identifier: MIT
// A hit group's record holds root constants as a constant buffer, and the addresses of the
// geometry's own vertices and indices.

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);

struct Vertex {
  float3 position;
  float3 normal;
};
struct Material {
  float3 color;
  float roughness;
};

// Each record binds other data to the same three registers.
StructuredBuffer<Vertex> vertices : register(t0, space1);
ByteAddressBuffer indices : register(t1, space1);
ConstantBuffer<Material> material : register(b0, space1);

struct Payload {
  float3 color;
};

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = float3(0, 0.6, -6);
  ray.Direction = normalize(float3(uv.x * size.x / size.y, -uv.y - 0.2, 2.4));
  ray.TMin = 0.0;
  ray.TMax = 1000.0;
  Payload payload = { float3(0, 0, 0) };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  image[pixel] = float4(pow(saturate(payload.color), 1.0 / 2.2), 1.0);
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.color = float3(0.75, 0.77, 0.8);
}

[shader("closesthit")]
void ClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const uint3 triangle_indices = indices.Load3(PrimitiveIndex() * 12);
  const float3 weights = float3(1.0 - hit.barycentrics.x - hit.barycentrics.y, hit.barycentrics);
  float3 normal = vertices[triangle_indices.x].normal * weights.x +
                  vertices[triangle_indices.y].normal * weights.y +
                  vertices[triangle_indices.z].normal * weights.z;
  normal = normalize(mul((float3x3)ObjectToWorld3x4(), normal));

  const float3 to_light = normalize(float3(-0.5, 0.8, -0.7));
  const float3 halfway = normalize(to_light - WorldRayDirection());
  const float power = 2.0 / (material.roughness * material.roughness);
  const float diffuse = 0.15 + 0.85 * saturate(dot(normal, to_light));
  const float specular = pow(saturate(dot(normal, halfway)), power);
  payload.color = material.color * diffuse + specular * 0.6;
}
