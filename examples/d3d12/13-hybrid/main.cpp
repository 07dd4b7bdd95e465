// SPDX-License-Identifier: MIT
// The frame of ../../13-hybrid as a D3D12 program: a rasterized G-buffer, traced shadows, and a
// pixel shader with a RayQuery; timestamps tell how long each pass takes.
#include <cmath>
#include <vector>

#include "..\common\pass_times.h"
#include "..\common\program.h"
#include "CompiledShaders\hybrid.Compose.h"
#include "CompiledShaders\hybrid.SeenFromEye.h"
#include "CompiledShaders\hybrid.StoreSurface.h"
#include "CompiledShaders\hybrid.WholePicture.h"
#include "CompiledShaders\hybrid.h"

namespace {

struct Box {
  float center[3];
  float half_size[3];
  float turn;  // radians about y
  float color[3];
};
const Box kBoxes[] = {
    {{0, -0.5f, 0}, {8, 0.5f, 8}, 0, {0.75f, 0.74f, 0.7f}},
    {{-2.4f, 1, 1}, {0.8f, 1, 0.8f}, 0.5f, {0.8f, 0.3f, 0.2f}},
    {{0.2f, 0.6f, -1.2f}, {0.6f, 0.6f, 0.6f}, 0.9f, {0.25f, 0.5f, 0.8f}},
    {{2.6f, 1.5f, 1.4f}, {0.5f, 1.5f, 0.5f}, 0.2f, {0.3f, 0.65f, 0.35f}},
    {{0.3f, 2.1f, 2.6f}, {3.6f, 0.12f, 0.12f}, 0.1f, {0.85f, 0.7f, 0.3f}},
    {{-3.2f, 1.05f, 3}, {0.12f, 1.05f, 0.12f}, 0.1f, {0.85f, 0.7f, 0.3f}},
    {{3.8f, 1.05f, 2.2f}, {0.12f, 1.05f, 0.12f}, 0.1f, {0.85f, 0.7f, 0.3f}},
};
const float kCube[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                       -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
// Clockwise, seen from outside.
const UINT kSides[] = {0, 2, 1, 1, 2, 3, 1, 3, 5, 5, 3, 7, 5, 7, 4, 4, 7, 6,
                       4, 6, 0, 0, 6, 2, 2, 6, 3, 3, 6, 7, 4, 0, 5, 5, 0, 1};

D3D12_RAYTRACING_INSTANCE_DESC InstanceOf(const Box& box, ID3D12Resource* bottom_level) {
  D3D12_RAYTRACING_INSTANCE_DESC instance = {};
  instance.InstanceMask = 0xFF;
  instance.AccelerationStructure = bottom_level->GetGPUVirtualAddress();
  const float c = std::cos(box.turn);
  const float s = std::sin(box.turn);
  const float turn[3][3] = {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      instance.Transform[row][column] = turn[row][column] * box.half_size[column];
    }
    instance.Transform[row][3] = box.center[row];
  }
  return instance;
}

class Hybrid : public Program {
 public:
  explicit Hybrid(const Options& options) : Program(options) {
    CreateScene();
    CreateTextures();
    CreatePipelines();
  }

  void Render() {
    SetState();
    times_.Start(list_.Get());
    DrawSurfaces();
    times_.End(list_.Get(), "G-buffer");
    TraceSun();
    times_.End(list_.Get(), "sun");
    Compose();
    times_.End(list_.Get(), "compose");
    times_.Resolve(list_.Get());
    WritePicture(image_.Get(), D3D12_RESOURCE_STATE_COPY_SOURCE);
    times_.Print();
  }

