// SPDX-License-Identifier: MIT
// Geometry shaders, and the vertex and pixel shaders around them.

cbuffer Constants : register(b0) {
  float4 tint;
};
RWByteAddressBuffer counts : register(u0);

struct Place {
  float4 position : SV_Position;
  float2 value : VALUE;
  nointerpolation uint id : ID;
};

[shader("vertex")]
Place Vertex(float2 position : POSITION, uint vertex : SV_VertexID) {
  Place result;
  result.position = float4(position.x / 32 - 1, 1 - position.y / 32, 0.5, 1);
  result.value = position;
  result.id = vertex;
  return result;
}

[shader("pixel")]
float4 Show(Place input, bool front : SV_IsFrontFace) : SV_Target0 {
  return float4(input.value, float(input.id), front ? 1.0 : 2.0);
}

[shader("pixel")]
float4 ShowPrimitive(Place input, uint primitive : SV_PrimitiveID) : SV_Target0 {
  return float4(input.value, float(input.id), float(primitive) + 1.0);
}

// As if it were not there.
[shader("geometry")]
[maxvertexcount(3)]
void Pass(triangle Place input[3], inout TriangleStream<Place> output) {
  for (uint i = 0; i < 3; ++i) output.Append(input[i]);
}
[shader("geometry")]
[maxvertexcount(2)]
void PassLine(line Place input[2], inout LineStream<Place> output) {
  output.Append(input[0]);
  output.Append(input[1]);
}
[shader("geometry")]
[maxvertexcount(1)]
void PassPoint(point Place input[1], inout PointStream<Place> output) {
  output.Append(input[0]);
}

// A square of `size` pixels around a vertex.
void square(Place center, float size, inout TriangleStream<Place> output) {
  for (uint i = 0; i < 4; ++i) {
    const float2 side = float2(i & 1, i >> 1) * 2 - 1;
    Place corner = center;
    corner.position.xy += side * float2(size, -size) / 64;
    corner.value += side * size / 2;
    output.Append(corner);
  }
  output.RestartStrip();
}

struct Numbered {
  Place place;
  uint primitive : SV_PrimitiveID;
};

[shader("geometry")]
[maxvertexcount(4)]
void Sprite(point Place input[1], uint primitive : SV_PrimitiveID,
            inout TriangleStream<Numbered> output) {
  counts.InterlockedAdd(0, 1);
  for (uint i = 0; i < 4; ++i) {
    const float2 side = float2(i & 1, i >> 1) * 2 - 1;
    Numbered corner;
    corner.place = input[0];
    corner.place.position.xy += side * float2(tint.x, -tint.x) / 64;
    corner.primitive = primitive * 10;
    output.Append(corner);
  }
}

// The same through a function, for each of four instances in another quarter.
[shader("geometry")]
[instance(4)]
[maxvertexcount(4)]
void Quarters(point Place input[1], uint instance : SV_GSInstanceID,
              inout TriangleStream<Place> output) {
  const float2 offset = float2(instance & 1, instance >> 1) * 32;
  Place center = input[0];
  center.position.xy += float2(offset.x, -offset.y) / 32;
  center.value += offset;
  center.id = instance;
  square(center, 8, output);
}

// Two triangles, then a strip of two vertices, of which nothing is drawn. The end of a strip is
// that of a triangle without a word of it, too.
[shader("geometry")]
[maxvertexcount(12)]
void Strips(point Place input[1], inout TriangleStream<Place> output) {
  const float2 corners[8] = {float2(0, 0),  float2(8, 0),  float2(0, 8), float2(16, 0),
                             float2(24, 0), float2(16, 8), float2(0, 16), float2(16, 16)};
  for (uint i = 0; i < 8; ++i) {
    Place corner = input[0];
    corner.position.xy += corners[i] * float2(1, -1) / 32;
    corner.id = i;
    output.Append(corner);
    if (i == 2 || i == 5) output.RestartStrip();
  }
}

// A strip of four: two triangles, of which the second is turned.
[shader("geometry")]
[maxvertexcount(4)]
void Strip(point Place input[1], inout TriangleStream<Place> output) {
  for (uint i = 0; i < 4; ++i) {
    Place corner = input[0];
    corner.position.xy += float2(i & 1, i >> 1) * float2(16, -16) / 32;
    corner.id = i;
    output.Append(corner);
  }
}

// Squares one over the other: the last one is seen. More than [maxvertexcount] is dropped.
[shader("geometry")]
[maxvertexcount(8)]
void Many(point Place input[1], inout TriangleStream<Place> output) {
  const uint count = uint(tint.y);
  for (uint i = 0; i < count; ++i) {
    Place center = input[0];
    center.id = i + 1;
    square(center, 8, output);
  }
}

// Triangles to their edges, and to their corners.
[shader("geometry")]
[maxvertexcount(4)]
void Edges(triangle Place input[3], inout LineStream<Place> output) {
  for (uint i = 0; i < 4; ++i) output.Append(input[i % 3]);
}
[shader("geometry")]
[maxvertexcount(3)]
void Corners(triangle Place input[3], inout PointStream<Place> output) {
  for (uint i = 0; i < 3; ++i) output.Append(input[i]);
}

// What a vertex can hold: arrays, matrices, structs in structs, distances to clip.
struct Part {
  float2x3 rows : ROWS;
  int number : NUMBER;
};
struct Rich {
  float4 position : SV_Position;
  Part part;
  float list[2] : LIST;
  float clip : SV_ClipDistance0;
};
[shader("vertex")]
Rich RichVertex(float2 position : POSITION, uint vertex : SV_VertexID) {
  Rich result;
  result.position = float4(position.x / 32 - 1, 1 - position.y / 32, 0.5, 1);
  result.part.rows = float2x3(1, 2, 3, 4, 5, 6) * float(vertex + 1);
  result.part.number = -int(vertex);
  result.list[0] = position.x;
  result.list[1] = position.y;
  result.clip = 1;
  return result;
}
[shader("geometry")]
[maxvertexcount(3)]
void RichPass(triangle Rich input[3], inout TriangleStream<Rich> output) {
  for (uint i = 0; i < 3; ++i) {
    Rich corner = input[i];
    corner.part.number -= 10;
    corner.clip = 32 - corner.list[0];  // the left half
    output.Append(corner);
  }
}
[shader("pixel")]
float4 RichPixel(Rich input) : SV_Target0 {
  const float3 sum = input.part.rows[0] + input.part.rows[1];
  return float4(dot(sum, float3(1, 1, 1)), input.list[0], input.list[1], float(input.part.number));
}

[shader("vertex")]
float4 PositionAlone(float2 position : POSITION) : SV_Position {
  return float4(position.x / 32 - 1, 1 - position.y / 32, 0.5, 1);
}
struct NoPosition {
  float2 value : VALUE;
};
[shader("geometry")]
[maxvertexcount(3)]
void WritesNoPosition(triangle Place input[3], inout TriangleStream<NoPosition> output) {
  NoPosition result;
  result.value = input[0].value;
  output.Append(result);
}
