// SPDX-License-Identifier: MIT
// The picture of ../../06-local-root-signature as a D3D12 program: a torus three times, each with a
// record of its own that holds buffers and a material.
#include <cmath>
#include <vector>

#include "..\common\program.h"
#include "CompiledShaders\records.h"

namespace {

struct Vertex {
  float position[3];
  float normal[3];
};

struct Material {
  float color[3];
  float roughness;
};
const Material kMaterials[] = {
    {{0.7f, 0.08f, 0.05f}, 0.5f}, {{0.05f, 0.4f, 0.1f}, 0.25f}, {{0.05f, 0.12f, 0.6f}, 0.1f}};

// The data that follow the identifier in a record of TorusGroup: the parameters of its local root
// signature.
struct TorusArguments {
  D3D12_GPU_VIRTUAL_ADDRESS vertices;
  D3D12_GPU_VIRTUAL_ADDRESS indices;
  Material material;
};

void MakeTorus(UINT around, UINT across, std::vector<Vertex>& vertices,
               std::vector<UINT>& indices) {
  const float turn = 6.2831853f;
  for (UINT i = 0; i < around; ++i) {
    for (UINT j = 0; j < across; ++j) {
      const float u = turn * static_cast<float>(i) / static_cast<float>(around);
      const float v = turn * static_cast<float>(j) / static_cast<float>(across);
      const float r = 0.7f + 0.3f * std::cos(v);
      vertices.push_back({{r * std::cos(u), r * std::sin(u), 0.3f * std::sin(v)},
                          {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)}});
      const UINT a = i * across + j;
      const UINT b = i * across + (j + 1) % across;
      const UINT c = (i + 1) % around * across + j;
      const UINT d = (i + 1) % around * across + (j + 1) % across;
      indices.insert(indices.end(), {a, b, c, c, b, d});
    }
  }
}

class Tori : public Program {
 public:
  explicit Tori(const Options& options) : Program(options), image_(CreateImage()) {
    BuildScene();
    CreatePipeline();
    CreateTables();
  }

  void Render() {
    list_->SetDescriptorHeaps(1, image_.heap.GetAddressOf());
    list_->SetComputeRootSignature(global_.Get());
    list_->SetComputeRootShaderResourceView(0, top_level_->GetGPUVirtualAddress());
    list_->SetComputeRootDescriptorTable(1, image_.heap->GetGPUDescriptorHandleForHeapStart());
    list_->SetPipelineState1(pipeline_.Get());

    constexpr UINT kRecord = D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES;
    D3D12_DISPATCH_RAYS_DESC rays = {};
    rays.RayGenerationShaderRecord = {raygen_table_->GetGPUVirtualAddress(), kRecord};
    rays.MissShaderTable = {miss_table_->GetGPUVirtualAddress(), kRecord, kRecord};
    rays.HitGroupTable = {hit_table_->GetGPUVirtualAddress(), hit_bytes_, hit_stride_};
    rays.Width = options_.width;
    rays.Height = options_.height;
    rays.Depth = 1;
    list_->DispatchRays(&rays);
    WritePicture(image_.texture.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS);
  }

 private:
  void BuildScene() {
    std::vector<Vertex> vertices;
    std::vector<UINT> indices;
    MakeTorus(64, 32, vertices, indices);
    vertices_ = Upload(vertices.data(), vertices.size() * sizeof(Vertex));
    indices_ = Upload(indices.data(), indices.size() * sizeof(UINT));
    D3D12_RAYTRACING_GEOMETRY_DESC geometry = {};
    geometry.Type = D3D12_RAYTRACING_GEOMETRY_TYPE_TRIANGLES;
    geometry.Flags = D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE;
    geometry.Triangles.VertexFormat = DXGI_FORMAT_R32G32B32_FLOAT;
    geometry.Triangles.VertexCount = static_cast<UINT>(vertices.size());
    geometry.Triangles.VertexBuffer = {vertices_->GetGPUVirtualAddress(), sizeof(Vertex)};
    geometry.Triangles.IndexFormat = DXGI_FORMAT_R32_UINT;
    geometry.Triangles.IndexCount = static_cast<UINT>(indices.size());
    geometry.Triangles.IndexBuffer = indices_->GetGPUVirtualAddress();
    bottom_level_ = BuildBottomLevel({geometry});

    std::vector<D3D12_RAYTRACING_INSTANCE_DESC> instances;
    for (UINT i = 0; i < _countof(kMaterials); ++i) {
      instances.push_back(
          InstanceAt(bottom_level_.Get(), -2.2f + 2.2f * static_cast<float>(i), 0, 0));
      instances.back().InstanceContributionToHitGroupIndex = i;  // selects record i
    }
    top_level_ = BuildTopLevel(instances);
    Execute();
  }

