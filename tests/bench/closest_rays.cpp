// SPDX-License-Identifier: MIT
#include "closest_rays.h"

#include <rtapi/upload.h>
#include <shaders/bench.h>

#include <cstring>
#include <random>

namespace kaamos::bench {

using namespace rtapi;

std::vector<Ray> random_rays(const Options& options, const float (&lower)[3],
                             const float (&upper)[3]) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> position(0, 1);
  std::uniform_real_distribution<float> direction(-1, 1);
  std::vector<Ray> rays(size_t{options.width} * options.height);
  for (Ray& ray : rays) {
    for (int i = 0; i < 3; ++i) {
      ray.origin[i] = lower[i] + (upper[i] - lower[i]) * position(random);
    }
    for (int i = 0; i < 3; ++i) ray.direction[i] = direction(random);
    ray.t_min = 0;
    ray.t_max = 1000;
  }
  return rays;
}

ClosestRays::ClosestRays(const Device& device, const CommandQueue& queue, const Options& options,
                         const std::vector<Ray>& rays)
    : device_(device), queue_(queue) {
  rays_ = CreateUploadBuffer(device, rays, "rays").value();
  BufferDesc desc;
  desc.SizeInBytes = rays.size() * sizeof(ClosestResult);
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  results_ = device.CreateBuffer(desc).value();
  signature_ = device.CreateRootSignature("SRV(t0), SRV(t1), UAV(u0)").value();
  DxilLibraryDesc library;
  library.DXILLibrary = LoadShaderLibrary(kaamos_shaders_bench()).value();
  library.Exports = {{"ClosestRays", ""}, {"ClosestMiss", ""}, {"ClosestHit", ""}};
  StateObjectDesc state;
  state.Add(library);
  HitGroupDesc group;
  group.HitGroupExport = "HitGroup";
  group.ClosestHitShaderImport = "ClosestHit";
  state.Add(group);
  state.Add(RaytracingShaderConfig{8, 8});
  state.Add(RaytracingPipelineConfig1{1, RaytracingPipelineFlags::kAllowClusteredGeometry});
  state.Add(GlobalRootSignature{signature_});
  pipeline_ = device.CreateStateObject(state).value();
  const char* const kNames[] = {"ClosestRays", "ClosestMiss", "HitGroup"};
  for (const char* name : kNames) {
    tables_.emplace_back(pipeline_).AddRecord(name).value();
    tables_.back().Build(device).value();
  }
  dispatch_.RayGenerationShaderRecord = tables_[0].GetRecord(0);
  dispatch_.MissShaderTable = tables_[1].GetTable();
  dispatch_.HitGroupTable = tables_[2].GetTable();
  dispatch_.Width = options.width;
  dispatch_.Height = options.height;
}

CommandList ClosestRays::list_for(GpuVirtualAddress top_level) const {
  CommandList list = device_.CreateCommandList().value();
  list.SetComputeRootSignature(signature_);
  list.SetPipelineState1(pipeline_);
  list.SetComputeRootShaderResourceView(0, top_level);
  list.SetComputeRootShaderResourceView(1, rays_.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(2, results_.GetGPUVirtualAddress());
  list.DispatchRays(dispatch_);
  list.Close().value();
  return list;
}

std::vector<ClosestResult> ClosestRays::results() const {
  const std::vector<std::byte> bytes = ReadbackBuffer(device_, queue_, results_).value();
  std::vector<ClosestResult> out(bytes.size() / sizeof(ClosestResult));
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

}  // namespace kaamos::bench
