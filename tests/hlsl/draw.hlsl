// SPDX-License-Identifier: MIT
// Two entry points in one source, each built with a target of its own.
struct Varyings {
  float4 position : SV_Position;
  float2 uv : UV;
  nointerpolation uint id : ID;
};
struct Inputs {
  nointerpolation uint id : ID;
  float2 uv : UV;
};

Varyings vs(float3 position : POSITION, uint id : SV_VertexID) {
  Varyings v = {float4(position, 1), position.xy, id};
  return v;
}

float4 ps(Inputs v) : SV_Target { return float4(v.uv, v.id, 1); }
