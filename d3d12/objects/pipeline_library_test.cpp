// SPDX-License-Identifier: MIT
// Cached pipelines and libraries of them. [D3D12: D3D12_CACHED_PIPELINE_STATE;
// ID3D12PipelineLibrary]
#include <windows.h>

#include <cstring>
#include <vector>

#include <d3dcompiler.h>
#include <directx/d3dx12.h>

#include "d3d12/container/container.h"
#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class PipelineLibraryTest : public D3d12Test {
 protected:
  void SetUp() override {
    D3d12Test::SetUp();
    store_ = compile("cs_6_0",
                     "RWByteAddressBuffer to : register(u0);"
                     "[numthreads(1, 1, 1)] void main() { to.Store(0, 1); }");
    other_ = compile("cs_6_0",
                     "RWByteAddressBuffer to : register(u0);"
                     "[numthreads(1, 1, 1)] void main() { to.Store(0, 2); }");
    vertex_ = compile(
        "vs_6_0", "float4 main(float2 at : POSITION) : SV_Position { return float4(at, 0, 1); }");
    pixel_ = compile("ps_6_0", "float4 main() : SV_Target { return 1; }");
    root_signature_ = root_signature(1);
  }

  // With `views` UAVs.
  ComPtr<ID3D12RootSignature> root_signature(UINT views) {
    std::vector<CD3DX12_ROOT_PARAMETER> parameters(views);
    for (UINT i = 0; i < views; ++i) parameters[i].InitAsUnorderedAccessView(i);
    D3D12_ROOT_SIGNATURE_DESC desc = {};
    desc.NumParameters = views;
    desc.pParameters = parameters.data();
    desc.Flags = D3D12_ROOT_SIGNATURE_FLAG_ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT;
    ComPtr<ID3DBlob> blob;
    EXPECT_EQ(D3D12SerializeRootSignature(&desc, D3D_ROOT_SIGNATURE_VERSION_1, blob.GetAddressOf(),
                                          nullptr),
              S_OK);
    ComPtr<ID3D12RootSignature> out;
    EXPECT_EQ(device_->CreateRootSignature(0, blob->GetBufferPointer(), blob->GetBufferSize(),
                                           IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }

  D3D12_COMPUTE_PIPELINE_STATE_DESC compute_desc() const {
    D3D12_COMPUTE_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root_signature_.Get();
    desc.CS = CD3DX12_SHADER_BYTECODE(store_.Get());
    return desc;
  }

  D3D12_GRAPHICS_PIPELINE_STATE_DESC graphics_desc() const {
    static const D3D12_INPUT_ELEMENT_DESC kPosition = {
        "POSITION", 0, DXGI_FORMAT_R32G32_FLOAT, 0, 0, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA,
        0};
    D3D12_GRAPHICS_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = root_signature_.Get();
    desc.VS = CD3DX12_SHADER_BYTECODE(vertex_.Get());
    desc.PS = CD3DX12_SHADER_BYTECODE(pixel_.Get());
    desc.BlendState = CD3DX12_BLEND_DESC(D3D12_DEFAULT);
    desc.SampleMask = UINT_MAX;
    desc.RasterizerState = CD3DX12_RASTERIZER_DESC(D3D12_DEFAULT);
    desc.InputLayout = {&kPosition, 1};
    desc.PrimitiveTopologyType = D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE;
    desc.NumRenderTargets = 1;
    desc.RTVFormats[0] = DXGI_FORMAT_R8G8B8A8_UNORM;
    desc.SampleDesc.Count = 1;
    return desc;
  }

  ComPtr<ID3D12PipelineState> compute() {
    ComPtr<ID3D12PipelineState> out;
    const auto desc = compute_desc();
    EXPECT_EQ(device_->CreateComputePipelineState(&desc, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    return out;
  }
  ComPtr<ID3D12PipelineState> graphics() {
    ComPtr<ID3D12PipelineState> out;
    const auto desc = graphics_desc();
    EXPECT_EQ(device_->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
    return out;
  }

  HRESULT open(const std::vector<std::byte>& blob, ComPtr<ID3D12PipelineLibrary1>& library) {
    return device_->CreatePipelineLibrary(blob.data(), blob.size(),
                                          IID_PPV_ARGS(library.ReleaseAndGetAddressOf()));
  }

  HRESULT load(ID3D12PipelineLibrary* library, LPCWSTR name,
               const D3D12_COMPUTE_PIPELINE_STATE_DESC& desc, ComPtr<ID3D12PipelineState>& out) {
    return library->LoadComputePipeline(name, &desc, IID_PPV_ARGS(out.ReleaseAndGetAddressOf()));
  }
  HRESULT load(ID3D12PipelineLibrary* library, LPCWSTR name,
               const D3D12_GRAPHICS_PIPELINE_STATE_DESC& desc, ComPtr<ID3D12PipelineState>& out) {
    return library->LoadGraphicsPipeline(name, &desc, IID_PPV_ARGS(out.ReleaseAndGetAddressOf()));
  }

  // A library with the pipelines "c" and "g".
  std::vector<std::byte> stored() {
    ComPtr<ID3D12PipelineLibrary> library;
    EXPECT_EQ(device_->CreatePipelineLibrary(nullptr, 0, IID_PPV_ARGS(library.GetAddressOf())),
              S_OK);
    EXPECT_EQ(library->StorePipeline(L"c", compute().Get()), S_OK);
    EXPECT_EQ(library->StorePipeline(L"g\x00E4", graphics().Get()), S_OK);
    std::vector<std::byte> out(library->GetSerializedSize());
    EXPECT_EQ(library->Serialize(out.data(), out.size()), S_OK);
    return out;
  }

  ComPtr<ID3DBlob> store_, other_, vertex_, pixel_;
  ComPtr<ID3D12RootSignature> root_signature_;
};

// A blob with another text in a part of four characters.
std::vector<std::byte> rewritten(std::span<const std::byte> blob, uint32_t part, const char* text) {
  auto parts = read_container(blob.data(), blob.size()).value();
  for (Part& each : parts) {
    if (each.fourcc == part) each.bytes = std::as_bytes(std::span(text, std::strlen(text)));
  }
  return write_container(parts);
}

TEST_F(PipelineLibraryTest, ACachedBlobIsThatOfItsDescription) {
  ComPtr<ID3DBlob> blob;
  ASSERT_EQ(compute()->GetCachedBlob(blob.GetAddressOf()), S_OK);
  auto desc = compute_desc();
  desc.CachedPSO = {blob->GetBufferPointer(), blob->GetBufferSize()};
  ComPtr<ID3D12PipelineState> made;
  const auto create = [&] {
    return device_->CreateComputePipelineState(&desc, IID_PPV_ARGS(made.ReleaseAndGetAddressOf()));
  };
  EXPECT_EQ(create(), S_OK);
  desc.CS = CD3DX12_SHADER_BYTECODE(other_.Get());
  EXPECT_EQ(create(), E_INVALIDARG);
  desc.CS = CD3DX12_SHADER_BYTECODE(store_.Get());
  const auto other_root = root_signature(2);
  desc.pRootSignature = other_root.Get();
  EXPECT_EQ(create(), E_INVALIDARG);
  // Equal bytes make an equal root signature.
  const auto same_root = root_signature(1);
  desc.pRootSignature = same_root.Get();
  EXPECT_EQ(create(), S_OK);
  ASSERT_EQ(messages().size(), 2u);
  EXPECT_NE(messages()[0].find("KA4026"), std::string::npos) << messages()[0];
}

TEST_F(PipelineLibraryTest, ABlobOfAnotherVersionOrBackendSaysSo) {
  ComPtr<ID3DBlob> blob;
  ASSERT_EQ(compute()->GetCachedBlob(blob.GetAddressOf()), S_OK);
  const std::span<const std::byte> bytes(static_cast<std::byte*>(blob->GetBufferPointer()),
                                         blob->GetBufferSize());
  ComPtr<ID3D12PipelineState> made;
  const auto create_with = [&](const std::vector<std::byte>& cached) {
    auto desc = compute_desc();
    desc.CachedPSO = {cached.data(), cached.size()};
    return device_->CreateComputePipelineState(&desc, IID_PPV_ARGS(made.ReleaseAndGetAddressOf()));
  };
  EXPECT_EQ(create_with({bytes.begin(), bytes.end()}), S_OK);
  EXPECT_EQ(create_with(rewritten(bytes, fourcc("KVER"), "0.0.1")),
            D3D12_ERROR_DRIVER_VERSION_MISMATCH);
  EXPECT_EQ(create_with(rewritten(bytes, fourcc("KBKD"), "other")), D3D12_ERROR_ADAPTER_NOT_FOUND);
  // No prefix of it is taken, nor a library's blob.
  for (size_t size = 1; size < bytes.size(); ++size) {
    ASSERT_EQ(create_with({bytes.begin(), bytes.begin() + size}), E_INVALIDARG) << size;
  }
  EXPECT_EQ(create_with(stored()), E_INVALIDARG);
}

TEST_F(PipelineLibraryTest, EveryMemberOfADescriptionCounts) {
  ComPtr<ID3DBlob> blob;
  ASSERT_EQ(graphics()->GetCachedBlob(blob.GetAddressOf()), S_OK);
  const auto create = [&](auto&& change) {
    auto desc = graphics_desc();
    D3D12_INPUT_ELEMENT_DESC element = desc.InputLayout.pInputElementDescs[0];
    desc.InputLayout.pInputElementDescs = &element;
    desc.CachedPSO = {blob->GetBufferPointer(), blob->GetBufferSize()};
    change(desc, element);
    ComPtr<ID3D12PipelineState> made;
    return device_->CreateGraphicsPipelineState(&desc, IID_PPV_ARGS(made.GetAddressOf()));
  };
  EXPECT_EQ(create([](auto&, auto&) {}), S_OK);
  EXPECT_EQ(create([](auto& desc, auto&) { desc.NodeMask = 1; }), S_OK);
  EXPECT_EQ(create([](auto& desc, auto&) { desc.SampleMask = 1; }), E_INVALIDARG);
  EXPECT_EQ(create([](auto& desc, auto&) { desc.PS = {}; }), E_INVALIDARG);
  EXPECT_EQ(create([](auto& desc, auto&) { desc.RasterizerState.DepthBias = 1; }), E_INVALIDARG);
  EXPECT_EQ(create([](auto& desc, auto&) { desc.DSVFormat = DXGI_FORMAT_D32_FLOAT; }),
            E_INVALIDARG);
  EXPECT_EQ(
      create([](auto& desc, auto&) { desc.BlendState.RenderTarget[7].RenderTargetWriteMask = 1; }),
      E_INVALIDARG);
  EXPECT_EQ(create([](auto& desc, auto&) {
              desc.DepthStencilState.BackFace.StencilFunc = D3D12_COMPARISON_FUNC_LESS;
            }),
            E_INVALIDARG);
  EXPECT_EQ(create([](auto&, auto& element) { element.AlignedByteOffset = 4; }), E_INVALIDARG);
  EXPECT_EQ(create([](auto&, auto& element) { element.SemanticName = "NORMAL"; }), E_INVALIDARG);
}

TEST_F(PipelineLibraryTest, APipelineIsFoundByItsNameAndDescription) {
  ComPtr<ID3D12PipelineLibrary1> library;
  ASSERT_EQ(open({}, library), S_OK);
  ComPtr<ID3D12PipelineState> loaded;
  EXPECT_EQ(load(library.Get(), L"c", compute_desc(), loaded), E_INVALIDARG);
  const auto made = compute();
  EXPECT_EQ(library->StorePipeline(L"c", made.Get()), S_OK);
  EXPECT_EQ(library->StorePipeline(L"c", graphics().Get()), E_INVALIDARG);
  EXPECT_EQ(library->StorePipeline(nullptr, made.Get()), E_INVALIDARG);
  EXPECT_EQ(load(library.Get(), L"c", compute_desc(), loaded), S_OK);
  EXPECT_EQ(loaded.Get(), made.Get());
  auto other = compute_desc();
  other.CS = CD3DX12_SHADER_BYTECODE(other_.Get());
  EXPECT_EQ(load(library.Get(), L"c", other, loaded), E_INVALIDARG);
  EXPECT_EQ(loaded, nullptr);
  EXPECT_EQ(load(library.Get(), L"c", graphics_desc(), loaded), E_INVALIDARG);
}

TEST_F(PipelineLibraryTest, ALibraryIsWrittenAndReadAgain) {
  const auto blob = stored();
  ComPtr<ID3D12PipelineLibrary1> library;
  ASSERT_EQ(open(blob, library), S_OK);
  std::vector<std::byte> again(library->GetSerializedSize());
  EXPECT_EQ(library->Serialize(again.data(), again.size() - 1), E_INVALIDARG);
  EXPECT_EQ(library->Serialize(again.data(), again.size()), S_OK);
  EXPECT_EQ(again, blob);
  ComPtr<ID3D12PipelineState> first, second;
  EXPECT_EQ(load(library.Get(), L"g\x00E4", graphics_desc(), first), S_OK);
  auto stream = CD3DX12_PIPELINE_STATE_STREAM(graphics_desc());
  const D3D12_PIPELINE_STATE_STREAM_DESC desc = {sizeof stream, &stream};
  EXPECT_EQ(library->LoadPipeline(L"g\x00E4", &desc, IID_PPV_ARGS(second.GetAddressOf())), S_OK);
  EXPECT_EQ(first.Get(), second.Get());
  EXPECT_EQ(load(library.Get(), L"c", compute_desc(), first), S_OK);
  auto changed = graphics_desc();
  changed.RTVFormats[0] = DXGI_FORMAT_R16G16B16A16_FLOAT;
  EXPECT_EQ(load(library.Get(), L"g\x00E4", changed, first), E_INVALIDARG);
}

// An empty file that a program maps.
TEST_F(PipelineLibraryTest, NoBytesAreAnEmptyLibrary) {
  ComPtr<ID3D12PipelineLibrary> library;
  const char byte = 0;
  ASSERT_EQ(device_->CreatePipelineLibrary(&byte, 0, IID_PPV_ARGS(library.GetAddressOf())), S_OK);
  ComPtr<ID3D12PipelineState> none;
  EXPECT_EQ(load(library.Get(), L"c", compute_desc(), none), E_INVALIDARG);
  EXPECT_TRUE(messages().empty());
  EXPECT_EQ(library->StorePipeline(L"c", compute().Get()), S_OK);
  EXPECT_EQ(load(library.Get(), L"c", compute_desc(), none), S_OK);
  EXPECT_EQ(device_->CreatePipelineLibrary(nullptr, 1, IID_PPV_ARGS(library.GetAddressOf())),
            E_INVALIDARG);
}

// The object stays in the library after a program's last reference.
TEST_F(PipelineLibraryTest, ALoadedPipelineIsOneObject) {
  ComPtr<ID3D12PipelineLibrary1> library;
  ASSERT_EQ(open(stored(), library), S_OK);
  ComPtr<ID3D12PipelineState> loaded;
  ASSERT_EQ(load(library.Get(), L"c", compute_desc(), loaded), S_OK);
  ID3D12PipelineState* const object = loaded.Detach();
  EXPECT_EQ(object->Release(), 0u);
  ASSERT_EQ(load(library.Get(), L"c", compute_desc(), loaded), S_OK);
  EXPECT_EQ(loaded.Get(), object);
  library.Reset();
  list_->SetPipelineState(loaded.Get());
  EXPECT_EQ(loaded.Reset(), 0u);
}

TEST_F(PipelineLibraryTest, ADamagedLibraryIsRefused) {
  const auto blob = stored();
  ComPtr<ID3D12PipelineLibrary1> library;
  for (size_t size = 1; size < blob.size(); ++size) {
    ASSERT_EQ(open({blob.begin(), blob.begin() + size}, library), E_INVALIDARG) << size;
  }
  EXPECT_EQ(open(rewritten(blob, fourcc("KVER"), "0.0.1"), library),
            D3D12_ERROR_DRIVER_VERSION_MISMATCH);
  // A name that is longer than the rest, in a container that is whole.
  std::string content(16, '\1');
  content += "\xFF\x01\x01\x01nam";
  EXPECT_EQ(open(rewritten(blob, fourcc("KPLB"), content.c_str()), library), E_INVALIDARG);
  EXPECT_EQ(open(rewritten(blob, fourcc("KPLB"), "short"), library), E_INVALIDARG);
  EXPECT_EQ(device_->CreatePipelineLibrary(nullptr, 4, IID_PPV_ARGS(library.GetAddressOf())),
            E_INVALIDARG);
  EXPECT_EQ(device_->CreatePipelineLibrary(nullptr, 0, IID_ID3D12PipelineLibrary, nullptr),
            S_FALSE);
}

}  // namespace
}  // namespace kaamos::d3d12
