// SPDX-License-Identifier: MIT
// Shaders of the rules of attributes and system values.
#include "ras.hlsli"

ByteAddressBuffer attributes : register(t0);  // a float4 for each vertex

struct Rebuilt {
  float4 interpolated : SV_Target0;
  float4 rebuilt : SV_Target1;
  float4 weights : SV_Target2;
};

float4 weigh(float3 weights, uint3 vertices) {
  return weights.x * asfloat(attributes.Load4(vertices.x * 16)) +
         weights.y * asfloat(attributes.Load4(vertices.y * 16)) +
         weights.z * asfloat(attributes.Load4(vertices.z * 16));
}

// `number` 1: a strip.
uint3 vertices_of(uint primitive) {
  if (number == 0) return primitive * 3 + uint3(0, 1, 2);
  return primitive + ((primitive & 1) == 0 ? uint3(0, 1, 2) : uint3(0, 2, 1));
}

[shader("pixel")]
Rebuilt FromBarycentrics(float4 position : SV_Position, float4 value : VALUE, uint primitive : SV_PrimitiveID,
                         float3 weights : SV_Barycentrics) {
  Rebuilt result;
  result.interpolated = value;
  result.rebuilt = weigh(weights, vertices_of(primitive));
  result.weights = float4(weights, 1.0);
  return result;
}

[shader("pixel")]
Rebuilt FromVertices(float4 position : SV_Position, nointerpolation float4 value : VALUE,
                     uint primitive : SV_PrimitiveID, float3 weights : SV_Barycentrics) {
  Rebuilt result;
  result.interpolated = weigh(weights, vertices_of(primitive));
  result.rebuilt = weights.x * GetAttributeAtVertex(value, 0) + weights.y * GetAttributeAtVertex(value, 1) +
                   weights.z * GetAttributeAtVertex(value, 2);
  result.weights = float4(weights, 1.0);
  return result;
}

struct ScreenVertex {
  float4 position : SV_Position;
  noperspective float4 value : VALUE;
};

[shader("vertex")]
ScreenVertex PassOnScreen(float4 position : POSITION, float4 value : VALUE) {
  ScreenVertex result;
  result.position = position;
  result.value = value;
  return result;
}

[shader("pixel")]
Rebuilt FromScreenBarycentrics(ScreenVertex input, uint primitive : SV_PrimitiveID,
                               noperspective float3 weights : SV_Barycentrics) {
  Rebuilt result;
  result.interpolated = input.value;
  result.rebuilt = weigh(weights, vertices_of(primitive));
  result.weights = float4(weights, 1.0);
  return result;
}

[shader("pixel")]
float4 ScreenValue(ScreenVertex input) : SV_Target {
  return input.value;
}

struct FlatVertex {
  float4 position : SV_Position;
  nointerpolation float4 value : VALUE;
  nointerpolation int4 bits : BITS;
};

[shader("vertex")]
FlatVertex PassFlat(float4 position : POSITION, uint4 bits : VALUE) {
  FlatVertex result;
  result.position = position;
  result.value = asfloat(bits);
  result.bits = asint(bits);
  return result;
}

struct TwoBits {
  uint4 floats : SV_Target0;
  uint4 ints : SV_Target1;
};

[shader("pixel")]
TwoBits ReadFlat(FlatVertex input) {
  TwoBits result;
  result.floats = asuint(input.value);
  result.ints = asuint(input.bits);
  return result;
}

struct Modes {
  float4 position : SV_Position;
  linear float a : A;
  centroid float b : B;
  sample float c : C;
  noperspective centroid float d : D;
};

[shader("vertex")]
Modes PassModes(float4 position : POSITION, float4 value : VALUE) {
  Modes result;
  result.position = position;
  result.a = value.x;
  result.b = value.x;
  result.c = value.x;
  result.d = value.x;
  return result;
}

[shader("pixel")]
float4 ReadModes(Modes input) : SV_Target {
  return float4(input.a, input.b, input.c, input.d);
}

struct Numbered {
  float4 position : SV_Position;
  uint instance : SV_InstanceID;
};

[shader("vertex")]
Numbered PassInstance(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Numbered result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.instance = instance + 40;
  return result;
}

[shader("pixel")]
uint4 ReadInstance(float4 position : SV_Position, uint instance : SV_InstanceID) : SV_Target {
  return uint4(instance, 0, 0, 1);
}

struct Many {
  float4 position : SV_Position;
  float4x4 matrices[7] : M;
  float4 rest[3] : R;
};

[shader("vertex")]
Many PassMany(uint vertex : SV_VertexID) {
  Many result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  for (uint m = 0; m < 7; ++m) {
    for (uint row = 0; row < 4; ++row) result.matrices[m][row] = float4(m, row, m * row, 1.0);
  }
  for (uint i = 0; i < 3; ++i) result.rest[i] = float4(i, 7.0, 8.0, 9.0);
  return result;
}

[shader("pixel")]
float4 ReadMany(Many input) : SV_Target {
  float4 sum = float4(0, 0, 0, 0);
  for (uint m = 0; m < 7; ++m) {
    for (uint row = 0; row < 4; ++row) sum += input.matrices[m][row];
  }
  for (uint i = 0; i < 3; ++i) sum += input.rest[i];
  return sum;
}
