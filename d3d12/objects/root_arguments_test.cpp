// SPDX-License-Identifier: MIT
// Which root argument or static sampler a register of a shader reads, on each backend.
#include <cstring>
#include <string>

#include <d3dcompiler.h>
#include <directx/d3dx12.h>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class RootArguments : public D3d12BackendTest {
 protected:
  void SetUp() override {
    D3d12BackendTest::SetUp();
    if (IsSkipped()) return;
    out_ = buffer(256, D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                  D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
    readback_ = buffer(256, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  }

  ComPtr<ID3D12RootSignature> signature(const std::string& text) {
    const std::string source =
        "[RootSignature(\"" + text + "\")] [numthreads(1, 1, 1)] void main() {}";
    ComPtr<ID3DBlob> code = compile(source);
    ComPtr<ID3D12RootSignature> out;
    EXPECT_EQ(device_->CreateRootSignature(0, code->GetBufferPointer(), code->GetBufferSize(),
                                           IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }
  HRESULT pipeline(ID3D12RootSignature* signature, const std::string& source) {
    ComPtr<ID3DBlob> code = compile(source);
    D3D12_COMPUTE_PIPELINE_STATE_DESC desc = {};
    desc.pRootSignature = signature;
    desc.CS = {code->GetBufferPointer(), code->GetBufferSize()};
    return device_->CreateComputePipelineState(&desc,
                                               IID_PPV_ARGS(pipeline_.ReleaseAndGetAddressOf()));
  }
  static ComPtr<ID3DBlob> compile(const std::string& source) {
    ComPtr<ID3DBlob> code;
    EXPECT_EQ(D3DCompile(source.data(), source.size(), "root_arguments.hlsl", nullptr, nullptr,
                         "main", "cs_6_0", 0, 0, code.GetAddressOf(), nullptr),
              S_OK);
    return code;
  }
  D3D12_GPU_VIRTUAL_ADDRESS out(UINT word) const {
    return out_->GetGPUVirtualAddress() + UINT64{word} * 4;
  }
  void dispatch() {
    list_->SetPipelineState(pipeline_.Get());
    list_->Dispatch(1, 1, 1);
    const auto barrier = CD3DX12_RESOURCE_BARRIER::UAV(out_.Get());
    list_->ResourceBarrier(1, &barrier);
  }
  // Runs the list; the words that the shaders wrote.
  std::vector<uint32_t> run_and_read() {
    const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(
        out_.Get(), D3D12_RESOURCE_STATE_UNORDERED_ACCESS, D3D12_RESOURCE_STATE_COPY_SOURCE);
    list_->ResourceBarrier(1, &barrier);
    list_->CopyResource(readback_.Get(), out_.Get());
    run();
    std::vector<uint32_t> words(64);
    void* data = nullptr;
    EXPECT_EQ(readback_->Map(0, nullptr, &data), S_OK);
    std::memcpy(words.data(), data, 256);
    readback_->Unmap(0, nullptr);
    return words;
  }

  ComPtr<ID3D12Resource> out_, readback_;
  ComPtr<ID3D12PipelineState> pipeline_;
};

INSTANTIATE_TEST_SUITE_P(Backends, RootArguments, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return std::string(backend.param); });

// Each static sampler clamps to a mip of its own.
TEST_P(RootArguments, AnArrayWithoutSizeReadsTheStaticSamplerAtItsRegister) {
  const auto mip = [](const char* where, const char* level) {
    return std::string(", StaticSampler(") + where +
           ", filter = FILTER_MIN_MAG_MIP_POINT, minLOD = " + level + ", maxLOD = " + level + ")";
  };
  const auto root =
      signature("UAV(u0), DescriptorTable(SRV(t0))" + mip("s2", "1") + mip("s3", "0"));
  const std::string body =
      "Texture2D<float> t : register(t0); RWByteAddressBuffer o : register(u0);"
      "[numthreads(1, 1, 1)] void main() { uint i = 0; [loop] for (; i < 4; ++i) "
      "o.Store(4 * i, asuint(t.SampleLevel(s[NonUniformResourceIndex(i)], 0.5, 0))); }";
  EXPECT_EQ(pipeline(root.Get(), "SamplerState s[2] : register(s2);" + body), E_INVALIDARG);
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA0529");
  ASSERT_EQ(pipeline(root.Get(), "SamplerState s[] : register(s2);" + body), S_OK);

  D3D12_RESOURCE_DESC desc = texture_desc(2, 2, 1, DXGI_FORMAT_R32_FLOAT);
  desc.MipLevels = 2;
  const CD3DX12_HEAP_PROPERTIES heap(D3D12_HEAP_TYPE_DEFAULT);
  ComPtr<ID3D12Resource> texture;
  ASSERT_EQ(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                             D3D12_RESOURCE_STATE_COPY_DEST, nullptr,
                                             IID_PPV_ARGS(texture.GetAddressOf())),
            S_OK);
  ComPtr<ID3D12Resource> upload = buffer(1024, D3D12_HEAP_TYPE_UPLOAD);
  float* texels = nullptr;
  ASSERT_EQ(upload->Map(0, nullptr, reinterpret_cast<void**>(&texels)), S_OK);
  texels[0] = texels[1] = texels[64] = texels[65] = 3.0f;  // mip 0
  texels[128] = 7.0f;                                      // mip 1
  upload->Unmap(0, nullptr);
  for (UINT level = 0; level < 2; ++level) {
    const UINT side = 2 - level;
    const CD3DX12_TEXTURE_COPY_LOCATION to(texture.Get(), level);
    const CD3DX12_TEXTURE_COPY_LOCATION from(
        upload.Get(), {level * 512, {DXGI_FORMAT_R32_FLOAT, side, side, 1, 256}});
    list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
  }
  const auto barrier = CD3DX12_RESOURCE_BARRIER::Transition(
      texture.Get(), D3D12_RESOURCE_STATE_COPY_DEST, D3D12_RESOURCE_STATE_ALL_SHADER_RESOURCE);
  list_->ResourceBarrier(1, &barrier);

  const D3D12_DESCRIPTOR_HEAP_DESC views = {D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV, 1,
                                            D3D12_DESCRIPTOR_HEAP_FLAG_SHADER_VISIBLE, 0};
  ComPtr<ID3D12DescriptorHeap> view;
  ASSERT_EQ(device_->CreateDescriptorHeap(&views, IID_PPV_ARGS(view.GetAddressOf())), S_OK);
  device_->CreateShaderResourceView(texture.Get(), nullptr,
                                    view->GetCPUDescriptorHandleForHeapStart());
  ID3D12DescriptorHeap* heaps[] = {view.Get()};
  list_->SetDescriptorHeaps(1, heaps);
  list_->SetComputeRootSignature(root.Get());
  list_->SetComputeRootUnorderedAccessView(0, out(0));
  list_->SetComputeRootDescriptorTable(1, view->GetGPUDescriptorHandleForHeapStart());
  dispatch();
  const std::vector<uint32_t> words = run_and_read();
  for (uint32_t i = 0; i < 4; ++i) EXPECT_EQ(words[i], 0x40E00000u) << "7, index " << i;
}

TEST_P(RootArguments, ARootDescriptorIsTheFirstOfAnArrayWithoutSize) {
  const auto root = signature("UAV(u1)");
  const char body[] = "[numthreads(1, 1, 1)] void main() { u[0].Store(8, 5); }";
  EXPECT_EQ(pipeline(root.Get(), std::string("RWByteAddressBuffer u[1] : register(u1);") + body),
            S_OK);
  EXPECT_EQ(pipeline(root.Get(), std::string("RWByteAddressBuffer u[2] : register(u1);") + body),
            E_INVALIDARG);
  ASSERT_EQ(pipeline(root.Get(), std::string("RWByteAddressBuffer u[] : register(u1);") + body),
            S_OK);
  list_->SetComputeRootSignature(root.Get());
  list_->SetComputeRootUnorderedAccessView(0, out(0));
  dispatch();
  EXPECT_EQ(run_and_read()[2], 5u);
}

constexpr char kStoreConstants[] =
    "RWByteAddressBuffer o : register(u0); cbuffer c : register(b0) { uint x, y, z; };"
    "[numthreads(1, 1, 1)] void main() { o.Store3(0, uint3(x, y, z)); }";

// Undefined in D3D12; drivers leave the registers as they are.
TEST_P(RootArguments, AnotherSignatureKeepsTheArgumentsOfParametersOfTheSameType) {
  const auto before = signature("UAV(u0), RootConstants(num32BitConstants = 2, b0), UAV(u7)");
  const auto after = signature(
      "UAV(u0), RootConstants(num32BitConstants = 3, b0), RootConstants(num32BitConstants = 1, "
      "b1)");
  ASSERT_EQ(pipeline(after.Get(), kStoreConstants), S_OK);
  list_->SetComputeRootSignature(before.Get());
  list_->SetComputeRootUnorderedAccessView(0, out(1));
  const uint32_t values[] = {21, 22};
  list_->SetComputeRoot32BitConstants(1, 2, values, 0);
  list_->SetComputeRootSignature(after.Get());
  list_->SetComputeRoot32BitConstant(1, 20, 0);
  dispatch();
  const std::vector<uint32_t> words = run_and_read();
  EXPECT_EQ(words[1], 20u);
  EXPECT_EQ(words[2], 22u) << "kept";
  EXPECT_EQ(words[3], 0u) << "never set";
}

// The pipeline was made with a signature, which decides what registers read.
TEST_P(RootArguments, TheSignatureOfThePipelineDecidesWhichRegisterReadsAnArgument) {
  const auto straight = signature("UAV(u0), UAV(u1)");
  const auto crossed = signature("UAV(u1), UAV(u0)");
  const auto other = signature("UAV(u1), CBV(b0)");
  ASSERT_EQ(pipeline(straight.Get(),
                     "RWByteAddressBuffer a : register(u0), b : register(u1);"
                     "[RootSignature(\"UAV(u1), UAV(u0)\")] [numthreads(1, 1, 1)] void main() "
                     "{ a.Store(0, 1); b.Store(0, 2); }"),
            S_OK);
  UINT word = 0;
  for (ID3D12RootSignature* set : {straight.Get(), crossed.Get()}) {
    list_->SetComputeRootSignature(set);
    list_->SetComputeRootUnorderedAccessView(0, out(word++));
    list_->SetComputeRootUnorderedAccessView(1, out(word++));
    dispatch();
  }
  const std::vector<uint32_t> words = run_and_read();
  EXPECT_EQ(std::vector<uint32_t>(words.begin(), words.begin() + 4),
            (std::vector<uint32_t>{1, 2, 1, 2}));
  ASSERT_EQ(messages().size(), 1u) << "an error all the same";
  EXPECT_EQ(messages()[0].substr(0, 6), "KA0812");
  // Arguments that lie elsewhere are none for the pipeline.
  list_->SetComputeRootSignature(other.Get());
  list_->SetComputeRootUnorderedAccessView(0, out(8));
  list_->SetComputeRootConstantBufferView(1, out_->GetGPUVirtualAddress());
  dispatch();
  EXPECT_EQ(run_and_read()[8], 0u);
  ASSERT_EQ(messages().size(), 2u);
  EXPECT_EQ(messages()[1].substr(0, 6), "KA0812");
}

// [D3D12: CreateRootSignatureFromSubobjectInLibrary]
TEST_P(RootArguments, ASubobjectOfALibraryIsARootSignature) {
  const std::string library =
      "GlobalRootSignature first = {\"RootConstants(num32BitConstants=1, b0), UAV(u0)\"};"
      "GlobalRootSignature second = {\"UAV(u0), RootConstants(num32BitConstants=1, b0)\"};";
  ComPtr<ID3DBlob> code;
  ASSERT_EQ(D3DCompile(library.data(), library.size(), "library.hlsl", nullptr, nullptr, "",
                       "lib_6_3", 0, 0, code.GetAddressOf(), nullptr),
            S_OK);
  ComPtr<ID3D12Device14> device;
  ASSERT_EQ(device_.As(&device), S_OK);
  ComPtr<ID3D12RootSignature> second;
  ASSERT_EQ(device->CreateRootSignatureFromSubobjectInLibrary(0, code->GetBufferPointer(),
                                                              code->GetBufferSize(), L"second",
                                                              IID_PPV_ARGS(second.GetAddressOf())),
            S_OK);
  ASSERT_EQ(pipeline(second.Get(),
                     "cbuffer C : register(b0) { uint c; } RWByteAddressBuffer o : register(u0);"
                     "[numthreads(1, 1, 1)] void main() { o.Store(0, c); }"),
            S_OK);
  list_->SetComputeRootSignature(second.Get());
  list_->SetComputeRootUnorderedAccessView(0, out(0));
  list_->SetComputeRoot32BitConstant(1, 42, 0);
  dispatch();
  EXPECT_EQ(run_and_read()[0], 42u);
  for (const wchar_t* name : {L"third", L""}) {
    EXPECT_EQ(device->CreateRootSignatureFromSubobjectInLibrary(
                  0, code->GetBufferPointer(), code->GetBufferSize(), name,
                  IID_PPV_ARGS(second.ReleaseAndGetAddressOf())),
              E_INVALIDARG);
  }
}

}  // namespace
}  // namespace kaamos::d3d12
