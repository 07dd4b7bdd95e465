// SPDX-License-Identifier: MIT
// Subobjects in HLSL. Tests export the ones they want by name.
#include "states.hlsl"

GlobalRootSignature Global = {"UAV(u0)"};
LocalRootSignature Three = {"RootConstants(num32BitConstants = 3, b0, space = 1)"};
LocalRootSignature Five = {"RootConstants(num32BitConstants = 5, b0, space = 1)"};
SubobjectToExportsAssociation ThreeForMissA = {"Three", "MissA"};
SubobjectToExportsAssociation FiveForMissA = {"Five", "MissA"};
RaytracingShaderConfig Shaders = {16, 8};
RaytracingPipelineConfig Pipeline = {1};
RaytracingPipelineConfig1 Pipeline1 = {1, RAYTRACING_PIPELINE_FLAG_SKIP_PROCEDURAL_PRIMITIVES};
StateObjectConfig Additions = {STATE_OBJECT_FLAG_ALLOW_STATE_OBJECT_ADDITIONS};
TriangleHitGroup Triangles = {"AnyA", "HitA"};
TriangleHitGroup OnlyClosest = {"", "HitA"};
TriangleHitGroup OnlyAny = {"AnyA", ""};
ProceduralPrimitiveHitGroup Boxes = {"AnyA", "HitA", "BoxA"};
ProceduralPrimitiveHitGroup OnlyBox = {"", "", "BoxA"};
