// SPDX-License-Identifier: MIT
// The picture of ../../07-update-and-compaction as a D3D12 program of several passes: a compute
// shader makes the vertices, a bottom level is built, compacted and updated, and the rays'
// arguments are in a buffer; timestamps tell how long each pass takes.
#include <cmath>
#include <cstdio>
#include <vector>

#include "..\common\pass_times.h"
#include "..\common\program.h"
#include "CompiledShaders\grid.h"
#include "CompiledShaders\wave.h"

namespace {

constexpr UINT kCells = 48;
constexpr UINT kVertices = (kCells + 1) * (kCells + 1);
constexpr auto kUpdate = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PERFORM_UPDATE;

std::vector<float> WaveHeights(float phase) {
  std::vector<float> heights;
  for (UINT i = 0; i <= kCells; ++i) {
    for (UINT j = 0; j <= kCells; ++j) {
      const float x = 2.0f * static_cast<float>(j) / kCells - 1;
      const float z = 2.0f * static_cast<float>(i) / kCells - 1;
      heights.push_back(0.25f * std::sin(9 * std::hypot(x, z) - phase));
    }
  }
  return heights;
}

class Wave : public Program {
 public:
  explicit Wave(const Options& options) : Program(options), image_(CreateImage()) {
    CreateMesh();
    CreatePipelines();
  }

  void Render() {
    BuildAndMeasure();
    const UINT64 compacted_bytes = ReadCompactedSize();
    printf("bottom level: %llu bytes, compacted %llu\n",
           static_cast<unsigned long long>(sizes_.ResultDataMaxSizeInBytes),
           static_cast<unsigned long long>(compacted_bytes));

    times_.Start(list_.Get());
    CompactInto(compacted_bytes);
    times_.End(list_.Get(), "compaction");
    MakeVertices(WaveHeights(3.14159265f));
    times_.End(list_.Get(), "vertices");
    Update();
    times_.End(list_.Get(), "update");
    before_ = BuildTopLevel({InstanceAt(compacted_.Get(), 0, 0, 0)});
    after_ = BuildTopLevel({InstanceAt(updated_.Get(), 0, 0, 0)});
    times_.End(list_.Get(), "top levels");
    DispatchRays();
    times_.End(list_.Get(), "rays");
    times_.Resolve(list_.Get());
    WritePicture(image_.texture.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS);
    times_.Print();
  }

