// SPDX-License-Identifier: MIT
// FEATURE: core HLSL subobjects
// EXPECT u32 0 1
GlobalRootSignature root = {"UAV(u0)"};
RaytracingShaderConfig shader_config = {16, 8};
RaytracingPipelineConfig pipeline_config = {1};
TriangleHitGroup hit_group = {"", "Hit"};
SubobjectToExportsAssociation association = {"root", "main"};
struct P {
  float4 a;
};
[shader("closesthit")]
void Hit(inout P p, BuiltInTriangleIntersectionAttributes a) {}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, 1);
}