 private:
  void CreateScene() {
    vertices_ = Upload(kCube, sizeof(kCube));
    indices_ = Upload(kSides, sizeof(kSides));
    D3D12_RAYTRACING_GEOMETRY_DESC geometry = {};
    geometry.Type = D3D12_RAYTRACING_GEOMETRY_TYPE_TRIANGLES;
    geometry.Flags = D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE;
    geometry.Triangles.IndexFormat = DXGI_FORMAT_R32_UINT;
    geometry.Triangles.VertexFormat = DXGI_FORMAT_R32G32B32_FLOAT;
    geometry.Triangles.IndexCount = _countof(kSides);
    geometry.Triangles.VertexCount = _countof(kCube) / 3;
    geometry.Triangles.IndexBuffer = indices_->GetGPUVirtualAddress();
    geometry.Triangles.VertexBuffer = {vertices_->GetGPUVirtualAddress(), 12};
    D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS bottom = {};
    bottom.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL;
    bottom.Flags = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_TRACE;
    bottom.NumDescs = 1;
    bottom.pGeometryDescs = &geometry;
    bottom_level_ = BuildAccelerationStructure(bottom);

    // The same transforms for rays and for draws.
    std::vector<D3D12_RAYTRACING_INSTANCE_DESC> instances;
    std::vector<float> colors;
    for (const Box& box : kBoxes) {
      instances.push_back(InstanceOf(box, bottom_level_.Get()));
      colors.insert(colors.end(), box.color, box.color + 3);
    }
    transforms_ = Upload(instances.data(), instances.size() * sizeof(instances[0]));
    colors_ = Upload(colors.data(), colors.size() * sizeof(float));
    D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS top = {};
    top.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL;
    top.Flags = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_TRACE;
    top.NumDescs = _countof(kBoxes);
    top.InstanceDescs = transforms_->GetGPUVirtualAddress();
    top_level_ = BuildAccelerationStructure(top);
    Execute();
  }

  void CreateTextures() {
    const auto target = D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET;
    albedo_ = CreateTexture(DXGI_FORMAT_R8G8B8A8_UNORM, target, D3D12_RESOURCE_STATE_RENDER_TARGET,
                            L"albedo");
    normals_ = CreateTexture(DXGI_FORMAT_R16G16B16A16_FLOAT, target,
                             D3D12_RESOURCE_STATE_RENDER_TARGET, L"normals");
    depth_ = CreateTexture(DXGI_FORMAT_R32_TYPELESS, D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL,
                           D3D12_RESOURCE_STATE_DEPTH_WRITE, L"depth");
    sunlight_ = CreateTexture(DXGI_FORMAT_R8_UNORM, D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS,
                              D3D12_RESOURCE_STATE_UNORDERED_ACCESS, L"sunlight");
    image_ = CreateTexture(DXGI_FORMAT_R8G8B8A8_UNORM, target, D3D12_RESOURCE_STATE_RENDER_TARGET,
                           L"image");
    targets_ = CreateDescriptorHeap(D3D12_DESCRIPTOR_HEAP_TYPE_RTV, 3);
    depths_ = CreateDescriptorHeap(D3D12_DESCRIPTOR_HEAP_TYPE_DSV, 1);
    views_ = CreateDescriptorHeap(D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV, 5);
    device_->CreateRenderTargetView(albedo_.Get(), nullptr, Slot(targets_.Get(), 0));
    device_->CreateRenderTargetView(normals_.Get(), nullptr, Slot(targets_.Get(), 1));
    device_->CreateRenderTargetView(image_.Get(), nullptr, Slot(targets_.Get(), 2));
    D3D12_DEPTH_STENCIL_VIEW_DESC depth = {};
    depth.Format = DXGI_FORMAT_D32_FLOAT;
    depth.ViewDimension = D3D12_DSV_DIMENSION_TEXTURE2D;
    device_->CreateDepthStencilView(depth_.Get(), &depth, Slot(depths_.Get(), 0));
    ID3D12Resource* read[] = {albedo_.Get(), normals_.Get(), depth_.Get(), sunlight_.Get()};
    const DXGI_FORMAT formats[] = {DXGI_FORMAT_R8G8B8A8_UNORM, DXGI_FORMAT_R16G16B16A16_FLOAT,
                                   DXGI_FORMAT_R32_FLOAT, DXGI_FORMAT_R8_UNORM};
    for (UINT i = 0; i < 4; ++i) {
      D3D12_SHADER_RESOURCE_VIEW_DESC view = {};
      view.Format = formats[i];
      view.ViewDimension = D3D12_SRV_DIMENSION_TEXTURE2D;
      view.Shader4ComponentMapping = D3D12_DEFAULT_SHADER_4_COMPONENT_MAPPING;
      view.Texture2D.MipLevels = 1;
      device_->CreateShaderResourceView(read[i], &view, Slot(views_.Get(), i));
    }
    device_->CreateUnorderedAccessView(sunlight_.Get(), nullptr, nullptr, Slot(views_.Get(), 4));
  }