 private:
  ComPtr<ID3D12Resource> CreateStructure(UINT64 bytes) {
    return CreateBuffer(bytes, D3D12_HEAP_TYPE_DEFAULT,
                        D3D12_RESOURCE_STATE_RAYTRACING_ACCELERATION_STRUCTURE,
                        D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  }
  ComPtr<ID3D12Resource> CreateWritable(UINT64 bytes) {
    return CreateBuffer(bytes, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                        D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  }

  void CreateMesh() {
    std::vector<UINT> indices;
    for (UINT i = 0; i < kCells; ++i) {
      for (UINT j = 0; j < kCells; ++j) {
        const UINT a = i * (kCells + 1) + j;
        const UINT c = a + kCells + 1;
        indices.insert(indices.end(), {a, c, a + 1, a + 1, c, c + 1});
      }
    }
    indices_ = Upload(indices.data(), indices.size() * sizeof(UINT));
    vertices_ = CreateWritable(kVertices * 3 * sizeof(float));
    geometry_.Type = D3D12_RAYTRACING_GEOMETRY_TYPE_TRIANGLES;
    geometry_.Flags = D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE;
    geometry_.Triangles.VertexFormat = DXGI_FORMAT_R32G32B32_FLOAT;
    geometry_.Triangles.VertexCount = kVertices;
    geometry_.Triangles.VertexBuffer = {vertices_->GetGPUVirtualAddress(), 3 * sizeof(float)};
    geometry_.Triangles.IndexFormat = DXGI_FORMAT_R32_UINT;
    geometry_.Triangles.IndexCount = static_cast<UINT>(indices.size());
    geometry_.Triangles.IndexBuffer = indices_->GetGPUVirtualAddress();

    inputs_.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL;
    inputs_.Flags = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_ALLOW_UPDATE |
                    D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_ALLOW_COMPACTION;
    inputs_.NumDescs = 1;
    inputs_.pGeometryDescs = &geometry_;
    device_->GetRaytracingAccelerationStructurePrebuildInfo(&inputs_, &sizes_);
    built_ = CreateStructure(sizes_.ResultDataMaxSizeInBytes);
    updated_ = CreateStructure(sizes_.ResultDataMaxSizeInBytes);
    build_scratch_ = CreateWritable(sizes_.ScratchDataSizeInBytes);
    update_scratch_ = CreateWritable(sizes_.UpdateScratchDataSizeInBytes);
    compacted_size_ = CreateWritable(sizeof(UINT64));
  }

  // Vertices are in state UNORDERED_ACCESS between passes.
  void MakeVertices(const std::vector<float>& heights) {
    heights_ = Upload(heights.data(), heights.size() * sizeof(float));
    list_->SetComputeRootSignature(grid_root_signature_.Get());
    list_->SetPipelineState(grid_pipeline_.Get());
    list_->SetComputeRoot32BitConstant(0, kCells, 0);
    list_->SetComputeRootShaderResourceView(1, heights_->GetGPUVirtualAddress());
    list_->SetComputeRootUnorderedAccessView(2, vertices_->GetGPUVirtualAddress());
    list_->Dispatch(kCells / 8 + 1, kCells / 8 + 1, 1);
  }

  // A build reads the vertices.
  void Build(const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC& desc, UINT infos,
             const D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC* info) {
    const auto readable =
        CD3DX12_RESOURCE_BARRIER::Transition(vertices_.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                                             D3D12_RESOURCE_STATE_NON_PIXEL_SHADER_RESOURCE);
    const auto writable = CD3DX12_RESOURCE_BARRIER::Transition(
        vertices_.Get(), D3D12_RESOURCE_STATE_NON_PIXEL_SHADER_RESOURCE,
        D3D12_RESOURCE_STATE_UNORDERED_ACCESS);
    list_->ResourceBarrier(1, &readable);
    list_->BuildRaytracingAccelerationStructure(&desc, infos, info);
    list_->ResourceBarrier(1, &writable);
    const auto built = CD3DX12_RESOURCE_BARRIER::UAV(nullptr);
    list_->ResourceBarrier(1, &built);
  }

  void BuildAndMeasure() {
    MakeVertices(WaveHeights(0));
    D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC desc = {};
    desc.Inputs = inputs_;
    desc.DestAccelerationStructureData = built_->GetGPUVirtualAddress();
    desc.ScratchAccelerationStructureData = build_scratch_->GetGPUVirtualAddress();
    D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC info = {};
    info.DestBuffer = compacted_size_->GetGPUVirtualAddress();
    info.InfoType = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_COMPACTED_SIZE;
    Build(desc, 1, &info);
  }

  UINT64 ReadCompactedSize() {
    const auto readback =
        CreateBuffer(sizeof(UINT64), D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
    const auto written = CD3DX12_RESOURCE_BARRIER::Transition(compacted_size_.Get(),
                                                              D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                                                              D3D12_RESOURCE_STATE_COPY_SOURCE);
    list_->ResourceBarrier(1, &written);
    list_->CopyResource(readback.Get(), compacted_size_.Get());
    Execute();
    UINT64* bytes = nullptr;
    CHECK(readback->Map(0, nullptr, reinterpret_cast<void**>(&bytes)));
    return *bytes;
  }

  void CompactInto(UINT64 bytes) {
    compacted_ = CreateStructure(bytes);
    list_->CopyRaytracingAccelerationStructure(
        compacted_->GetGPUVirtualAddress(), built_->GetGPUVirtualAddress(),
        D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE_COMPACT);
    const auto copied = CD3DX12_RESOURCE_BARRIER::UAV(compacted_.Get());
    list_->ResourceBarrier(1, &copied);
  }

  // The original stays as it was.
  void Update() {
    D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC desc = {};
    desc.Inputs = inputs_;
    desc.Inputs.Flags |= kUpdate;
    desc.SourceAccelerationStructureData = built_->GetGPUVirtualAddress();
    desc.DestAccelerationStructureData = updated_->GetGPUVirtualAddress();
    desc.ScratchAccelerationStructureData = update_scratch_->GetGPUVirtualAddress();
    Build(desc, 0, nullptr);
  }

  void DispatchRays() {
    list_->SetDescriptorHeaps(1, image_.heap.GetAddressOf());
    list_->SetComputeRootSignature(rays_root_signature_.Get());
    list_->SetComputeRootShaderResourceView(0, before_->GetGPUVirtualAddress());
    list_->SetComputeRootShaderResourceView(1, after_->GetGPUVirtualAddress());
    list_->SetComputeRootDescriptorTable(2, image_.heap->GetGPUDescriptorHandleForHeapStart());
    list_->SetPipelineState1(rays_pipeline_.Get());

    constexpr UINT kRecord = D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES;
    D3D12_DISPATCH_RAYS_DESC rays = {};
    rays.RayGenerationShaderRecord = {raygen_table_->GetGPUVirtualAddress(), kRecord};
    rays.MissShaderTable = {miss_table_->GetGPUVirtualAddress(), kRecord, kRecord};
    rays.HitGroupTable = {hit_table_->GetGPUVirtualAddress(), kRecord, kRecord};
    rays.Width = options_.width;
    rays.Height = options_.height;
    rays.Depth = 1;
    arguments_ = Upload(&rays, sizeof(rays));
    list_->ExecuteIndirect(command_signature_.Get(), 1, arguments_.Get(), 0, nullptr, 0);
  }

  void CreatePipelines() {
    // The compute shader brings its root signature along.
    CHECK(device_->CreateRootSignature(0, g_pGrid, sizeof(g_pGrid),
                                       IID_PPV_ARGS(&grid_root_signature_)));
    D3D12_COMPUTE_PIPELINE_STATE_DESC grid = {};
    grid.pRootSignature = grid_root_signature_.Get();
    grid.CS = CD3DX12_SHADER_BYTECODE(g_pGrid, sizeof(g_pGrid));
    CHECK(device_->CreateComputePipelineState(&grid, IID_PPV_ARGS(&grid_pipeline_)));

    CD3DX12_DESCRIPTOR_RANGE1 image;
    image.Init(D3D12_DESCRIPTOR_RANGE_TYPE_UAV, 1, 0);
    CD3DX12_ROOT_PARAMETER1 parameters[3];
    parameters[0].InitAsShaderResourceView(0);
    parameters[1].InitAsShaderResourceView(1);
    parameters[2].InitAsDescriptorTable(1, &image);
    CD3DX12_VERSIONED_ROOT_SIGNATURE_DESC desc;
    desc.Init_1_1(_countof(parameters), parameters);
    rays_root_signature_ = CreateRootSignature(desc);

    CD3DX12_STATE_OBJECT_DESC pipeline(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
    const CD3DX12_SHADER_BYTECODE bytecode(g_pWave, sizeof(g_pWave));
    pipeline.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>()->SetDXILLibrary(&bytecode);
    auto* group = pipeline.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>();
    group->SetHitGroupExport(L"WaveGroup");
    group->SetClosestHitShaderImport(L"ClosestHit");
    pipeline.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(12, 8);
    pipeline.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(1);
    pipeline.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
        rays_root_signature_.Get());
    CHECK(device_->CreateStateObject(pipeline, IID_PPV_ARGS(&rays_pipeline_)));
    raygen_table_ = CreateShaderTable(rays_pipeline_.Get(), L"RayGen");
    miss_table_ = CreateShaderTable(rays_pipeline_.Get(), L"Miss");
    hit_table_ = CreateShaderTable(rays_pipeline_.Get(), L"WaveGroup");

    D3D12_INDIRECT_ARGUMENT_DESC argument = {};
    argument.Type = D3D12_INDIRECT_ARGUMENT_TYPE_DISPATCH_RAYS;
    D3D12_COMMAND_SIGNATURE_DESC signature = {};
    signature.ByteStride = sizeof(D3D12_DISPATCH_RAYS_DESC);
    signature.NumArgumentDescs = 1;
    signature.pArgumentDescs = &argument;
    CHECK(device_->CreateCommandSignature(&signature, nullptr, IID_PPV_ARGS(&command_signature_)));
  }

  Image image_;
  ComPtr<ID3D12Resource> heights_, vertices_, indices_;
  D3D12_RAYTRACING_GEOMETRY_DESC geometry_ = {};
  D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS inputs_ = {};
  D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO sizes_ = {};
  ComPtr<ID3D12Resource> built_, compacted_, updated_, before_, after_;
  ComPtr<ID3D12Resource> build_scratch_, update_scratch_, compacted_size_;
  ComPtr<ID3D12RootSignature> grid_root_signature_, rays_root_signature_;
  ComPtr<ID3D12PipelineState> grid_pipeline_;
  ComPtr<ID3D12StateObject> rays_pipeline_;
  ComPtr<ID3D12CommandSignature> command_signature_;
  ComPtr<ID3D12Resource> raygen_table_, miss_table_, hit_table_, arguments_;
  PassTimes times_{device_.Get(), queue_.Get()};
};

}  // namespace

int main(int argc, char** argv) {
  return RunProgram(argc, argv, [](const Options& options) { Wave(options).Render(); });
}
