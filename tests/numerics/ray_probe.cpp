// SPDX-License-Identifier: MIT
#include "ray_probe.h"

#include <rtapi/upload.h>
#include <shaders/ray_probe.h>

#include <algorithm>
#include <cstring>

#include "tests/common/structures.h"

namespace kaamos::test {
namespace {

using namespace rtapi;

static_assert(sizeof(ProbeRay) == 32 && sizeof(ProbeHit) == 16, "as in ray_probe.hlsl");

Buffer build_mesh(const Device& device, CommandQueue& queue, const ProbeMesh& mesh) {
  const Buffer vertices = CreateUploadBuffer(device, mesh.positions, "vertices").value();
  const Buffer indices = CreateUploadBuffer(device, mesh.triangles, "indices").value();
  RaytracingGeometryDesc geometry;
  geometry.Flags = RaytracingGeometryFlags::kOpaque;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = static_cast<std::uint32_t>(mesh.positions.size());
  geometry.Triangles.VertexBuffer = {vertices.GetGPUVirtualAddress(), sizeof(glm::vec3)};
  geometry.Triangles.IndexFormat = Format::kR32Uint;
  geometry.Triangles.IndexCount = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  geometry.Triangles.IndexBuffer = indices.GetGPUVirtualAddress();
  return build_bottom_level(device, queue, {geometry});
}

Buffer build_instance(const Device& device, CommandQueue& queue, const ProbeMesh& mesh,
                      const Buffer& bottom_level) {
  RaytracingInstanceDesc instance;
  std::memcpy(instance.Transform, &mesh.transform, sizeof(instance.Transform));
  instance.InstanceMask = 0xFF;
  instance.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
  return build_top_level(device, queue, {instance});
}

StateObject create_pipeline(const Device& device, const RootSignature& root_signature) {
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_ray_probe()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Hit", .ClosestHitShaderImport = "ProbeClosestHit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "Count", .AnyHitShaderImport = "CountAnyHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = sizeof(ProbeHit)});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(GlobalRootSignature{root_signature});
  return device.CreateStateObject(desc).value();
}

}  // namespace

RayProbe::RayProbe(const DeviceDesc& desc)
    : device_(CreateDevice(desc).value()),
      queue_(device_.CreateCommandQueue().value()),
      root_signature_(device_.CreateRootSignature("SRV(t0), SRV(t1), UAV(u0)").value()),
      pipeline_(create_pipeline(device_, root_signature_)),
      hits_(pipeline_),
      counts_(pipeline_),
      miss_(pipeline_),
      groups_(pipeline_) {
  hits_.AddRecord("ProbeRays").value();
  counts_.AddRecord("CountTriangles").value();
  miss_.AddRecord("ProbeMiss").value();
  groups_.AddRecord("Hit").value();
  groups_.AddRecord("Count").value();
  for (ShaderTable* table : {&hits_, &counts_, &miss_, &groups_}) table->Build(device_).value();
}

void RayProbe::set_mesh(const ProbeMesh& mesh) {
  bottom_level_ = build_mesh(device_, queue_, mesh);
  top_level_ = build_instance(device_, queue_, mesh, bottom_level_);
}

std::vector<ProbeHit> RayProbe::hits(const std::vector<ProbeRay>& rays) {
  return run(hits_, rays);
}

std::vector<std::uint32_t> RayProbe::triangle_counts(const std::vector<ProbeRay>& rays) {
  std::vector<std::uint32_t> counts;
  counts.reserve(rays.size());
  for (const ProbeHit& hit : run(counts_, rays)) counts.push_back(hit.primitive);
  return counts;
}

std::vector<ProbeHit> RayProbe::run(const ShaderTable& ray_generation,
                                    const std::vector<ProbeRay>& rays) {
  const Buffer ray_buffer = CreateUploadBuffer(device_, rays, "rays").value();
  BufferDesc desc;
  desc.SizeInBytes = rays.size() * sizeof(ProbeHit);
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  const Buffer hit_buffer = device_.CreateBuffer(desc).value();
  CommandList list = device_.CreateCommandList().value();
  list.SetComputeRootSignature(root_signature_);
  list.SetComputeRootShaderResourceView(0, top_level_.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(1, ray_buffer.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(2, hit_buffer.GetGPUVirtualAddress());
  list.SetPipelineState1(pipeline_);
  list.DispatchRays({.RayGenerationShaderRecord = ray_generation.GetRecord(0),
                     .MissShaderTable = miss_.GetTable(),
                     .HitGroupTable = groups_.GetTable(),
                     .Width = static_cast<std::uint32_t>(rays.size()),
                     .Height = 1});
  queue_.ExecuteAndWait(list).value();
  const std::vector<std::byte> bytes = ReadbackBuffer(device_, queue_, hit_buffer).value();
  std::vector<ProbeHit> hits(rays.size());
  std::memcpy(hits.data(), bytes.data(), hits.size() * sizeof(ProbeHit));
  return hits;
}

std::vector<ProbeHit> probe(const ProbeMesh& mesh, const std::vector<ProbeRay>& rays) {
  RayProbe prober;
  prober.set_mesh(mesh);
  return prober.hits(rays);
}

}  // namespace kaamos::test
