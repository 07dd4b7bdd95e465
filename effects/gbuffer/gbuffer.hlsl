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
  TraceRay(scene, RAY_FLAG_NONE, kMaskVisible, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
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

// A texture of the material, or 1 where it has none.
float4 SampleMaterial(MaterialConstants material, uint slot, float2 uv, float lod_of_unit_texture) {
  const int image = material.image[slot];
  if (image < 0) {
    return float4(1, 1, 1, 1);
  }
  uint width, height, mips;
  textures[NonUniformResourceIndex(image)].GetDimensions(0, width, height, mips);
  const float lod = lod_of_unit_texture + 0.5 * log2(float(width) * float(height));
  return textures[NonUniformResourceIndex(image)].SampleLevel(
      samplers[NonUniformResourceIndex(material.sampler[slot])], MaterialUv(material, slot, uv),
      max(lod, 0.0));
}

[shader("closesthit")]
void GBufferClosestHit(inout SurfacePayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const uint2 pixel = FramePixel();
  const MaterialConstants material = materials[hit_constants.material_id];
  const HitTriangle corners = LoadHitTriangle(vertices, indices, hit_constants, PrimitiveIndex());
  const SurfacePoint surface = EvaluateSurface(corners, hit.barycentrics, ObjectToWorld3x4(),
                                               WorldToObject3x4(), RayTCurrent());

  // Ray cone: how much of the texture a pixel covers. [Akenine-Moller et al. 2019]
  const float3 direction = WorldRayDirection();
  const float distance = RayTCurrent() * length(direction);
  const float facing = max(abs(dot(normalize(direction), surface.normal)), 0.05);
  const float lod = 0.5 * log2(max(surface.uv_area, 1e-20) / max(surface.world_area, 1e-20)) +
                    log2(max(distance * frame.pixel_angle, 1e-20) / facing);

  // Everything is seen from the side that the camera is on.
  const float side = dot(direction, surface.normal) <= 0.0 ? 1.0 : -1.0;
  const float3 normal = side * surface.normal;
  float3 shading_normal = side * surface.shading_normal;
  if (material.image[kNormalTexture] >= 0) {
    float3 bump = SampleMaterial(material, kNormalTexture, surface.uv, lod).xyz * 2.0 - 1.0;
    bump.xy *= material.normal_scale;
    const float3 bitangent = surface.tangent.w * cross(surface.shading_normal, surface.tangent.xyz);
    shading_normal = normalize(surface.tangent.xyz * bump.x + bitangent * bump.y +
                               shading_normal * bump.z);
  }
  // A shading normal that looks away from the camera lights nothing that is seen.
  if (dot(shading_normal, direction) >= 0.0) {
    shading_normal = normal;
  }

  const float4 base_color = material.base_color * SampleMaterial(material, kBaseColorTexture, surface.uv, lod);
  const float4 metallic_roughness = SampleMaterial(material, kMetallicRoughnessTexture, surface.uv, lod);
  const float3 emissive = material.emissive * SampleMaterial(material, kEmissiveTexture, surface.uv, lod).rgb;

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
  g_position[pixel] = float4(surface.position, surface.offset);
}
