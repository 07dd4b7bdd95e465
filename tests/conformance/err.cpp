// SPDX-License-Identifier: MIT
//
// Tests what the runtime must say about acceleration structures and their memory, and when: errors
// of calls, and messages of checked mode.
#include <limits>

#include "tests/conformance/checked.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using BuildFlags = RaytracingAccelerationStructureBuildFlags;

void structure_buffers(Context& t) {
  Checked c(t);
  const auto state = ResourceStates::kRaytracingAccelerationStructure;
  BufferDesc desc{.SizeInBytes = 1024, .InitialState = state};
  c.refused("no unordered access flag", c.device().CreateBuffer(desc), "KA0907");
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.Heap = HeapType::kUpload;
  c.refused("upload heap", c.device().CreateBuffer(desc));
  const Buffer level = c.bottom_level({triangle(5)});
  CommandList list = c.list();
  list.ResourceBarrier(ResourceBarrier::Transition(level, state, ResourceStates::kUnorderedAccess));
  c.refused("transition out of the state", list.Close());
}

BuildRaytracingAccelerationStructureInputs inputs_of(const RaytracingGeometryDesc& geometry,
                                                     BuildFlags flags = BuildFlags::kNone) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = flags;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &geometry;
  return inputs;
}

RaytracingGeometryDesc geometry_of(Context& c, const std::vector<float>& vertices) {
  RaytracingGeometryDesc geometry;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = static_cast<uint32_t>(vertices.size() / 3);
  geometry.Triangles.VertexBuffer = {c.upload(vertices).GetGPUVirtualAddress(), 12};
  return geometry;
}

const std::vector<float> kTriangle = {0, 3, 5, 3, -3, 5, -3, -3, 5};

Status record_and_close(Checked& c, const BuildRaytracingAccelerationStructureDesc& desc) {
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(desc);
  return list.Close();
}

void misaligned_addresses(Context& t) {
  Checked c(t);
  RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry);
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress() + 64;
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  c.refused("destination at 64", record_and_close(c, desc));
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  geometry.Triangles.VertexBuffer.StartAddress += 2;
  c.refused("vertices at 2", record_and_close(c, desc));
  CheckedScene s(c);
  s.add("Plain");
  for (const uint64_t stride : {16u, 4128u}) {
    DispatchRaysDesc tables = s.tables();
    tables.HitGroupTable.StrideInBytes = stride;
    CommandList list = c.list();
    list.SetComputeRootSignature(s.global);
    list.SetPipelineState1(s.pipeline);
    list.DispatchRays(tables);
    c.refused("stride " + std::to_string(stride), list.Close());
  }
  DispatchRaysDesc tables = s.tables();
  tables.MissShaderTable.StartAddress += 32;
  CommandList list = c.list();
  list.SetComputeRootSignature(s.global);
  list.SetPipelineState1(s.pipeline);
  list.DispatchRays(tables);
  c.refused("a table at +32", list.Close());
}

void states_and_barriers(Context& t) {
  Checked c(t);
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  const Buffer top = c.top_level({instance(level)});
  c.silent("builds with barriers between them");
  BuildRaytracingAccelerationStructureDesc bottom;
  bottom.Inputs = inputs_of(geometry);
  bottom.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  bottom.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  BuildRaytracingAccelerationStructureDesc upper;
  upper.Inputs.NumDescs = 1;
  upper.Inputs.InstanceDescs = c.upload(std::vector{instance(level)}).GetGPUVirtualAddress();
  upper.DestAccelerationStructureData = top.GetGPUVirtualAddress();
  upper.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(bottom);
  list.BuildRaytracingAccelerationStructure(upper);
  c.accepted("builds", c.execute(list));
  c.told("bottom and top level without a barrier", "KA0450");
  const Buffer moved = c.zeros(36);
  RaytracingGeometryDesc other = geometry;
  other.Triangles.VertexBuffer.StartAddress = moved.GetGPUVirtualAddress();
  bottom.Inputs = inputs_of(other);
  CommandList copy = c.list();
  copy.CopyBufferRegion(moved, 0, c.upload(kTriangle), 0, 36);
  copy.BuildRaytracingAccelerationStructure(bottom);
  c.accepted("copy and build", c.execute(copy));
  c.told("vertices that are a copy destination", "KA0451");
}

void build_flags(Context& t) {
  Checked c(t);
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry, BuildFlags::kPreferFastTrace | BuildFlags::kPreferFastBuild);
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  c.refused("fast trace and fast build", record_and_close(c, desc));
  desc.Inputs.Flags = BuildFlags::kNone;
  desc.SourceAccelerationStructureData = level.GetGPUVirtualAddress();
  c.refused("a source without an update", record_and_close(c, desc));
}

void updates(Context& t) {
  Checked c(t);
  RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  Buffer indices = c.upload(std::vector<uint32_t>{0, 1, 2});
  geometry.Triangles.IndexFormat = Format::kR32Uint;
  geometry.Triangles.IndexCount = 3;
  geometry.Triangles.IndexBuffer = indices.GetGPUVirtualAddress();
  auto inputs = inputs_of(geometry, BuildFlags::kAllowUpdate);
  const Buffer level = c.build(inputs);
  indices.data<uint32_t>()[1] = 0;
  inputs.Flags = BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate;
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs;
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.SourceAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(desc);
  c.accepted("update", c.execute(list));
  c.told("other indices", "KA0470");
}

