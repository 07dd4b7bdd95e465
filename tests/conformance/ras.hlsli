// SPDX-License-Identifier: MIT
// This file holds what all shaders of the RAS rules share.

cbuffer Constants : register(b0) {
  float4 tint;
  float2 offset;  // of each instance from the one before, in clip space
  float depth;
  uint number;
};

struct Vertex {
  float4 position : SV_Position;
  float4 value : VALUE;
  nointerpolation uint vertex : VERTEX;
  nointerpolation uint instance : INSTANCE;
  nointerpolation uint element : ELEMENT;
};

// Corners of a triangle that covers the target; clockwise.
float2 corner_of_target(uint vertex) {
  return float2(vertex % 3 == 1 ? 3.0 : -1.0, vertex % 3 == 2 ? -3.0 : 1.0);
}