  void CreatePipelines() {
    CD3DX12_DESCRIPTOR_RANGE1 ranges[2];
    ranges[0].Init(D3D12_DESCRIPTOR_RANGE_TYPE_SRV, 4, 0, 1);
    ranges[1].Init(D3D12_DESCRIPTOR_RANGE_TYPE_UAV, 1, 0, 1);
    CD3DX12_ROOT_PARAMETER1 parameters[4];
    parameters[0].InitAsConstants(2, 0);
    parameters[1].InitAsShaderResourceView(0);
    parameters[2].InitAsShaderResourceView(1);
    parameters[3].InitAsDescriptorTable(2, ranges);
    CD3DX12_VERSIONED_ROOT_SIGNATURE_DESC root;
    root.Init_1_1(4, parameters, 0, nullptr,
                  D3D12_ROOT_SIGNATURE_FLAG_ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT);
    root_signature_ = CreateRootSignature(root);

    const auto per_instance = D3D12_INPUT_CLASSIFICATION_PER_INSTANCE_DATA;
    const D3D12_INPUT_ELEMENT_DESC layout[] = {
        {"CORNER", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 0, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA,
         0},
        {"TRANSFORM", 0, DXGI_FORMAT_R32G32B32A32_FLOAT, 1, 0, per_instance, 1},
        {"TRANSFORM", 1, DXGI_FORMAT_R32G32B32A32_FLOAT, 1, 16, per_instance, 1},
        {"TRANSFORM", 2, DXGI_FORMAT_R32G32B32A32_FLOAT, 1, 32, per_instance, 1}};
    D3D12_GRAPHICS_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root_signature_.Get();
    desc.VS = CD3DX12_SHADER_BYTECODE(g_pSeenFromEye, sizeof(g_pSeenFromEye));
    desc.PS = CD3DX12_SHADER_BYTECODE(g_pStoreSurface, sizeof(g_pStoreSurface));
    desc.BlendState = CD3DX12_BLEND_DESC(D3D12_DEFAULT);
    desc.SampleMask = UINT_MAX;
    desc.RasterizerState = CD3DX12_RASTERIZER_DESC(D3D12_DEFAULT);
    desc.DepthStencilState = CD3DX12_DEPTH_STENCIL_DESC(D3D12_DEFAULT);
    desc.DepthStencilState.DepthFunc = D3D12_COMPARISON_FUNC_GREATER;
    desc.InputLayout = {layout, _countof(layout)};
    desc.PrimitiveTopologyType = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
    desc.NumRenderTargets = 2;
    desc.RTVFormats[0] = DXGI_FORMAT_R8G8B8A8_UNORM;
    desc.RTVFormats[1] = DXGI_FORMAT_R16G16B16A16_FLOAT;
    desc.DSVFormat = DXGI_FORMAT_D32_FLOAT;
    desc.SampleDesc.Count = 1;
    CHECK(device_->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(&surface_pipeline_)));

