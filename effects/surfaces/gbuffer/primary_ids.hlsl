// SPDX-License-Identifier: MIT
// Finds which triangle primary rays hit, and how far away: the draws of raster.hlsl are held
// against it.
#include "alpha_test.hlsli"
#include "store.hlsli"

// InstanceIndex() + 1 (0: nothing), GeometryIndex(), PrimitiveIndex(), the view depth's bits.
RWTexture2D<uint4> primary_ids : register(u0, space3);

struct IdsPayload {
  uint unused;  // the hit and miss shaders write the picture themselves
};

[shader("raygeneration")]
void PrimaryIdsRayGen() {
  const uint2 pixel = FramePixel();
  uint2 size;
  primary_ids.GetDimensions(size.x, size.y);
  const CameraRay through = PixelRay(pixel, size);
  RayDesc ray;
  ray.Origin = through.origin;
  ray.TMin = 0.0;
  ray.Direction = through.direction;
  ray.TMax = 1e30;
  IdsPayload payload;
  payload.unused = 0;
  TraceRay(scene, RAY_FLAG_NONE, kMaskSolid, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
           payload);
}

[shader("miss")]
void PrimaryIdsMiss(inout IdsPayload payload) {
  primary_ids[FramePixel()] = uint4(0, 0, 0, 0);
}

[shader("anyhit")]
void PrimaryIdsAnyHit(inout IdsPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void PrimaryIdsClosestHit(inout IdsPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  primary_ids[FramePixel()] =
      uint4(InstanceIndex() + 1, GeometryIndex(), PrimitiveIndex(), asuint(RayTCurrent()));
}
