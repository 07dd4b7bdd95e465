// SPDX-License-Identifier: MIT
// Shaders of the rules of geometry shaders.
#include "ras.hlsli"

[shader("geometry")]
[maxvertexcount(3)]
void HandOn(triangle Vertex input[3], inout TriangleStream<Vertex> output) {
  for (uint i = 0; i < 3; ++i) output.Append(input[i]);
}

// A square of 4 pixels of 64 with its upper left corner at the point.
Vertex corner_of(Vertex input, uint corner) {
  Vertex result = input;
  result.position.xy += float2(corner & 1, corner >> 1) * float2(0.125, -0.125);
  return result;
}

struct Numbered {
  Vertex vertex;
  uint primitive : SV_PrimitiveID;
};

[shader("geometry")]
[maxvertexcount(4)]
void Square(point Vertex input[1], uint primitive : SV_PrimitiveID,
            inout TriangleStream<Numbered> output) {
  for (uint i = 0; i < 4; ++i) {
    Numbered result;
    result.vertex = corner_of(input[0], i);
    result.primitive = primitive + 100;
    output.Append(result);
  }
}

// A square for each instance, 8 pixels apart.
[shader("geometry")]
[instance(8)]
[maxvertexcount(4)]
void Row(point Vertex input[1], uint instance : SV_GSInstanceID,
         inout TriangleStream<Vertex> output) {
  Vertex first = input[0];
  first.position.x += 0.25 * instance;
  first.element = instance + 1;
  for (uint i = 0; i < 4; ++i) output.Append(corner_of(first, i));
}

// `number` squares in one place, cut after each vertex of `tint.x` of them from the end.
[shader("geometry")]
[maxvertexcount(12)]
void Pile(point Vertex input[1], inout TriangleStream<Vertex> output) {
  for (uint i = 0; i < number; ++i) {
    Vertex first = input[0];
    first.element = i + 1;
    for (uint corner = 0; corner < 4; ++corner) {
      output.Append(corner_of(first, corner));
      if (number - i <= uint(tint.x)) output.RestartStrip();
    }
    output.RestartStrip();
  }
}

// The border of a triangle, as one strip of lines; its corners, as points.
[shader("geometry")]
[maxvertexcount(4)]
void Border(triangle Vertex input[3], inout LineStream<Vertex> output) {
  for (uint i = 0; i < 4; ++i) output.Append(input[i % 3]);
}
[shader("geometry")]
[maxvertexcount(3)]
void Corners(triangle Vertex input[3], inout PointStream<Vertex> output) {
  for (uint i = 0; i < 3; ++i) output.Append(input[i]);
}

[shader("pixel")]
uint4 Seen(Vertex input, bool front : SV_IsFrontFace) : SV_Target0 {
  return uint4(input.vertex, 0, 0x20000u | (front ? 0x10000u : 0u), input.element);
}