    // The same by a stream of subobjects.
    struct {
      CD3DX12_PIPELINE_STATE_STREAM_ROOT_SIGNATURE root_signature;
      CD3DX12_PIPELINE_STATE_STREAM_VS vs;
      CD3DX12_PIPELINE_STATE_STREAM_PS ps;
      CD3DX12_PIPELINE_STATE_STREAM_DEPTH_STENCIL depth_stencil;
      CD3DX12_PIPELINE_STATE_STREAM_PRIMITIVE_TOPOLOGY topology;
      CD3DX12_PIPELINE_STATE_STREAM_RENDER_TARGET_FORMATS targets;
    } stream;
    CD3DX12_DEPTH_STENCIL_DESC no_depth(D3D12_DEFAULT);
    no_depth.DepthEnable = FALSE;
    D3D12_RT_FORMAT_ARRAY targets = {};
    targets.NumRenderTargets = 1;
    targets.RTFormats[0] = DXGI_FORMAT_R8G8B8A8_UNORM;
    stream.root_signature = root_signature_.Get();
    stream.vs = CD3DX12_SHADER_BYTECODE(g_pWholePicture, sizeof(g_pWholePicture));
    stream.ps = CD3DX12_SHADER_BYTECODE(g_pCompose, sizeof(g_pCompose));
    stream.depth_stencil = no_depth;
    stream.topology = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
    stream.targets = targets;
    const D3D12_PIPELINE_STATE_STREAM_DESC stream_desc = {sizeof(stream), &stream};
    CHECK(device_->CreatePipelineState(&stream_desc, IID_PPV_ARGS(&compose_pipeline_)));

    CD3DX12_STATE_OBJECT_DESC rays(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
    auto* library = rays.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>();
    const D3D12_SHADER_BYTECODE bytecode = CD3DX12_SHADER_BYTECODE(g_pHybrid, sizeof(g_pHybrid));
    library->SetDXILLibrary(&bytecode);
    library->DefineExport(L"TraceSun");
    library->DefineExport(L"SunIsSeen");
    rays.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>()->SetHitGroupExport(L"Opaque");
    rays.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(4, 8);
    rays.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(1);
    rays.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
        root_signature_.Get());
    CHECK(device_->CreateStateObject(rays, IID_PPV_ARGS(&sun_pipeline_)));
    raygen_table_ = CreateShaderTable(sun_pipeline_.Get(), L"TraceSun");
    miss_table_ = CreateShaderTable(sun_pipeline_.Get(), L"SunIsSeen");
    hit_table_ = CreateShaderTable(sun_pipeline_.Get(), L"Opaque");
  }

  void SetState() {
    ID3D12DescriptorHeap* heaps[] = {views_.Get()};
    list_->SetDescriptorHeaps(1, heaps);
    const UINT size[2] = {options_.width, options_.height};
    list_->SetGraphicsRootSignature(root_signature_.Get());
    list_->SetGraphicsRoot32BitConstants(0, 2, size, 0);
    list_->SetGraphicsRootShaderResourceView(1, top_level_->GetGPUVirtualAddress());
    list_->SetGraphicsRootShaderResourceView(2, colors_->GetGPUVirtualAddress());
    list_->SetGraphicsRootDescriptorTable(3, views_->GetGPUDescriptorHandleForHeapStart());
    list_->SetComputeRootSignature(root_signature_.Get());
    list_->SetComputeRoot32BitConstants(0, 2, size, 0);
    list_->SetComputeRootShaderResourceView(1, top_level_->GetGPUVirtualAddress());
    list_->SetComputeRootShaderResourceView(2, colors_->GetGPUVirtualAddress());
    list_->SetComputeRootDescriptorTable(3, views_->GetGPUDescriptorHandleForHeapStart());
    list_->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    const D3D12_VERTEX_BUFFER_VIEW vertices[] = {
        {vertices_->GetGPUVirtualAddress(), sizeof(kCube), 12},
        {transforms_->GetGPUVirtualAddress(),
         _countof(kBoxes) * sizeof(D3D12_RAYTRACING_INSTANCE_DESC),
         sizeof(D3D12_RAYTRACING_INSTANCE_DESC)}};
    const D3D12_INDEX_BUFFER_VIEW indices = {indices_->GetGPUVirtualAddress(), sizeof(kSides),
                                             DXGI_FORMAT_R32_UINT};
    list_->IASetVertexBuffers(0, 2, vertices);
    list_->IASetIndexBuffer(&indices);
    const CD3DX12_VIEWPORT viewport(0.0f, 0.0f, static_cast<float>(options_.width),
                                    static_cast<float>(options_.height));
    const CD3DX12_RECT scissor(0, 0, static_cast<LONG>(options_.width),
                               static_cast<LONG>(options_.height));
    list_->RSSetViewports(1, &viewport);
    list_->RSSetScissorRects(1, &scissor);
  }

