// SPDX-License-Identifier: MIT
// A state object's subobjects beside its shaders, so that the program only names this library.
#include "../../05-callable-and-recursion/mirrors.hlsl"

GlobalRootSignature SceneAndImage = {"SRV(t0), DescriptorTable(UAV(u0))"};
LocalRootSignature CallableOfSurface = {"RootConstants(num32BitConstants = 1, b0, space = 1)"};
TriangleHitGroup BoxGroup = {"", "BoxClosestHit"};
SubobjectToExportsAssociation BoxesHaveSurfaces = {"CallableOfSurface", "BoxGroup"};
RaytracingShaderConfig PayloadAndAttributes = {16, 8};
RaytracingPipelineConfig Recursion = {6};  // kMaxDepth
