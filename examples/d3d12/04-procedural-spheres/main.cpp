// SPDX-License-Identifier: MIT
// The picture of ../../04-procedural-spheres as a D3D12 program: boxes, an intersection shader that
// finds spheres in them, and two ray types.
#include <cmath>
#include <vector>

#include "..\common\program.h"
#include "CompiledShaders\spheres.h"

namespace {

struct Sphere {
  float x, y, z, radius;
};

class Spheres : public Program {
 public:
  explicit Spheres(const Options& options) : Program(options), image_(CreateImage()) {
    BuildScene();
    CreatePipeline();
    CreateTables();
  }

  void Render() {
    list_->SetDescriptorHeaps(1, image_.heap.GetAddressOf());
    list_->SetComputeRootSignature(root_signature_.Get());
    list_->SetComputeRootShaderResourceView(0, top_level_->GetGPUVirtualAddress());
    list_->SetComputeRootShaderResourceView(1, spheres_->GetGPUVirtualAddress());
    list_->SetComputeRootDescriptorTable(2, image_.heap->GetGPUDescriptorHandleForHeapStart());
    list_->SetPipelineState1(pipeline_.Get());

    constexpr UINT kRecord = D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES;
    D3D12_DISPATCH_RAYS_DESC rays = {};
    rays.RayGenerationShaderRecord = {raygen_table_->GetGPUVirtualAddress(), kRecord};
    rays.MissShaderTable = {miss_table_->GetGPUVirtualAddress(), 2 * kRecord, kRecord};
    rays.HitGroupTable = {hit_table_->GetGPUVirtualAddress(), 2 * kRecord, kRecord};
    rays.Width = options_.width;
    rays.Height = options_.height;
    rays.Depth = 1;
    list_->DispatchRays(&rays);
    WritePicture(image_.texture.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS);
  }

 private:
  void BuildScene() {
    std::vector<Sphere> spheres;
    std::vector<D3D12_RAYTRACING_AABB> boxes;
    for (int i = 0; i < 60; ++i) {
      // A spiral that grows outwards.
      const float t = static_cast<float>(i) / 60;
      const float angle = 14 * t;
      const Sphere s = {3.2f * t * std::cos(angle), 1.6f * t * std::sin(angle),
                        2 * std::sin(angle * 2), 0.12f + 0.35f * t};
      spheres.push_back(s);
      boxes.push_back({s.x - s.radius, s.y - s.radius, s.z - s.radius, s.x + s.radius,
                       s.y + s.radius, s.z + s.radius});
    }
    spheres_ = Upload(spheres.data(), spheres.size() * sizeof(Sphere));
    boxes_ = Upload(boxes.data(), boxes.size() * sizeof(boxes[0]));
    D3D12_RAYTRACING_GEOMETRY_DESC geometry = {};
    geometry.Type = D3D12_RAYTRACING_GEOMETRY_TYPE_PROCEDURAL_PRIMITIVE_AABBS;
    geometry.Flags = D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE;
    geometry.AABBs.AABBCount = boxes.size();
    geometry.AABBs.AABBs = {boxes_->GetGPUVirtualAddress(), sizeof(boxes[0])};
    bottom_level_ = BuildBottomLevel({geometry});
    top_level_ = BuildTopLevel({InstanceAt(bottom_level_.Get(), 0, 0.6f, 0)});
    Execute();
  }

  void CreatePipeline() {
    CD3DX12_DESCRIPTOR_RANGE1 image;
    image.Init(D3D12_DESCRIPTOR_RANGE_TYPE_UAV, 1, 0);
    CD3DX12_ROOT_PARAMETER1 parameters[3];
    parameters[0].InitAsShaderResourceView(0);
    parameters[1].InitAsShaderResourceView(1);
    parameters[2].InitAsDescriptorTable(1, &image);
    CD3DX12_VERSIONED_ROOT_SIGNATURE_DESC desc;
    desc.Init_1_1(_countof(parameters), parameters);
    root_signature_ = CreateRootSignature(desc);

    CD3DX12_STATE_OBJECT_DESC pipeline(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
    const CD3DX12_SHADER_BYTECODE bytecode(g_pSpheres, sizeof(g_pSpheres));
    pipeline.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>()->SetDXILLibrary(&bytecode);
    auto* camera = pipeline.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>();
    camera->SetHitGroupExport(L"SphereGroup");
    camera->SetHitGroupType(D3D12_HIT_GROUP_TYPE_PROCEDURAL_PRIMITIVE);
    camera->SetIntersectionShaderImport(L"SphereIntersection");
    camera->SetClosestHitShaderImport(L"SphereClosestHit");
    auto* shadow = pipeline.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>();
    shadow->SetHitGroupExport(L"SphereShadowGroup");
    shadow->SetHitGroupType(D3D12_HIT_GROUP_TYPE_PROCEDURAL_PRIMITIVE);
    shadow->SetIntersectionShaderImport(L"SphereIntersection");
    pipeline.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(12, 12);
    pipeline.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(2);
    pipeline.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
        root_signature_.Get());
    CHECK(device_->CreateStateObject(pipeline, IID_PPV_ARGS(&pipeline_)));
  }

  // Record 0 is that of camera rays, record 1 that of shadow rays.
  void CreateTables() {
    raygen_table_ = CreateShaderTable(pipeline_.Get(), L"RayGen");
    ShaderTable misses(pipeline_.Get());
    misses.AddRecord(L"Miss");
    misses.AddRecord(L"ShadowMiss");
    miss_table_ = Upload(misses);
    ShaderTable hit_groups(pipeline_.Get());
    hit_groups.AddRecord(L"SphereGroup");
    hit_groups.AddRecord(L"SphereShadowGroup");
    hit_table_ = Upload(hit_groups);
  }

  Image image_;
  ComPtr<ID3D12Resource> spheres_, boxes_, bottom_level_, top_level_;
  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12StateObject> pipeline_;
  ComPtr<ID3D12Resource> raygen_table_, miss_table_, hit_table_;
};

}  // namespace

int main(int argc, char** argv) {
  return RunProgram(argc, argv, [](const Options& options) { Spheres(options).Render(); });
}
