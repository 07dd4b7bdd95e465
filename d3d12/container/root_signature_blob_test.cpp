// SPDX-License-Identifier: MIT
// Serialized root signatures, byte by byte, there and back, and damaged.
#include "d3d12/container/root_signature_blob.h"

#include <cstring>

#include <d3dcompiler.h>

#include "d3d12/com/errors.h"
#include "d3d12/container/container.h"
#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

// One table of a range, one CBV, three constants, a sampler.
struct Example {
  Example() {
    range.RangeType = D3D12_DESCRIPTOR_RANGE_TYPE_UAV;
    range.NumDescriptors = 2;
    range.BaseShaderRegister = 4;
    range.RegisterSpace = 1;
    range.Flags = D3D12_DESCRIPTOR_RANGE_FLAG_DATA_VOLATILE;
    range.OffsetInDescriptorsFromTableStart = D3D12_DESCRIPTOR_RANGE_OFFSET_APPEND;
    parameters[0].ParameterType = D3D12_ROOT_PARAMETER_TYPE_DESCRIPTOR_TABLE;
    parameters[0].DescriptorTable = {1, &range};
    parameters[1].ParameterType = D3D12_ROOT_PARAMETER_TYPE_CBV;
    parameters[1].Descriptor = {3, 0, D3D12_ROOT_DESCRIPTOR_FLAG_DATA_STATIC};
    parameters[1].ShaderVisibility = D3D12_SHADER_VISIBILITY_PIXEL;
    parameters[2].ParameterType = D3D12_ROOT_PARAMETER_TYPE_32BIT_CONSTANTS;
    parameters[2].Constants = {0, 2, 3};
    sampler.Filter = D3D12_FILTER_MIN_MAG_MIP_LINEAR;
    sampler.AddressU = sampler.AddressV = sampler.AddressW = D3D12_TEXTURE_ADDRESS_MODE_CLAMP;
    sampler.MaxLOD = 8;
    sampler.ShaderRegister = 5;
    desc.Version = D3D_ROOT_SIGNATURE_VERSION_1_1;
    desc.Desc_1_1 = {3, parameters, 1, &sampler,
                     D3D12_ROOT_SIGNATURE_FLAG_ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT};
  }
  D3D12_DESCRIPTOR_RANGE1 range = {};
  D3D12_ROOT_PARAMETER1 parameters[3] = {};
  D3D12_STATIC_SAMPLER_DESC sampler = {};
  D3D12_VERSIONED_ROOT_SIGNATURE_DESC desc = {};
};

std::vector<uint32_t> words(std::span<const std::byte> bytes) {
  std::vector<uint32_t> out(bytes.size() / 4);
  std::memcpy(out.data(), bytes.data(), out.size() * 4);
  return out;
}

// The layout, by hand: header, three parameters, their rest, a sampler. [vkd3d, DXC: RTS0]
TEST(RootSignatureBlob, EveryWordIsWhereToolsExpectIt) {
  const Example example;
  const auto desc = root_signature_desc(example.desc);
  ASSERT_TRUE(desc.ok());
  const auto part = words(write_root_signature(*desc, D3D_ROOT_SIGNATURE_VERSION_1_1));
  const std::vector<uint32_t> expected = {
      2, 3,  24,  1, 116, 1,            // version 1.1, 3 parameters at 24, 1 sampler at 116, flags
      0, 0,  60,                        // a table, all shaders
      2, 5,  92,                        // a CBV, pixel shaders
      1, 0,  104,                       // constants
      1, 68,                            // the table: 1 range at 68
      1, 2,  4,   1, 2,   0xFFFFFFFFu,  // UAV, 2 descriptors, u4, space 1, volatile, append
      3, 0,  8,                         // the CBV: b3, static
      0, 2,  3};                        // constants: b0, space 2, 3 values
  ASSERT_EQ(part.size(), expected.size() + 13);
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(part[i], expected[i]) << "word " << i;
  EXPECT_EQ(part[expected.size()], static_cast<uint32_t>(D3D12_FILTER_MIN_MAG_MIP_LINEAR));
  EXPECT_EQ(part[expected.size() + 10], 5u);  // s5
}

