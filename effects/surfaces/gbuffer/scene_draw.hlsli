// SPDX-License-Identifier: MIT
// A draw of the scene's geometry. [effects/engine/scene_draws.h]
#ifndef KAAMOS_SCENE_DRAW_HLSLI
#define KAAMOS_SCENE_DRAW_HLSLI

// A geometry of an instance: one draw.
struct SceneDraw {
  float4 object_to_world[3];  // rows, relative to the camera
  float4 world_to_object[3];
  uint instance;  // InstanceIndex() of a ray that hits it
  uint geometry;  // in `geometries`
  uint mask;      // of the instance
  uint padding;
};

float3x4 ObjectToWorld(SceneDraw draw) {
  return float3x4(draw.object_to_world[0], draw.object_to_world[1], draw.object_to_world[2]);
}
float3x4 WorldToObject(SceneDraw draw) {
  return float3x4(draw.world_to_object[0], draw.world_to_object[1], draw.world_to_object[2]);
}

#endif
