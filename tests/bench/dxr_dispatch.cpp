// SPDX-License-Identifier: MIT
#include <rtapi/upload.h>
#include <shaders/bench.h>
#include <shaders/hit_objects.h>

#include "dxr_scene.h"

namespace kaamos::bench {
namespace {

using namespace rtapi;

// Parameters of the global root signature, in order.
enum Parameter : uint32_t { kScene, kRays, kMaterials, kClosest, kVisible, kShaded, kImages };

constexpr char kGlobalSignature[] =
    "SRV(t0), SRV(t1), SRV(t2), UAV(u0), UAV(u1), UAV(u2),"
    "DescriptorTable(SRV(t0, space = 1, numDescriptors = unbounded)),"
    "StaticSampler(s0, filter = FILTER_MIN_MAG_MIP_LINEAR)";
constexpr char kLocalSignature[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), SRV(t0, space = 2), SRV(t1, space = 2),"
    "RootConstants(b0, space = 2, num32BitConstants = 1)";
constexpr char kHitGroup[] = "HitGroup";

struct Shaders {
  const char* ray_generation;
  const char* miss;
  const char* closest_hit;  // empty: none
  const char* any_hit;      // empty: none
  uint32_t payload_bytes;
  uint32_t result_bytes;
  Parameter output;
};

const Shaders& shaders_of(Program program) {
  static const Shaders kShaders[] = {
      {"ClosestRays", "ClosestMiss", "ClosestHit", "", 8, sizeof(ClosestResult), kClosest},
      {"VisibilityRays", "VisibilityMiss", "", "", 4, 4, kVisible},
      {"VisibilityRays", "VisibilityMiss", "", "AlphaTest", 4, 4, kVisible},
      {"ShadedRays", "ShadedMiss", "ShadedHit", "", 32, sizeof(ShadedResult), kShaded},
      {"ClosestHitObjects", "ClosestMiss", "ClosestHit", "", 8, sizeof(ClosestResult), kClosest},
      {"ShadedHitObjects", "ShadedMiss", "ShadedHit", "", 32, sizeof(ShadedResult), kShaded},
  };
  return kShaders[static_cast<int>(program)];
}

bool has_local_signature(const Shaders& shaders) {
  return shaders.any_hit[0] != 0 || std::string_view(shaders.closest_hit) == "ShadedHit";
}

}  // namespace

DxrDispatch::DxrDispatch(DxrScene& scene, Program program, const RayGrid& grid)
    : scene_(scene), program_(program), grid_(grid) {
  rays_ = CreateUploadBuffer(scene.device(), grid.rays, "rays").value();
  BufferDesc desc;
  desc.SizeInBytes = grid.rays.size() * shaders_of(program).result_bytes;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  desc.Name = "results";
  results_ = scene.device().CreateBuffer(desc).value();
  create_pipeline();
  create_tables();
  record();
}

void DxrDispatch::create_pipeline() {
  const Device& device = scene_.device();
  const Shaders& shaders = shaders_of(program_);
  global_ = device.CreateRootSignature(kGlobalSignature).value();
  DxilLibraryDesc library;
  const bool by_hit_objects = program_ >= Program::kHitObject;
  library.DXILLibrary =
      LoadShaderLibrary(by_hit_objects ? kaamos_shaders_hit_objects() : kaamos_shaders_bench())
          .value();
  for (const char* name :
       {shaders.ray_generation, shaders.miss, shaders.closest_hit, shaders.any_hit}) {
    if (name[0] != 0) library.Exports.push_back({name, ""});
  }
  StateObjectDesc desc;
  desc.Add(library);
  HitGroupDesc group;
  group.HitGroupExport = kHitGroup;
  group.ClosestHitShaderImport = shaders.closest_hit;
  group.AnyHitShaderImport = shaders.any_hit;
  desc.Add(group);
  desc.Add(RaytracingShaderConfig{shaders.payload_bytes, 8});
  desc.Add(RaytracingPipelineConfig{1});
  desc.Add(GlobalRootSignature{global_});
  if (has_local_signature(shaders)) {
    local_ = device.CreateRootSignature(kLocalSignature).value();
    const uint32_t subobject = desc.Add(LocalRootSignature{local_});
    desc.Associate(subobject, {kHitGroup});
  }
  pipeline_ = device.CreateStateObject(desc).value();
}

void DxrDispatch::create_tables() {
  const Shaders& shaders = shaders_of(program_);
  for (int i = 0; i < 3; ++i) tables_.emplace_back(pipeline_);
  tables_[0].AddRecord(shaders.ray_generation).value();
  tables_[1].AddRecord(shaders.miss).value();
  for (const MeshData& mesh : scene_.data().meshes) {
    for (const GeometryData& geometry : mesh.geometries) {
      if (!has_local_signature(shaders)) {
        tables_[2].AddRecord(kHitGroup).value();
        continue;
      }
      tables_[2]
          .AddRecord(kHitGroup, {LocalArgument::Address(scene_.vertices_of(mesh, geometry)),
                                 LocalArgument::Address(scene_.indices_of(mesh, geometry)),
                                 LocalArgument::Constants(geometry.material)})
          .value();
    }
  }
  for (ShaderTable& table : tables_) table.Build(scene_.device()).value();
}

void DxrDispatch::record() {
  list_ = scene_.device().CreateCommandList().value();
  list_.SetDescriptorHeaps({scene_.images()});
  list_.SetComputeRootSignature(global_);
  list_.SetPipelineState1(pipeline_);
  list_.SetComputeRootShaderResourceView(kScene, scene_.top_level().GetGPUVirtualAddress());
  list_.SetComputeRootShaderResourceView(kRays, rays_.GetGPUVirtualAddress());
  list_.SetComputeRootShaderResourceView(kMaterials, scene_.materials().GetGPUVirtualAddress());
  list_.SetComputeRootUnorderedAccessView(shaders_of(program_).output,
                                          results_.GetGPUVirtualAddress());
  list_.SetComputeRootDescriptorTable(kImages, scene_.images().GetGPUDescriptorHandle(0));
  DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = tables_[0].GetRecord(0);
  desc.MissShaderTable = tables_[1].GetTable();
  desc.HitGroupTable = tables_[2].GetTable();
  desc.Width = grid_.width;
  desc.Height = grid_.height;
  list_.DispatchRays(desc);
  list_.Close().value();
}

void DxrDispatch::run() {
  scene_.queue().ExecuteAndWait(list_).value();
}

}  // namespace kaamos::bench