TEST(RootSignatureBlob, ADescriptionComesBackAtEitherVersion) {
  const Example example;
  ComPtr<ID3DBlob> blob, errors;
  ASSERT_EQ(D3D12SerializeVersionedRootSignature(&example.desc, blob.GetAddressOf(),
                                                 errors.GetAddressOf()),
            S_OK);
  EXPECT_EQ(errors.Get(), nullptr);
  ComPtr<ID3D12VersionedRootSignatureDeserializer> deserializer;
  ASSERT_EQ(
      D3D12CreateVersionedRootSignatureDeserializer(blob->GetBufferPointer(), blob->GetBufferSize(),
                                                    IID_PPV_ARGS(deserializer.GetAddressOf())),
      S_OK);
  const D3D12_VERSIONED_ROOT_SIGNATURE_DESC* back = deserializer->GetUnconvertedRootSignatureDesc();
  ASSERT_EQ(back->Version, D3D_ROOT_SIGNATURE_VERSION_1_1);
  ASSERT_EQ(back->Desc_1_1.NumParameters, 3u);
  EXPECT_EQ(back->Desc_1_1.pParameters[0].DescriptorTable.pDescriptorRanges[0].NumDescriptors, 2u);
  EXPECT_EQ(back->Desc_1_1.pParameters[1].ShaderVisibility, D3D12_SHADER_VISIBILITY_PIXEL);
  EXPECT_EQ(back->Desc_1_1.pStaticSamplers[0].MaxLOD, 8);
  ASSERT_EQ(deserializer->GetRootSignatureDescAtVersion(D3D_ROOT_SIGNATURE_VERSION_1_0, &back),
            S_OK);
  EXPECT_EQ(back->Desc_1_0.pParameters[2].Constants.Num32BitValues, 3u);
}

// Version 1.2: flags at the end of each static sampler. The older versions leave them out.
TEST(RootSignatureBlob, Version12HasFlagsOfStaticSamplers) {
  D3D12_STATIC_SAMPLER_DESC1 samplers[2] = {};
  for (UINT i = 0; i < 2; ++i) {
    samplers[i].AddressU = samplers[i].AddressV = samplers[i].AddressW =
        D3D12_TEXTURE_ADDRESS_MODE_BORDER;
    samplers[i].ShaderRegister = 5 + i;
  }
  samplers[1].BorderColor = D3D12_STATIC_BORDER_COLOR_OPAQUE_WHITE_UINT;
  samplers[1].Flags = D3D12_SAMPLER_FLAG_UINT_BORDER_COLOR;
  const D3D12_ROOT_SIGNATURE_DESC2 newest = {0, nullptr, 2, samplers,
                                             D3D12_ROOT_SIGNATURE_FLAG_NONE};
  D3D12_VERSIONED_ROOT_SIGNATURE_DESC desc = {};
  desc.Version = D3D_ROOT_SIGNATURE_VERSION_1_2;
  std::memcpy(&desc.Desc_1_1, &newest, sizeof(newest));
  ComPtr<ID3DBlob> blob;
  ASSERT_EQ(D3D12SerializeVersionedRootSignature(&desc, blob.GetAddressOf(), nullptr), S_OK);
  const auto parts = read_container(blob->GetBufferPointer(), blob->GetBufferSize());
  ASSERT_TRUE(parts.ok());
  const std::vector<uint32_t> part = words((*parts)[0].bytes);
  ASSERT_EQ(part.size(), 6u + 2 * 14);
  EXPECT_EQ(part[0], 3u);
  EXPECT_EQ(part[6 + 13], 0u);
  EXPECT_EQ(part[6 + 14 + 7], 4u);
  EXPECT_EQ(part[6 + 14 + 13], 1u) << "the last sampler's flags";

  ComPtr<ID3D12VersionedRootSignatureDeserializer> reader;
  ASSERT_EQ(
      D3D12CreateVersionedRootSignatureDeserializer(blob->GetBufferPointer(), blob->GetBufferSize(),
                                                    IID_PPV_ARGS(reader.GetAddressOf())),
      S_OK);
  const D3D12_VERSIONED_ROOT_SIGNATURE_DESC* read = reader->GetUnconvertedRootSignatureDesc();
  ASSERT_EQ(read->Version, D3D_ROOT_SIGNATURE_VERSION_1_2);
  EXPECT_EQ(desc_1_2(*read).pStaticSamplers[1].Flags, D3D12_SAMPLER_FLAG_UINT_BORDER_COLOR);
  for (const auto version : {D3D_ROOT_SIGNATURE_VERSION_1_0, D3D_ROOT_SIGNATURE_VERSION_1_1}) {
    ASSERT_EQ(reader->GetRootSignatureDescAtVersion(version, &read), S_OK);
    ASSERT_EQ(read->Desc_1_0.NumStaticSamplers, 2u);
    EXPECT_EQ(read->Desc_1_0.pStaticSamplers[1].ShaderRegister, 6u);
    EXPECT_EQ(read->Desc_1_0.pStaticSamplers[1].BorderColor,
              D3D12_STATIC_BORDER_COLOR_OPAQUE_WHITE_UINT);
  }
}

