// SPDX-License-Identifier: MIT
// Local lights: what arrives at a point, without shadows. The layout is that of
// effects/lights/light_constants.h.
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
};

struct LightSample {
  float3 direction;    // towards the light, unit
  float distance;      // metres to its centre
  float3 irradiance;   // on a surface that faces the light
};

// Inverse square law with a smooth cutoff at the range. Inside the light's sphere, a point is lit
// as if it were on the sphere. [KHR_lights_punctual; effects-spec B1.3]
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
  return result;
}

#endif
