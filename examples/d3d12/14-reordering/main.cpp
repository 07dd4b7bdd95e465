// SPDX-License-Identifier: MIT
// The picture of ../../14-reordering as a D3D12 program: it asks the device for Shader Model 6.9
// and whether threads are really reordered, then follows mirrors by hit objects.
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "..\common\program.h"
#include "CompiledShaders\reordering.h"

namespace {

// Records of the hit group table.
enum Material : UINT { kMatte, kCheckered, kMirror };
const wchar_t* const kMaterials[] = {L"Matte", L"Checkered", L"Mirror"};
const wchar_t* const kGroups[] = {L"MatteGroup", L"CheckeredGroup", L"MirrorGroup"};

struct Color {
  float rgb[3];
};
struct Box {
  float center[3];
  float half_size[3];
  float turn;  // radians about y
  Material material;
  Color color;
};
const Box kBoxes[] = {
    {{0, -0.5f, 0}, {8, 0.5f, 8}, 0, kCheckered, {0.8f, 0.79f, 0.75f}},
    {{-2.6f, 1, 0.6f}, {0.8f, 1, 0.8f}, 0.5f, kMatte, {0.8f, 0.3f, 0.2f}},
    {{-0.6f, 0.55f, -1.6f}, {0.55f, 0.55f, 0.55f}, 0.9f, kMatte, {0.25f, 0.5f, 0.8f}},
    {{2.6f, 0.8f, -0.9f}, {0.4f, 0.8f, 0.4f}, 0.2f, kMatte, {0.3f, 0.65f, 0.35f}},
    {{-1.8f, 1.8f, 3.2f}, {2.6f, 1.8f, 0.1f}, -0.25f, kMirror, {0.9f, 0.85f, 0.75f}},
    {{3.3f, 1.8f, 2.4f}, {2.4f, 1.8f, 0.1f}, 0.55f, kMirror, {0.8f, 0.87f, 0.92f}},
    {{0.7f, 0.6f, 0.6f}, {0.6f, 0.6f, 0.6f}, 0.35f, kMirror, {0.85f, 0.85f, 0.85f}},
};
const float kCube[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                           {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
// Clockwise, seen from outside.
const UINT kSides[] = {0, 2, 1, 1, 2, 3, 1, 3, 5, 5, 3, 7, 5, 7, 4, 4, 7, 6,
                       4, 6, 0, 0, 6, 2, 2, 6, 3, 3, 6, 7, 4, 0, 5, 5, 0, 1};

class Mirrors : public Program {
 public:
  explicit Mirrors(const Options& options) : Program(options), image_(CreateImage()) {
    CheckSupport();
    BuildScene();
    CreatePipeline();
    CreateTables();
  }

  void Render() {
    list_->SetDescriptorHeaps(1, image_.heap.GetAddressOf());
    list_->SetComputeRootSignature(root_signature_.Get());
    list_->SetComputeRootShaderResourceView(0, top_level_->GetGPUVirtualAddress());
    list_->SetComputeRootShaderResourceView(1, colors_->GetGPUVirtualAddress());
    list_->SetComputeRootDescriptorTable(2, image_.heap->GetGPUDescriptorHandleForHeapStart());
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
  // HitObject and MaybeReorderThread are there with Shader Model 6.9; whether a device moves
  // threads is another question.
  void CheckSupport() {
    D3D12_FEATURE_DATA_SHADER_MODEL model = {D3D_SHADER_MODEL_6_9};
    CHECK(device_->CheckFeatureSupport(D3D12_FEATURE_SHADER_MODEL, &model, sizeof(model)));
    if (model.HighestShaderModel < D3D_SHADER_MODEL_6_9) {
      throw std::runtime_error("this device has no Shader Model 6.9");
    }
    D3D12_FEATURE_DATA_D3D12_OPTIONS22 options = {};
    CHECK(device_->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS22, &options, sizeof(options)));
    printf("this device %s threads\n",
           options.ShaderExecutionReorderingActuallyReorders ? "reorders" : "does not reorder");
  }

  void BuildScene() {
    vertices_ = Upload(kCube, sizeof(kCube));
    indices_ = Upload(kSides, sizeof(kSides));
    D3D12_RAYTRACING_GEOMETRY_DESC geometry = {};
    geometry.Type = D3D12_RAYTRACING_GEOMETRY_TYPE_TRIANGLES;
    geometry.Flags = D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE;
    geometry.Triangles.VertexFormat = DXGI_FORMAT_R32G32B32_FLOAT;
    geometry.Triangles.VertexCount = _countof(kCube);
    geometry.Triangles.VertexBuffer = {vertices_->GetGPUVirtualAddress(), sizeof(kCube[0])};
    geometry.Triangles.IndexFormat = DXGI_FORMAT_R32_UINT;
    geometry.Triangles.IndexCount = _countof(kSides);
    geometry.Triangles.IndexBuffer = indices_->GetGPUVirtualAddress();
    bottom_level_ = BuildBottomLevel({geometry});

    std::vector<D3D12_RAYTRACING_INSTANCE_DESC> instances;
    std::vector<Color> colors;
    for (const Box& box : kBoxes) {
      instances.push_back(InstanceOf(box));
      colors.push_back(box.color);
    }
    colors_ = Upload(colors.data(), colors.size() * sizeof(Color));
    top_level_ = BuildTopLevel(instances);
    Execute();
  }

  D3D12_RAYTRACING_INSTANCE_DESC InstanceOf(const Box& box) {
    D3D12_RAYTRACING_INSTANCE_DESC instance = InstanceAt(bottom_level_.Get(), 0, 0, 0);
    const float c = std::cos(box.turn);
    const float s = std::sin(box.turn);
    const float turn[3][3] = {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        instance.Transform[row][column] = turn[row][column] * box.half_size[column];
      }
      instance.Transform[row][3] = box.center[row];
    }
    instance.InstanceContributionToHitGroupIndex = box.material;  // selects its record
    return instance;
  }

  void CreatePipeline() {
    CD3DX12_DESCRIPTOR_RANGE1 image;
    image.Init(D3D12_DESCRIPTOR_RANGE_TYPE_UAV, 1, 0);
    CD3DX12_ROOT_PARAMETER1 parameters[3];
    parameters[0].InitAsShaderResourceView(0);
    parameters[1].InitAsShaderResourceView(1);
    parameters[2].InitAsDescriptorTable(1, &image);
    CD3DX12_VERSIONED_ROOT_SIGNATURE_DESC root_signature;
    root_signature.Init_1_1(_countof(parameters), parameters);
    root_signature_ = CreateRootSignature(root_signature);

    CD3DX12_STATE_OBJECT_DESC pipeline(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
    const CD3DX12_SHADER_BYTECODE bytecode(g_pReordering, sizeof(g_pReordering));
    pipeline.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>()->SetDXILLibrary(&bytecode);
    for (UINT i = 0; i < _countof(kMaterials); ++i) {
      auto* group = pipeline.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>();
      group->SetHitGroupExport(kGroups[i]);
      group->SetClosestHitShaderImport(kMaterials[i]);
    }
    constexpr UINT kShadingBytes = 4 * 3 * sizeof(float);
    pipeline.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(
        kShadingBytes, D3D12_RAYTRACING_MAX_ATTRIBUTE_SIZE_IN_BYTES);
    // TraceRay and Invoke both come from the ray generation shader.
    pipeline.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(1);
    pipeline.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
        root_signature_.Get());
    CHECK(device_->CreateStateObject(pipeline, IID_PPV_ARGS(&pipeline_)));
  }

  void CreateTables() {
    raygen_table_ = CreateShaderTable(pipeline_.Get(), L"FollowMirrors");
    miss_table_ = CreateShaderTable(pipeline_.Get(), L"Sky");
    ShaderTable hit_groups(pipeline_.Get());
    for (const wchar_t* group : kGroups) hit_groups.AddRecord(group);
    hit_table_ = Upload(hit_groups);
    hit_bytes_ = hit_groups.Records().size();
    hit_stride_ = hit_groups.Stride();
  }

  Image image_;
  ComPtr<ID3D12Resource> vertices_, indices_, colors_, bottom_level_, top_level_;
  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12StateObject> pipeline_;
  ComPtr<ID3D12Resource> raygen_table_, miss_table_, hit_table_;
  UINT64 hit_bytes_ = 0, hit_stride_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  return RunProgram(argc, argv, [](const Options& options) { Mirrors(options).Render(); });
}