void sizes_and_overlaps(Context& t) {
  Checked c(t);
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry);
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = level.GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(desc);
  (void)c.execute(list);
  c.told("scratch in the destination", "KA0471");
  desc.DestAccelerationStructureData =
      level.GetGPUVirtualAddress() + level.size() / 256 * 256 - 256;
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  c.refused("destination too small", record_and_close(c, desc));
}

void geometry_descriptions(Context& t) {
  Checked c(t);
  RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const auto try_it = [&] {
    return c.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs_of(geometry));
  };
  c.accepted("triangles", try_it());
  geometry.Triangles.VertexFormat = Format::kR32Uint;
  c.refused("vertex format", try_it());
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.IndexFormat = Format::kR32Uint;
  geometry.Triangles.IndexCount = 3;
  c.accepted("indices without a buffer are sized", try_it());
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry);
  c.refused("but not built", record_and_close(c, desc));
  geometry.Triangles.IndexFormat = Format::kR8G8Unorm;
  c.refused("index format", try_it());
}

void indices_and_nans(Context& t) {
  Checked c(t);
  RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  geometry.Triangles.IndexFormat = Format::kR32Uint;
  geometry.Triangles.IndexCount = 3;
  geometry.Triangles.IndexBuffer = c.upload(std::vector<uint32_t>{0, 1, 9}).GetGPUVirtualAddress();
  c.build(inputs_of(geometry));
  c.told("index 9 of 3 vertices", "KA0472");
  std::vector<float> vertices = kTriangle;
  vertices[4] = std::numeric_limits<float>::quiet_NaN();
  c.build(inputs_of(geometry_of(c, vertices)));
  c.told("NaN in Y alone", "KA0473");
  vertices[3] = vertices[4];
  c.build(inputs_of(geometry_of(c, vertices)));
  c.silent("NaN in X");
}

void postbuild_infos(Context& t) {
  Checked c(t);
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  const Buffer level = c.bottom_level({triangle(5)});
  const RaytracingAccelerationStructurePostbuildInfoDesc info = {
      c.zeros(64).GetGPUVirtualAddress(),
      RaytracingAccelerationStructurePostbuildInfoType::kCurrentSize};
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs_of(geometry);
  desc.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(desc, std::vector{info, info});
  c.refused("one info twice", list.Close());
}

void lives_of_structures(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  s.add("Plain");
  const Buffer level = c.bottom_level({triangle(5)});
  const Buffer top = c.top_level({instance(level)});
  s.scene = level;
  s.run();
  c.told("a bottom level passed to TraceRay", "KA0464");
  s.scene = top;
  s.run();
  c.silent("a sound scene");
  CommandList bytes = c.list();
  bytes.CopyBufferRegion(c.top_level({instance(level)}), 0, top, 0, top.size());
  c.refused("a copy of bytes", bytes.Close());
  const RaytracingGeometryDesc geometry = geometry_of(c, kTriangle);
  BuildRaytracingAccelerationStructureDesc again;
  again.Inputs = inputs_of(geometry);
  again.DestAccelerationStructureData = level.GetGPUVirtualAddress();
  again.ScratchAccelerationStructureData = c.zeros(65536).GetGPUVirtualAddress();
  CommandList list = c.list();
  list.BuildRaytracingAccelerationStructure(again);
  c.accepted("build", c.execute(list));
  s.scene = top;
  s.run();
  c.told("a stale top level", "KA0463");
}

void count_limits(Context& t) {
  Checked c(t);
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.NumDescs = (1u << 24) + 1;
  c.refused("instances", c.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs));
  RaytracingGeometryDesc geometry;
  geometry.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  geometry.AABBs = {(uint64_t{1} << 29) + 1, {0, 24}};
  c.refused("primitives",
            c.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs_of(geometry)));
}

void instance_flags(Context& t) {
  Checked c(t);
  c.top_level({instance(c.bottom_level({triangle(5)}), 0, 0, 12)});
  c.told("force opaque and force non-opaque", "KA0474");
}

void structure_views(Context& t) {
  Checked c(t);
  const Buffer top = c.top_level({});
  DescriptorHeapDesc heap;
  heap.NumDescriptors = 1;
  const DescriptorHeap views = c.device().CreateDescriptorHeap(heap).value();
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kRaytracingAccelerationStructure;
  view.RaytracingAccelerationStructure.Location = top.GetGPUVirtualAddress();
  c.accepted("without a resource",
             c.device().CreateShaderResourceView(Resource(), view,
                                                 views.GetCPUDescriptorHandleForHeapStart()));
  c.not_told("without a resource", "KA0826");
  // It is ignored, with a warning, as by D3D12's runtimes.
  c.accepted("with a resource", c.device().CreateShaderResourceView(
                                    top, view, views.GetCPUDescriptorHandleForHeapStart()));
  c.told("with a resource", "KA0826");
}

}  // namespace

std::vector<RuleTest> err_tests() {
  std::vector<RuleTest> tests = {
      {"ERR-03, ERR-04", structure_buffers},
      {"ERR-07", misaligned_addresses},
      {"ERR-08", states_and_barriers},
      {"ERR-09", build_flags},
      {"ERR-10", updates},
      {"ERR-11", sizes_and_overlaps},
      {"ERR-12", geometry_descriptions},
      {"ERR-13", indices_and_nans},
      {"ERR-15", postbuild_infos},
      {"ERR-16", lives_of_structures},
      {"ERR-17", count_limits},
      {"ERR-18", instance_flags},
      {"ERR-31", structure_views},
  };
  const std::vector<RuleTest> more = err_dispatch_tests();
  tests.insert(tests.end(), more.begin(), more.end());
  return tests;
}

}  // namespace kaamos::conformance
