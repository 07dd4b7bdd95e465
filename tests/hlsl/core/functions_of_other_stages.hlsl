// SPDX-License-Identifier: MIT
// FEATURE: core functions of hull and domain shaders beside the shader; geometry shaders have a stage
// EXPECT u32 0 7
RWByteAddressBuffer results : register(u0);

struct Vertex {
  float4 position : SV_Position;
};

struct Factors {
  float edges[3] : SV_TessFactor;
  float inside : SV_InsideTessFactor;
};

void emit(inout TriangleStream<Vertex> stream, Vertex v) {
  stream.Append(v);
  stream.RestartStrip();
}

[maxvertexcount(3)] void geometry_main(triangle Vertex input[3],
                                       inout TriangleStream<Vertex> stream) {
  for (uint i = 0; i < 3; ++i) emit(stream, input[i]);
}

Factors patch_constants(InputPatch<Vertex, 3> patch, uint id : SV_PrimitiveID) {
  return (Factors)1;
}

[domain("tri")]
[partitioning("integer")]
[outputtopology("triangle_cw")]
[outputcontrolpoints(3)]
[patchconstantfunc("patch_constants")]
Vertex hull_main(InputPatch<Vertex, 3> patch, uint id : SV_OutputControlPointID) {
  return patch[id];
}

[domain("tri")]
Vertex domain_main(Factors factors, float3 weights : SV_DomainLocation,
                   const OutputPatch<Vertex, 3> patch) {
  Vertex v;
  v.position = patch[0].position * weights.x;
  return v;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, 7);
}
