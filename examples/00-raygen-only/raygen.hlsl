// SPDX-License-Identifier: MIT
// One ray generation shader and no rays: the least that a DXR program can run.

RWTexture2D<float4> image : register(u0);

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  // The pixel's centre, from 0 to 1 across the picture.
  const float2 uv = (float2(pixel) + 0.5) / size;
  const float2 from_centre = (uv - 0.5) * float2(size.x / size.y, 1.0);
  const float rings = 0.5 + 0.5 * cos(80.0 * length(from_centre));
  image[pixel] = float4(uv, rings, 1.0);
}
