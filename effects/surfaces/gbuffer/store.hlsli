// SPDX-License-Identifier: MIT
// Stores what the G-buffer holds of a pixel, whether a ray found the surface or a draw did.
#ifndef KAAMOS_GBUFFER_STORE_HLSLI
#define KAAMOS_GBUFFER_STORE_HLSLI

#include "surface.hlsli"

// From the camera through the centre of a pixel, moved by the jitter.
CameraRay PixelRay(uint2 pixel, uint2 size) {
  const float2 ndc = (float2(pixel) + 0.5 + frame.jitter) / float2(size) * 2.0 - 1.0;
  return RayThrough(ndc);
}

void StoreNothing(uint2 pixel) {
  g_depth[pixel] = 0.0;  // reversed-Z: infinitely far away
  g_view_z[pixel] = 0.0;
  g_normal[pixel] = float2(0, 0);
  g_shading_normal[pixel] = float2(0, 0);
  g_base_color[pixel] = float4(0, 0, 0, 0);
  g_emissive[pixel] = float4(0, 0, 0, 0);
  g_material[pixel] = float4(0, 0, 0, 0);
  g_ids[pixel] = uint2(0, 0);
  g_position[pixel] = float4(0, 0, 0, 0);
  g_motion[pixel] = float4(0, 0, 0, 0);
}

// The point's position in the previous frame, relative to that frame's camera. `instance` is its
// InstanceIndex().
float3 PreviousPosition(ByteAddressBuffer vertices, ByteAddressBuffer indices, TriangleHit hit,
                        uint instance, float3 position) {
  const PreviousInstance before = previous_instances[instance];
  if (before.flags == 0) {
    return position + frame.camera_motion;
  }
  const uint stride = hit.layout.vertex_stride;
  const uint offset = (before.flags & kPreviousDeformed) != 0 ? kPreviousPositionOffset : 0;
  const uint3 corners = LoadTriangle(indices, hit.layout.index_size_bytes, hit.primitive);
  const float4 object =
      float4(Interpolate(LoadVertexFloat3(vertices, stride, offset, corners.x),
                         LoadVertexFloat3(vertices, stride, offset, corners.y),
                         LoadVertexFloat3(vertices, stride, offset, corners.z), hit.barycentrics),
             1.0);
  return float3(dot(before.rows[0], object), dot(before.rows[1], object),
                dot(before.rows[2], object));
}

// Motion vector to where the point was in the previous frame: picture widths and heights, and
// metres along the camera's axis. `previous_position` is relative to the previous camera.
float3 MotionOf(float3 position, float3 previous_position) {
  float view_z, previous_view_z;
  const float2 now = PictureUv(position, frame.camera_right, frame.over_right, frame.camera_up,
                               frame.over_up, frame.camera_forward, view_z);
  const float2 before = PreviousPictureUv(previous_position, previous_view_z);
  return float3(before - now, previous_view_z - view_z);
}

// `ids`: instance + 1 and primitive. `instance`: as in PreviousPosition.
void StoreSurface(uint2 pixel, ByteAddressBuffer vertices, ByteAddressBuffer indices,
                  TriangleHit hit, uint instance, uint2 ids, float view_z, float cone_width) {
  const Surface surface = LoadSurface(vertices, indices, hit, cone_width);
  g_depth[pixel] = min(frame.near_plane / view_z, 1.0);
  g_view_z[pixel] = view_z;
  g_normal[pixel] = OctahedralEncode(surface.normal);
  g_shading_normal[pixel] = OctahedralEncode(surface.shading_normal);
  g_base_color[pixel] = float4(EncodeColor(saturate(surface.base_color)), 1.0);
  float tint;
  const float2 dielectric =
      EncodeDielectric(surface.dielectric_f0, surface.dielectric_f90, tint);
  g_emissive[pixel] = float4(surface.emissive, tint);
  g_material[pixel] = float4(surface.roughness, surface.metallic,
                             surface.is_unlit ? 1.0 : dielectric.x, dielectric.y);
  g_ids[pixel] = ids;
  g_position[pixel] = float4(surface.position, surface.offset);
  const float3 previous = PreviousPosition(vertices, indices, hit, instance, surface.position);
  g_motion[pixel] = float4(MotionOf(surface.position, previous), 0.0);
}

#endif
