// SPDX-License-Identifier: MIT
// The G-buffer: one ray through the centre of each pixel, attributes of what it hits.
// [effects-spec B0.2]
#include "alpha_test.hlsli"

struct SurfacePayload {
  uint unused;  // hit and miss write the pictures themselves
};

[shader("raygeneration")]
void GBufferRayGen() {
  const uint2 pixel = FramePixel();
  uint width, height;
  g_view_z.GetDimensions(width, height);
  const float2 ndc = (float2(pixel) + 0.5) / float2(width, height) * 2.0 - 1.0;
  // Not normalised: one step along it is one metre along the camera's axis, so that the ray's t is
  // the view depth.
  RayDesc ray;
  ray.Origin = float3(0, 0, 0);
  ray.TMin = 0.0;
  ray.Direction = frame.camera_forward + ndc.x * frame.camera_right - ndc.y * frame.camera_up;
  ray.TMax = 1e30;
  SurfacePayload payload;
  payload.unused = 0;
  TraceRay(scene, RAY_FLAG_NONE, kMaskSolid, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
           payload);
}

[shader("miss")]
void GBufferMiss(inout SurfacePayload payload) {
  const uint2 pixel = FramePixel();
  g_depth[pixel] = 0.0;  // reversed-Z: infinitely far
  g_view_z[pixel] = 0.0;
  g_normal[pixel] = float2(0, 0);
  g_shading_normal[pixel] = float2(0, 0);
  g_base_color[pixel] = float4(0, 0, 0, 0);
  g_emissive[pixel] = float4(0, 0, 0, 0);
  g_material[pixel] = float4(0, 0, 0, 0);
  g_ids[pixel] = uint2(0, 0);
  g_position[pixel] = float4(0, 0, 0, 0);
}

[shader("anyhit")]
void GBufferAnyHit(inout SurfacePayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

// A texture of the material, or 1 where it has none. `lod` is that of a texture of one texel.
float4 SampleMaterial(MaterialConstants material, uint slot, float2 uv, float lod) {
  if (!HasTexture(material, slot)) {
    return float4(1, 1, 1, 1);
  }
  const uint image = material.image[slot];
  const uint sampler_id = material.sampler_id[slot];
  uint width, height, mips;
  textures[NonUniformResourceIndex(image)].GetDimensions(0, width, height, mips);
  return textures[NonUniformResourceIndex(image)].SampleLevel(
      samplers[NonUniformResourceIndex(sampler_id)], MaterialUv(material, slot, uv),
      max(lod + 0.5 * log2(float(width) * float(height)), 0.0));
}

// Level of detail for a texture of one texel: how large the pixel is on the surface, against how
// much of the texture the triangle spreads over its area. [Akenine-Moller et al. 2019, ray cones]
float RayConeLod(float3 p0, float3 p1, float3 p2, float2 uv0, float2 uv1, float2 uv2, float facing) {
  const float3x3 to_world = (float3x3)ObjectToWorld3x4();
  const float world_area = length(cross(mul(to_world, p1 - p0), mul(to_world, p2 - p0)));
  const float2 a = uv1 - uv0;
  const float2 b = uv2 - uv0;
  const float uv_area = abs(a.x * b.y - a.y * b.x);
  const float distance = RayTCurrent() * length(WorldRayDirection());
  return 0.5 * log2(max(uv_area, 1e-20) / max(world_area, 1e-20)) +
         log2(max(distance * frame.pixel_angle, 1e-20) / max(facing, 0.05));
}

[shader("closesthit")]
void GBufferClosestHit(inout SurfacePayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const uint2 pixel = FramePixel();
  const HitConstants layout = hit_constants;
  const MaterialConstants material = materials[layout.material_id];
  const uint3 corners = LoadTriangle(indices, layout.index_size_bytes, PrimitiveIndex());
  const float3 p0 = LoadVertexFloat3(vertices, layout.vertex_stride, 0, corners.x);
  const float3 p1 = LoadVertexFloat3(vertices, layout.vertex_stride, 0, corners.y);
  const float3 p2 = LoadVertexFloat3(vertices, layout.vertex_stride, 0, corners.z);
  const float2 uv0 = LoadVertexFloat2(vertices, layout.vertex_stride, layout.uv_offset, corners.x);
  const float2 uv1 = LoadVertexFloat2(vertices, layout.vertex_stride, layout.uv_offset, corners.y);
  const float2 uv2 = LoadVertexFloat2(vertices, layout.vertex_stride, layout.uv_offset, corners.z);
  const float2 uv = Interpolate(uv0, uv1, uv2, hit.barycentrics);
  const SpawnPoint spawn =
      MakeSpawnPoint(p0, p1, p2, hit.barycentrics, ObjectToWorld3x4(), WorldToObject3x4());

  // Everything is seen from the side that the camera is on.
  const float3 direction = normalize(WorldRayDirection());
  const float side = dot(direction, spawn.normal) <= 0.0 ? 1.0 : -1.0;
  const float3 normal = side * spawn.normal;
  const float lod = RayConeLod(p0, p1, p2, uv0, uv1, uv2, abs(dot(direction, spawn.normal)));

  float3 shading_normal =
      NormalToWorld(LoadNormal(vertices, layout, corners, hit.barycentrics), WorldToObject3x4());
  if (HasTexture(material, kNormalTexture)) {
    const float4 tangent = LoadTangent(vertices, layout, corners, hit.barycentrics);
    const float3 world_tangent = normalize(mul((float3x3)ObjectToWorld3x4(), tangent.xyz));
    shading_normal =
        ApplyNormalTexture(SampleMaterial(material, kNormalTexture, uv, lod).xyz,
                           material.normal_scale, shading_normal, world_tangent, tangent.w);
  }
  shading_normal *= dot(shading_normal, spawn.normal) * side >= 0.0 ? 1.0 : -1.0;
  // A shading normal that looks away from the camera lights nothing that is seen.
  if (!(dot(shading_normal, direction) < 0.0)) {
    shading_normal = normal;
  }

  const float4 base_color =
      material.base_color * SampleMaterial(material, kBaseColorTexture, uv, lod);
  const float4 metallic_roughness = SampleMaterial(material, kMetallicRoughnessTexture, uv, lod);
  const float3 emissive = material.emissive * SampleMaterial(material, kEmissiveTexture, uv, lod).rgb;

  const float view_z = RayTCurrent();
  g_depth[pixel] = min(frame.near_plane / view_z, 1.0);
  g_view_z[pixel] = view_z;
  g_normal[pixel] = OctahedralEncode(normal);
  g_shading_normal[pixel] = OctahedralEncode(shading_normal);
  g_base_color[pixel] = float4(SrgbFromLinear(saturate(base_color.rgb)), 1.0);
  g_emissive[pixel] = float4(emissive, 0.0);
  g_material[pixel] = float4(material.roughness * metallic_roughness.g,
                             material.metallic * metallic_roughness.b, 0.0, 0.0);
  g_ids[pixel] = uint2(InstanceID() + 1, PrimitiveIndex());
  g_position[pixel] = float4(spawn.position, spawn.offset);
}
