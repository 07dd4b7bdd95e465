// SPDX-License-Identifier: MIT
// The G-buffer: one ray through the centre of each pixel stores the attributes of the surface it
// hits. [effects-spec B0.2]
#include "alpha_test.hlsli"
#include "surface.hlsli"

struct SurfacePayload {
  uint unused;  // the hit and miss shaders write the pictures themselves
};

[shader("raygeneration")]
void GBufferRayGen() {
  const uint2 pixel = FramePixel();
  uint width, height;
  g_view_z.GetDimensions(width, height);
  const float2 ndc = (float2(pixel) + 0.5 + frame.jitter) / float2(width, height) * 2.0 - 1.0;
  // Not normalised: its component along the camera's axis is 1, so the ray's t is the view depth.
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

[shader("anyhit")]
void GBufferAnyHit(inout SurfacePayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

// The hit point's position in the previous frame, relative to that frame's camera.
float3 PreviousPosition(float3 position, float2 barycentrics) {
  const PreviousInstance before = previous_instances[InstanceIndex()];
  if (before.flags == 0) {
    return position + frame.camera_motion;
  }
  const HitConstants layout = hit_constants;
  const uint offset = (before.flags & kPreviousDeformed) != 0 ? kPreviousPositionOffset : 0;
  const uint3 corners = LoadTriangle(indices, layout.index_size_bytes, PrimitiveIndex());
  const float4 object = float4(
      Interpolate(LoadVertexFloat3(vertices, layout.vertex_stride, offset, corners.x),
                  LoadVertexFloat3(vertices, layout.vertex_stride, offset, corners.y),
                  LoadVertexFloat3(vertices, layout.vertex_stride, offset, corners.z), barycentrics),
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

[shader("closesthit")]
void GBufferClosestHit(inout SurfacePayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const uint2 pixel = FramePixel();
  const Surface surface = LoadSurface(hit.barycentrics, ConeWidth());
  const float view_z = RayTCurrent();
  g_depth[pixel] = min(frame.near_plane / view_z, 1.0);
  g_view_z[pixel] = view_z;
  g_normal[pixel] = OctahedralEncode(surface.normal);
  g_shading_normal[pixel] = OctahedralEncode(surface.shading_normal);
  g_base_color[pixel] = float4(EncodeColor(saturate(surface.base_color)), 1.0);
  g_emissive[pixel] = float4(surface.emissive, 0.0);
  g_material[pixel] = float4(surface.roughness, surface.metallic, 0.0, 0.0);
  g_ids[pixel] = uint2(InstanceID() + 1, PrimitiveIndex());
  g_position[pixel] = float4(surface.position, surface.offset);
  g_motion[pixel] = float4(MotionOf(surface.position,
                                    PreviousPosition(surface.position, hit.barycentrics)),
                           0.0);
}
