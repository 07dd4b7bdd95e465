// SPDX-License-Identifier: MIT
// The picture of ../../05-callable-and-recursion as a D3D12 program whose state object is declared
// in HLSL: root signatures, hit group, association and configs are subobjects of the library.
#include <vector>

#include "..\common\program.h"
#include "CompiledShaders\subobjects.h"

namespace {

struct Box {
  float lower[3];
  float upper[3];
  UINT callable;  // record of the callable table: what its surface looks like
};
const Box kBoxes[] = {
    {{-8, -0.1f, -8}, {8, 0, 8}, 0},        // floor
    {{-3, 0, 2.5f}, {3, 2.6f, 2.7f}, 1},    // mirror behind
    {{-3.2f, 0, -2}, {-3, 2.6f, 2.5f}, 1},  // mirror on the left
    {{-0.6f, 0, -0.4f}, {0.4f, 1.3f, 0.6f}, 2},
    {{1.2f, 0, 0.2f}, {1.8f, 0.7f, 0.8f}, 2},
};
// Four triangles for each axis; front faces point outwards.
const UINT kSides[] = {0, 4, 2, 4, 6, 2, 1, 3, 5, 3, 7, 5,   // x
                       0, 1, 4, 1, 5, 4, 2, 6, 3, 6, 7, 3,   // y
                       0, 2, 1, 2, 3, 1, 4, 5, 6, 6, 5, 7};  // z

class Mirrors : public Program {
 public:
  explicit Mirrors(const Options& options) : Program(options), image_(CreateImage()) {
    BuildScene();
    CreatePipeline();
    CreateTables();
  }

  void Render() {
    list_->SetDescriptorHeaps(1, image_.heap.GetAddressOf());
    list_->SetComputeRootSignature(root_signature_.Get());
    list_->SetComputeRootShaderResourceView(0, top_level_->GetGPUVirtualAddress());
    list_->SetComputeRootDescriptorTable(1, image_.heap->GetGPUDescriptorHandleForHeapStart());
    list_->SetPipelineState1(pipeline_.Get());

    constexpr UINT kRecord = D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES;
    D3D12_DISPATCH_RAYS_DESC rays = {};
    rays.RayGenerationShaderRecord = {raygen_table_->GetGPUVirtualAddress(), kRecord};
    rays.MissShaderTable = {miss_table_->GetGPUVirtualAddress(), kRecord, kRecord};
    rays.HitGroupTable = {hit_table_->GetGPUVirtualAddress(), _countof(kBoxes) * hit_stride_,
                          hit_stride_};
    rays.CallableShaderTable = {callable_table_->GetGPUVirtualAddress(), 3 * kRecord, kRecord};
    rays.Width = options_.width;
    rays.Height = options_.height;
    rays.Depth = 1;
    list_->DispatchRays(&rays);
    WritePicture(image_.texture.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS);
  }

 private:
  void BuildScene() {
    indices_ = Upload(kSides, sizeof(kSides));
    std::vector<float> corners;
    for (const Box& box : kBoxes) {
      for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          corners.push_back((i >> axis & 1) != 0 ? box.upper[axis] : box.lower[axis]);
        }
      }
    }
    constexpr UINT kCorner = 3 * sizeof(float);
    vertices_ = Upload(corners.data(), corners.size() * sizeof(float));
    // One geometry for each box, since each has a record.
    std::vector<D3D12_RAYTRACING_GEOMETRY_DESC> geometries;
    for (UINT i = 0; i < _countof(kBoxes); ++i) {
      D3D12_RAYTRACING_GEOMETRY_DESC geometry = {};
      geometry.Type = D3D12_RAYTRACING_GEOMETRY_TYPE_TRIANGLES;
      geometry.Flags = D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE;
      geometry.Triangles.VertexFormat = DXGI_FORMAT_R32G32B32_FLOAT;
      geometry.Triangles.VertexCount = 8;
      geometry.Triangles.VertexBuffer = {vertices_->GetGPUVirtualAddress() + 8 * i * kCorner,
                                         kCorner};
      geometry.Triangles.IndexFormat = DXGI_FORMAT_R32_UINT;
      geometry.Triangles.IndexCount = _countof(kSides);
      geometry.Triangles.IndexBuffer = indices_->GetGPUVirtualAddress();
      geometries.push_back(geometry);
    }
    bottom_level_ = BuildBottomLevel(geometries);
    top_level_ = BuildTopLevel({InstanceAt(bottom_level_.Get(), 0, 0, 0)});
    Execute();
  }

  void CreatePipeline() {
    CD3DX12_STATE_OBJECT_DESC pipeline(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
    const CD3DX12_SHADER_BYTECODE bytecode(g_pSubobjects, sizeof(g_pSubobjects));
    pipeline.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>()->SetDXILLibrary(&bytecode);
    CHECK(device_->CreateStateObject(pipeline, IID_PPV_ARGS(&pipeline_)));
    // The library's only global one.
    CHECK(device_->CreateRootSignature(0, g_pSubobjects, sizeof(g_pSubobjects),
                                       IID_PPV_ARGS(&root_signature_)));
  }

  void CreateTables() {
    raygen_table_ = CreateShaderTable(pipeline_.Get(), L"RayGen");
    miss_table_ = CreateShaderTable(pipeline_.Get(), L"Miss");
    ShaderTable hit_groups(pipeline_.Get());
    for (const Box& box : kBoxes) hit_groups.AddRecord(L"BoxGroup", box.callable);
    hit_table_ = Upload(hit_groups);
    hit_stride_ = hit_groups.Stride();
    ShaderTable callables(pipeline_.Get());
    for (const wchar_t* name : {L"Chequers", L"Mirror", L"Stripes"}) callables.AddRecord(name);
    callable_table_ = Upload(callables);
  }

  Image image_;
  ComPtr<ID3D12Resource> vertices_, indices_, bottom_level_, top_level_;
  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12StateObject> pipeline_;
  ComPtr<ID3D12Resource> raygen_table_, miss_table_, hit_table_, callable_table_;
  UINT64 hit_stride_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  return RunProgram(argc, argv, [](const Options& options) { Mirrors(options).Render(); });
}
