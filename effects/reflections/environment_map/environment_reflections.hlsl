// SPDX-License-Identifier: MIT
// Reflections from environment maps alone: one look in the mirrored direction, as blurred as the
// surface is rough. [survey 6.2]
#include "../traced/reflection_ray.hlsli"
#include "environment_map.hlsli"

// As effects/reflections/traced has it: radiance / ReflectionScale, and the distance that the rays of such
// a surface have there.
RWTexture2D<float4> reflection : register(u0, space3);

[shader("compute")]
[numthreads(8, 8, 1)]
void EnvironmentReflections(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  g_view_z.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  reflection[id.xy] = float4(0, 0, 0, 0);
  if (g_ids[id.xy].x == 0) return;
  const ReflectionPoint surface = LoadReflectionPoint(id.xy);
  const float3 view = SeenAlong(g_position[id.xy].xyz);
  const float3 mirrored = reflect(view, surface.shading_normal);
  // The mean over the lobe is over its own albedo: the same as the sum of samples over the scale.
  reflection[id.xy] = float4(
      EnvironmentRadiance(surface.origin, mirrored, surface.roughness), 0.0);
}
