// SPDX-License-Identifier: MIT
// Local lights: what arrives at a point, without shadows. The layout is that of
// effects/assets/scene/light_constants.h. frame.hlsli includes this behind its textures and samplers.
#ifndef KAAMOS_LIGHTS_HLSLI
#define KAAMOS_LIGHTS_HLSLI

struct LightConstants {
  float3 position;  // relative to the camera
  float range;      // metres
  float3 intensity;
  float radius;
  float3 direction;
  float spot_scale;
  float spot_offset;
  uint is_spot;
  float cos_outer;  // of a spot's cone, where its map ends
  float over_range;  // 1 / range
  // Axes of a spot's map: direction d falls at dot(d, axis) / dot(d, direction), from -1 to 1.
  float3 map_right;
  float over_least_distance;  // 1 / metres; closer points are lit as if at that distance
  float3 map_up;
  float map_texel;  // radians that a texel of the map covers
  int projection;   // a spot's projection map, of the textures; -1: none
  uint projection_sampler;
  float2 padding;
};

struct LightSample {
  float3 direction;    // towards the light, unit
  float distance;      // metres to its centre
  float3 irradiance;   // on a surface that faces the light
};

// Returns what a spot's projection map lets through towards a unit direction from the light.
float3 ProjectionTowards(LightConstants light, float3 direction) {
  const float along = max(dot(direction, light.direction), 1e-6f);
  const float2 at = float2(dot(direction, light.map_right), dot(direction, light.map_up)) / along;
  return textures[NonUniformResourceIndex(light.projection)].SampleLevel(
      samplers[NonUniformResourceIndex(light.projection_sampler)],
      at * float2(0.5f, -0.5f) + 0.5f, 0.0f).rgb;
}

// Inverse square law with a smooth cutoff at the range. Inside the light's sphere, a point is lit
// as if it were on the sphere. [KHR_lights_punctual]
LightSample SampleLight(LightConstants light, float3 position) {
  const float3 to_light = light.position - position;
  const float distance_squared = dot(to_light, to_light);
  LightSample result;
  result.distance = sqrt(distance_squared);
  const float over_distance = 1.0f / result.distance;
  result.direction = distance_squared > 0.0f ? to_light * over_distance : -light.direction;
  result.irradiance = float3(0.0f, 0.0f, 0.0f);
  const float ratio = result.distance * light.over_range;
  const float ratio_squared = ratio * ratio;
  const float window = saturate(1.0f - ratio_squared * ratio_squared);
  const float cone =
      saturate(dot(-result.direction, light.direction) * light.spot_scale + light.spot_offset);
  // Most lights of a cluster do not reach the point.
  if (!(window * cone > 0.0f)) return result;
  const float root = window * cone * min(over_distance, light.over_least_distance);
  result.irradiance = light.intensity * (root * root);
  if (light.projection >= 0) result.irradiance *= ProjectionTowards(light, -result.direction);
  return result;
}

#endif