TEST(RootSignatureBlob, DeserializersHaveNoOtherInterface) {
  const Example example;
  ComPtr<ID3DBlob> blob;
  ASSERT_EQ(D3D12SerializeVersionedRootSignature(&example.desc, blob.GetAddressOf(), nullptr),
            S_OK);
  void* made = nullptr;
  EXPECT_EQ(D3D12CreateRootSignatureDeserializer(blob->GetBufferPointer(), blob->GetBufferSize(),
                                                 IID_IUnknown, &made),
            E_NOINTERFACE);
  EXPECT_EQ(D3D12CreateVersionedRootSignatureDeserializer(
                blob->GetBufferPointer(), blob->GetBufferSize(), IID_IUnknown, &made),
            E_NOINTERFACE);
  ComPtr<ID3D12RootSignatureDeserializer> reader;
  EXPECT_EQ(D3D12CreateRootSignatureDeserializer(blob->GetBufferPointer(), blob->GetBufferSize(),
                                                 IID_PPV_ARGS(reader.GetAddressOf())),
            S_OK);
}

TEST(RootSignatureBlob, DamagedBytesAreRefusedWithoutACrash) {
  const Example example;
  const auto desc = root_signature_desc(example.desc);
  const std::vector<std::byte> part = write_root_signature(*desc, D3D_ROOT_SIGNATURE_VERSION_1_1);
  for (size_t size = 0; size < part.size(); ++size) {
    EXPECT_FALSE(read_root_signature(std::span(part).first(size)).ok()) << size;
  }
  // Any word replaced by a large number: refused, or a description that differs.
  for (size_t i = 0; i + 4 <= part.size(); i += 4) {
    std::vector<std::byte> damaged = part;
    const uint32_t large = 0x7FFFFFFF;
    std::memcpy(damaged.data() + i, &large, 4);
    const auto read = read_root_signature(damaged);
    if (!read.ok()) {
      EXPECT_EQ(read.error().id, public_id(ErrorId::kRootSignatureBlob)) << i;
    }
  }
}

class RootSignatureCalls : public D3d12Test {};

TEST_F(RootSignatureCalls, ABlobMakesARootSignatureAndJunkDoesNot) {
  const Example example;
  ComPtr<ID3DBlob> blob;
  ASSERT_EQ(D3D12SerializeVersionedRootSignature(&example.desc, blob.GetAddressOf(), nullptr),
            S_OK);
  ComPtr<ID3D12RootSignature> root_signature;
  EXPECT_EQ(device_->CreateRootSignature(0, blob->GetBufferPointer(), blob->GetBufferSize(),
                                         IID_PPV_ARGS(root_signature.GetAddressOf())),
            S_OK);
  const char junk[] = "this is no root signature";
  EXPECT_EQ(device_->CreateRootSignature(0, junk, sizeof(junk),
                                         IID_PPV_ARGS(root_signature.ReleaseAndGetAddressOf())),
            E_INVALIDARG);
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA4021");
}

TEST_F(RootSignatureCalls, AnUnknownVersionFillsTheErrorBlob) {
  D3D12_VERSIONED_ROOT_SIGNATURE_DESC desc = {};
  desc.Version = static_cast<D3D_ROOT_SIGNATURE_VERSION>(9);
  ComPtr<ID3DBlob> blob, errors;
  EXPECT_EQ(D3D12SerializeVersionedRootSignature(&desc, blob.GetAddressOf(), errors.GetAddressOf()),
            E_INVALIDARG);
  EXPECT_EQ(blob.Get(), nullptr);
  ASSERT_NE(errors.Get(), nullptr);
  EXPECT_NE(std::string(static_cast<const char*>(errors->GetBufferPointer())).find("Version is 9"),
            std::string::npos);
}

TEST_F(RootSignatureCalls, SerializingChecksTheRulesOfRootSignatures) {
  D3D12_ROOT_PARAMETER parameters[2] = {};
  for (D3D12_ROOT_PARAMETER& parameter : parameters) {
    parameter.ParameterType = D3D12_ROOT_PARAMETER_TYPE_UAV;
    parameter.Descriptor.ShaderRegister = 3;
  }
  const D3D12_ROOT_SIGNATURE_DESC desc = {2, parameters, 0, nullptr,
                                          D3D12_ROOT_SIGNATURE_FLAG_NONE};
  ComPtr<ID3DBlob> blob, errors;
  EXPECT_EQ(D3D12SerializeRootSignature(&desc, D3D_ROOT_SIGNATURE_VERSION_1, blob.GetAddressOf(),
                                        errors.GetAddressOf()),
            E_INVALIDARG);
  EXPECT_EQ(blob.Get(), nullptr);
  ASSERT_NE(errors.Get(), nullptr);
  const std::string text = static_cast<const char*>(errors->GetBufferPointer());
  EXPECT_EQ(text.substr(0, 6), "KA0604");
  EXPECT_NE(text.find("u3"), std::string::npos) << text;
}

