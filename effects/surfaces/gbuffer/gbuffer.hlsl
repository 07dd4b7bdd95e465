// SPDX-License-Identifier: MIT
// The G-buffer by rays: one ray through the centre of each pixel stores the attributes of the
// surface it hits. raster.hlsl and resolve.hlsl do the same without rays.
#include "alpha_test.hlsli"
#include "store.hlsli"

struct SurfacePayload {
  uint unused;  // the hit and miss shaders write the pictures themselves
};

[shader("raygeneration")]
void GBufferRayGen() {
  const uint2 pixel = FramePixel();
  uint2 size;
  g_view_z.GetDimensions(size.x, size.y);
  const CameraRay through = PixelRay(pixel, size);
  RayDesc ray;
  ray.Origin = through.origin;
  ray.TMin = 0.0;
  ray.Direction = through.direction;
  ray.TMax = 1e30;
  SurfacePayload payload;
  payload.unused = 0;
  TraceRay(scene, RAY_FLAG_NONE, kMaskSolid, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
           payload);
}

[shader("miss")]
void GBufferMiss(inout SurfacePayload payload) {
  StoreNothing(FramePixel());
}

[shader("anyhit")]
void GBufferAnyHit(inout SurfacePayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void GBufferClosestHit(inout SurfacePayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  StoreSurface(FramePixel(), vertices, indices, RayHit(hit.barycentrics), InstanceIndex(),
               uint2(InstanceID() + 1, PrimitiveIndex()), RayTCurrent(), ConeWidth());
}