  void DrawSurfaces() {
    const float black[4] = {};
    const D3D12_CPU_DESCRIPTOR_HANDLE targets[] = {Slot(targets_.Get(), 0),
                                                   Slot(targets_.Get(), 1)};
    const D3D12_CPU_DESCRIPTOR_HANDLE depth = Slot(depths_.Get(), 0);
    list_->ClearRenderTargetView(targets[0], black, 0, nullptr);
    list_->ClearRenderTargetView(targets[1], black, 0, nullptr);
    list_->ClearDepthStencilView(depth, D3D12_CLEAR_FLAG_DEPTH, 0, 0, 0, nullptr);
    list_->OMSetRenderTargets(2, targets, FALSE, &depth);
    list_->SetPipelineState(surface_pipeline_.Get());
    list_->DrawIndexedInstanced(_countof(kSides), _countof(kBoxes), 0, 0, 0);
    // Both kinds of shaders read what was drawn.
    const auto readable =
        D3D12_RESOURCE_STATE_NON_PIXEL_SHADER_RESOURCE | D3D12_RESOURCE_STATE_PIXEL_SHADER_RESOURCE;
    const D3D12_RESOURCE_BARRIER barriers[] = {
        CD3DX12_RESOURCE_BARRIER::Transition(albedo_.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET,
                                             readable),
        CD3DX12_RESOURCE_BARRIER::Transition(normals_.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET,
                                             readable),
        CD3DX12_RESOURCE_BARRIER::Transition(depth_.Get(), D3D12_RESOURCE_STATE_DEPTH_WRITE,
                                             readable)};
    list_->ResourceBarrier(_countof(barriers), barriers);
  }

  void TraceSun() {
    list_->SetPipelineState1(sun_pipeline_.Get());
    constexpr UINT kRecord = D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES;
    D3D12_DISPATCH_RAYS_DESC rays = {};
    rays.RayGenerationShaderRecord = {raygen_table_->GetGPUVirtualAddress(), kRecord};
    rays.MissShaderTable = {miss_table_->GetGPUVirtualAddress(), kRecord, kRecord};
    rays.HitGroupTable = {hit_table_->GetGPUVirtualAddress(), kRecord, kRecord};
    rays.Width = options_.width;
    rays.Height = options_.height;
    rays.Depth = 1;
    list_->DispatchRays(&rays);
    const auto traced =
        CD3DX12_RESOURCE_BARRIER::Transition(sunlight_.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                                             D3D12_RESOURCE_STATE_PIXEL_SHADER_RESOURCE);
    list_->ResourceBarrier(1, &traced);
  }

  void Compose() {
    const D3D12_CPU_DESCRIPTOR_HANDLE target = Slot(targets_.Get(), 2);
    list_->OMSetRenderTargets(1, &target, FALSE, nullptr);
    list_->SetPipelineState(compose_pipeline_.Get());
    list_->DrawInstanced(3, 1, 0, 0);
    const auto to_copy = CD3DX12_RESOURCE_BARRIER::Transition(
        image_.Get(), D3D12_RESOURCE_STATE_RENDER_TARGET, D3D12_RESOURCE_STATE_COPY_SOURCE);
    list_->ResourceBarrier(1, &to_copy);
  }

  ComPtr<ID3D12Resource> vertices_, indices_, transforms_, colors_, bottom_level_, top_level_;
  ComPtr<ID3D12Resource> albedo_, normals_, depth_, sunlight_, image_;
  ComPtr<ID3D12DescriptorHeap> targets_, depths_, views_;
  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12PipelineState> surface_pipeline_, compose_pipeline_;
  ComPtr<ID3D12StateObject> sun_pipeline_;
  ComPtr<ID3D12Resource> raygen_table_, miss_table_, hit_table_;
  PassTimes times_{device_.Get(), queue_.Get()};
};

}  // namespace

int main(int argc, char** argv) {
  return RunProgram(argc, argv, [](const Options& options) { Hybrid(options).Render(); });
}
