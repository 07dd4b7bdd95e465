// SPDX-License-Identifier: MIT
// This file holds what the tests of ray tracing stages share: the scene of scene.h, and rays along
// +z that pass through everything in it.
#pragma once

RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);

struct Payload {
  float4 color;
  uint4 numbers;
};

RayDesc test_ray(float z) {
  RayDesc ray = {float3(-3, 2, z), 0, float3(0, 0, 1), 100};
  return ray;
}

Payload trace(uint flags, uint mask, RayDesc ray) {
  Payload payload = (Payload)0;
  TraceRay(scene, flags, mask, 0, 0, 0, ray, payload);
  return payload;
}

void store(uint offset, Payload payload) {
  results.Store4(offset, asuint(payload.color));
  results.Store4(offset + 16, payload.numbers);
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.numbers.w = 99;
}
