// SPDX-License-Identifier: MIT
// The screen of 03-any-hit-alpha whose triangles have opacity micromaps.
#include <shaders/micromaps.h>

#include <cmath>

#include "../common/example.h"

using namespace rtapi;
using State = RaytracingOpacityMicromapState;

namespace {

constexpr uint32_t kLevel = 8;  // 4^8 micro-triangles for each triangle

struct Point {
  float u, v;
};

Point between(Point a, Point b) {
  return {(a.u + b.u) / 2, (a.v + b.v) / 2};
}

// How far inside a leaf a point is: is_hole() of the shader says where this is below 0.
float depth_in_leaf(Point uv) {
  const float x = uv.u * 5 - std::floor(uv.u * 5) - 0.5f;
  const float y = uv.v * 5 - std::floor(uv.v * 5) - 0.5f;
  return 0.36f - std::abs(x) - y * y * 2;
}

// Opaque or transparent if all of the triangle is. The depth changes by less than 2.3 for each unit
// that a point moves, 5 of which are the width of the screen.
State state_of(Point a, Point b, Point c) {
  const Point middle = {(a.u + b.u + c.u) / 3, (a.v + b.v + c.v) / 3};
  float radius = 0;
  for (const Point p : {a, b, c}) {
    radius = std::max(radius, std::hypot(p.u - middle.u, p.v - middle.v));
  }
  const float change = 2.3f * 5 * radius;
  const float depth = depth_in_leaf(middle);
  if (depth > change) return State::kOpaque;
  if (depth < -change) return State::kTransparent;
  return depth > 0 ? State::kUnknownOpaque : State::kUnknownTransparent;
}

// Appends the states of a triangle that the curve enters at a and leaves at c, in DXR's order: a
// quarter at a, the middle one, and the quarters at b and c.
void bake(Point a, Point b, Point c, uint32_t level, std::vector<State>& states) {
  if (level == 0) return states.push_back(state_of(a, b, c));
  const Point ab = between(a, b), bc = between(b, c), ca = between(c, a);
  bake(a, ab, ca, level - 1, states);
  bake(ca, bc, ab, level - 1, states);
  bake(ab, b, bc, level - 1, states);
  bake(bc, ca, c, level - 1, states);
}

// An array of two micromaps, one for each triangle of the screen.
Buffer build_micromaps(const example::Setup& setup) {
  std::vector<State> states;
  bake({0, 0}, {1, 0}, {1, 1}, kLevel, states);  // texture coordinates as in quad_uv()
  bake({0, 0}, {1, 1}, {0, 1}, kLevel, states);
  std::vector<uint8_t> bits(states.size() / 4);  // two bits each, the lowest first
  for (size_t i = 0; i < states.size(); ++i) {
    bits[i / 4] |= static_cast<uint8_t>(static_cast<uint32_t>(states[i]) << 2 * (i % 4));
  }
  const Buffer input = CreateUploadBuffer(setup.device, bits, "micromap states").value();
  std::vector<RaytracingOpacityMicromapDesc> micromaps(2);
  micromaps[0] = {.ByteOffset = 0, .SubdivisionLevel = kLevel, .Format = 2};  // four states
  micromaps[1] = micromaps[0];
  micromaps[1].ByteOffset = static_cast<uint32_t>(bits.size() / 2);
  const Buffer descs = CreateUploadBuffer(setup.device, micromaps, "micromap descs").value();

  const RaytracingOpacityMicromapHistogramEntry two = {
      .Count = 2,
      .SubdivisionLevel = kLevel,
      .Format = RaytracingOpacityMicromapFormat::kOc1_4State};
  const RaytracingOpacityMicromapArrayDesc array = {
      .NumOmmHistogramEntries = 1,
      .pOmmHistogram = &two,
      .InputBuffer = input.GetGPUVirtualAddress(),
      .PerOmmDescs = {descs.GetGPUVirtualAddress(), sizeof(RaytracingOpacityMicromapDesc)}};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kOpacityMicromapArray;
  inputs.NumDescs = 1;
  inputs.pOpacityMicromapArrayDesc = &array;
  return BuildAccelerationStructure(setup.device, setup.queue, inputs, "micromaps").value();
}

Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  const std::vector<uint32_t> quad = {0, 1, 2, 0, 2, 3};
  const example::Mesh floor = example::CreateMesh(setup, {-9, 0, -9, -9, 0, 9, 9, 0, 9, 9, 0, -9},
                                                  quad, RaytracingGeometryFlags::kOpaque);
  const example::Mesh screen =
      example::CreateMesh(setup, {-2, 0.3f, 0, -2, 2.6f, 0.6f, 2, 2.6f, 0.6f, 2, 0.3f, 0}, quad,
                          RaytracingGeometryFlags::kNone);
  // Triangle k has micromap k. An index buffer could say otherwise, or that a whole triangle is
  // opaque or transparent.
  const Buffer micromaps = build_micromaps(setup);
  RaytracingGeometryOmmLinkageDesc linkage;
  linkage.OpacityMicromapArray = micromaps.GetGPUVirtualAddress();
  RaytracingGeometryDesc linked = screen.geometry;
  linked.Type = RaytracingGeometryType::kOmmTriangles;
  linked.OmmTriangles = {&screen.geometry.Triangles, &linkage};
  const Buffer bottom_level =
      BuildBottomLevel(setup.device, setup.queue, {floor.geometry, linked}, "bottom level").value();
  const Buffer top_level = BuildTopLevel(setup.device, setup.queue,
                                         {example::Instance(bottom_level, 0, 0, 0)}, "top level")
                               .value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), DescriptorTable(UAV(u0))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_micromaps()).value(), {}});
  desc.Add(
      HitGroupDesc{.HitGroupExport = "FloorPrimary", .ClosestHitShaderImport = "FloorClosestHit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "FloorShadow"});
  desc.Add(HitGroupDesc{.HitGroupExport = "LeafPrimary",
                        .AnyHitShaderImport = "LeafAnyHit",
                        .ClosestHitShaderImport = "LeafClosestHit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "LeafShadow", .AnyHitShaderImport = "LeafAnyHitShadow"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  // Without the flag the pipeline would not look at micromaps.
  desc.Add(RaytracingPipelineConfig1{.MaxTraceRecursionDepth = 2,
                                     .Flags = RaytracingPipelineFlags::kAllowOpacityMicromaps});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();

  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("PrimaryMiss").value();
  miss_table.AddRecord("ShadowMiss").value();
  for (const char* group : {"FloorPrimary", "FloorShadow", "LeafPrimary", "LeafShadow"}) {
    hit_table.AddRecord(group).value();
  }
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, top_level.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(1, image.heap.GetGPUDescriptorHandleForHeapStart());
  list.SetPipelineState1(pipeline);
  list.DispatchRays({.RayGenerationShaderRecord = raygen_table.GetRecord(0),
                     .MissShaderTable = miss_table.GetTable(),
                     .HitGroupTable = hit_table.GetTable(),
                     .Width = setup.width,
                     .Height = setup.height});
  setup.queue.ExecuteAndWait(list).value();
  return image.texture;
}

}  // namespace

int main(int argc, char** argv) {
  return example::Main(argc, argv, "15-opacity-micromaps", Render);
}
