// SPDX-License-Identifier: MIT
// State objects: collections, additions, identifiers and stack sizes.
#include <cstring>
#include <string>

#include <d3dcompiler.h>
#include <directx/d3dx12.h>

#include "d3d12/com/text.h"
#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

constexpr const char* kShaders = R"(
struct Payload { float3 color; };
RaytracingAccelerationStructure scene : register(t0);
[shader("raygeneration")] void RayGen() {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 1};
  Payload payload = {float3(0, 0, 0)};
  TraceRay(scene, 0, 0xFF, 0, 1, 0, ray, payload);
}
[shader("raygeneration")] void Empty() {}
[shader("closesthit")] void Closest(inout Payload p, BuiltInTriangleIntersectionAttributes a) {
  p.color = float3(a.barycentrics, 0);
}
[shader("miss")] void Sky(inout Payload p) { p.color = float3(0, 0, 1); }
[shader("miss")] void Ground(inout Payload p) { p.color = float3(1, 0, 0); }
)";

class StateObjectCalls : public D3d12Test {
 protected:
  void SetUp() override {
    D3d12Test::SetUp();
    ASSERT_EQ(D3DCompile(kShaders, std::strlen(kShaders), "shaders.hlsl", nullptr, nullptr, nullptr,
                         "lib_6_3", 0, 0, code_.GetAddressOf(), nullptr),
              S_OK);
    ASSERT_EQ(device_.As(&device7_), S_OK);
    D3D12_ROOT_PARAMETER scene = {};
    scene.ParameterType = D3D12_ROOT_PARAMETER_TYPE_SRV;
    const D3D12_ROOT_SIGNATURE_DESC desc = {1, &scene, 0, nullptr, D3D12_ROOT_SIGNATURE_FLAG_NONE};
    ComPtr<ID3DBlob> blob;
    ASSERT_EQ(D3D12SerializeRootSignature(&desc, D3D_ROOT_SIGNATURE_VERSION_1, blob.GetAddressOf(),
                                          nullptr),
              S_OK);
    ASSERT_EQ(device_->CreateRootSignature(0, blob->GetBufferPointer(), blob->GetBufferSize(),
                                           IID_PPV_ARGS(root_signature_.GetAddressOf())),
              S_OK);
  }