TEST_F(RootSignatureCalls, ALibrarysOnlyGlobalOneIsTaken) {
  const auto compile = [](const std::string& text) {
    ComPtr<ID3DBlob> code;
    EXPECT_EQ(D3DCompile(text.data(), text.size(), "library.hlsl", nullptr, nullptr, nullptr,
                         "lib_6_3", 0, 0, code.GetAddressOf(), nullptr),
              S_OK);
    return code;
  };
  const auto create = [&](ID3DBlob* code) {
    ComPtr<ID3D12RootSignature> made;
    return device_->CreateRootSignature(0, code->GetBufferPointer(), code->GetBufferSize(),
                                        IID_PPV_ARGS(made.GetAddressOf()));
  };
  const std::string shader = "struct P { float v; }; [shader(\"miss\")] void Miss(inout P p) {}";
  EXPECT_EQ(create(compile("GlobalRootSignature g = {\"SRV(t0)\"};" + shader).Get()), S_OK);
  EXPECT_EQ(messages().size(), 0u);
  EXPECT_EQ(create(compile(shader).Get()), E_FAIL);
  ASSERT_EQ(messages().size(), 1u);
  EXPECT_EQ(messages()[0].substr(0, 6), "KA0633");
}

TEST_F(RootSignatureCalls, Version10ReadAs11IsVolatile) {
  D3D12_DESCRIPTOR_RANGE ranges[2] = {};
  ranges[0] = {D3D12_DESCRIPTOR_RANGE_TYPE_SRV, 1, 0, 0, 0};
  D3D12_ROOT_PARAMETER parameters[2] = {};
  parameters[0].ParameterType = D3D12_ROOT_PARAMETER_TYPE_DESCRIPTOR_TABLE;
  parameters[0].DescriptorTable = {1, ranges};
  parameters[1].ParameterType = D3D12_ROOT_PARAMETER_TYPE_CBV;
  const D3D12_ROOT_SIGNATURE_DESC desc = {2, parameters, 0, nullptr,
                                          D3D12_ROOT_SIGNATURE_FLAG_NONE};
  ComPtr<ID3DBlob> blob;
  ASSERT_EQ(D3D12SerializeRootSignature(&desc, D3D_ROOT_SIGNATURE_VERSION_1, blob.GetAddressOf(),
                                        nullptr),
            S_OK);
  ComPtr<ID3D12VersionedRootSignatureDeserializer> reader;
  ASSERT_EQ(
      D3D12CreateVersionedRootSignatureDeserializer(blob->GetBufferPointer(), blob->GetBufferSize(),
                                                    IID_PPV_ARGS(reader.GetAddressOf())),
      S_OK);
  const D3D12_VERSIONED_ROOT_SIGNATURE_DESC* read = nullptr;
  ASSERT_EQ(reader->GetRootSignatureDescAtVersion(D3D_ROOT_SIGNATURE_VERSION_1_1, &read), S_OK);
  EXPECT_EQ(
      read->Desc_1_1.pParameters[0].DescriptorTable.pDescriptorRanges[0].Flags,
      D3D12_DESCRIPTOR_RANGE_FLAG_DESCRIPTORS_VOLATILE | D3D12_DESCRIPTOR_RANGE_FLAG_DATA_VOLATILE);
  EXPECT_EQ(read->Desc_1_1.pParameters[1].Descriptor.Flags,
            D3D12_ROOT_DESCRIPTOR_FLAG_DATA_VOLATILE);
}

TEST_F(RootSignatureCalls, AnUnknownVersionOfTheOldCallFillsTheErrorBlob) {
  const D3D12_ROOT_SIGNATURE_DESC desc = {};
  auto* blob = reinterpret_cast<ID3DBlob*>(1);
  ComPtr<ID3DBlob> errors;
  EXPECT_EQ(D3D12SerializeRootSignature(&desc, D3D_ROOT_SIGNATURE_VERSION_1_1, &blob,
                                        errors.GetAddressOf()),
            E_INVALIDARG);
  EXPECT_EQ(blob, reinterpret_cast<ID3DBlob*>(1)) << "left as it was";
  EXPECT_NE(errors.Get(), nullptr);
}

}  // namespace
}  // namespace kaamos::d3d12