  void CreatePipeline() {
    CD3DX12_DESCRIPTOR_RANGE1 image;
    image.Init(D3D12_DESCRIPTOR_RANGE_TYPE_UAV, 1, 0);
    CD3DX12_ROOT_PARAMETER1 global_parameters[2];
    global_parameters[0].InitAsShaderResourceView(0);
    global_parameters[1].InitAsDescriptorTable(1, &image);
    CD3DX12_VERSIONED_ROOT_SIGNATURE_DESC global;
    global.Init_1_1(_countof(global_parameters), global_parameters);
    global_ = CreateRootSignature(global);

    CD3DX12_ROOT_PARAMETER1 local_parameters[3];
    local_parameters[0].InitAsShaderResourceView(0, 1);
    local_parameters[1].InitAsShaderResourceView(1, 1);
    local_parameters[2].InitAsConstants(sizeof(Material) / 4, 0, 1);
    CD3DX12_VERSIONED_ROOT_SIGNATURE_DESC local;
    local.Init_1_1(_countof(local_parameters), local_parameters, 0, nullptr,
                   D3D12_ROOT_SIGNATURE_FLAG_LOCAL_ROOT_SIGNATURE);
    local_ = CreateRootSignature(local);

    CD3DX12_STATE_OBJECT_DESC pipeline(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
    const CD3DX12_SHADER_BYTECODE bytecode(g_pRecords, sizeof(g_pRecords));
    pipeline.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>()->SetDXILLibrary(&bytecode);
    auto* group = pipeline.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>();
    group->SetHitGroupExport(L"TorusGroup");
    group->SetClosestHitShaderImport(L"ClosestHit");
    pipeline.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(12, 8);
    pipeline.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(1);
    pipeline.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
        global_.Get());
    auto* arguments = pipeline.CreateSubobject<CD3DX12_LOCAL_ROOT_SIGNATURE_SUBOBJECT>();
    arguments->SetRootSignature(local_.Get());
    auto* association =
        pipeline.CreateSubobject<CD3DX12_SUBOBJECT_TO_EXPORTS_ASSOCIATION_SUBOBJECT>();
    association->SetSubobjectToAssociate(*arguments);
    association->AddExport(L"TorusGroup");
    CHECK(device_->CreateStateObject(pipeline, IID_PPV_ARGS(&pipeline_)));
  }

  void CreateTables() {
    raygen_table_ = CreateShaderTable(pipeline_.Get(), L"RayGen");
    miss_table_ = CreateShaderTable(pipeline_.Get(), L"Miss");
    ShaderTable hit_groups(pipeline_.Get());
    for (const Material& material : kMaterials) {
      hit_groups.AddRecord(L"TorusGroup",
                           TorusArguments{vertices_->GetGPUVirtualAddress(),
                                          indices_->GetGPUVirtualAddress(), material});
    }
    hit_table_ = Upload(hit_groups);
    hit_bytes_ = hit_groups.Records().size();
    hit_stride_ = hit_groups.Stride();
  }

  Image image_;
  ComPtr<ID3D12Resource> vertices_, indices_, bottom_level_, top_level_;
  ComPtr<ID3D12RootSignature> global_, local_;
  ComPtr<ID3D12StateObject> pipeline_;
  ComPtr<ID3D12Resource> raygen_table_, miss_table_, hit_table_;
  UINT64 hit_bytes_ = 0, hit_stride_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  return RunProgram(argc, argv, [](const Options& options) { Tori(options).Render(); });
}