  // The library's exports of these names, with what every pipeline needs.
  void describe(CD3DX12_STATE_OBJECT_DESC& desc, std::initializer_list<const wchar_t*> exports) {
    const D3D12_SHADER_BYTECODE bytecode = {code_->GetBufferPointer(), code_->GetBufferSize()};
    auto* library = desc.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>();
    library->SetDXILLibrary(&bytecode);
    for (const wchar_t* name : exports) library->DefineExport(name);
    desc.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(12, 8);
    desc.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(1);
    desc.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
        root_signature_.Get());
  }

  ComPtr<ID3D12StateObjectProperties> properties(ID3D12StateObject* object) {
    ComPtr<ID3D12StateObjectProperties> out;
    EXPECT_EQ(object->QueryInterface(IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    return out;
  }

  ComPtr<ID3DBlob> code_;
  ComPtr<ID3D12Device7> device7_;
  ComPtr<ID3D12RootSignature> root_signature_;
};

TEST_F(StateObjectCalls, APipelineTakesACollection) {
  CD3DX12_STATE_OBJECT_DESC part(D3D12_STATE_OBJECT_TYPE_COLLECTION);
  describe(part, {L"Closest"});
  auto* group = part.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>();
  group->SetHitGroupExport(L"Group");
  group->SetClosestHitShaderImport(L"Closest");
  ComPtr<ID3D12StateObject> collection;
  ASSERT_EQ(device_->CreateStateObject(part, IID_PPV_ARGS(collection.GetAddressOf())), S_OK);

  CD3DX12_STATE_OBJECT_DESC whole(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  describe(whole, {L"RayGen", L"Sky"});
  whole.CreateSubobject<CD3DX12_EXISTING_COLLECTION_SUBOBJECT>()->SetExistingCollection(
      collection.Get());
  ComPtr<ID3D12StateObject> pipeline;
  ASSERT_EQ(device_->CreateStateObject(whole, IID_PPV_ARGS(pipeline.GetAddressOf())), S_OK);
  const auto found = properties(pipeline.Get());
  for (const wchar_t* name : {L"RayGen", L"Sky", L"Group"}) {
    EXPECT_NE(found->GetShaderIdentifier(name), nullptr) << to_utf8(name);
  }
  EXPECT_EQ(found->GetShaderIdentifier(L"Nothing"), nullptr);
  EXPECT_EQ(found->GetShaderIdentifier(L"Group"),
            properties(collection.Get())->GetShaderIdentifier(L"Group"));
  EXPECT_NE(found->GetShaderIdentifier(L"Group"), found->GetShaderIdentifier(L"Sky"));

  const UINT64 stack = found->GetPipelineStackSize();
  EXPECT_GE(stack, found->GetShaderStackSize(L"RayGen"));
  EXPECT_EQ(found->GetShaderStackSize(L"Group"), UINT64{0xFFFFFFFF});  // names no shader
  EXPECT_NE(found->GetShaderStackSize(L"Group::closesthit"), UINT64{0xFFFFFFFF});
  found->SetPipelineStackSize(stack + 1024);
  EXPECT_EQ(found->GetPipelineStackSize(), stack + 1024);
}

TEST_F(StateObjectCalls, AdditionsKeepWhatWasThere) {
  CD3DX12_STATE_OBJECT_DESC desc(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  describe(desc, {L"RayGen", L"Sky"});
  auto* config = desc.CreateSubobject<CD3DX12_STATE_OBJECT_CONFIG_SUBOBJECT>();
  config->SetFlags(D3D12_STATE_OBJECT_FLAG_ALLOW_STATE_OBJECT_ADDITIONS);
  ComPtr<ID3D12StateObject> first;
  ASSERT_EQ(device_->CreateStateObject(desc, IID_PPV_ARGS(first.GetAddressOf())), S_OK);

  CD3DX12_STATE_OBJECT_DESC addition(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  describe(addition, {L"Ground"});
  addition.CreateSubobject<CD3DX12_STATE_OBJECT_CONFIG_SUBOBJECT>()->SetFlags(
      D3D12_STATE_OBJECT_FLAG_ALLOW_STATE_OBJECT_ADDITIONS);
  ComPtr<ID3D12StateObject> second;
  ASSERT_EQ(device7_->AddToStateObject(addition, first.Get(), IID_PPV_ARGS(second.GetAddressOf())),
            S_OK);
  const auto before = properties(first.Get());
  const auto after = properties(second.Get());
  EXPECT_EQ(before->GetShaderIdentifier(L"Ground"), nullptr);
  ASSERT_NE(after->GetShaderIdentifier(L"Ground"), nullptr);
  ASSERT_NE(after->GetShaderIdentifier(L"Sky"), nullptr);
  EXPECT_EQ(before->GetShaderIdentifier(L"Sky"), after->GetShaderIdentifier(L"Sky"));
}

// A program passes it for shaders without arguments, and associates it.
TEST_F(StateObjectCalls, ANullRootSignatureHasNoArguments) {
  CD3DX12_STATE_OBJECT_DESC desc(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  describe(desc, {L"Sky"});
  auto* local = desc.CreateSubobject<CD3DX12_LOCAL_ROOT_SIGNATURE_SUBOBJECT>();
  local->SetRootSignature(nullptr);
  auto* association = desc.CreateSubobject<CD3DX12_SUBOBJECT_TO_EXPORTS_ASSOCIATION_SUBOBJECT>();
  association->SetSubobjectToAssociate(*local);
  association->AddExport(L"Sky");
  ComPtr<ID3D12StateObject> pipeline;
  EXPECT_EQ(device_->CreateStateObject(desc, IID_PPV_ARGS(pipeline.GetAddressOf())), S_OK);

  // Shaders with arguments need one, and calls need none.
  CD3DX12_STATE_OBJECT_DESC global(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  root_signature_ = nullptr;
  describe(global, {L"Sky", L"Empty"});
  EXPECT_EQ(device_->CreateStateObject(global, IID_PPV_ARGS(pipeline.ReleaseAndGetAddressOf())),
            S_OK);
  ComPtr<ID3D12GraphicsCommandList4> list;
  ASSERT_EQ(list_.As(&list), S_OK);
  const auto table = buffer(64, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  void* record = nullptr;
  ASSERT_EQ(table->Map(0, nullptr, &record), S_OK);
  std::memcpy(record, properties(pipeline.Get())->GetShaderIdentifier(L"Empty"), 32);
  D3D12_DISPATCH_RAYS_DESC rays = {};
  rays.RayGenerationShaderRecord = {table->GetGPUVirtualAddress(), 32};
  rays.Width = rays.Height = rays.Depth = 1;
  list->SetPipelineState1(pipeline.Get());
  list->DispatchRays(&rays);
  EXPECT_EQ(list->Close(), S_OK);
  EXPECT_TRUE(messages().empty());
  CD3DX12_STATE_OBJECT_DESC without(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  describe(without, {L"RayGen"});
  EXPECT_EQ(device_->CreateStateObject(without, IID_PPV_ARGS(pipeline.ReleaseAndGetAddressOf())),
            E_INVALIDARG);
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_NE(messages()[0].find("scene"), std::string::npos) << messages()[0];
}

TEST_F(StateObjectCalls, ErrorsNameTheSubobject) {
  CD3DX12_STATE_OBJECT_DESC desc(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  describe(desc, {L"RayGen", L"Sky"});
  auto* group = desc.CreateSubobject<CD3DX12_HIT_GROUP_SUBOBJECT>();
  group->SetHitGroupExport(L"Group");
  group->SetClosestHitShaderImport(L"NotThere");
  ComPtr<ID3D12StateObject> pipeline;
  EXPECT_EQ(device_->CreateStateObject(desc, IID_PPV_ARGS(pipeline.GetAddressOf())), E_INVALIDARG);
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_NE(messages()[0].find("NotThere"), std::string::npos) << messages()[0];
}

}  // namespace
}  // namespace kaamos::d3d12
